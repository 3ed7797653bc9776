/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Signals: ask a run to end after its step; name the plugin in which a crash happened; end a
 * case file that does not come back. */
#include "base/process.h"
#include "cli/cli.h"

#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

static sigset_t stop_signals(void)
{
    sigset_t set;

    sigemptyset(&set);
    sigaddset(&set, SIGINT);
    sigaddset(&set, SIGTERM);
    sigaddset(&set, SIGHUP);
    return set;
}

static void put(const char *s)
{
    if (write(STDERR_FILENO, s, strlen(s)) < 0)
        return;
}

/* Which term some thread is in now: " (inside term gnf.stress, residual)", or nothing.  Read while it may change,
 * so until two readings agree; the strings stay where they are. */
static void put_place(void)
{
    for (int i = 0; i < PROCESS_MAX_THREADS; i++) {
        const volatile breadcrumb *now = &process.thread[i].now;
        const breadcrumb in = {now->plugin, now->term, now->phase, -1};

        if (!in.plugin || !in.term || !in.phase || now->plugin != in.plugin || now->term != in.term ||
            now->phase != in.phase)
            continue;
        put(" (inside term ");
        put(in.plugin);
        put(".");
        put(in.term);
        put(", ");
        put(in.phase);
        put(")");
        return;
    }
}

/* A thread that does nothing else.  Before there is anything to lose a signal ends the program at once; in a run
 * the first asks it to end after its step, the second ends it at once. What comes right after the first is still
 * the first: timeout(1) and batch systems send it to the process and to its group.  A run that is still there after
 * a while, in a long step or in a term that does not come back, says how to end it. */
static void *take_signals(void *unused)
{
    const sigset_t set = stop_signals();
    const struct timespec at_once = {0}, a_moment = {.tv_nsec = 200000000}, a_while = {.tv_sec = 2};
    int number;

    (void)unused;
    sigwait(&set, &number);
    process.stop = number;
    if (!process.running) {
        put("plugflow: stopped by a signal before the run began; nothing was written");
        put_place();
        put("\n");
        _exit(128 + number);
    }
    nanosleep(&a_moment, NULL);
    while (sigtimedwait(&set, NULL, &at_once) > 0)
        ;
    number = sigtimedwait(&set, NULL, &a_while);
    if (number < 0) {
        put("plugflow: the run ends after this step");
        put_place();
        put("; another signal ends it at once\n");
        sigwait(&set, &number);
    }
    put("plugflow: ended at once by a second signal");
    put_place();
    put("\n");
    _exit(128 + number);
}

/* SIGINT, SIGTERM and SIGHUP are blocked in all threads (those to come inherit it) and taken by one, so that no
 * library can take them in between.  METIS does: while it runs, its own handler of SIGTERM makes it fail, which
 * nobody hears of, and jumps out of whatever was interrupted, malloc too.  Without the thread both end the program
 * at once, as usual. */
void cli_catch_signals(void)
{
    const sigset_t set = stop_signals();
    sigset_t all, before;
    pthread_t taker;

    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before); /* the thread takes no alarm and no signal of others */
    if (pthread_create(&taker, NULL, take_signals, NULL) == 0) {
        pthread_detach(taker);
        sigorset(&before, &before, &set);
    }
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    signal(SIGPIPE, SIG_IGN);
    signal(SIGXFSZ, SIG_IGN); /* a full quota is an error of write, not the end of the program */
}

void cli_release_signals(void)
{
    const sigset_t set = stop_signals();

    pthread_sigmask(SIG_UNBLOCK, &set, NULL);
}

/* Only writes; then the signal goes its way. */
static void on_crash(int number)
{
    char digits[24], *d = digits + sizeof digits;
    const breadcrumb in = process_now();
    int64_t n = in.cell;

    put("plugflow: crashed (");
    put(number == SIGSEGV   ? "bad memory access"
        : number == SIGFPE  ? "arithmetic trap"
        : number == SIGABRT ? "abort"
                            : "signal");
    put(")");
    if (in.plugin) {
        put(" inside term ");
        put(in.plugin);
        put(".");
        put(in.term);
        put(", ");
        put(in.phase);
        if (n >= 0) {
            put(", cells from ");
            *--d = 0;
            do
                *--d = (char)('0' + n % 10);
            while ((n /= 10) > 0);
            put(d);
            put("; plugflow test ");
            put(in.plugin);
            put(" runs it in isolation");
        }
    }
    put("\n");
    signal(number, SIG_DFL);
    raise(number);
}

void cli_catch_crashes(void)
{
    stack_t s = {.ss_sp = process.crash_stack, .ss_size = sizeof process.crash_stack};
    struct sigaction a = {.sa_handler = on_crash, .sa_flags = SA_ONSTACK};

    sigaltstack(&s, NULL);
    sigaction(SIGSEGV, &a, NULL);
    sigaction(SIGBUS, &a, NULL);
    sigaction(SIGFPE, &a, NULL);
    sigaction(SIGABRT, &a, NULL);
}

static void on_watchdog(int number)
{
    (void)number;
    put(process.watchdog);
    _exit(ERR_CASE);
}

void cli_watchdog(int seconds, const char *path)
{
    struct itimerval t = {.it_value = {.tv_sec = seconds}};
    struct sigaction a = {.sa_handler = on_watchdog};

    snprintf(process.watchdog, sizeof process.watchdog,
             "plugflow: %.400s: reading the case takes longer than %d s; is there an endless loop in it?\n", path,
             seconds);
    sigaction(SIGALRM, &a, NULL);
    setitimer(ITIMER_REAL, &t, NULL);
}
