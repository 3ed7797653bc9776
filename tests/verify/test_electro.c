/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Charged and polarised bodies: balances that hold exactly, overdamped motions against their exact solutions, the
 * forces of pairs against the energy that they come from. */
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <plugflow/plugin.h>

#include <dlfcn.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Drag and field balance to round-off; the velocity is Faxen's between two walls.  Refined from 8 to 16 and 24
 * cells across, the disk 2, 4 and 6 cells wide, the drag is 1.0039, 1.00007 and 1.00002 of it. */
static void a_charge_falls_through_a_field_as_faxen_says(void **state)
{
    (void)state;
    assert_ran(plugflow("run cases/electro_charge.lua --quiet --out %s/charge", scratch()), 0, NULL);
    assert_between(summary("charge", "results.balance"), -1e-12, 1e-12);
    assert_between(summary("charge", "results.drag"), 0.999, 1.001);
}

/* The angle at the end, at a step, from the rate at the start that the steady case gives. */
static double angle(const char *name, double rate, double dt)
{
    assert_ran(plugflow("run cases/electro_%s.lua --quiet --set spin=%.17g --set dt=%g --out %s/turn", name, rate,
                        dt, scratch()),
               0, NULL);
    return summary("turn", "results.angle");
}

static double rate(const char *name)
{
    assert_ran(plugflow("run cases/electro_%s.lua --quiet --set steady=true --out %s/rate", name, scratch()), 0,
               NULL);
    return summary("rate", "results.omega");
}

/* zeta theta' = -m E sin(theta), zeta from the rate at the start. */
static void a_compass_turns_as_its_equation_says(void **state)
{
    const double start = rate("compass"), slope = start / sin(2.4);
    const double exact = 2 * atan(tan(1.2) * exp(2 * slope));

    (void)state;
    assert_between(summary("rate", "results.torque") / (0.9 * sin(2.4)) - 1, -1e-12, 1e-12);
    assert_between(angle("compass", start, 0.1) - exact, -5e-5, 5e-5);
    assert_between(angle("compass", start, 0.025) - exact, -1e-5, 1e-5);
}

/* Both turn at the same rate, by equal torques; zeta theta' = -(2 k m^2 / r^2) sin(2 theta).  The forces of the
 * pair keep the angular momentum: r x F = -2 T. */
static void two_dipoles_turn_alike_and_their_forces_make_up(void **state)
{
    const double start = rate("pair"), slope = 2 * start / sin(2.4);
    const double exact = atan(tan(1.2) * exp(2 * slope)), torque = 4 * 0.05 * 0.64 / 0.25 * sin(1.2) * cos(1.2);

    (void)state;
    assert_between(summary("rate", "results.torque") / torque - 1, -1e-12, 1e-12);
    assert_between(summary("rate", "results.other_torque") / torque - 1, -1e-12, 1e-12);
    assert_between(0.5 * summary("rate", "results.fy") / (2 * torque) - 1, -1e-12, 1e-12);
    assert_between(summary("rate", "results.fy") + summary("rate", "results.other_fy"), -1e-14, 1e-14);
    assert_between(angle("pair", start, 0.1) - exact, -5e-5, 5e-5);
    assert_between(angle("pair", start, 0.025) - exact, -1e-5, 1e-5);
    assert_between(summary("turn", "results.angle") - summary("turn", "results.other_angle"), -1e-8, 1e-8);
}

/* u(s) / s as a polynomial in s^2 through the places of steady cases, s = x - x0. */
enum { PLACES = 4 };

static double velocity(const double *place, const double *u, double s)
{
    double sum = 0;

    for (int i = 0; i < PLACES; i++) {
        double l = s * u[i] / place[i];

        for (int j = 0; j < PLACES; j++)
            if (j != i)
                l *= (s * s - place[j] * place[j]) / (place[i] * place[i] - place[j] * place[j]);
        sum += l;
    }
    return sum;
}

