/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Pictures of bodies, on fields that are made: linear in the fluid, and absurd inside of bodies. */
#include "io/picture_parts.h"
#include "support/made.h"
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#define GHOST 100.0

/* What the picture is made of: component x of u, or p. */
typedef struct drawn {
    arena a;
    vtu_file v;
    vtu_array room;
    picture_field f;
    picture_view view;
    picture_bodies bodies;
    picture_raster r;
} drawn;

static void draw(const char *path, int field, int normal, double at, drawn *d)
{
    error err;

    memset(d, 0, sizeof *d);
    assert_int_equal(vtu_open(&d->v, path, &err), 0);
    d->view = (picture_view){
        .dim = d->v.dim, .across = {normal == 0, normal == 2 ? 1 : 2}, .normal = normal, .at = at, .near = 1e-9};
    assert_int_equal(bodies_read(path, &d->view, INFINITY, &d->bodies, &d->a, &err), 0);
    d->f = (picture_field){.colour = &d->room, .component = field ? PICTURE_MAGNITUDE : 0};
    assert_int_equal(extend_into_bodies(&d->v, &d->v.field[field], &d->room, &d->a, &err), 0);
    d->r = (picture_raster){.w = 300, .h = 300, .left = 0, .top = 1, .scale = {300, 300}, .n_value = 1};
    assert_int_equal(bodies_cover(&d->bodies, &d->r, &d->a, &err), 0);
    assert_int_equal(raster_make(&d->v, &d->view, &d->f, &d->r, &d->a, &err), 0);
}

static void undraw(drawn *d)
{
    vtu_close(&d->v);
    arena_free(&d->a);
}

static void place_of(const drawn *d, int i, int j, double x[3])
{
    x[0] = x[1] = x[2] = d->view.dim == 3 ? d->view.at : 0;
    x[d->view.across[0]] = (i + 0.5) / 300;
    x[d->view.across[1]] = 1 - (j + 0.5) / 300;
}

/* Every pixel of the fluid, up to the true surface, has the linear field; inside the outline are the bodies only.
 */
static void check_pixels(const made *k, const drawn *d)
{
    for (int j = 0; j < 300; j++)
        for (int i = 0; i < 300; i++) {
            double x[3], value = (double)d->r.value[0][j * 300 + i], deepest = INFINITY;

            place_of(d, i, j, x);
            for (int b = 0; b < k->n; b++)
                deepest = fmin(deepest, made_level(&k->bodies[b], x));
            if (deepest > 0)
                assert_between(value, made_field(x) - 1e-5, made_field(x) + 1e-5);
            if (fabs(deepest) > 0.03)
                assert_int_equal(!!d->r.solid[j * 300 + i], deepest < 0);
        }
}

static void a_field_without_values_in_a_body_is_drawn_up_to_its_surface(void **state)
{
    (void)state;
    for (int simplex = 0; simplex < 2; simplex++) {
        made k;
        drawn d;

        made_create(&k, 2, simplex, 11);
        made_add(&k, SHAPE_ELLIPSOID, 0.21, 0.21, 0, (const double[]){0.47, 0.53}, 1);
        made_fill(&k, 0, 0);
        draw(made_write(&k, scratch(), 1), 1, 2, 0, &d);
        check_pixels(&k, &d);
        assert_between(d.r.low, 1 - 1e-9, 1 + 1e-9);
        assert_between(d.r.high, 5 - 1e-9, 5 + 1e-9);
        undraw(&d);
        made_destroy(&k);
    }
}

static void a_section_of_bodies_in_3d_is_cut_at_their_surfaces(void **state)
{
    (void)state;
    for (int normal = 0; normal < 3; normal++) {
        made k;
        drawn d;
        double low, high;

        made_create(&k, 3, normal == 1, 7);
        made_add(&k, SHAPE_ELLIPSOID, 0.2, 0.2, 0.2, (const double[]){0.27, 0.3, 0.31}, 0);
        made_add(&k, SHAPE_BOX, 0.12, 0.2, 0.16, (const double[]){0.8, 0.75, 0.3}, 1);
        made_add(&k, SHAPE_CYLINDER, 0.15, 0.15, 0.1, (const double[]){0.3, 0.75, 0.8}, 1);
        made_fill(&k, 0, 0);
        draw(made_write(&k, scratch(), 1), 1, normal, 0.31, &d);
        assert_int_equal(d.bodies.n, normal == 2 ? 2 : normal == 0 ? 2 : 1);
        check_pixels(&k, &d);
        low = (double[]){2 + 0.93 - 1, 2 - 0.31, 2 - 1 + 0.155}[normal];
        high = (double[]){2 + 0.93 + 0.5, 5 - 0.31 + 0.5, 5 + 0.155}[normal];
        assert_between(d.r.low, low - 1e-9, low + 1e-9);
        assert_between(d.r.high, high - 1e-9, high + 1e-9);
        undraw(&d);
        made_destroy(&k);
    }
}

