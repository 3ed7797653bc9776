/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What a case cannot do: leave its folder, take all memory or time, print without end, spoil files of results. */
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* Six lines. */
#define CAVITY                                                                                                     \
    "mesh { box = {{0,0},{1,1}}, cells = {3,3} }\nfluid { density = 1, viscosity = 0.1 }\n"                        \
    "term \"continuity\" {}\nterm \"momentum\" {}\nboundary \"*\" { u = {0, 0} }\n"                                \
    "boundary \"top\" { u = {1, 0} }\n"
/* s has 4096 bytes. */
#define LONG "local s = 'x' for i = 1, 12 do s = s .. s end "

/* `plugflow check` of the case ends with the code and prints the texts. */
#define assert_check(text, code, ...)                                                                              \
    assert_ran(plugflow("check %s", put_file("case.lua", text)), code, __VA_ARGS__)

static void text_outside_of_the_memory_of_lua_is_limited(void **state)
{
    (void)state;
    assert_check(LONG "boundary(s) {}\n", 3,
                 "case.lua:1: boundary: the name has 4096 bytes; at most 200 are possible");
    assert_check(LONG "term(s) {}\n", 3, "case.lua:1: term: the name");
    assert_check(LONG "param(s, 1)\n", 3, "param: the name has 4096 bytes; at most 200");
    assert_check(LONG "param('n', 1, s)\n", 3, "param: the description has 4096 bytes; at most 1000");
    assert_check(LONG "case(s)\n", 3, "case: the title has 4096 bytes; at most 200");
}

static void printed_text_ends_after_a_megabyte(void **state)
{
    ran r = plugflow("check %s", put_file("case.lua", CAVITY LONG "for i = 1, 3000 do print(s) end\n"));
    const char *end;

    (void)state;
    assert_ran(r, 0, "print: more than 1 MB of text; the rest is left out\n");
    assert_in_range(strlen(r.err), 900000, 1100000);
    end = strstr(r.err, "the rest is left out");
    assert_null(strstr(end + 1, "the rest is left out"));
}

static void memory_of_the_case_that_ends_is_code_8_with_figures(void **state)
{
    (void)state;
    assert_check("local t = {}\nfor i = 1, 1e9 do t[i] = {i} end\n", 8, "case.lua:2: out of memory: Lua holds 107",
                 "MB and asked for", "a case may hold 1074 MB");
    assert_check("local x\ngraded(0, 1, 1e12, 1)\n", 8, "near ", "case.lua:2: out of memory");
    assert_check("local s = 'abcdefgh'\nwhile true do s = s .. s end\n", 8,
                 "asked for 1074 MB more; a case may hold");
#ifndef __SANITIZE_ADDRESS__ /* the sanitizer's own address space is larger than any limit */
    assert_ran(shell("ulimit -v 700000; %s check %s/case.lua --threads 1", getenv("PLUGFLOW_PROGRAM"), scratch()),
               8, "out of memory: Lua holds", "the system has no more");
#endif
}

static void random_numbers_lie_in_any_interval(void **state)
{
    (void)state;
    assert_check(CAVITY
                 "local low, high = math.mininteger, math.maxinteger\n"
                 "local seen, minus, plus = {}, 0, 0\n"
                 "for i = 1, 100 do\n"
                 "  local all, half, some = math.random(low, high), math.random(0, high), math.random(-2, 2)\n"
                 "  if all < 0 then minus = minus + 1 else plus = plus + 1 end\n"
                 "  assert(half >= 0, 'half')\n"
                 "  assert(some >= -2 and some <= 2, 'some')\n"
                 "  assert(math.random(high - 1, high) >= high - 1, 'two')\n"
                 "  assert(math.random(low, low) == low, 'one')\n"
                 "  seen[some] = true\n"
                 "end\n"
                 "assert(minus > 20 and plus > 20, 'all')\n"
                 "for i = -2, 2 do assert(seen[i], 'every') end\n",
                 0, "ok");
    assert_check(CAVITY
                 "print(math.random(6), math.random(6), math.random(1, 100), math.random(-1000000, 1000000))\n"
                 "math.randomseed(-88172645463325252 // 2)\nassert(math.random() > 0, 'stuck')\n",
                 0, "6\t4\t63\t-965081\n");
    assert_check("math.random(2, 1)\n", 3, "interval is empty");
}

