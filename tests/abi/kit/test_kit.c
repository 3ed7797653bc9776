/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Plugins written with term.h are sound, and what their descriptions say is what their source says. */
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

static ran test_of(const char *name)
{
    return plugflow("test \"$PLUGFLOW_BUILD/tests/abi/kit/%s.so\"", name);
}

static void functions_carry_their_derivatives(void **state)
{
    (void)state;
    assert_ran(test_of("functions"), 0, "d s / d T in 2D: analytic = complex step", "0 failed");
}

static void a_law_of_viscosity_is_sound(void **state)
{
    (void)state;
    assert_ran(test_of("gnf"), 0, "power law, shear 3", "Carreau, time 1", "d grad_v / d grad_u in 3D", "0 failed");
}

static void the_slots_and_keys_are_those_of_the_source(void **state)
{
    (void)state;
    assert_ran(plugflow("describe gnf.stress --plugin \"$PLUGFLOW_BUILD/tests/abi/kit/gnf.so\""), 0, "power_law",
               "consistency", "Pa s^n", "grad_v", "default 0.0001");
}

/* u = n/(n+1) (1/2^e - |y - 1/2|^e), e = (n+1)/n, is driven by a force of 1 through a channel of width 1. */
static void a_power_law_channel_is_exact(void **state)
{
    (void)state;
    assert_ran(
        plugflow("run tests/abi/kit/channel.lua --plugin \"$PLUGFLOW_BUILD/tests/abi/kit/gnf.so\" --out '%s/c'",
                 scratch()),
        0, "ok");
    assert_between(summary("c", "errors.u.l2"), 0, 1e-5);
    assert_ran(
        plugflow("run tests/abi/kit/channel.lua --plugin \"$PLUGFLOW_BUILD/tests/abi/kit/gnf.so\" --out '%s/c' "
                 "--set consistency=0",
                 scratch()),
        3, "power_law needs consistency > 0");
}

/* By duals and by differences of the assembled residual. */
static void a_term_in_cpp_is_written_once(void **state)
{
    (void)state;
#ifndef HAVE_CPP
    skip();
#endif
    assert_ran(test_of("drag"), 0, "rho = 2, mu = 3", "complex twin in 3D = residual", "0 failed");
    assert_ran(test_of("functions_in_cpp"), 0, "d s / d T in 2D: analytic = complex step", "0 failed");
    assert_ran(plugflow("jacobian tests/abi/kit/drag.lua --plugin \"$PLUGFLOW_BUILD/tests/abi/kit/drag.so\""), 0,
               "ok     d R_u / d u");
}

static void terms_of_bodies_pairs_and_boundaries_are_sound(void **state)
{
    (void)state;
    assert_ran(test_of("mag"), 0, "dipole", "torque", "0 failed");
    assert_ran(test_of("lab"), 0, "marangoni", "oldroyd", "0 failed");
}

static void slots_of_every_kind_are_sound(void **state)
{
    (void)state;
    assert_ran(test_of("slots"), 0, "d w / d tau in 3D: analytic = complex step",
               "d grad_v / d tau in 3D: analytic = complex step", "d grad_w / d grad_tau in 2D: analytic",
               "d viscosity / d grad_u", "d test_phi / d lap_phi", "d other_V / d U", "0 failed");
}

/* A file that the command line names is what solve { solver = ... } asks for. */
static void a_solver_is_found_on_the_command_line(void **state)
{
    (void)state;
    assert_ran(
        plugflow("run tests/abi/kit/solved.lua --plugin \"$PLUGFLOW_BUILD/tests/abi/kit/solver_declines.so\" "
                 "--out '%s/s'",
                 scratch()),
        2, "the test was here");
    assert_ran(plugflow("run tests/abi/kit/solved.lua --out '%s/s'", scratch()), 2,
               "no plugin solver_declines.so was found");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(functions_carry_their_derivatives),
        cmocka_unit_test(a_law_of_viscosity_is_sound),
        cmocka_unit_test(the_slots_and_keys_are_those_of_the_source),
        cmocka_unit_test(a_power_law_channel_is_exact),
        cmocka_unit_test(terms_of_bodies_pairs_and_boundaries_are_sound),
        cmocka_unit_test(slots_of_every_kind_are_sound),
        cmocka_unit_test(a_solver_is_found_on_the_command_line),
        cmocka_unit_test(a_term_in_cpp_is_written_once),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