/* Places on faces of cells differ from the plane by rounding. */
static void a_slice_along_faces_of_cells_has_no_holes(void **state)
{
    (void)state;
    for (int simplex = 0; simplex < 2; simplex++)
        for (int n = 1; n < 8; n++) {
            made k;
            drawn d;
            double at = 0;
            int holes = 0;

            made_create(&k, 3, simplex, n);
            for (int64_t i = 0; i < k.m.n_node; i++) {
                k.m.x[3 * i + 2] *= 0.41;
                at = k.m.x[3 * i + 2] < 0.25 ? fmax(at, k.m.x[3 * i + 2]) : at;
            }
            made_fill(&k, 0, 0);
            draw(made_write(&k, scratch(), 0), 1, 2, at, &d);
            for (int i = 0; i < 300 * 300; i++)
                holes += !isfinite(d.r.value[0][i]);
            assert_int_equal(holes, 0);
            undraw(&d);
            made_destroy(&k);
        }
}

/* Area that a closed line goes round. */
static double area(const picture_bodies *b, const picture_loop *l)
{
    double sum = 0;

    for (size_t i = 0; i < l->n; i++) {
        const double *p = b->point[l->first + i], *q = b->point[l->first + (i + 1) % l->n];

        sum += 0.5 * (p[0] * q[1] - p[1] * q[0]);
    }
    return fabs(sum);
}

static void sections_are_closed_also_where_the_plane_meets_corners_of_triangles(void **state)
{
    const double at[] = {0.5, 0.4375, 0.62, 0.25 + 1e-12};
    made k;
    drawn d;

    (void)state;
    made_create(&k, 3, 0, 4);
    made_add(&k, SHAPE_ELLIPSOID, 0.25, 0.25, 0.25, (const double[]){0.5, 0.5, 0.5}, 1);
    made_fill(&k, 0, 0);
    for (int normal = 0; normal < 3; normal++)
        for (int i = 0; i < 4; i++) {
            double exact = M_PI * (0.0625 - (at[i] - 0.5) * (at[i] - 0.5));

            draw(made_write(&k, scratch(), 1), 0, normal, at[i], &d);
            assert_int_equal(d.bodies.n, 1);
            assert_between(area(&d.bodies, d.bodies.loop), 0.99 * exact - 1e-6, exact);
            undraw(&d);
        }
    made_destroy(&k);
}

/* A file of fields that tells nothing of bodies, as earlier versions wrote it. */
static void ranges_leave_out_what_stands_inside_an_outline(void **state)
{
    (void)state;
    for (int dim = 2; dim <= 3; dim++) {
        made k;
        drawn d;

        made_create(&k, dim, 0, 8);
        made_add(&k, SHAPE_ELLIPSOID, 0.34, 0.34, 0.34, (const double[]){0.5, 0.5, 0.5}, 0);
        made_fill(&k, GHOST, 0.9); /* cells that the surface cuts have the linear field */
        draw(made_write(&k, scratch(), 0), 0, 2, 0.5, &d);
        assert_int_equal(d.v.body.at != NULL, 0);
        assert_between(d.r.high, 5 + (dim == 3 ? 0.25 : 0) - 1e-9, 5 + (dim == 3 ? 0.25 : 0) + 1e-9);
        undraw(&d);
        made_destroy(&k);
    }
}

static void motion_of_a_body_is_no_part_of_the_range(void **state)
{
    made k;
    drawn d;

    (void)state;
    made_create(&k, 2, 0, 10);
    made_add(&k, SHAPE_BOX, 0.2, 0.2, 0, (const double[]){0.5, 0.5}, 1); /* along the cells' sides */
    made_fill(&k, GHOST, 1e-9);
    draw(made_write(&k, scratch(), 1), 0, 2, 0, &d);
    assert_between(d.r.high, 5 - 1e-9, 5 + 1e-9);
    undraw(&d);
    made_destroy(&k);
}

/* A file of fields that has lost its bodies' surfaces. */
static void without_surfaces_cells_that_lie_in_a_body_are_left_out(void **state)
{
    char vtp[500];
    made k;
    drawn d;

    (void)state;
    made_create(&k, 2, 0, 8);
    made_add(&k, SHAPE_ELLIPSOID, 0.34, 0.34, 0, (const double[]){0.5, 0.5}, 1);
    made_fill(&k, GHOST, 0.9);
    for (int64_t i = 0; i < k.m.n_node; i++)
        k.body[i] = made_level(k.bodies, (const double[]){k.m.x[2 * i], k.m.x[2 * i + 1]}) < 0 ? 0 : -1;
    made_write(&k, scratch(), 1);
    snprintf(vtp, sizeof vtp, "%s/particles_00000.vtp", scratch());
    assert_int_equal(remove(vtp), 0);
    snprintf(vtp, sizeof vtp, "%s/fields_00000.vtu", scratch());
    draw(vtp, 0, 2, 0, &d);
    assert_int_equal(d.bodies.n, 0);
    assert_between(d.r.high, 5 - 1e-9, 5 + 1e-9);
    assert_true(isnan(d.r.value[0][150 * 300 + 150]));
    undraw(&d);
    made_destroy(&k);
}