static void include_stays_below_the_folder_of_the_case(void **state)
{
    char folder[400];

    (void)state;
    snprintf(folder, sizeof folder, "%s/parts", scratch());
    mkdir(folder, 0777);
    put_file("parts/walls..lua", "boundary \"*\" { u = {0, 0} }\nreturn 7\n");
    put_file("outside.lua", CAVITY);
    assert_check("include '/etc/passwd'\n", 3,
                 "case.lua:1: include: \"/etc/passwd\" is outside of the case's folder; expected a path below it");
    assert_ran(plugflow("check %s", put_file("parts/case.lua", "include '../outside.lua'\n")), 3,
               "\"../outside.lua\" is outside of the case's folder");
    assert_ran(plugflow("check %s", put_file("parts/case.lua", "include '../parts/../outside.lua'\n")), 3,
               "is outside of the case's folder");
    assert_check("include 'parts/..'\n", 3, "is outside of the case's folder");
    assert_check("include 'nothing.lua'\n", 3, "case.lua:1: include: ", "nothing.lua: No such file");
    assert_check("include 'case.lua'\n", 3, "more than 16 files in a case");
    assert_check("mesh { box = {{0,0},{1,1}}, cells = {3,3} }\nfluid { density = 1, viscosity = 0.1 }\n"
                 "term \"continuity\" {}\nterm \"momentum\" {}\nassert(include './parts/walls..lua' == 7)\n",
                 0, "ok");
}

static void a_title_is_plain_text(void **state)
{
    (void)state;
    assert_check("local x\ncase \"a\\xe9\"\n", 3, "case.lua:2: case: byte 2 of the title is not UTF-8");
    assert_check("case \"a\\0b\"\n", 3, "case.lua:1: case: byte 2 of the title is a control character (code 0)");
    assert_check("case \"a\\27[31m\"\n", 3, "control character (code 27)");
    assert_check("case(print)\n", 3, "the title must be a string, got function");
    assert_check("term \"a\\0b\" {}\n", 3, "term: byte 2 of the name is a control character");
}

static void files_of_results_are_json_whatever_bytes_the_case_has(void **state)
{
    (void)state;
    assert_ran(
        plugflow("run %s --quiet --set 'name=\xff\"\\' --out %s/o",
                 put_file("case.lua", "case \"\xce\xa9\" -- \xe9t\xe9\n" CAVITY "param('name', '\\xc0\\x80')\n"),
                 scratch()),
        0, NULL);
    for (int i = 0; i < 2; i++)
        assert_ran(shell("python3 -c 'import json, sys; json.loads(open(sys.argv[1], \"rb\").read().decode())' "
                         "%s/o/%s.json && cat %s/o/%s.json",
                         scratch(), i ? "summary" : "case", scratch(), i ? "summary" : "case"),
                   0, "\"case\": \"\xce\xa9\"");
}

/* The garbage of `initial` takes the place of the name, if the name was nobody's. */
static void a_block_outlives_the_name_that_made_it(void **state)
{
    (void)state;
    assert_ran(
        plugflow("run %s --quiet --out %s/o",
                 put_file("case.lua", CAVITY "results(function(r) return { a = 1 } end)\nresults, mesh = nil\n"
                                             "initial { u = function(x, y)\n  local t = {}\n"
                                             "  for i = 1, 1e4 do t[i % 1000] = 'other' .. i end\n"
                                             "  return 0, 0\nend }\n"),
                 scratch()),
        0, NULL);
    assert_ran(shell("cat %s/o/summary.json", scratch()), 0, "\"results\": {\"a\": 1}");
}

static void the_table_of_globals_is_a_table_like_others(void **state)
{
    (void)state;
    assert_check(CAVITY "output { lines = { a = _ENV } }\n", 3, "line \"a\": \"from\" is missing");
}

