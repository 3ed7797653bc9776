/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Signals to the program at moments that matter. */
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

/* A run of the cavity in the background; what it says on stderr comes through the pipe. */
static pid_t start_cavity(const char *cells, const char *dir, FILE **said)
{
    const char *program = getenv("PLUGFLOW_PROGRAM"), *source = getenv("PLUGFLOW_SOURCE");
    int end[2];
    pid_t pid;

    assert_non_null(program);
    assert_int_equal(pipe(end), 0);
    pid = fork();
    assert_true(pid >= 0);
    if (pid == 0) {
        dup2(end[1], STDERR_FILENO);
        close(end[0]);
        close(end[1]);
        if (!source || chdir(source) != 0 || !freopen("/dev/null", "w", stdout))
            _exit(99);
        execl(program, program, "run", "cases/cavity2d.lua", "--set", cells, "--out", dir, (char *)NULL);
        _exit(99);
    }
    close(end[1]);
    *said = fdopen(end[0], "r");
    assert_non_null(*said);
    return pid;
}

static void wait_for_line(FILE *said, const char *with)
{
    char line[500];

    while (fgets(line, sizeof line, said))
        if (strstr(line, with))
            return;
    fail_msg("the program ended without saying \"%s\"", with);
}

/* Returns when the program has had so much more processor time, or has ended. */
static void wait_for_work(pid_t pid, double seconds)
{
    const struct timespec pause = {.tv_nsec = 5000000};
    struct timespec t;
    siginfo_t ended = {0};
    clockid_t clock;
    double until = 0;

    assert_int_equal(clock_getcpuclockid(pid, &clock), 0);
    for (int k = 0; clock_gettime(clock, &t) == 0; k++) {
        double now = (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;

        if (k == 0)
            until = now + seconds;
        waitid(P_PID, (id_t)pid, &ended, WEXITED | WNOHANG | WNOWAIT);
        if (now >= until || ended.si_pid == pid)
            return;
        nanosleep(&pause, NULL);
    }
}

/* METIS, which has SIGTERM for itself while it runs, takes most of the first second after the first residual. */
static void sigterm_while_the_unknowns_are_ordered_ends_the_run_with_143(void **state)
{
    (void)state;
    for (int k = 1; k <= 2; k++) {
        char dir[400], said_last[500] = "", line[500];
        FILE *said;
        int status;
        pid_t pid;

        snprintf(dir, sizeof dir, "%s/cavity", scratch());
        pid = start_cavity("n=150", dir, &said);
        wait_for_line(said, "newton  0");
        wait_for_work(pid, 0.25 * k);
        kill(pid, SIGTERM);
        while (fgets(line, sizeof line, said))
            strcpy(said_last, line);
        fclose(said);
        assert_int_equal(waitpid(pid, &status, 0), pid);
        if (!WIFEXITED(status) || WEXITSTATUS(status) != 143)
            fail_msg("%s %d instead of exit code 143; it said last: %s", WIFEXITED(status) ? "exit code" : "signal",
                     WIFEXITED(status) ? WEXITSTATUS(status) : WTERMSIG(status), said_last);
        assert_non_null(strstr(said_last, "stopped by a signal after 1 steps"));
    }
}

/* As timeout(1) sends it: to the process, then to its group. */
static void signal_that_is_sent_twice_in_a_row_ends_the_run_after_its_step(void **state)
{
    const struct timespec pause = {.tv_nsec = 20000000};
    char dir[400], line[500];
    FILE *said;
    int status, told = 0;
    pid_t pid;

    (void)state;
    snprintf(dir, sizeof dir, "%s/cavity", scratch());
    pid = start_cavity("n=64", dir, &said);
    wait_for_line(said, "newton  0");
    wait_for_work(pid, 0.05);
    for (int k = 0; k < 2; k++) {
        kill(pid, SIGTERM);
        nanosleep(&pause, NULL);
    }
    while (fgets(line, sizeof line, said))
        told |= strstr(line, "stopped by a signal") != NULL;
    fclose(said);
    assert_int_equal(waitpid(pid, &status, 0), pid);
    assert_true(WIFEXITED(status));
    assert_int_equal(WEXITSTATUS(status), 143);
    assert_true(told);
}

/* And not after the iteration, when it would say so. */
static void second_sigterm_ends_the_program_at_once(void **state)
{
    const struct timespec pause = {.tv_nsec = 400000000};
    char dir[400], line[500];
    FILE *said;
    int status;
    pid_t pid;

    (void)state;
    snprintf(dir, sizeof dir, "%s/cavity", scratch());
    pid = start_cavity("n=150", dir, &said);
    wait_for_line(said, "newton  0");
    wait_for_work(pid, 0.1);
    kill(pid, SIGTERM);
    nanosleep(&pause, NULL);
    kill(pid, SIGTERM);
    while (fgets(line, sizeof line, said))
        assert_null(strstr(line, "stopped by a signal"));
    fclose(said);
    assert_int_equal(waitpid(pid, &status, 0), pid);
    assert_true(WIFEXITED(status));
    assert_int_equal(WEXITSTATUS(status), 143);
}

/* Functions of a case that take long, and the set-up: nothing is lost yet, so the program ends at once. */
static void signals_before_the_run_end_the_program_at_once(void **state)
{
    static const char *const name[] = {"TERM", "HUP", "INT"};
    const char *path =
        put_file("slow.lua", "mesh { box = {{0,0},{1,1}}, cells = {8,8} }\n"
                             "fluid { density = 1, viscosity = 1 }\n"
                             "term 'continuity' {}\nterm 'momentum' {}\nboundary '*' { u = {0,0} }\n"
                             "initial { u = function(x, y) local s = 0 for i = 1, 2e7 do s = s + i end "
                             "return 0, 0 end }\n");

    (void)state;
    for (int k = 0; k < 3; k++) {
        assert_ran(
            shell("sh -c '\"$PLUGFLOW_PROGRAM\" run %s --out %s/slow%d & p=$!; sleep 1; kill -%s $p; wait $p; echo "
                  "code $?'; test ! -e %s/slow%d",
                  path, scratch(), k, name[k], scratch(), k),
            0, "nothing was written",
            k == 0   ? "code 143"
            : k == 1 ? "code 129"
                     : "code 130");
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sigterm_while_the_unknowns_are_ordered_ends_the_run_with_143),
        cmocka_unit_test(signals_before_the_run_end_the_program_at_once),
        cmocka_unit_test(signal_that_is_sent_twice_in_a_row_ends_the_run_after_its_step),
        cmocka_unit_test(second_sigterm_ends_the_program_at_once),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
