/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * plugflow test finds the faults of faults.txt, each planted in a copy of laws.c, and names them: term, block,
 * entry.
 *
 *     PLUGFLOW_SOURCE, PLUGFLOW_PROGRAM, PLUGFLOW_FAULTS_DIR (folder of the copies, NAME.so) */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>

#include <cmocka.h>

enum { MAX_LINE = 600, LEAST = 40, EXIT_PLUGIN = 5 };

static const char *setting(const char *name)
{
    const char *value = getenv(name);

    if (!value || !*value)
        fail_msg("the environment variable %s is not set", name);
    return value;
}

/* Exit code of plugflow test NAME.so, and what it says. */
static int tested(const char *name, char *output, size_t size)
{
    char command[4096];
    FILE *p;
    size_t n;
    int status;

    snprintf(command, sizeof command, "ulimit -c 0; PLUGFLOW_CALL_SECONDS=0.5 '%s' test '%s/%s.so' 2>&1",
             setting("PLUGFLOW_PROGRAM"), setting("PLUGFLOW_FAULTS_DIR"), name);
    p = popen(command, "r");
    assert_non_null(p);
    n = fread(output, 1, size - 1, p);
    output[n] = 0;
    status = pclose(p);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

static void sound_laws_pass(void **state)
{
    static char output[1 << 17];

    (void)state;
    if (tested("laws", output, sizeof output) != 0)
        fail_msg("the laws without a fault do not pass:\n%s", output);
}

/* The lines of the output that are no passed checks. */
static void print_rest(char *output)
{
    for (char *line = strtok(output, "\n"); line; line = strtok(NULL, "\n"))
        if (strncmp(line, "  ok", 4) != 0)
            print_error("#     %s\n", line);
}

static void planted_faults_are_found_and_named(void **state)
{
    static char output[1 << 17];
    char path[1024], line[MAX_LINE], name[MAX_LINE] = "";
    int n = 0, found = 0, code = 0, right = 1;
    FILE *f;

    (void)state;
    snprintf(path, sizeof path, "%s/tests/abi/faults/faults.txt", setting("PLUGFLOW_SOURCE"));
    f = fopen(path, "r");
    assert_non_null(f);
    while (fgets(line, sizeof line, f)) {
        line[strcspn(line, "\n")] = 0;
        if (strncmp(line, "fault ", 6) == 0) {
            snprintf(name, sizeof name, "%s", line + 6);
            code = tested(name, output, sizeof output);
            right = code == EXIT_PLUGIN;
            n++, found++;
            if (!right) {
                print_error("# %s: exit code %d\n", name, code);
                found--;
            }
        } else if (right && strncmp(line, "says ", 5) == 0 && !strstr(output, line + 5)) {
            print_error("# %s: plugflow test does not say\n#     %s\n", name, line + 5);
            print_rest(output);
            right = 0, found--;
        }
    }
    fclose(f);
    print_message("# %d of %d planted faults were found and named\n", found, n);
    assert_true(n >= LEAST);
    assert_int_equal(found, n);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sound_laws_pass),
        cmocka_unit_test(planted_faults_are_found_and_named),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
