/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Properties that one term publishes and others take: derivatives through chains of them at all kinds of points,
 * the same solution as with the number, and what is refused. */
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static char plugin[2000];

#define CHANNEL                                                                                                    \
    "mesh { box = {{0,0},{2,1}}, cells = {8,4}, shape = param('shape', 'quads', '') }\n"                           \
    "local numbers = { density = 1, viscosity = param('mu', 0, '') > 0 and 0.1 or nil }\n"                         \
    "fluid(numbers)\nterm 'continuity' {}\nterm 'momentum' {}\n"                                                   \
    "boundary '*' { u = {0,0} }\nboundary 'left' { u = function(x, y) return 4*y*(1-y), 0 end }\n"                 \
    "boundary 'right' { natural = true }\n"

static ran command(const char *verb, const char *more, const char *set)
{
    char text[3000];

    snprintf(text, sizeof text, "%s%s", CHANNEL, more);
    put_file("c.lua", text);
    return plugflow("%s %s/c.lua --plugin %s --threads 1 %s", verb, scratch(), plugin, set);
}

/* Every block of the matrix against differences, with a body that cuts through cells, terms on its surface and in
 * the cells tied to others, and stabilisation. */
static void matrices_go_through_chains(void **state)
{
    static const char *const more =
        "term 'laws.thins' {}\nterm 'laws.chained' {}\nterm 'stabilise' {}\nterm 'stabilise.streamline' {}\n"
        "particulate 'sharp'\n"
        "particle { shape = disk { radius = 0.21 }, density = 2, at = {0.913, 0.487}, motion = 'fixed' }\n";
    static const char *const shape[] = {"--set shape=quads", "--set shape=triangles"};

    (void)state;
    for (int i = 0; i < 2; i++) {
        ran r = command("jacobian", more, shape[i]);

        assert_ran(r, 0, "d R_u / d u  differences agree", "d R_u / d p  differences agree");
        assert_null(strstr(r.out, "WRONG"));
    }
}

/* A law that gives 0.1 everywhere is the number 0.1. */
static void a_constant_law_is_the_number(void **state)
{
    double e[2];

    (void)state;
    for (int law = 0; law < 2; law++) {
        char more[2000];

        snprintf(more, sizeof more,
                 "%sparticulate 'sharp'\nparticle { shape = disk { radius = 0.2 }, density = 2, at = {0.9, 0.49}, "
                 "motion = 'fixed' }\nresults(function(r) return { drag = r.last['p0.fx'] } end)\n",
                 law ? "term 'laws.even' {}\n" : "");
        {
            char set[400];

            snprintf(set, sizeof set, "--quiet --set mu=%d --out %s/o", !law, scratch());
            assert_ran(command("run", more, set), 0, NULL);
        }
        e[law] = summary("o", "results.drag");
    }
    assert_between(e[0], 0.1, 100);
    assert_between(e[1] / e[0], 1 - 1e-10, 1 + 1e-10);
}

/* The film between two disks: a law feeds contact.lubrication as the number does. */
static void a_law_feeds_films_between_bodies(void **state)
{
    double v[2];

    (void)state;
    for (int law = 0; law < 2; law++) {
        char more[2000], set[400];

        snprintf(more, sizeof more,
                 "%sterm 'contact.lubrication' {}\nparticulate 'sharp'\n"
                 "particle { shape = disk { radius = 0.15 }, density = 2, at = {0.7, 0.5} }\n"
                 "particle { shape = disk { radius = 0.15 }, density = 2, at = {1.02, 0.5}, motion = 'fixed' }\n"
                 "time { step = 0.01, stop = 0.03 }\n"
                 "results(function(r) return { v = r.last['p0.u'] } end)\n",
                 law ? "term 'laws.even' {}\n" : "");
        snprintf(set, sizeof set, "--quiet --set mu=%d --out %s/o", !law, scratch());
        assert_ran(command("run", more, set), 0, NULL);
        v[law] = summary("o", "results.v");
    }
    assert_between(v[0], 1e-6, 10);
    assert_between(v[1] / v[0], 1 - 1e-8, 1 + 1e-8);
}

