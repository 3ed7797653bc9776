/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Lengths of steps from their errors, and the formulas that errors are known by, against BDF2 done by hand on
 * cubics. */
#include "solve/step_control.h"
#include "solve/stepper.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>

static void near(double a, double b, double tolerance)
{
    if (!(fabs(a - b) <= tolerance))
        fail_msg("%.17g is not %.17g within %g", a, b, tolerance);
}

static double cubic(double t)
{
    return 2 - t + 3 * t * t - 0.7 * t * t * t;
}

static double slope(double t)
{
    return -1 + 6 * t - 2.1 * t * t;
}

static const double steps[][3] = {{0.1, 0.1, 0.1}, {0.2, 0.1, 0.05}, {0.03, 0.1, 0.07}, {0.11, 0.06, 0.12}};
enum { N_STEPS = sizeof steps / sizeof *steps };

static void three_levels_extrapolate_a_parabola(void **state)
{
    (void)state;
    for (int i = 0; i < N_STEPS; i++) {
        const double *h = steps[i], t[3] = {0, -h[1], -h[1] - h[2]};
        double c[3], sum = 0;

        control_extrapolate(h[0], h[1], h[2], c);
        for (int k = 0; k < 3; k++)
            sum += c[k] * (1 + 2 * t[k] - 5 * t[k] * t[k]);
        near(sum, 1 + 2 * h[0] - 5 * h[0] * h[0], 1e-14);
    }
}

/* A step of BDF2 for u' = f(t) from exact values: its error is what Milne's factor makes of its distance from the
 * extrapolation, and what the third derivative makes. */
static void errors_of_bdf2_are_known(void **state)
{
    (void)state;
    for (int i = 0; i < N_STEPS; i++) {
        const double *h = steps[i], t[3] = {0, -h[1], -h[1] - h[2]};
        bdf b = bdf_of(2, h[0], h[1]);
        double u = (slope(h[0]) - b.c[0] * cubic(t[0]) - b.c[1] * cubic(t[1])) / b.shift, c[3], predicted = 0;

        control_extrapolate(h[0], h[1], h[2], c);
        for (int k = 0; k < 3; k++)
            predicted += c[k] * cubic(t[k]);
        near(control_milne(h[0], h[1], h[2]) * (u - predicted), u - cubic(h[0]), 1e-15);
        near(control_defect(h[0], h[1]) * 6 * -0.7, u - cubic(h[0]), 1e-15);
    }
}

static void a_step_grows_shrinks_and_stays(void **state)
{
    step_control c = {.before = 0.5};

    (void)state;
    control_accept(&c, 1e-6, 0.1, NOT_REPEATED);
    near(c.next, 0.2, 1e-15); /* no more than twice */
    c = (step_control){.before = 0.5};
    control_accept(&c, 0.6, 0.1, NOT_REPEATED);
    near(c.next, 0.1, 1e-15); /* little is nothing */
    c = (step_control){.before = 0.5};
    control_accept(&c, 0.95, 0.1, NOT_REPEATED);
    assert_true(c.next < 0.09);
    c = (step_control){.before = 0.5};
    control_accept(&c, 1e-6, 0.1, REPEATED);
    near(c.next, 0.1, 1e-15); /* one that had to be repeated does not grow at once */
    c = (step_control){.before = 0.5, .next = 0.3};
    control_accept(&c, 1e-3, 0.01, NOT_REPEATED);
    near(c.next, 0.3, 1e-15); /* cut to land somewhere */
    assert_true(control_shorten(8, 0.1) < 0.05 && control_shorten(1.1, 0.1) <= 0.07 &&
                control_shorten(1e9, 0.1) >= 0.02);
}

/* The last steps before an end are equal, and none is longer than it was meant to be. */
static void steps_land(void **state)
{
    (void)state;
    near(control_land(1, 0.4, 2), 1.0 / 3, 1e-15);
    near(control_land(1, 1.5, 2), 1, 0);
    near(control_land(1, 0.5, 2), 0.5, 1e-15);
    near(control_land(1, 0.01, 2), 0.01, 0);
    for (double dt = 0.011; dt < 1; dt *= 1.3) {
        double t = 0;
        int n = 0;

        for (; t < 1 - 1e-12; n++)
            t += control_land(t, dt, 1);
        near(t, 1, 1e-12);
        assert_true(n <= ceil(1 / dt) + 1);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(three_levels_extrapolate_a_parabola),
        cmocka_unit_test(errors_of_bdf2_are_known),
        cmocka_unit_test(a_step_grows_shrinks_and_stays),
        cmocka_unit_test(steps_land),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