/* x' = u(x), u from steady cases, by Runge and Kutta's method. */
static void a_disk_in_a_trap_moves_as_its_equation_says(void **state)
{
    const double place[PLACES] = {0.03, 0.06, 0.09, 0.12}, dt = 0.01;
    double u[PLACES], s = 0.12, moved;

    (void)state;
    for (int i = 0; i < PLACES; i++) {
        assert_ran(plugflow("run cases/electro_trap.lua --quiet --set steady=true --set x=%g --out %s/trap",
                            0.5 + place[i], scratch()),
                   0, NULL);
        u[i] = summary("trap", "results.u");
    }
    for (int i = 0; i < 100; i++) {
        double k1 = velocity(place, u, s), k2 = velocity(place, u, s + 0.5 * dt * k1),
               k3 = velocity(place, u, s + 0.5 * dt * k2), k4 = velocity(place, u, s + dt * k3);

        s += dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    assert_ran(plugflow("run cases/electro_trap.lua --quiet --set u=%.17g --out %s/trap", u[PLACES - 1], scratch()),
               0, NULL);
    moved = summary("trap", "results.x") - 0.5;
    assert_between((moved - s) / 0.12, -1e-3, 1e-3); /* the cut cells are others at every place */
}

/* --- the forces of a pair from its energy --- */

typedef struct two {
    int dim;
    double x[2][3], m[2][3], q[2];
} two;

/* -m1 . E2 with the field of a dipole, or k q1 q2 / r; k = 1, and in 2D of lines: twice those of a plane. */
static double energy(const two *p, int charged)
{
    double r = 0, n1 = 0, n2 = 0, both = 0;

    for (int a = 0; a < p->dim; a++)
        r += (p->x[0][a] - p->x[1][a]) * (p->x[0][a] - p->x[1][a]);
    r = sqrt(r);
    for (int a = 0; a < p->dim; a++) {
        n1 += (p->x[0][a] - p->x[1][a]) / r * p->m[0][a];
        n2 += (p->x[0][a] - p->x[1][a]) / r * p->m[1][a];
        both += p->m[0][a] * p->m[1][a];
    }
    if (charged)
        return p->q[0] * p->q[1] * (p->dim == 2 ? -2 * log(r) : 1 / r);
    return p->dim == 2 ? 2 * (both - 2 * n1 * n2) / (r * r) : (both - 3 * n1 * n2) / (r * r * r);
}

/* - d energy / d number */
static double slope(two *p, double *number, int charged)
{
    const double step = 1e-5, kept = *number;
    double e[2];

    for (int i = 0; i < 2; i++) {
        *number = kept + (i ? step : -step);
        e[i] = energy(p, charged);
    }
    *number = kept;
    return (e[0] - e[1]) / (2 * step);
}

/* - d energy / d angle about axis a, of body i. */
static double turning(two *p, int i, int a)
{
    const double step = 1e-5, kept[3] = {p->m[i][0], p->m[i][1], p->m[i][2]};
    const int j = (a + 1) % 3, k = (a + 2) % 3;
    double e[2];

    for (int s = 0; s < 2; s++) {
        double c = cos(step), d = s ? sin(step) : -sin(step);

        p->m[i][j] = c * kept[j] - d * kept[k];
        p->m[i][k] = d * kept[j] + c * kept[k];
        e[s] = energy(p, 0);
    }
    memcpy(p->m[i], kept, sizeof kept);
    return (e[0] - e[1]) / (2 * step);
}

static const pf_term *term(const char *name)
{
    char path[600];
    const pf_plugin *plugin;
    pf_entry_fn *entry;
    void *file, *symbol;

    snprintf(path, sizeof path, "%.500s/electro/electro.so", getenv("PLUGFLOW_PLUGIN_PATH"));
    file = dlopen(path, RTLD_NOW);
    assert_non_null(file);
    symbol = dlsym(file, "pf_plugin_entry");
    memcpy(&entry, &symbol, sizeof entry);
    plugin = entry(NULL, NULL, 0);
    for (uint32_t i = 0; i < plugin->n_term; i++)
        if (strcmp(plugin->term[i]->name, name) == 0)
            return plugin->term[i];
    fail_msg("no term %s", name);
    return NULL;
}

/* What a term gives for two bodies that are not turned, in one lane. */
static void call(const char *name, const two *p, double out[3][3])
{
    const pf_term *t = term(name);
    double at[2][3 * PF_LANES] = {{0}}, axes[9 * PF_LANES] = {0}, in[2][3 * PF_LANES] = {{0}}, got[3][3 * PF_LANES];
    const double params[8] = {1, 1};
    int32_t id[PF_LANES] = {0};
    pf_batch b = {.size = sizeof b,
                  .dim = (uint32_t)p->dim,
                  .n = 1,
                  .ld = PF_LANES,
                  .params = params,
                  .centre = at[0],
                  .other_centre = at[1],
                  .axes = axes,
                  .other_axes = axes,
                  .other_id = id};

    for (int i = 0; i < 2; i++)
        for (int a = 0; a < p->dim; a++) {
            at[i][a * (int)PF_LANES] = p->x[i][a];
            axes[(a * p->dim + a) * (int)PF_LANES] = 1;
            in[i][a * (int)PF_LANES] = strcmp(name, "dipoles") ? p->q[i] : p->m[i][a];
        }
    assert_int_equal(
        t->residual(&b, (const double *const[]){in[0], in[1]}, (double *const[]){got[0], got[1], got[2]}), PF_OK);
    for (int o = 0; o < 3; o++)
        for (int a = 0; a < 3; a++)
            out[o][a] = -got[o][a * (int)PF_LANES];
}

static void forces_of_pairs_are_slopes_of_their_energy(void **state)
{
    (void)state;
    for (int dim = 2; dim <= 3; dim++) {
        two p = {dim, {{0.3, 0.7, 0.4}, {1.1, 0.2, -0.5}}, {{0.4, -0.3, 0.6}, {0.2, 0.9, -0.1}}, {1.3, -0.8}};
        double out[3][3], charges[3][3];

        if (dim == 2)
            p.x[0][2] = p.x[1][2] = p.m[0][2] = p.m[1][2] = 0;
        call("dipoles", &p, out);
        call("coulomb", &p, charges);
        for (int a = 0; a < dim; a++) {
            assert_between(out[0][a] - slope(&p, &p.x[0][a], 0), -1e-8, 1e-8);
            assert_between(charges[0][a] - slope(&p, &p.x[0][a], 1), -1e-8, 1e-8);
        }
        for (int i = 0; i < 2; i++)
            for (int a = dim == 2 ? 2 : 0; a < 3; a++)
                assert_between(out[1 + i][dim == 2 ? 0 : a] - turning(&p, i, a), -1e-8, 1e-8);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(forces_of_pairs_are_slopes_of_their_energy),
        cmocka_unit_test(a_charge_falls_through_a_field_as_faxen_says),
        cmocka_unit_test(a_compass_turns_as_its_equation_says),
        cmocka_unit_test(two_dipoles_turn_alike_and_their_forces_make_up),
        cmocka_unit_test(a_disk_in_a_trap_moves_as_its_equation_says),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
