/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A line for a whole plugin switches its terms at the surfaces of bodies on where its fields end there, and only
 * there; a line of their own always does. */
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define BODY "particle { shape = disk { radius = 0.2 }, density = 1, at = {0.5, 0.5}, motion = 'fixed' }\n"

/* Whether plugflow check lists the term. */
static int is_on(const char *term, const char *lines)
{
    char text[2000];
    ran r;

    snprintf(
        text, sizeof text,
        "mesh { box = {{0,0},{1,1}}, cells = {16,16} }\nfluid { density = 1, viscosity = 1, polymer_viscosity = "
        "1, relaxation_time = 1 }\nterm 'continuity' {}\nterm 'momentum' {}\nterm 'oldroyd_b' {}\n%s"
        "boundary '*' { u = {0, 0} }\ntime { step = 1, stop = 1 }\n",
        lines);
    r = plugflow("check %s --plugin %s/laplacians.so", put_file("case.lua", text), getenv("PLUGFLOW_BROKEN_DIR"));
    assert_ran(r, 0, "oldroyd_b.constitutive", "oldroyd_b.stress");
    return strstr(r.out, term) != NULL;
}

static void sharp_bodies_have_them(void **state)
{
    (void)state;
    assert_true(is_on("oldroyd_b.surface", "particulate 'sharp'\n" BODY));
    assert_true(is_on("oldroyd_b.extension", "particulate 'sharp'\n" BODY));
}

static void without_bodies_there_are_none(void **state)
{
    (void)state;
    assert_false(is_on("oldroyd_b.surface", ""));
    assert_false(is_on("oldroyd_b.extension", ""));
}

/* T has an equation in all cells, so that a term at surfaces would stand in the middle of its domain. */
static void a_field_that_goes_on_has_none(void **state)
{
    (void)state;
    assert_false(is_on("laplacians.surface", "particulate 'sharp'\n" BODY
                                             "term 'laplacians' { without = {'fluid', 'solid'}, over = 'all' }\n"));
    assert_true(is_on("laplacians.surface",
                      "particulate 'sharp'\n" BODY
                      "term 'laplacians' { without = {'fluid', 'solid', 'surface'}, over = 'all' "
                      "}\nterm 'laplacians.surface' {}\n"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sharp_bodies_have_them),
        cmocka_unit_test(without_bodies_there_are_none),
        cmocka_unit_test(a_field_that_goes_on_has_none),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
