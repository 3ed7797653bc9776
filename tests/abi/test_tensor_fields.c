/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Fields of tensors: tensors.lua has one that lies in the finite element spaces for every slot, so that errors are
 * of round-off. */
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static char plugin[2000];

static ran solve(const char *set)
{
    return plugflow("run tests/abi/tensors.lua --plugin %s --quiet --threads 1 %s --out %s/o", plugin, set,
                    scratch());
}

/* Relative to the size of the field, which is between 1 and 60. */
static void assert_exact(const char *fields)
{
    for (; *fields; fields++) {
        char key[40];

        snprintf(key, sizeof key, "errors.%c.l2_exact", *fields);
        assert_between(summary("o", key), 1, 60);
        snprintf(key, sizeof key, "errors.%c.l2", *fields);
        assert_between(summary("o", key), 0, 1e-9);
    }
}

static void every_slot_of_a_tensor_is_exact_for_a_polynomial(void **state)
{
    static const char *const set[] = {"", "--set simplex=true", "--set dim=3", "--set dim=3 --set simplex=true",
                                      "--set periodic=true"};

    (void)state;
    for (size_t i = 0; i < sizeof set / sizeof set[0]; i++) {
        assert_ran(solve(set[i]), 0, NULL);
        assert_exact("STGHL");
    }
}

/* On a mirror S_xy, which is odd in x, is held at zero, and S_xx and S_yy come level. */
static void a_mirror_holds_the_components_that_it_turns(void **state)
{
    (void)state;
    assert_ran(solve("--set symmetry=true"), 0, NULL);
    assert_exact("STL");
    assert_ran(solve("--set symmetry=true --set dim=3"), 0, NULL);
    assert_exact("STL");
}

static void matrices_are_the_derivatives(void **state)
{
    (void)state;
    assert_ran(plugflow("jacobian tests/abi/tensors.lua --plugin %s", plugin), 0, NULL);
    assert_ran(plugflow("test %s", plugin), 0, "72 passed, 0 failed");
}

static void files_name_the_components(void **state)
{
    char path[400];
    double *v;

    (void)state;
    assert_ran(solve(""), 0, NULL);
    snprintf(path, sizeof path, "%s/o/probes.csv", scratch());
    assert_int_equal(csv_column(path, "middle.S_xy", &v), 3);
    free(v);
    assert_int_equal(csv_column(path, "middle.T_yx", &v), 3);
    free(v);
    snprintf(path, sizeof path, "%s/o/lines/along.csv", scratch());
    assert_int_equal(csv_column(path, "S_yy", &v), 5);
    free(v);
    assert_ran(shell("grep -a -c 'Name=\"S\" unit=\"1\" NumberOfComponents=\"6\" ComponentName0=\"xx\" "
                     "ComponentName1=\"yy\"' %s/o/fields_00001.vtu",
                     scratch()),
               0, NULL);
    assert_ran(plugflow("picture %s/o --field S --component xy", scratch()), 0, "S.png");
    assert_ran(plugflow("picture %s/o --field T --component yx", scratch()), 0, "T.png");
    assert_ran(plugflow("picture %s/o --field T --component magnitude", scratch()), 0, "T.png");
    assert_ran(plugflow("picture %s/o --field S --component x", scratch()), 2,
               "'S' is a tensor and has no component x");
    assert_ran(plugflow("picture %s/o --field S --component xz", scratch()), 2,
               "no component xz in two dimensions");
    assert_ran(plugflow("describe %s", plugin), 0, "symmetric tensor of order 2", "tensor of order 2");
}

static void a_wrong_number_of_components_is_told_with_their_order(void **state)
{
    static const char head[] = "mesh { box = {{0, 0}, {1, 1}}, cells = {2, 2} }\n"
                               "term 'tensors' { f = {0, 0, 0}, g = {0, 0, 0, 0} }\ntime { step = 1, stop = 1 }\n";
    static const char *const line[][2] = {
        {"boundary 'left' { S = {1, 0} }", "expected 3 components {xx, xy, yy} in braces"},
        {"initial { T = 1 }", "expected 4 components {xx, xy, yx, yy} in braces"},
        {"boundary 'left' { S = {1, 0, 1}, symmetry = true }",
         "prescribes its components of the normal with other"},
    };
    char text[1000];

    (void)state;
    for (size_t i = 0; i < sizeof line / sizeof line[0]; i++) {
        snprintf(text, sizeof text, "%s%s\n", head, line[i][0]);
        assert_ran(plugflow("check %s --plugin %s", put_file("bad.lua", text), plugin), 3,
                   "bad.lua:4: ", line[i][1]);
    }
}

int main(void)
{
    snprintf(plugin, sizeof plugin, "%s/tensors.so", getenv("PLUGFLOW_BROKEN_DIR"));

    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_slot_of_a_tensor_is_exact_for_a_polynomial),
        cmocka_unit_test(a_mirror_holds_the_components_that_it_turns),
        cmocka_unit_test(matrices_are_the_derivatives),
        cmocka_unit_test(files_name_the_components),
        cmocka_unit_test(a_wrong_number_of_components_is_told_with_their_order),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
