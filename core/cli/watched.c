/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A child process for the code of plugins.  Every call has a limit of its own, in time of the processor (a machine
 * may be busy) and, for one that sleeps, by the clock. */
#include "cli/watched.h"

#include "cli/cli.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

enum { BY_CLOCK = 15, ALL_SECONDS = 240 }; /* what a call may take by the clock, in those of the processor */

/* For the handler of the alarm. */
static watched *here;

static void on_slow(int number)
{
    (void)number;
    here->slow = 1;
    _exit(ERR_PLUGIN);
}

/* Seconds of the processor that a call may take; tests of the test have no time to wait. */
static double call_seconds(void)
{
    const char *given = getenv("PLUGFLOW_CALL_SECONDS");
    const double v = given ? atof(given) : 0;

    return v > 0 && v < 100 ? v : 2;
}

static struct itimerval after(double seconds)
{
    const time_t whole = (time_t)seconds;

    return (struct itimerval){.it_value = {whole, (suseconds_t)(1e6 * (seconds - (double)whole))}};
}

static void set_alarms(double busy)
{
    const struct itimerval of_processor = after(busy), of_clock = after(BY_CLOCK * busy);

    setitimer(ITIMER_VIRTUAL, &of_processor, NULL);
    setitimer(ITIMER_REAL, &of_clock, NULL);
}

void watched_enter(watched *w, const char *subject, const char *what)
{
    if (what) {
        snprintf(w->in, sizeof w->in, "%s, %s", subject, what);
        set_alarms(call_seconds());
    } else {
        set_alarms(0);
        *w->in = 0;
    }
}

static void prepare(watched *w)
{
    const struct rlimit cpu = {ALL_SECONDS, ALL_SECONDS + 5};
    const struct sigaction a = {.sa_handler = on_slow};
    sigset_t set;

    here = w;
    cli_release_signals();
    setrlimit(RLIMIT_CPU, &cpu);
    sigaction(SIGALRM, &a, NULL);
    sigaction(SIGVTALRM, &a, NULL);
    sigemptyset(&set);
    sigaddset(&set, SIGALRM);
    sigaddset(&set, SIGVTALRM);
    sigprocmask(SIG_UNBLOCK, &set, NULL);
}

/* How the child ended, in words. */
static int judge(const watched *w, int status, const char *subject, error *err)
{
    const char *in = *w->in ? w->in : "the test, between calls";

    if (WIFEXITED(status) && w->done)
        return WEXITSTATUS(status);
    if (w->slow)
        return error_set(
            err, ERR_PLUGIN,
            "%s: inside %s: the call does not come back (more than %g s of computing); an endless loop?", subject,
            in, call_seconds());
    if (WIFEXITED(status))
        return error_set(err, ERR_PLUGIN,
                         "%s: inside %s: the plugin ended the whole process, with exit code %d; it must return",
                         subject, in, WEXITSTATUS(status));
    if (WTERMSIG(status) == SIGXCPU)
        return error_set(err, ERR_PLUGIN, "%s: the test takes longer than %d s; the last call was inside %s",
                         subject, ALL_SECONDS, in);
    return error_set(err, ERR_PLUGIN, "%s: the test ended by signal %d (%s) inside %s", subject, WTERMSIG(status),
                     strsignal(WTERMSIG(status)), in);
}

int watched_run(int (*work)(watched *w, void *arg, error *err), void *arg, const char *subject, watched *out,
                error *err)
{
    watched *w = mmap(NULL, sizeof *w, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    int status = 0;
    pid_t child;

    if (w == MAP_FAILED)
        return error_memory(err, "test", sizeof *w);
    fflush(stdout);
    child = fork();
    if (child == 0) {
        prepare(w);
        status = work(w, arg, err);
        if (status)
            fprintf(stderr, "plugflow: %s\n", err->text);
        fflush(stdout);
        w->done = 1;
        _exit(status);
    }
    *err->text = 0;
    if (child < 0) {
        munmap(w, sizeof *w);
        return error_set(err, ERR_MEMORY, "%s: no process can be started for the test", subject);
    }
    waitpid(child, &status, 0);
    status = judge(w, status, subject, err);
    *out = *w;
    munmap(w, sizeof *w);
    return status;
}
