/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Convection on meshes that do not resolve it: with the terms of plugin stabilise, and at outflows with backflow,
 * flow stays stable, and the answer where it is resolved stays what it was. */
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

static double error_of(const char *arguments, const char *keys)
{
    assert_ran(plugflow("run tests/verify/%s --quiet --out %s/o", arguments, scratch()), 0, NULL);
    return summary("o", keys);
}

/* A vortex whose fluid comes back in through the outflow. */
static void outflow_with_backflow_lets_a_vortex_leave(void **state)
{
    (void)state;
    assert_between(error_of("vortex_outflow.lua", "errors.u.l2"), 0, 0.03);
    assert_between(summary("o", "steps_halved"), 0, 0);
    assert_ran(plugflow("run tests/verify/vortex_outflow.lua --set backflow=false --quiet --out %s/o", scratch()),
               6, "no convergence at t = ");
}

/* At the start |u|_L2 = 5.887 and |grad u|_L2 = 7.05; without the terms the latter is 24 and more at t = 8, and
 * numbers overflow before t = 20. */
static void energy_never_grows_by_itself(void **state)
{
    static const char *const shape[] = {"quads", "triangles"};

    (void)state;
    for (int k = 0; k < 2; k++) {
        double before = 5.888;

        for (int stop = 4; stop <= 12; stop += 4) {
            char arguments[200];
            double now;

            snprintf(arguments, sizeof arguments, "unresolved_vortices.lua --set shape=%s --set stop=%d", shape[k],
                     stop);
            now = error_of(arguments, "errors.u.l2");
            assert_between(now, 5, before);
            assert_between(summary("o", "errors.u.h1"), 0, 10);
            before = now;
        }
    }
}

/* Also where a term reads the velocity of a step ago, which does not move with the unknowns. */
static void the_matrix_is_the_derivative(void **state)
{
    (void)state;
    assert_ran(plugflow("jacobian tests/verify/unresolved_vortices.lua --set n=3"), 0, "ok     d R_u / d u");
    assert_ran(plugflow("jacobian tests/verify/mms2d.lua --set n=3 --set stabilise=true --set viscosity=1e-3"), 0,
               "ok     d R_u / d u");
    assert_ran(plugflow("jacobian tests/verify/unresolved_vortices.lua --set n=3 --set streamline=1"), 0,
               "ok     d R_u / d u", "ok     d R_u / d p");
    assert_ran(plugflow("jacobian tests/verify/mms2d.lua --set n=3 --set streamline=1 --set viscosity=1e-3"), 0,
               "ok     d R_u / d u", "ok     d R_u / d p");
}

/* A stream with a body in it, left to itself, at cell Reynolds numbers up to 1000: its energy falls in every step.
 * Without the term surface.inflow fluid that comes out of the weakly closed surface brings energy without bounds.
 */
static void energy_never_grows_past_a_body(void **state)
{
    static const int reynolds[] = {1, 10, 100, 1000};

    (void)state;
    for (int k = 0; k < 4; k++) {
        assert_ran(plugflow("run tests/verify/stream_past_disk.lua --set re=%d --set stop=%s --quiet --out %s/o",
                            reynolds[k], k < 3 ? "2" : "1.2", scratch()),
                   0, NULL);
        assert_ran(
            shell("grep '\"event\": \"solve\"' %s/o/run.jsonl | sed 's/.*\"energy\": \\([^,]*\\),.*/\\1/' | "
                  "awk 'NR > 1 && $1 > before * (1 + 1e-9) { print \"grew from\", before, \"to\", $1; bad = 1 } "
                  "{ before = $1 } END { exit bad || NR < 10 }'",
                  scratch()),
            0, NULL);
        assert_between(summary("o", "energy.kinetic_end"), 1e-6, summary("o", "energy.kinetic_start"));
    }
}

static void resolved_flow_stays_what_it_was(void **state)
{
    const double off = error_of("mms2d.lua --set n=16", "errors.u.l2");
    const double on = error_of("mms2d.lua --set n=16 --set stabilise=true", "errors.u.l2");

    (void)state;
    assert_between(on / off, 0.999, 1.001);
}

/* The viscosity is too small for the mesh by four powers of ten; without the terms there is no solution to be
 * found.  The order is that of grad-div, one below that of the best approximation (de Frutos et al. 2018). */
static void small_viscosity_costs_one_order_at_most(void **state)
{
    static const char small[] = "mms2d.lua --set viscosity=1e-6 --set n=";
    char a[200], b[200];
    double u, p;

    (void)state;
    snprintf(a, sizeof a, "%s16 --set stabilise=true", small);
    snprintf(b, sizeof b, "%s32 --set stabilise=true", small);
    u = error_of(a, "errors.u.l2");
    p = summary("o", "errors.p.l2");
    assert_between(u, 0, 3e-4);
    u /= error_of(b, "errors.u.l2");
    p /= summary("o", "errors.p.l2");
    print_message("# viscosity 1e-6: order of u %.2f, of p %.2f\n", log2(u), log2(p));
    assert_between(log2(u), 1.9, 3.5);
    assert_between(log2(p), 1.9, 2.8);
    assert_ran(plugflow("run tests/verify/%s16 --quiet --out %s/o", small, scratch()), 6, NULL);
}

/* It keeps what is resolved, and where viscosity is too small for the mesh the error is smaller than without. */
static void streamline_makes_no_error_larger(void **state)
{
    static const struct {
        const char *viscosity, *shape;
        int n;
        double least, most;
    } run[] = {{"1", "quads", 16, 0.999, 1.001},  {"1e-2", "quads", 16, 0.9, 1},
               {"1e-4", "quads", 16, 0.85, 0.97}, {"1e-4", "triangles", 16, 0.6, 0.9},
               {"1e-6", "quads", 32, 0.7, 0.9},   {"1e-4", "quads", 32, 0.7, 0.9}};

    (void)state;
    for (size_t k = 0; k < sizeof run / sizeof *run; k++) {
        char arguments[200];
        double off, on;

        snprintf(arguments, sizeof arguments,
                 "mms2d.lua --set stabilise=true --set viscosity=%s --set shape=%s --set n=%d", run[k].viscosity,
                 run[k].shape, run[k].n);
        off = error_of(arguments, "errors.u.l2");
        strcat(arguments, " --set streamline=0.01");
        on = error_of(arguments, "errors.u.l2");
        print_message("# viscosity %s, %s, n = %d: %.3g without, %.3g with\n", run[k].viscosity, run[k].shape,
                      run[k].n, off, on);
        assert_between(on / off, run[k].least, run[k].most);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(outflow_with_backflow_lets_a_vortex_leave),
        cmocka_unit_test(energy_never_grows_by_itself),
        cmocka_unit_test(energy_never_grows_past_a_body),
        cmocka_unit_test(the_matrix_is_the_derivative),
        cmocka_unit_test(resolved_flow_stays_what_it_was),
        cmocka_unit_test(small_viscosity_costs_one_order_at_most),
        cmocka_unit_test(streamline_makes_no_error_larger),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