/* All nodes of the cells between the bodies lie in one of them. */
static void a_gap_without_a_node_of_the_fluid_is_coloured(void **state)
{
    made k;
    drawn d;
    int coloured = 0;

    (void)state;
    made_create(&k, 2, 0, 6); /* nodes at multiples of 1/12; the gap is 0.51 < x < 0.57 */
    made_add(&k, SHAPE_BOX, 0.205, 0.25, 0, (const double[]){0.305, 0.5}, 1);
    made_add(&k, SHAPE_BOX, 0.165, 0.25, 0, (const double[]){0.735, 0.5}, 1);
    made_fill(&k, 0, 0);
    draw(made_write(&k, scratch(), 1), 1, 2, 0, &d);
    for (int j = 0; j < 300; j++)
        for (int i = 154; i < 170; i++) {
            assert_true(isfinite(d.r.value[0][j * 300 + i]));
            coloured += !d.r.solid[j * 300 + i];
        }
    assert_int_equal(coloured, 300 * 16);
    assert_between(d.r.low, 1 - 1e-9, 1 + 1e-9);
    assert_between(d.r.high, 5 - 1e-9, 5 + 1e-9);
    undraw(&d);
    made_destroy(&k);
}

/* The whole figure; grey (0..255) at a place of the domain. */
static int grey_at(const drawn *d, const double *x)
{
    const picture_text text = {.title = "t", .x = "x", .y = "y", .bar = "p"};
    const picture_outline outline = {.low = {0, 0}, .high = {1, 1}};
    picture_figure g;
    picture_content c = {.bodies = &d->bodies, .figure = &g, .text = &text, .outline = &outline, .raster = &d->r};
    cairo_surface_t *image;
    cairo_t *cr;
    const unsigned char *at;
    int grey, i, j;

    figure_place(&g, &text, outline.low, outline.high, (const double[]){1, 5}, 600);
    c.map = colour_map_of(1, 5);
    image = cairo_image_surface_create(CAIRO_FORMAT_RGB24, (int)g.width, (int)g.height);
    cr = cairo_create(image);
    figure_draw(cr, &c);
    assert_int_equal(cairo_status(cr), 0);
    cairo_surface_flush(image);
    i = (int)(g.x + x[0] * g.w);
    j = (int)(g.y + (1 - x[1]) * g.h);
    at = cairo_image_surface_get_data(image) + j * cairo_image_surface_get_stride(image) + 4 * i;
    grey = at[0] == at[1] && at[1] == at[2] ? at[0] : -1;
    cairo_destroy(cr);
    cairo_surface_destroy(image);
    return grey;
}

static void only_bodies_that_move_show_how_they_are_turned(void **state)
{
    made k;
    drawn d;

    (void)state;
    made_create(&k, 2, 0, 8);
    made_add(&k, SHAPE_ELLIPSOID, 0.2, 0.2, 0, (const double[]){0.25, 0.25}, 0);
    made_add(&k, SHAPE_ELLIPSOID, 0.2, 0.2, 0, (const double[]){0.75, 0.25}, 1);
    made_add(&k, SHAPE_ELLIPSOID, 0.2, 0.2, 0, (const double[]){0.75, 0.75}, 1);
    made_fill(&k, 0, 0);
    draw(made_write(&k, scratch(), 1), 1, 2, 0, &d);
    assert_int_equal(d.bodies.n, 3);
    assert_between(grey_at(&d, (const double[]){0.35, 0.25}), 235, 239); /* the body's colour */
    assert_between(grey_at(&d, (const double[]){0.85, 0.25}), 0, 150);
    assert_between(grey_at(&d, (const double[]){0.85, 0.75}), 0, 150);
    assert_between(grey_at(&d, (const double[]){0.65, 0.75}), 235, 239);
    assert_int_equal(grey_at(&d, (const double[]){0.25, 0.75}), -1); /* the fluid is coloured */
    undraw(&d);
    made_destroy(&k);
}

static void bodies_beside_a_file_of_another_name_are_not_looked_for(void **state)
{
    const picture_view view = {.dim = 2, .across = {0, 1}};
    picture_bodies b;
    arena a = {0};
    error err;

    (void)state;
    assert_int_equal(bodies_read("nothing/field.vtu", &view, 0, &b, &a, &err), 0);
    assert_int_equal(b.n, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_field_without_values_in_a_body_is_drawn_up_to_its_surface),
        cmocka_unit_test(a_section_of_bodies_in_3d_is_cut_at_their_surfaces),
        cmocka_unit_test(a_slice_along_faces_of_cells_has_no_holes),
        cmocka_unit_test(sections_are_closed_also_where_the_plane_meets_corners_of_triangles),
        cmocka_unit_test(ranges_leave_out_what_stands_inside_an_outline),
        cmocka_unit_test(motion_of_a_body_is_no_part_of_the_range),
        cmocka_unit_test(without_surfaces_cells_that_lie_in_a_body_are_left_out),
        cmocka_unit_test(a_gap_without_a_node_of_the_fluid_is_coloured),
        cmocka_unit_test(only_bodies_that_move_show_how_they_are_turned),
        cmocka_unit_test(bodies_beside_a_file_of_another_name_are_not_looked_for),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
