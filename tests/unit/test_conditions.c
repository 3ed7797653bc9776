/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Boundary conditions on a mesh: what flows through each boundary is what its own line says, also at the nodes that
 * it shares with others. */
#include "support/opened.h"
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <string.h>

/* Outflow through a named boundary by the finite-element function. */
static double flux(const problem *p, const char *name)
{
    const mesh *m = &p->mesh;
    int bit = mesh_find_name(m, name), u = space_find_field(&p->space, "u");
    double sum = 0;
    error err;

    assert_true(bit >= 0);
    for (int64_t f = 0; f < m->n_facet; f++) {
        const int32_t *cell = m->cell + (int64_t)m->facet[f].cell * m->type->n_node;
        double weight[FE_MAX_FACET_NODES][3], all[3];

        if (!(m->facet[f].names >> bit & 1))
            continue;
        assert_int_equal(facet_weights(m, f, weight, all, &err), 0);
        for (int k = 0; k < m->type->facet_nodes; k++)
            for (int a = 0; a < m->dim; a++)
                sum += weight[k][a] * p->state.x[p->space.first[u][cell[m->type->facet[m->facet[f].local][k]]] + a];
    }
    return sum;
}

static opened *start(const char *text)
{
    opened *k = open_text(text, NULL, 0);

    assert_int_equal(problem_initial(&k->p, &k->err), 0);
    return k;
}

#define FLOW "fluid { density = 1, viscosity = 1 }\nterm 'continuity' {}\nterm 'momentum' {}\n"

/* The lid moves, the walls stand: nothing flows through any side; the lid's own velocity stands everywhere but at
 * its ends. */
static void a_lid_pumps_nothing_through_the_walls(void **state)
{
    static const char *const side[] = {"left", "right", "bottom", "top", "back", "front"};

    (void)state;
    for (int kind = 0; kind < 5; kind++) {
        static const char *const text[] = {
            "mesh { box = {{0,0},{1,1}}, cells = {6,5} }\n" FLOW
            "boundary '*' { u = {0,0} }\nboundary 'top' { u = {1,0} }\n",
            "mesh { box = {{0,0},{1,1}}, cells = {6,5}, shape = 'triangles' }\n" FLOW
            "boundary 'top' { u = {1,0} }\nboundary 'left' { u = {0,0} }\nboundary 'right' { u = {0,0} }\n"
            "boundary 'bottom' { u = {0,0} }\n",
            "mesh { box = {{0,0,0},{1,1,1}}, cells = {3,4,3} }\n" FLOW
            "boundary '*' { u = {0,0,0} }\nboundary 'front' { u = {1,0.3,0} }\n",
            "mesh { box = {{0,0,0},{1,1,1}}, cells = {3,2,3}, shape = 'tets' }\n" FLOW
            "boundary '*' { u = {0,0,0} }\nboundary 'front' { u = {1,0.3,0} }\n",
            "mesh { box = {{0,0},{1,1}}, cells = {96,96} }\n" FLOW
            "boundary '*' { u = {0,0} }\nboundary 'top' { u = {1,0} }\n"};
        opened *k = start(text[kind]);
        int u = space_find_field(&k->p.space, "u"), moving = 0;

        for (int i = 0; i < 2 * k->p.mesh.dim; i++)
            assert_true(fabs(flux(&k->p, side[i])) <= 1e-14);
        for (int64_t n = 0; n < k->p.mesh.n_node; n++)
            moving += k->p.state.x[k->p.space.first[u][n]] == 1;
        assert_int_equal(moving, kind == 4   ? 191
                                 : kind < 2  ? 11
                                 : kind == 2 ? 5 * 9
                                             : 5 * 5); /* in 3D the edges along the motion move */
        close_case(k);
    }
}

/* A plug of fluid enters beside walls: all of it enters, whatever the order of the lines. */
static void an_inlet_keeps_its_flow_beside_walls(void **state)
{
    (void)state;
    for (int order = 0; order < 2; order++) {
        opened *k =
            start(order ? "mesh { box = {{0,0},{3,2}}, cells = {6,5} }\n" FLOW
                          "boundary 'left' { u = {0.5,0} }\nboundary 'bottom' { u = {0,0} }\n"
                          "boundary 'top' { u = {0,0} }\nboundary 'right' { natural = true }\n"
                        : "mesh { box = {{0,0},{3,2}}, cells = {6,5} }\n" FLOW "boundary '*' { u = {0,0} }\n"
                          "boundary 'right' { natural = true }\nboundary 'left' { u = {0.5,0} }\n");

        assert_true(fabs(flux(&k->p, "left") + 1) < 1e-14);
        assert_true(fabs(flux(&k->p, "top")) < 1e-14 && fabs(flux(&k->p, "bottom")) < 1e-14);
        close_case(k);
    }
}