static void a_second_block_names_the_first(void **state)
{
    (void)state;
    assert_check(CAVITY "offset { p = 1 }\noffset { p = 2 }\n", 3,
                 "case.lua:8: offset: a second block of this kind; the first is in line 7");
    assert_check(CAVITY "solve {}\nsolve {}\n", 3, "case.lua:8: solve: a second block");
    assert_check("local f = term \"momentum\"\nf {}\nf {}\n", 3,
                 "case.lua:3: term \"momentum\": has its table already, from line 1");
}

static void a_list_of_names_that_is_too_long_is_an_error(void **state)
{
    (void)state;
    assert_check(CAVITY "boundary { periodic = {\"left\", \"right\", \"top\"} }\n", 3,
                 "case.lua:7: boundary: \"periodic\"", "expected the names of 2 boundaries", "got 3");
    assert_check(CAVITY "output { forces = {\"top\\0x\"} }\n", 3, "expected names in quotes");
}

static void a_set_that_is_no_number_is_shown(void **state)
{
    (void)state;
    put_file("case.lua",
             "local re = param(\"re\", 100, \"Reynolds number\")\nlocal on = param(\"on\", true)\n" CAVITY);
    assert_ran(plugflow("check %s/case.lua --set re=1,10,100", scratch()), 3,
               "case.lua:1: --set re=1,10,100: expected a number, found \"1,10,100\"; the default is 100");
    assert_ran(plugflow("check %s/case.lua --set on=yes", scratch()), 3, "expected true or false, found \"yes\"");
}

static void an_endless_function_is_named(void **state)
{
    (void)state;
    assert_ran(
        plugflow("run %s --out %s/o",
                 put_file("case.lua", CAVITY "initial { u = function(x, y) while true do end end }\n"), scratch()),
        3, "case.lua:7: function \"u\" at (", "function \"u\" runs for too long (200 million steps in one call)");
    assert_check("local function f() while true do end end\nf()\n", 3, "case.lua:1: the case runs for too long");
}

/* Each call of the function ends, but there are many: a signal ends the program at once. */
static void a_signal_ends_long_functions(void **state)
{
    (void)state;
    put_file(
        "long.lua",
        "mesh { box = {{0,0},{1,1}}, cells = {32,32} }\nfluid { density = 1, viscosity = 0.1 }\n"
        "term \"continuity\" {}\nterm \"momentum\" {}\nboundary \"*\" { u = {0, 0} }\ntime { step = 1, stop = 2 }\n"
        "initial { u = function(x, y) local s = 0 for i = 1, 2e7 do s = s + i end return 0, 0 end }\n");
    assert_ran(shell("timeout --preserve-status -k 20 -s TERM 1 %s run %s/long.lua --out %s/o",
                     getenv("PLUGFLOW_PROGRAM"), scratch(), scratch()),
               143, "stopped by a signal before the run began; nothing was written");
    put_file("loop.lua", "while true do end\n");
    assert_ran(shell("timeout --preserve-status -k 20 -s INT 0.2 %s check %s/loop.lua", getenv("PLUGFLOW_PROGRAM"),
                     scratch()),
               130, "stopped by a signal before the run began");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(text_outside_of_the_memory_of_lua_is_limited),
        cmocka_unit_test(printed_text_ends_after_a_megabyte),
        cmocka_unit_test(memory_of_the_case_that_ends_is_code_8_with_figures),
        cmocka_unit_test(random_numbers_lie_in_any_interval),
        cmocka_unit_test(include_stays_below_the_folder_of_the_case),
        cmocka_unit_test(a_title_is_plain_text),
        cmocka_unit_test(files_of_results_are_json_whatever_bytes_the_case_has),
        cmocka_unit_test(a_block_outlives_the_name_that_made_it),
        cmocka_unit_test(the_table_of_globals_is_a_table_like_others),
        cmocka_unit_test(a_second_block_names_the_first),
        cmocka_unit_test(a_list_of_names_that_is_too_long_is_an_error),
        cmocka_unit_test(a_set_that_is_no_number_is_shown),
        cmocka_unit_test(an_endless_function_is_named),
        cmocka_unit_test(a_signal_ends_long_functions),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
