/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Orders of convergence by manufactured solutions (numerics: velocity L2 >= 2.9, H1 >= 1.9,
 * pressure L2 >= 1.9, BDF2 >= 1.9 in velocity and pressure). */
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>

typedef struct errors {
    double u, h1, p;
} errors;

static errors solve(const char *arguments)
{
    assert_ran(plugflow("run %s --quiet --out %s/o", arguments, scratch()), 0, NULL);
    assert_between(summary("o", "worst_linear_residual"), 0, 1e-10);
    return (errors){summary("o", "errors.u.l2"), summary("o", "errors.u.h1"), summary("o", "errors.p.l2")};
}

/* Runs with n and 2n cells; orders in u, grad u, p. */
static void check(const char *what, const char *arguments, int n)
{
    char a[300], b[300];
    errors e, f;

    snprintf(a, sizeof a, "%s --set n=%d", arguments, n);
    snprintf(b, sizeof b, "%s --set n=%d", arguments, 2 * n);
    e = solve(a);
    f = solve(b);
    print_message("# %s: order of u %.2f (L2), %.2f (H1), of p %.2f\n", what, log2(e.u / f.u), log2(e.h1 / f.h1),
                  log2(e.p / f.p));
    assert_between(log2(e.u / f.u), 2.9, 3.5);
    assert_between(log2(e.h1 / f.h1), 1.9, 2.5);
    assert_between(log2(e.p / f.p), 1.9, 2.8);
}

#define ORDER_TEST(NAME, ARGUMENTS, N)                                                                             \
    static void NAME(void **state)                                                                                 \
    {                                                                                                              \
        (void)state;                                                                                               \
        check(#NAME, ARGUMENTS, N);                                                                                \
    }

ORDER_TEST(orders_on_quads, "tests/verify/mms2d.lua --set shape=quads", 16)
ORDER_TEST(orders_on_triangles, "tests/verify/mms2d.lua --set shape=triangles", 16)
ORDER_TEST(orders_on_curved_quads, "tests/verify/mms2d.lua --set curved=true", 16)
ORDER_TEST(orders_on_curved_triangles, "tests/verify/mms2d.lua --set curved=true --set shape=triangles", 16)
ORDER_TEST(orders_on_hexes, "tests/verify/mms3d.lua --set shape=hexes", 4)
ORDER_TEST(orders_on_tets, "tests/verify/mms3d.lua --set shape=tets", 4)
ORDER_TEST(orders_on_curved_hexes, "tests/verify/mms3d.lua --set curved=true", 4)
ORDER_TEST(orders_of_kovasznay, "cases/kovasznay.lua", 32)
ORDER_TEST(orders_of_beltrami_on_hexes, "cases/beltrami.lua --set dt=0.0025 --set stop=0.01", 3)

static errors in_time(const char *arguments, double dt)
{
    char a[300];

    snprintf(a, sizeof a, "%s --set dt=%g", arguments, dt);
    return solve(a);
}

static void bdf2_has_order_two_in_velocity_and_pressure(void **state)
{
    errors e = in_time("tests/verify/unsteady2d.lua", 0.05), f = in_time("tests/verify/unsteady2d.lua", 0.025);

    (void)state;
    print_message("# BDF2: order of u %.2f, of p %.2f\n", log2(e.u / f.u), log2(e.p / f.p));
    assert_between(log2(e.u / f.u), 1.9, 2.3);
    assert_between(log2(e.p / f.p), 1.9, 2.3);
}

/* The first step alone: its error must fall with dt^2 at least, in both. */
static void bdf2_keeps_its_order_from_the_first_step(void **state)
{
    errors e = in_time("tests/verify/unsteady2d.lua --set stop=0.05", 0.05);
    errors f = in_time("tests/verify/unsteady2d.lua --set stop=0.025", 0.025);

    (void)state;
    print_message("# first step: order of u %.2f, of p %.2f\n", log2(e.u / f.u), log2(e.p / f.p));
    assert_between(log2(e.u / f.u), 2.5, 4);
    assert_between(log2(e.p / f.p), 1.9, 3);
}

static void bdf1_has_order_one(void **state)
{
    errors e = in_time("tests/verify/unsteady2d.lua --set scheme=bdf1", 0.0125);
    errors f = in_time("tests/verify/unsteady2d.lua --set scheme=bdf1", 0.00625);

    (void)state;
    assert_between(log2(e.u / f.u), 0.9, 1.2);
    assert_between(log2(e.p / f.p), 0.9, 1.2);
}

/* Halving h and taking dt ~ h^(3/2) keeps the order in space visible. */
static void taylor_green_has_order_three_in_space_and_two_in_time(void **state)
{
    errors a = solve("cases/taylor_green.lua --set n=16 --set dt=0.005 --set stop=0.1");
    errors b = solve("cases/taylor_green.lua --set n=32 --set dt=0.005 --set stop=0.1");
    errors c = solve("cases/taylor_green.lua --set n=32 --set nu=1 --set dt=0.05 --set stop=0.5");
    errors d = solve("cases/taylor_green.lua --set n=32 --set nu=1 --set dt=0.025 --set stop=0.5");

    (void)state;
    print_message("# Taylor-Green: order in h %.2f (u), %.2f (p); in dt %.2f (u)\n", log2(a.u / b.u),
                  log2(a.p / b.p), log2(c.u / d.u));
    assert_between(log2(a.u / b.u), 2.9, 4.5);
    assert_between(log2(a.p / b.p), 1.9, 4.5);
    assert_between(log2(c.u / d.u), 1.7, 2.4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(orders_on_quads),
        cmocka_unit_test(orders_on_triangles),
        cmocka_unit_test(orders_on_curved_quads),
        cmocka_unit_test(orders_on_curved_triangles),
        cmocka_unit_test(orders_on_hexes),
        cmocka_unit_test(orders_on_tets),
        cmocka_unit_test(orders_on_curved_hexes),
        cmocka_unit_test(orders_of_kovasznay),
        cmocka_unit_test(orders_of_beltrami_on_hexes),
        cmocka_unit_test(bdf2_has_order_two_in_velocity_and_pressure),
        cmocka_unit_test(bdf2_keeps_its_order_from_the_first_step),
        cmocka_unit_test(bdf1_has_order_one),
        cmocka_unit_test(taylor_green_has_order_three_in_space_and_two_in_time),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
