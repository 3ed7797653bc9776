/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * results(function(r) ... end): what it returns is in summary.json, all of it and of its type, or there is an
 * error. */
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Seven lines; results(...) begins in line 8. */
#define CAVITY                                                                                                     \
    "mesh { box = {{0,0},{1,1}}, cells = {3,3} }\nfluid { density = 1, viscosity = 0.1 }\n"                        \
    "term \"continuity\" {}\nterm \"momentum\" {}\nboundary \"*\" { u = {0, 0} }\n"                                \
    "boundary \"top\" { u = {1, 0} }\noutput { forces = {\"top\"} }\n"

/* Runs the cavity with this function in results(...). */
static ran run_with(const char *function)
{
    char text[4000];

    snprintf(text, sizeof text, CAVITY "results(function(r) %s end)\n", function);
    return plugflow("run %s --out %s/o", put_file("case.lua", text), scratch());
}

/* summary.json is JSON in UTF-8 and contains the text. */
static void assert_summary(const char *text)
{
    assert_ran(
        shell("python3 -m json.tool --no-ensure-ascii %s/o/summary.json >%s/checked && cat %s/o/summary.json",
              scratch(), scratch(), scratch()),
        0, text);
}

static void values_of_every_type_reach_the_summary(void **state)
{
    (void)state;
    assert_ran(
        run_with("return { yes = true, no = false, whole = 9007199254740993, x = 0.1, name = 'Gr\\u{fc}n \"q\"\\n',"
                 " list = {1, 2.5, -3}, names = {'a', 'b'}, none = {},"
                 " forces = { drag = 1.5, parts = { pressure = {0.5, 1} } } }"),
        0, NULL);
    assert_summary("\"results\": {\"forces\": {\"drag\": 1.5, \"parts\": {\"pressure\": [0.5, 1]}}, "
                   "\"list\": [1, 2.5, -3], \"name\": \"Gr\xc3\xbcn \\\"q\\\"\\u000a\", \"names\": [\"a\", \"b\"], "
                   "\"no\": false, \"none\": [], \"whole\": 9007199254740993, \"x\": 0.1, \"yes\": true}");
}

static void a_thousand_results_are_a_thousand(void **state)
{
    (void)state;
    assert_ran(run_with("local t = {} for i = 1, 1000 do t['k' .. i] = i end return t"), 0, NULL);
    assert_ran(
        shell("grep '\"results\"' %s/o/summary.json | grep -o '\"k[0-9]*\": [0-9]*' | sort -u | wc -l", scratch()),
        0, "1000\n");
    assert_summary("\"k1000\": 1000");
}

static void what_cannot_be_a_result_is_an_error_that_names_it(void **state)
{
    static const struct {
        const char *function, *text;
    } wrong[] = {
        {"return { a = print }", "results: \"a\" is a function; expected a finite number, true or false, a string"},
        {"return { a = free }", "\"a\" is a userdata"},
        {"return { cd = r.last['top.fx'] / 0 }", "\"cd\" is infinite"},
        {"return { b = { c = {1, 0 / 0} } }", "\"b.c[2]\" is no number (nan)"},
        {"return { a = {1, b = 2} }", "\"a\" is a table that mixes names and places"},
        {"return { a = {[1] = 1, [3] = 2} }", "\"a\" is a list with holes"},
        {"return { a = {[true] = 1} }", "\"a\" is a table with a key that is neither a name nor a place"},
        {"return { a = '\\xff' }", "\"a\" is a string that is not UTF-8"},
        {"return { a = 1, ['b\\0c'] = 2 }", "the key \"b?c\" is no plain name"},
        {"return { a = { ['b c'] = 2 } }", "the key \"b c\" in \"a\" is no plain name"},
        {"return {1, 2}", "a value without a name"},
        {"return 5", "the function must return a table, as in { cd = 1.5 }, got number"},
        {"return", "must return a table"},
        {"local t = {} t.t = t return t", "\"t.t.t.t.t.t.t.t.t\" is a table in more than 8 others"},
        {"local t, u = {}, {} for i = 1, 10000 do t[i] = i end for i = 1, 10000 do u[i] = t end return { u = u }",
         "more than 64 MB of text"},
        {"return { a = error(nil) }", "an error whose value is no text"},
        {"while true do end", "function \"results\" runs for too long"},
    };

    (void)state;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        assert_ran(run_with(wrong[i].function), 3, wrong[i].text);
        assert_summary("\"results\": {}");
    }
    assert_ran(run_with("return { a = print }"), 3, "case.lua:8: results:");
}

