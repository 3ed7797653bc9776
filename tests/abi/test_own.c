/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What a plugin of one's own leaves out, and what would go wrong in silence: a viscosity that others do not know, a
 * force that is not counted, a field without a tie, data that nobody gave. */
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define BODY                                                                                                       \
    "particulate 'sharp'\nparticle { shape = disk { radius = 0.3 }, density = 1, at = {1, 0.5}, motion = 'fixed' " \
    "}\n"
#define DYE "term 'own.dye' {}\n"

/* plugflow check of a channel with these lines, from line 9 on. */
static ran check(const char *lines)
{
    char text[3000];

    snprintf(text, sizeof text,
             "mesh { box = {{0,0},{2,1}}, cells = {16,8} }\n\n\nfluid { density = 1, viscosity = 1 }\n"
             "term 'continuity' {}\nterm 'momentum' {}\nboundary 'left' { u = {1, 0}%s }\n"
             "boundary 'right' { natural = true } boundary '*' { u = {0, 0} }\n%s",
             strstr(lines, DYE) ? ", c = 1" : "", lines);
    return plugflow("check %s --plugin %s/own.so --threads 1", put_file("case.lua", text),
                    getenv("PLUGFLOW_BROKEN_DIR"));
}

static void says_not(ran r, const char *text)
{
    if (strstr(r.out, text) || strstr(r.err, text))
        fail_msg("it says %s:\n%s%s", text, r.out, r.err);
}

/* surface.nitsche would hold the body with the viscosity of fluid{}. */
static void a_viscosity_that_others_do_not_know_is_refused_at_bodies(void **state)
{
    ran r;

    (void)state;
    assert_ran(check("term 'own.stress' {}\n" BODY), 3,
               "case.lua:9: own.stress takes the place of momentum.viscous", "surface.nitsche (line 10)",
               "publish \"viscosity\" instead");
    assert_ran(check("term 'own.stress' {}\nterm 'show.dissipation' {}\n"), 0,
               "case.lua:9: own.stress takes the place of momentum.viscous",
               "; show.dissipation (line 10) would go on");
    r = check("term 'own.stress' {}\n");
    assert_ran(r, 0, "ok");
    says_not(r, "warning");
    r = check("term 'own.shares' {}\n" BODY);
    assert_ran(r, 0, "ok");
    says_not(r, "warning");
}

static void a_misspelt_name_of_what_is_replaced_is_doubted(void **state)
{
    ran r;

    (void)state;
    assert_ran(check("term 'own.misspelt' {}\n"), 0,
               "case.lua:9: own.misspelt says that it replaces \"momentun.viscous\"", "did you mean \"momentum\"?");
    r = check("term 'own.unknown' {}\n");
    assert_ran(r, 0, "ok");
    says_not(r, "warning");
}

static void a_force_that_is_not_counted_is_doubted(void **state)
{
    ran r;

    (void)state;
    assert_ran(check("term 'own.skin' {}\n" BODY), 0, "warning", "case.lua:9: own.skin gives bodies what it takes",
               "missing in particles.csv", "PF_FLUID_FORCE");
    r = check("term 'own.counted' {}\n" BODY);
    assert_ran(r, 0, "ok");
    says_not(r, "warning");
    r = plugflow("describe %s/own.so", getenv("PLUGFLOW_BROKEN_DIR"));
    assert_ran(r, 0, "what the fluid does to the body", "dye that comes, 1/s; required");
}

static void a_field_without_a_tie_is_doubted(void **state)
{
    ran r;

    (void)state;
    assert_ran(check(DYE BODY), 0, "warning", "case.lua:9: c (dye) has no tie in cells with too little fluid",
               "PF_CUT");
    r = check(DYE "term 'own.tie' {}\n" BODY);
    assert_ran(r, 0, "ok");
    says_not(r, "warning");
    r = check(DYE);
    assert_ran(r, 0, "ok");
    says_not(r, "warning");
}

static void data_that_nobody_gave(void **state)
{
    ran r;

    (void)state;
    assert_ran(check(DYE "term 'own.source' {}\n"), 3,
               "case.lua:10: term \"own.source\": \"dye_source\" is missing (dye that comes, 1/s)");
    assert_ran(check(DYE "term 'own.source' { dye_sorce = 1 }\n"), 3, "did you mean \"dye_source\"");
    assert_ran(check(DYE "term 'own.source' { dye_source = 0 }\n"), 0, "ok");
    assert_ran(check(DYE "term 'own.sink' {}\n"), 0, "dye_sink of own.sink: not given, 0");
    r = check(DYE "term 'own.sink' { dye_sink = 0 }\n");
    assert_ran(r, 0, "ok");
    says_not(r, "dye_sink");
}

/* contact.repulsion takes it in m, contact.lubrication in cells. */
static void a_key_that_means_two_things_on_a_line(void **state)
{
    (void)state;
    assert_ran(check(BODY "term 'contact' { only = {'repulsion', 'lubrication'}, range = 0.1 }\n"), 3,
               "\"range\" means two things here", "term \"contact.lubrication\" {}");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_viscosity_that_others_do_not_know_is_refused_at_bodies),
        cmocka_unit_test(a_misspelt_name_of_what_is_replaced_is_doubted),
        cmocka_unit_test(a_force_that_is_not_counted_is_doubted),
        cmocka_unit_test(a_field_without_a_tie_is_doubted),
        cmocka_unit_test(data_that_nobody_gave),
        cmocka_unit_test(a_key_that_means_two_things_on_a_line),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
