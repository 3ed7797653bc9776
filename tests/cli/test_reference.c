/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What plugins say of themselves, on the terminal and as pages. */
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <string.h>

static int count(const char *s, const char *what)
{
    int n = 0;

    for (; (s = strstr(s, what)); s += strlen(what))
        n++;
    return n;
}

static void pages_in_docs_are_those_of_the_plugins(void **state)
{
    ran r;

    (void)state;
    assert_ran(plugflow("describe --markdown --all %s/pages", scratch()), 0, "");
    r = shell("diff -r docs/reference %s/pages", scratch());
    if (r.code != 0)
        fail_msg("./pf reference writes other pages than docs/reference has:\n%.3000s", r.out);
}

static void page_has_the_weak_form_keys_slots_and_examples(void **state)
{
    (void)state;
    assert_ran(plugflow("describe --markdown momentum"), 0, "$$\n2\\mu D(u):\\nabla v\n$$",
               "| `viscosity` | dynamic viscosity | Pa s | required | at least 0 | viscous |",
               "| in | `grad_u` | gradient of u | tensor |  |  |", "| p = 7 | 2D | `p` = 7 | `div_v` = -7 |",
               "| `traction` |", "Jacobian by hand; faded in by continuation");
    assert_ran(plugflow("describe --markdown electro.force"), 0, "Of `particle {}`:\n", "| `charge` |");
    assert_ran(plugflow("describe --markdown show"), 0, "column `BOUNDARY.flow_rate` of integrals.csv",
               "field `shear_rate`");
    assert_ran(plugflow("describe --markdown solver_umfpack"), 0, "solve { solver = \"umfpack\" }");
    assert_ran(plugflow("describe --markdown mesh_gmsh"), 0, "`.msh`, `.geo`");
}

static void page_of_a_solver_has_its_keys(void **state)
{
    (void)state;
    assert_ran(plugflow("describe --markdown \"$PLUGFLOW_BUILD/tests/abi/solvers/solver_klu.so\""), 0,
               "solve { solver = \"klu\" }", "| key | what | unit | default | range |\n");
    assert_ran(plugflow("describe \"$PLUGFLOW_BUILD/tests/abi/solvers/solver_klu.so\""), 0, "  keys ");
}

static void what_cannot_be_a_page_is_refused(void **state)
{
    (void)state;
    assert_ran(plugflow("describe --markdown"), 2, "needs the name of a plugin, or --all DIR");
    assert_ran(plugflow("describe --markdown momentum --all %s/x", scratch()), 2, "not both");
    assert_ran(plugflow("describe --all %s/x", scratch()), 2, "--all DIR goes with --markdown");
    assert_ran(plugflow("describe --markdown momentm"), 5, "did you mean \"momentum\"?");
    assert_ran(plugflow("describe --markdown momentum.nothing"), 2, "has no term \"nothing\"");
    assert_ran(plugflow("describe --markdown solver_umfpack.nothing"), 2, "has no term \"nothing\"");
    assert_ran(plugflow("describe --markdown --all /dev/null/x"), 7, "/dev/null");
}

/* Density is a key of five terms of it. */
static void each_key_is_told_once(void **state)
{
    ran r = plugflow("describe momentum");

    (void)state;
    assert_ran(r, 0,
               "mass per volume, kg/m^3; required; at least 0; from fluid{}; inertia, convection, body_force");
    assert_int_equal(count(r.out, "mass per volume, kg/m^3; required"), 1);
    r = plugflow("describe rigid_body");
    assert_ran(r, 0, "field omega: angular velocity of a particle, rad/s, spin of each body", "; of all terms");
    assert_int_equal(count(r.out, "acceleration of gravity"), 1);
}

/* They differ in what they mean. */
static void keys_of_one_name_that_differ_are_told_both(void **state)
{
    ran r = plugflow("describe contact");

    (void)state;
    assert_ran(r, 0, "gap at which the force begins", "gap below which the mesh does not resolve the film");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pages_in_docs_are_those_of_the_plugins),
        cmocka_unit_test(page_has_the_weak_form_keys_slots_and_examples),
        cmocka_unit_test(page_of_a_solver_has_its_keys),
        cmocka_unit_test(what_cannot_be_a_page_is_refused),
        cmocka_unit_test(each_key_is_told_once),
        cmocka_unit_test(keys_of_one_name_that_differ_are_told_both),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
