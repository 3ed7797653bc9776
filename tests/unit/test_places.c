/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Where bodies start: the part of a body that symmetry planes leave in the domain, and the search on surfaces by
 * which overlaps and bodies in walls are found. */
#include "body/places.h"
#include "support/opened.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#define RADIUS 0.23

/* A fixed disk on the floor, or in the corner, of a box whose floor and left side are as given. */
static opened *disk_on(const char *floor, const char *left, double x)
{
    char text[1000];

    snprintf(
        text, sizeof text,
        "mesh { box = {{0,0},{1,1}}, cells = {9,9} }\nfluid { density = 1, viscosity = 1 }\nterm 'continuity' {}\n"
        "term 'momentum' {}\nparticulate 'sharp'\nboundary '*' { u = {0,0} }\nboundary 'bottom' { %s }\n"
        "boundary 'left' { %s }\n"
        "particle { shape = disk { radius = %g }, density = 1, at = {%g, 0}, motion = 'fixed' }\n",
        floor, left, RADIUS, x);
    return open_text(text, NULL, 0);
}

/* Covered area over that of the whole disk. */
static double covered(const opened *k)
{
    const bodies *b = &k->p.bodies;
    double area = 0;

    for (int64_t i = 0; i < b->now->n_covered; i++)
        for (int j = 0; j < b->cut.n; j++)
            area += b->now->covered_weight[i * b->cut.n + j] / (4.0 * 81);
    return area / (M_PI * RADIUS * RADIUS);
}

/* The moments of the part inside are made exact where the part is known, which the volume alone does not tell. */
static void a_body_cut_by_symmetry_planes_counts_with_its_exact_part(void **state)
{
    static const struct {
        const char *floor, *left;
        double x, part;
        int exact;
    } cases[] = {{"symmetry = true", "u = {0,0}", 0.51, 0.5, 1},
                 {"symmetry = true", "symmetry = true", 0, 0.25, 1},
                 {"u = {0,0}", "u = {0,0}", 0.51, 0.5, 0},
                 {"u = {0,0}", "natural = true", 0.51, 0.5, 0}};

    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        opened *k = disk_on(cases[i].floor, cases[i].left, cases[i].x);
        double off = fabs(covered(k) / cases[i].part - 1);

        if (cases[i].exact ? !(off < 1e-13) : !(off > 1e-12 && off < 1e-3))
            fail_msg("floor { %s }, left { %s }: the covered part is off by %.3g", cases[i].floor, cases[i].left,
                     off);
        close_case(k);
    }
}

static double against(const void *ctx, const double *x)
{
    const double *n = ctx;

    return -(n[0] * x[0] + n[1] * x[1] + n[2] * x[2]);
}

/* The largest extent in oblique directions, against the formulas. */
static void the_search_on_a_surface_finds_its_farthest_point(void **state)
{
    static const shape shapes[] = {
        {.kind = SHAPE_ELLIPSOID, .dim = 2, .half = {0.5, 0.1}},
        {.kind = SHAPE_BOX, .dim = 2, .half = {0.5, 0.1}},
        {.kind = SHAPE_ELLIPSOID, .dim = 3, .half = {0.5, 0.3, 0.1}},
        {.kind = SHAPE_BOX, .dim = 3, .half = {0.5, 0.3, 0.1}},
        {.kind = SHAPE_CYLINDER, .dim = 3, .half = {0.2, 0.2, 0.5}},
    };

    (void)state;
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++)
        for (int k = 0; k < 7; k++) {
            const double a = 0.3 + 0.9 * k, b = shapes[i].dim == 2 ? 0 : 0.2 * k - 0.5;
            const double n[3] = {cos(a) * cos(b), sin(a) * cos(b), sin(b)};
            const pose at = {.x = {1, 2, shapes[i].dim == 2 ? 0 : 3}, .angle = 0.4, .q = {0.8, 0, 0.6, 0}};
            shape s = shapes[i];
            double x[3] = {0}, found, exact;
            solid body;
            arena memory = {0};
            error err;

            assert_int_equal(shape_measure(&s, &memory, &err), 0);
            body = solid_at(&s, &at);
            found = -surface_least(&body, against, n, 1, x);
            exact = at.x[0] * n[0] + at.x[1] * n[1] + at.x[2] * n[2] + solid_support(&body, n);
            if (!(fabs(found - exact) < 1e-6))
                fail_msg("shape %zu, direction %d: %.9g, exact %.9g", i, k, found, exact);
            arena_free(&memory);
        }
}

/* Whether a case can be opened. */
static int opens(const char *text)
{
    const char *folder = getenv("TMPDIR");
    opened *k = calloc(1, sizeof *k);
    char path[400];
    int ok;
    FILE *f;

    assert_non_null(k);
    snprintf(path, sizeof path, "%.300s/places-%ld.lua", folder && *folder ? folder : "/tmp", (long)getpid());
    f = fopen(path, "w");
    assert_non_null(f);
    fputs(text, f);
    fclose(f);
    ok = !case_load(&k->c, path, NULL, 0, NULL, &k->err) && !registry_create(&k->r, NULL, 0, &k->err) &&
         !problem_create(&k->p, &k->c, &k->r, 1, &k->err);
    remove(path);
    close_case(k);
    return ok;
}

/* Two turned ellipses in the direction 0.3: by bisection, against minimisation to 15 digits. */
static void bodies_overlap_up_to_where_they_touch(void **state)
{
    static const char form[] =
        "mesh { box = {{0,0},{2,1}}, cells = {4,2} }\nfluid { density = 1, viscosity = 1 }\nterm 'continuity' {}\n"
        "term 'momentum' {}\nparticulate 'sharp'\nboundary '*' { u = {0,0} }\n"
        "particle { shape = ellipse { a = 0.3, b = 0.1 }, density = 1, at = {0.6, 0.5}, angle = 0.7 }\n"
        "particle { shape = ellipse { a = 0.2, b = 0.15 }, density = 1, at = {%.17g, %.17g}, angle = -0.4 }\n"
        "time { step = 1, stop = 1 }\n";
    double overlap = 0.2, clear = 0.6; /* distances of the centres */

    (void)state;
    for (int i = 0; i < 36; i++) {
        double d = 0.5 * (overlap + clear);
        char text[1000];

        snprintf(text, sizeof text, form, 0.6 + d * cos(0.3), 0.5 + d * sin(0.3));
        if (opens(text))
            clear = d;
        else
            overlap = d;
    }
    if (!(fabs(clear - 0.4517523007993508) < 1e-9))
        fail_msg("the ellipses touch at a distance of %.12f, found %.12f", 0.4517523007993508, clear);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_body_cut_by_symmetry_planes_counts_with_its_exact_part),
        cmocka_unit_test(the_search_on_a_surface_finds_its_farthest_point),
        cmocka_unit_test(bodies_overlap_up_to_where_they_touch),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
