/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A linear solver outside of the tree, taken by solve {} with the keys that it describes. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>

#include <cmocka.h>

enum { EXIT_CASE = 3 };

static char output[1 << 16];

/* Exit code of `plugflow COMMAND` with examples/solver_klu/channel.lua, altered by sed. */
static int with_channel(const char *command, const char *sed)
{
    char line[4096];
    FILE *p;
    size_t n;
    int status;

    snprintf(
        line, sizeof line,
        "d=$(mktemp -d) && sed -e '%s' \"$PLUGFLOW_SOURCE/examples/solver_klu/channel.lua\" >$d/channel.lua && "
        "(\"$PLUGFLOW_PROGRAM\" %s $d/channel.lua --threads 1 2>&1; s=$?; rm -rf $d; exit $s)",
        sed, command);
    p = popen(line, "r");
    assert_non_null(p);
    n = fread(output, 1, sizeof output - 1, p);
    output[n] = 0;
    status = pclose(p);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

static void says(int code, int expected, const char *text)
{
    if (code != expected || !strstr(output, text))
        fail_msg("exit code %d, expected %d and\n  %s\nbut it says\n%s", code, expected, text, output);
}

static void solver_of_the_case_solves(void **state)
{
    (void)state;
    says(with_channel("run --out $d/out", ""), 0, "converged in ");
    says(with_channel("check", ""), 0, "klu");
}

static void its_keys_are_checked_as_those_of_terms(void **state)
{
    (void)state;
    says(with_channel("check", "s/pivot =/pivots =/"), EXIT_CASE,
         "channel.lua:11: solve: unknown key \"pivots\"; did you mean \"pivot\"");
    says(with_channel("check", "s/0[.]01/2/"), EXIT_CASE,
         "\"pivot\" (least share of the largest entry that a diagonal "
         "pivot has) is 2; it must lie between 0 and 1");
    says(with_channel("check", "s/colamd/colamb/"), EXIT_CASE, "colamd");
}

static void solvers_of_plugflow_have_keys(void **state)
{
    static char by_metis[sizeof output];

    (void)state;
    says(with_channel("check", "s/solver = .*}/solver = \"umfpack\" }/"), 0, "solver_umfpack; factors (predicted)");
    memcpy(by_metis, strstr(output, "factors (predicted)"), 40);
    says(with_channel("check", "s/solver = .*}/solver = \"umfpack\", ordering = \"metis\" }/"), 0, by_metis);
    says(with_channel("check", "s/solver = .*}/solver = \"umfpack\", ordering = \"amd\" }/"), 0, "solver_umfpack");
    assert_null(strstr(output, by_metis));
    says(with_channel("check", "s/solver = .*}/solver = \"umfpack\", pivot = 2 }/"), EXIT_CASE,
         "it must lie between 0 and 1");
    says(with_channel("run --out $d/out", "s/solver = .*}/solver = \"block\", sweeps = 2, inner = 0.01 }/"), 0,
         "converged in ");
    says(with_channel("check", "s/solver = .*}/solver = \"block\", sweeps = 0 }/"), EXIT_CASE,
         "it must lie between 1 and 20");
}

static void unknown_solver_is_an_error_of_the_case(void **state)
{
    (void)state;
    says(with_channel("check", "s/\"klu\"/\"umfpak\"/"), EXIT_CASE,
         "channel.lua:11: solve: there is no linear solver \"umfpak\"; did you mean \"umfpack\"?");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(solver_of_the_case_solves),
        cmocka_unit_test(its_keys_are_checked_as_those_of_terms),
        cmocka_unit_test(solvers_of_plugflow_have_keys),
        cmocka_unit_test(unknown_solver_is_an_error_of_the_case),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