static void what_there_will_not_be_is_found_before_the_run(void **state)
{
    static const struct {
        const char *function, *text;
    } wrong[] = {
        {"return { a = r.last['top.fz'] }",
         "case.lua:8: results: there is no column \"top.fz\"; did you mean \"top.fx\"? there are: top.fx, top.fy, "
         "top.torque"},
        {"return { a = #r.series['wall.fx'] }", "there is no column \"wall.fx\"; there are: top.fx"},
        {"return { a = r.mean.w[1] }", "r.mean has no field \"w\"; there are: p, u"},
        {"return { a = r.errors.u.l2 }",
         "r.errors has no field with an exact solution called \"u\"; there are: none"},
        {"return { a = r.serie.t }", "r has no part called \"serie\"; did you mean \"series\"?"},
    };

    (void)state;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        ran r;

        shell("mkdir -p %s/o && echo kept > %s/o/summary.json", scratch(), scratch());
        r = run_with(wrong[i].function);
        assert_ran(r, 3, wrong[i].text);
        assert_null(strstr(r.err, "newton"));
        assert_ran(shell("cat %s/o/summary.json", scratch()), 0, "kept"); /* earlier results stay */
    }
}

static void columns_of_bodies_and_norms_are_known_before_the_run(void **state)
{
    (void)state;
    put_file("body.lua",
             "mesh { box = {{0,0},{1,1}}, cells = {8,8} }\nfluid { density = 1, viscosity = 0.1 }\n"
             "term \"continuity\" {}\nterm \"momentum\" {}\nparticulate \"sharp\"\n"
             "particle { shape = disk { radius = 0.2 }, density = 1, at = {0.5, 0.5}, motion = \"fixed\" }\n"
             "boundary \"*\" { u = {1, 0} }\nexact { u = {1, 0} }\n"
             "results(function(r) return { fx = r.last['p0.fx'], n = #r.series['p0.omega'],\n"
             "  l2 = r.errors.u.l2, u = r.mean.u, wrong = second and r.last['p1.fx'] } end)\n");
    put_file("named.lua", "second = false\ninclude 'body.lua'\n");
    assert_ran(plugflow("run %s/named.lua --out %s/o", scratch(), scratch()), 0, NULL);
    assert_summary("\"n\": 1, ");
    put_file("named.lua", "second = true\ninclude 'body.lua'\n");
    assert_ran(plugflow("run %s/named.lua --out %s/o", scratch(), scratch()), 3,
               "body.lua:10: results: there is no", "\"p1.fx\"; did you mean \"p0.fx\"?", "p0.torque");
}

/* The first call has ones for numbers: it may fail, it prints nothing, and takes no random numbers. */
static void the_call_before_the_run_leaves_no_trace(void **state)
{
    ran r = run_with(
        "print('called') if r.last['top.fx'] == 1 then error('ones') end return { a = math.random(1000000) }");

    (void)state;
    assert_ran(r, 0, "called");
    assert_null(strstr(strstr(r.err, "called") + 1, "called"));
    assert_summary("\"results\": {\"a\": 900996}");
}

/* r.t has the times of all steps, with or without tables; what is wrong whatever the numbers are is told before. */
static void times_are_there_without_tables_and_mistakes_come_early(void **state)
{
    static const char form[] =
        "mesh { box = {{0,0},{1,1}}, cells = {3,3} }\nfluid { density = 1, viscosity = 0.1 }\n"
        "term 'continuity' {}\nterm 'momentum' {}\nboundary '*' { u = {0,0} }\n"
        "time { step = 0.1, stop = 0.3 }\n%s\n";
    char text[1000];

    (void)state;
    snprintf(text, sizeof text, form, "results(function(r) return { n = #r.t, last = r.t[#r.t] } end)");
    assert_ran(plugflow("run %s --quiet --out %s/o", put_file("t.lua", text), scratch()), 0, NULL);
    assert_summary("\"n\": 3");
    assert_summary("\"last\": 0.3");
    snprintf(text, sizeof text, form, "results(function(r) return 5 end)");
    assert_ran(plugflow("run %s --out %s/early", put_file("t.lua", text), scratch()), 3,
               "t.lua:7: results: the function must return a table");
    assert_ran(shell("test ! -e %s/early/run.jsonl || ! grep -q solve %s/early/run.jsonl", scratch(), scratch()), 0,
               NULL);
    snprintf(text, sizeof text, form, "exact { u = function(x, y) return x end }");
    assert_ran(plugflow("run %s --out %s/early2", put_file("t.lua", text), scratch()), 3,
               "t.lua:7: ", "must return 2 numbers");
    assert_ran(shell("test ! -e %s/early2/run.jsonl || ! grep -q solve %s/early2/run.jsonl", scratch(), scratch()),
               0, NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_of_every_type_reach_the_summary),
        cmocka_unit_test(a_thousand_results_are_a_thousand),
        cmocka_unit_test(what_cannot_be_a_result_is_an_error_that_names_it),
        cmocka_unit_test(what_there_will_not_be_is_found_before_the_run),
        cmocka_unit_test(columns_of_bodies_and_norms_are_known_before_the_run),
        cmocka_unit_test(the_call_before_the_run_leaves_no_trace),
        cmocka_unit_test(times_are_there_without_tables_and_mistakes_come_early),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
