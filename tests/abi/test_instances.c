/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Terms on several lines, each in a part of the domain; terms in the place of others; before a run and after it. */
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* A slab from x = 0, where T = 0, to x = 1, where T = 1, and these lines. */
static const char *slab(const char *lines)
{
    char text[2000];

    snprintf(text, sizeof text,
             "mesh { box = {{0,0},{1,1}}, cells = {8, 2}, shape = 'quads' }\n%s\n"
             "boundary 'left' { T = 0 }\nboundary 'right' { T = 1 }\nboundary '*' { natural = true }\n"
             "output { probes = { middle = {0.5, 0.5}, quarter = {0.25, 0.5} } }\n",
             lines);
    return put_file("slab.lua", text);
}

static ran run(const char *command, const char *lines, const char *out)
{
    char folder[400] = "";

    if (*out)
        snprintf(folder, sizeof folder, "--out %s/%s", scratch(), out);
    return plugflow("%s %s --plugin %s/parts.so --threads 1 %s", command, slab(lines),
                    getenv("PLUGFLOW_BROKEN_DIR"), folder);
}

static double probe(const char *out, const char *column, int row)
{
    char path[500];
    double *v, x;
    int n;

    snprintf(path, sizeof path, "%s/%s/probes.csv", scratch(), out);
    n = csv_column(path, column, &v);
    assert_true(n > row);
    x = v[row < 0 ? n - 1 : row];
    free(v);
    return x;
}

/* Heat flows through both layers: T in the middle is k_2 / (k_1 + k_2), here 4/5. */
static void two_layers_are_two_lines_of_one_term(void **state)
{
    (void)state;
    assert_ran(run("run",
                   "term 'parts' { name = 'left', inside = function(x, y) return x < 0.5 end }\n"
                   "term 'parts' { name = 'right', inside = function(x, y) return x > 0.5 and 2 or -1 end, "
                   "conductivity = 4 }",
                   "layers"),
               0, "");
    assert_between(probe("layers", "middle.T", -1), 0.8 - 1e-12, 0.8 + 1e-12);
    assert_between(probe("layers", "quarter.T", -1), 0.4 - 1e-12, 0.4 + 1e-12);
    assert_ran(run("check",
                   "term 'parts' { name = 'left', inside = function(x, y) return x < 0.5 end }\n"
                   "term 'parts' { name = 'right', inside = function(x, y) return x > 0.5 end }",
                   ""),
               0, "parts.conduct (left)", "parts.conduct (right)");
    assert_ran(run("jacobian",
                   "term 'parts' { inside = function(x, y) return x < y end }\n"
                   "term 'parts' { inside = function(x, y) return x >= y end, conductivity = 4 }",
                   ""),
               0, "");
}

/* The boundary of the layers moves with time: at t = 1/4 and 3/4 it is at x = t, where T = k_2 t / (k_2 t + k_1 (1
 * - t)). */
static void a_part_may_move(void **state)
{
    (void)state;
    assert_ran(run("run",
                   "term 'parts' { inside = function(x, y, t) return x < t end }\n"
                   "term 'parts' { inside = function(x, y, t) return x > t end, conductivity = 4 }\n"
                   "time { step = 0.25, stop = 0.5, scheme = 'bdf1' }",
                   "moves"),
               0, "");
    assert_between(probe("moves", "quarter.T", 1), 4 * 0.25 / 1.75 - 1e-12, 4 * 0.25 / 1.75 + 1e-12);
    assert_between(probe("moves", "middle.T", 2), 0.8 - 1e-12, 0.8 + 1e-12);
}

static void lines_without_parts_contradict_each_other(void **state)
{
    (void)state;
    assert_ran(run("check", "term 'parts' {}\nterm 'parts' { conductivity = 2 }", ""), 3,
               "slab.lua:3: ", "parts.conduct is on already, by line 2", "inside = function(x, y)");
    assert_ran(run("check", "term 'parts' {}\nterm 'parts' { inside = function(x) return x < 0.5 end }", ""), 3,
               "parts.conduct is on already, by line 2");
    assert_ran(run("check", "term 'parts' { inside = 3 }", ""), 3,
               "slab.lua:2: ", "expected a function of place that says true or false");
    assert_ran(run("check", "term 'parts' { inside = function(x) return 'yes' end }", ""), 3,
               "slab.lua:2: ", "it must return 1 number");
}

static void a_term_takes_the_place_of_another(void **state)
{
    (void)state;
    assert_ran(run("check", "term 'parts' {}\nterm 'parts.twice' {}", ""), 0,
               "parts.conduct is left out: parts.twice (line 3) replaces it", "terms: parts.twice\n");
    assert_ran(run("run", "term 'parts.twice' {}\nterm 'parts' {}", "replaced"), 0,
               "parts.conduct is left out: parts.twice (line 2) replaces it");
    assert_ran(run("check", "term 'parts' {}\nterm 'parts.twice' {}\nterm 'parts.too' {}", ""), 3,
               "slab.lua:4: ", "parts.too replaces parts.conduct, which parts.twice, by line 3, replaces, too");
    assert_ran(run("check", "term 'parts.lost' {}", ""), 3, "slab.lua:2: ",
               "parts.lost says that it replaces \"parts.conductor\", a term that its plugin does not have");
    assert_ran(run("check", "term 'parts' {}\nterm 'parts.twice' { inside = function(x) return true end }", ""), 3,
               "slab.lua:3: ", "would be missing outside");
    assert_ran(run("check", "term 'parts' { conductivity = 3 }\nterm 'parts.twice' {}", ""), 3,
               "\"conductivity\" belongs to parts.conduct, which is off here");
}

static int count(const char *text, const char *what)
{
    int n = 0;

    for (const char *at = text; (at = strstr(at, what)); at += strlen(what))
        n++;
    return n;
}

static void every_line_has_a_start_and_an_end(void **state)
{
    const char *lines = "term 'parts' { inside = function(x) return x < 0.5 end }\n"
                        "term 'parts' { inside = function(x) return x > 0.5 end, conductivity = 4 }";
    ran r;

    (void)state;
    setenv("PARTS_END", "1", 1);
    r = run("run", lines, "ends");
    assert_int_equal(count(r.out, "end of 1\n"), 1);
    assert_int_equal(count(r.out, "end of 4\n"), 1);
    r = run("check", lines, "");
    assert_int_equal(count(r.out, "end of 4\n"), 1);
    r = run("check",
            "term 'parts' { inside = function(x) return x < 0.5 end }\n"
            "term 'parts' { inside = function(x) return x > 0.5 end, conductivity = 13 }",
            "");
    assert_ran(
        r, 3, "slab.lua:3: term \"parts\": parts.conduct cannot start: no table for a conductivity of 13 (steady)");
    assert_int_equal(count(r.out, "end of 1\n"), 1);
    assert_int_equal(count(r.out, "end of 13\n"), 0);
    unsetenv("PARTS_END");
    assert_ran(run("check", "term 'parts' { conductivity = 14 }", ""), 128 + 11, "parts.conduct", "init");
    assert_ran(plugflow("test %s/parts.so", getenv("PLUGFLOW_BROKEN_DIR")), 0, "0 failed");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(two_layers_are_two_lines_of_one_term),
        cmocka_unit_test(a_part_may_move),
        cmocka_unit_test(lines_without_parts_contradict_each_other),
        cmocka_unit_test(a_term_takes_the_place_of_another),
        cmocka_unit_test(every_line_has_a_start_and_an_end),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