static void check_says_who_publishes_and_who_takes(void **state)
{
    (void)state;
    assert_ran(command("check", "term 'laws.thins' {}\nterm 'laws.chained' {}\n", ""), 0,
               "thinning (part that shear leaves, 1): published by laws.thins for laws.chained",
               "viscosity (dynamic viscosity, Pa s): published by laws.chained for momentum.viscous");
}

static void what_cannot_be_is_refused(void **state)
{
    (void)state;
    assert_ran(command("check", "term 'laws.even' {}\nterm 'laws.negative' {}\n", ""), 3,
               "\"viscosity\" is published by laws.even (line 9) and by laws.negative (line 10)");
    assert_ran(command("check", "term 'laws.even' {}\n", "--set mu=1"), 3, "c.lua:3: \"viscosity\" is given here",
               "laws.even publishes it", "would not be used");
    assert_ran(command("check", "term 'laws.thins' {}\n", "--set mu=1"), 3,
               "\"thinning\" is published by laws.thins (line 9), but no term of the case takes it");
    assert_ran(command("check", "term 'laws.chained' {}\n", ""), 3, "laws.chained takes \"thinning\"",
               "no term of the case publishes");
    assert_ran(command("check", "term 'laws.centipoise' {}\n", ""), 3,
               "momentum.viscous takes \"viscosity\" as another quantity", "Pa s", "cP");
    assert_ran(command("check", "term 'laws.a_of_b' {}\nterm 'laws.b_of_a' {}\n", "--set mu=1"), 3,
               "in a circle: laws.a_of_b takes what is published by laws.b_of_a");
    assert_ran(command("check", "", ""), 3, "needs \"viscosity\"", "give it in fluid");
    assert_ran(command("check", "term 'laws.even' { inside = function(x, y) return 1 end }\n", ""), 3,
               "laws.even publishes a property, which is everywhere");
}

/* One that no term of the case would take, with a term that would. */
static void a_law_without_a_use_names_a_term_that_has_one(void **state)
{
    (void)state;
    put_file("d.lua",
             "mesh { box = {{0,0},{2,1}}, cells = {8,4} }\nfluid { density = 1 }\nterm 'continuity' {}\n"
             "term 'momentum' { without = {'viscous'} }\nterm 'laws.even' {}\nboundary '*' { u = {0,0} }\n");
    assert_ran(
        plugflow("check %s/d.lua --plugin %s", scratch(), plugin), 3,
        "\"viscosity\" is published by laws.even (line 5), but no term of the case takes it; momentum.viscous "
        "would");
}

static void values_that_make_no_sense_stop_the_run(void **state)
{
    char set[400];

    (void)state;
    snprintf(set, sizeof set, "--quiet --out %s/o", scratch());
    assert_ran(command("run", "term 'laws.negative' {}\n", set), 6, "laws.negative: \"viscosity\" is -", "at x = (",
               "momentum.viscous takes it from 1e-30");
    assert_ran(command("run", "term 'laws.infinite' {}\n", set), 6, "laws.infinite: \"viscosity\" is inf at x = (");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(matrices_go_through_chains),
        cmocka_unit_test(a_constant_law_is_the_number),
        cmocka_unit_test(a_law_feeds_films_between_bodies),
        cmocka_unit_test(check_says_who_publishes_and_who_takes),
        cmocka_unit_test(what_cannot_be_is_refused),
        cmocka_unit_test(a_law_without_a_use_names_a_term_that_has_one),
        cmocka_unit_test(values_that_make_no_sense_stop_the_run),
    };

    snprintf(plugin, sizeof plugin, "%s/laws.so", getenv("PLUGFLOW_BROKEN_DIR"));
    return cmocka_run_group_tests(tests, NULL, NULL);
}
