/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Fields with one value a cell: means that are known, alone and coupled with nodes and with the problem. */
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static ran run(const char *command, const char *file, const char *set)
{
    return plugflow("%s %s %s --plugin %s/cells.so --threads 2 %s %s", command, file, set,
                    getenv("PLUGFLOW_BROKEN_DIR"), strcmp(command, "run") ? "" : "--out",
                    strcmp(command, "run") ? "" : scratch());
}

static double last(const char *file, const char *column)
{
    char path[500];
    double *v, x;
    int n;

    snprintf(path, sizeof path, "%s/%s.csv", scratch(), file);
    n = csv_column(path, column, &v);
    assert_true(n > 0);
    x = v[n - 1];
    free(v);
    return x;
}

/* x^2 from a to b: (a^2 + ab + b^2) / 3; over all cells, whatever they are: 1/3. */
static void values_of_cells_are_means(void **state)
{
    static const char *const set[] = {"", "--set shape=triangles", "--set shape=hexes", "--set shape=tets",
                                      "--set curved=true"};

    (void)state;
    for (size_t i = 0; i < sizeof set / sizeof *set; i++) {
        assert_ran(run("run", "tests/abi/cells.lua", set[i]), 0, "");
        if (i == 0 || i == 2)
            assert_between(last("probes", "here.mean"), 0.4375 / 3 - 1e-13, 0.4375 / 3 + 1e-13);
        if (i < 4)
            assert_between(last("problem", "total"), 1.0 / 3 - 1e-12, 1.0 / 3 + 1e-12);
        assert_ran(run("jacobian", "tests/abi/cells.lua", set[i]), 0, "d R_flow / d mean");
    }
}

/* a dm/dt = -m from the value in the middle of the cell, by backward Euler. */
static void values_of_cells_change_in_time(void **state)
{
    const double euler = 0.375 / pow(1 + 0.1 / 0.3, 5);

    (void)state;
    assert_ran(run("run", "tests/abi/cells.lua", "--set decay=0.3"), 0, "");
    assert_between(last("probes", "here.mean"), euler - 1e-9, euler + 1e-9);
}

static void files_have_values_of_cells(void **state)
{
    (void)state;
    assert_ran(run("run", "tests/abi/cells.lua", ""), 0, "");
    assert_ran(shell("grep -a -A 3 '<CellData>' %s/fields_00000.vtu", scratch()), 0, "Name=\"mean\"",
               "Name=\"flow\"", "</CellData>");
    assert_ran(plugflow("picture %s", scratch()), 0, "");
}

static void what_a_cell_does_not_have_is_refused(void **state)
{
    static const char text[] = "mesh { box = {{0,0},{1,1}}, cells = {4,4} }\nterm 'cells' {}\n"
                               "boundary 'left' { mean = 1 }\nboundary '*' { natural = true }\n";

    (void)state;
    assert_ran(run("check", put_file("value.lua", text), ""), 3,
               "value.lua:3: ", "\"mean\" (mean of a cell) has one value");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_of_cells_are_means),
        cmocka_unit_test(values_of_cells_change_in_time),
        cmocka_unit_test(files_have_values_of_cells),
        cmocka_unit_test(what_a_cell_does_not_have_is_refused),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
