/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * plugflow test on linear solvers: sound ones pass, and what is wrong with those of faults.txt is named.
 *
 *     PLUGFLOW_SOURCE, PLUGFLOW_PROGRAM, PLUGFLOW_SOLVERS_DIR (folder of the altered copies, dense_NAME.so) */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>

#include <cmocka.h>

enum { EXIT_PLUGIN = 5, FAULTS = 16, MAX_LINE = 600 };

static char output[1 << 16];

/* Exit code of plugflow test OPERAND. */
static int tested(const char *operand)
{
    char command[2000];
    FILE *p;
    size_t n;
    int status;

    snprintf(command, sizeof command, "ulimit -c 0; \"$PLUGFLOW_PROGRAM\" test %s 2>&1", operand);
    p = popen(command, "r");
    assert_non_null(p);
    n = fread(output, 1, sizeof output - 1, p);
    output[n] = 0;
    status = pclose(p);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

static int tested_copy(const char *name, const char *kind)
{
    char operand[400];

    snprintf(operand, sizeof operand, "\"$PLUGFLOW_SOLVERS_DIR\"/dense_%s%s.so", name, kind);
    return tested(operand);
}

/* The text stands in a line on what is wrong, or in the error. */
static int blamed(const char *text)
{
    const char *at = strstr(output, text);

    while (at) {
        const char *line = at;

        while (line > output && line[-1] != '\n')
            line--;
        if (strncmp(line, "  WRONG", 7) == 0 || strncmp(line, "plugflow: ", 10) == 0)
            return 1;
        at = strstr(at + 1, text);
    }
    return 0;
}

static void passes(const char *operand)
{
    if (tested(operand) != 0 || !strstr(output, " passed, 0 failed"))
        fail_msg("%s does not pass:\n%s", operand, output);
}

static void sound_solvers_pass(void **state)
{
    (void)state;
    passes("solver_umfpack");
    passes("solver_block");
    passes("\"$PLUGFLOW_SOLVERS_DIR\"/dense_sound.so");
    passes("\"$PLUGFLOW_SOLVERS_DIR\"/dense_sound_rough.so");
#ifdef HAVE_KLU
    passes("\"$PLUGFLOW_SOLVERS_DIR\"/solver_klu.so");
#endif
}

/* A fault of the list. */
typedef struct fault {
    char name[100];
    int said, rough; /* lines on it */
    int missed;
} fault;

static void judge(fault *f, const char *kind, const char *text)
{
    const int code = tested_copy(f->name, kind);

    if (code == EXIT_PLUGIN && blamed(text))
        return;
    print_error("dense_%s%s: exit code %d, expected %d and\n  %s\nbut it says\n%s", f->name, kind, code,
                EXIT_PLUGIN, text, output);
    f->missed++;
}

/* What is none as a preconditioner. */
static void close_fault(fault *f)
{
    if (*f->name && !f->rough && tested_copy(f->name, "_rough") != 0) {
        print_error("dense_%s_rough is sound, but\n%s", f->name, output);
        f->missed++;
    }
    assert_true(!*f->name || f->said > 0);
}

static void planted_faults_are_named(void **state)
{
    char path[1000], line[MAX_LINE];
    fault f = {{0}, 0, 0, 0};
    int n = 0;
    FILE *list;

    (void)state;
    snprintf(path, sizeof path, "%s/tests/abi/solvers/faults.txt", getenv("PLUGFLOW_SOURCE"));
    list = fopen(path, "r");
    assert_non_null(list);
    while (fgets(line, sizeof line, list)) {
        line[strcspn(line, "\n")] = 0;
        if (strncmp(line, "fault ", 6) == 0) {
            close_fault(&f);
            f.said = f.rough = 0;
            snprintf(f.name, sizeof f.name, "%.99s", line + 6);
            n++;
        } else if (strncmp(line, "says ", 5) == 0) {
            f.said++;
            judge(&f, "", line + 5);
        } else if (strncmp(line, "rough ", 6) == 0) {
            f.rough++;
            judge(&f, "_rough", line + 6);
        }
    }
    fclose(list);
    close_fault(&f);
    assert_int_equal(f.missed, 0);
    assert_int_equal(n, FAULTS);
}

static void report_as_json(void **state)
{
    (void)state;
    assert_int_equal(tested("solver_umfpack --json"), 0);
    assert_non_null(strstr(output, "{\"checks\": [\n"));
    assert_non_null(strstr(output, "{\"ok\": true, \"text\": \"saddle point: residual "));
    assert_non_null(strstr(output, "\"failed\": 0, \"exit\": 0, \"error\": null}"));
    assert_int_equal(tested("\"$PLUGFLOW_SOLVERS_DIR\"/dense_zeros.so --json 2>/dev/null"), EXIT_PLUGIN);
    assert_non_null(strstr(output, "{\"ok\": false, \"text\": "));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sound_solvers_pass),
        cmocka_unit_test(planted_faults_are_named),
        cmocka_unit_test(report_as_json),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