/* Curved sides: a ring whose outer wall turns, with an inlet in its inner one; the radial parts stay. */
static void curved_boundaries_keep_their_flow(void **state)
{
    opened *k = start("mesh { box = {{0,1},{1.5,2}}, cells = {9,4}, map = function(a, r) return r*math.sin(a), "
                      "r*math.cos(a) end }\n" FLOW
                      "boundary 'bottom' { u = function(x, y) local r = math.sqrt(x*x+y*y) return x/r, y/r end }\n"
                      "boundary 'left' { u = {0,0} }\nboundary 'right' { u = {0,0} }\n"
                      "boundary 'top' { u = function(x, y) return x/4 - y, y/4 + x end }\n");
    double in = flux(&k->p, "bottom"), out = flux(&k->p, "top");

    (void)state;
    assert_true(fabs(fabs(in) - 1.5) < 1e-4);  /* the ring's inner side is an arc of length 1.5, speed 1 */
    assert_true(fabs(fabs(out) - 1.5) < 1e-4); /* outer: length 3, radial speed 1/2 */
    assert_true(fabs(flux(&k->p, "left")) < 1e-14 && fabs(flux(&k->p, "right")) < 1e-14);
    close_case(k);
}

/* Two lines that meet on one straight side (here the corner of a box, opened by z^2) cannot both keep their normal
 * component: a warning that names them and the place. */
static void a_contradiction_on_a_straight_side_is_told(void **state)
{
    (void)state;
    assert_ran(
        plugflow("check %s",
                 put_file("flat.lua", "mesh { box = {{0,0},{1,1}}, cells = {4,4}, map = function(x, y) return "
                                      "x*x - y*y, 2*x*y end }\n" FLOW
                                      "boundary 'left' { u = {0,1} }\nboundary 'bottom' { u = {0,0} }\n"
                                      "boundary 'right' { natural = true }\nboundary 'top' { natural = true }\n")),
        0, "ok", "warning: boundary \"bottom\" and \"left\" meet without an edge at (0, 0)",
        "keeps that of \"bottom\"");
    assert_ran(
        plugflow("check %s", put_file("edge.lua", "mesh { box = {{0,0},{1,1}}, cells = {4,4} }\n" FLOW
                                                  "boundary 'left' { u = {1,0} }\nboundary 'bottom' { u = {0,0} }\n"
                                                  "boundary 'right' { natural = true }\n"
                                                  "boundary 'top' { natural = true }\n")),
        0, "ok");
}

static void what_flows_in_must_flow_out(void **state)
{
    (void)state;
    assert_ran(plugflow("check %s", put_file("closed.lua", "mesh { box = {{0,0},{2,1}}, cells = {8,4} }\n" FLOW
                                                           "boundary '*' { u = {0,0} }\nboundary 'left' { u = "
                                                           "function(x, y) return 4*y*(1-y), 0 end }\n")),
               3, "closed.lua: u is prescribed on all boundaries", "the net outflow is -0.666667",
               "\"left\" -0.666667", "natural = true");
    assert_ran(plugflow("run --quiet --out %s/later %s", scratch(),
                        put_file("later.lua", "mesh { box = {{0,0},{2,1}}, cells = {8,4} }\n" FLOW
                                              "boundary '*' { u = {0,0} }\nboundary 'left' { u = function(x, y, t) "
                                              "return math.max(0, t - 0.25)*y*(1-y), 0 end }\n"
                                              "time { step = 0.1, stop = 1 }\n")),
               3, "at t = 0.3");
    /* balanced, but the mesh does not resolve it: no error */
    assert_ran(
        plugflow("check %s",
                 put_file("sines.lua", "mesh { box = {{0,0},{2,1}}, cells = {4,4} }\n" FLOW
                                       "boundary '*' { u = function(x, y) return math.sin(5*x)*math.cos(5*y), "
                                       "-math.cos(5*x)*math.sin(5*y) end }\n")),
        0, "ok");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_lid_pumps_nothing_through_the_walls),
        cmocka_unit_test(an_inlet_keeps_its_flow_beside_walls),
        cmocka_unit_test(curved_boundaries_keep_their_flow),
        cmocka_unit_test(a_contradiction_on_a_straight_side_is_told),
        cmocka_unit_test(what_flows_in_must_flow_out),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
