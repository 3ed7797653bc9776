/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Residual and matrix near bodies, formed by several threads: twice the same bytes, and but for round-off those of
 * one thread. */
#include "support/opened.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char disks[] = "case 'Disks'\n"
                            "mesh { box = {{0, 0}, {1, 2}}, cells = {20, 40} }\n"
                            "fluid { density = 1, viscosity = 0.1, gravity = {0, -981} }\n"
                            "term 'continuity' {}\n term 'momentum' {}\n particulate('%s')\n"
                            "term 'contact.repulsion' { range = 0.1 }\n"
                            "boundary '*' { u = {0, 0} }\n"
                            "particles { n = 8, shape = disk { radius = 0.11 }, density = 1.1,\n"
                            "  inside = {{0.02, 0.02}, {0.98, 1.98}}, gap = 0.01, seed = 3 }\n"
                            "time { step = 0.01, stop = 0.01 }\n";

static const char sphere[] = "case 'Sphere'\n"
                             "mesh { box = {{0, 0, 0}, {1, 1, 1}}, cells = {6, 6, 6} }\n"
                             "fluid { density = 1, viscosity = 0.1, gravity = {0, 0, -981} }\n"
                             "term 'continuity' {}\n term 'momentum' {}\n particulate('%s')\n"
                             "boundary '*' { u = {0, 0, 0} }\n"
                             "particles { n = 1, shape = sphere { radius = 0.24 }, density = 1.1,\n"
                             "  inside = {{0.1, 0.1, 0.1}, {0.9, 0.9, 0.9}}, seed = 3 }\n"
                             "time { step = 0.01, stop = 0.01 }\n";

typedef struct formed {
    int64_t n, entries;
    int slabs, shares; /* of any class that follows the bodies; of rows of bodies */
    double *residual, *value;
} formed;

static void form(const char *text, const char *formulation, int n_thread, formed *f)
{
    char all[2000];
    opened *k;
    double *x, *dot;

    snprintf(all, sizeof all, text, formulation);
    k = open_text_on(all, n_thread);
    if (problem_initial(&k->p, &k->err))
        fail_msg("%s", k->err.text);
    f->n = k->p.space.n_dof;
    f->entries = k->p.space.row[k->p.space.n_free];
    x = calloc((size_t)f->n, sizeof *x);
    dot = calloc((size_t)f->n, sizeof *dot);
    f->residual = calloc((size_t)f->n, sizeof *f->residual);
    f->value = calloc((size_t)f->entries, sizeof *f->value);
    fill_random(x, f->n, 1);
    fill_random(dot, f->n, 2);
    for (int round = 0; round < 2; round++) { /* the second finds all room in use, and both old numbers */
        assembly_state s = {
            .dt = 0.01, .shift = 150, .x = x, .dot = dot, .old = x, .bodies = problem_points(&k->p)};

        for (int64_t i = 0; i < f->entries; i++)
            f->value[i] = NAN;
        if (assembly_run(&k->p.system.assembly, &s, f->residual, f->value, 1, &k->err))
            fail_msg("%s", k->err.text);
    }
    f->slabs = f->shares = 0;
    for (int i = 0; i < k->p.system.assembly.n_class; i++) {
        const assembly_class *c = &k->p.system.assembly.class_[i];

        f->slabs = c->follows && c->n_slab > f->slabs ? c->n_slab : f->slabs;
        f->shares += c->n_share;
    }
    free(x);
    free(dot);
    close_case(k);
}

static double difference(const double *a, const double *b, int64_t n)
{
    double most = 0, size = 0;

    for (int64_t i = 0; i < n; i++) {
        most = fmax(most, fabs(a[i] - b[i]));
        size = fmax(size, fabs(a[i]));
        assert_true(isfinite(a[i]) && isfinite(b[i]));
    }
    assert_true(size > 0);
    return most / size;
}

static void check(const char *text, const char *formulation)
{
    formed one, many, again;
    int slabs = 0, shares = 0;

    form(text, formulation, 1, &one);
    for (int n = 2; n < 6; n++) {
        double r, v;

        form(text, formulation, n, &many);
        form(text, formulation, n, &again);
        slabs = many.slabs > slabs ? many.slabs : slabs;
        shares += many.shares;
        assert_true(many.n == one.n && many.entries == one.entries);
        assert_memory_equal(many.residual, again.residual, (size_t)many.n * sizeof *many.residual);
        assert_memory_equal(many.value, again.value, (size_t)many.entries * sizeof *many.value);
        r = difference(one.residual, many.residual, one.n);
        v = difference(one.value, many.value, one.entries);
        print_message("# %s, %d threads: %.1e, %.1e\n", formulation, n, r, v);
        assert_true(r < 1e-13 && v < 1e-13);
        free(many.residual), free(many.value), free(again.residual), free(again.value);
    }
    print_message("# %s: %d slabs near bodies, %d of them at the body of another\n", formulation, slabs, shares);
    assert_true(slabs > 1 && shares > 0);
    free(one.residual), free(one.value);
}

static void sums_near_bodies_do_not_depend_on_threads(void **state)
{
    (void)state;
    check(disks, "sharp");
    check(disks, "conservative");
}

static void nor_do_those_of_one_body(void **state)
{
    (void)state;
    check(sphere, "sharp");
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(sums_near_bodies_do_not_depend_on_threads),
                                       cmocka_unit_test(nor_do_those_of_one_body)};

    return cmocka_run_group_tests(tests, NULL, NULL);
}
