/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Signals: ask a run to end after its step; name the plugin in which a crash happened; end a
 * case file that does not come back. */
#include "cli/cli.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <unistd.h>

volatile sig_atomic_t cli_stop;
static char watchdog_text[600];

static void on_stop(int number)
{
    if (cli_stop)
        _exit(128 + number);
    cli_stop = number;
}

void cli_catch_signals(void)
{
    struct sigaction a = {.sa_handler = on_stop};

    sigaction(SIGINT, &a, NULL);
    sigaction(SIGTERM, &a, NULL);
    signal(SIGPIPE, SIG_IGN);
    signal(SIGXFSZ, SIG_IGN); /* a full quota is an error of write, not the end of the program */
}

static void put(const char *s)
{
    if (write(STDERR_FILENO, s, strlen(s)) < 0)
        return;
}

/* Only writes; then the signal goes its way. */
static void on_crash(int number)
{
    char digits[24], *d = digits + sizeof digits;
    int64_t n = term_now.cell;

    put("plugflow: crashed (");
    put(number == SIGSEGV   ? "bad memory access"
        : number == SIGFPE  ? "arithmetic trap"
        : number == SIGABRT ? "abort"
                            : "signal");
    put(")");
    if (term_now.plugin) {
        put(" inside term ");
        put(term_now.plugin);
        put(".");
        put(term_now.term);
        put(", ");
        put(term_now.phase);
        if (n >= 0) {
            put(", cells from ");
            *--d = 0;
            do
                *--d = (char)('0' + n % 10);
            while ((n /= 10) > 0);
            put(d);
            put("; plugflow test ");
            put(term_now.plugin);
            put(" runs it in isolation");
        }
    }
    put("\n");
    signal(number, SIG_DFL);
    raise(number);
}

void cli_catch_crashes(void)
{
    static char stack[1 << 16];
    stack_t s = {.ss_sp = stack, .ss_size = sizeof stack};
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
    put(watchdog_text);
    _exit(ERR_CASE);
}

void cli_watchdog(int seconds, const char *path)
{
    struct itimerval t = {.it_value = {.tv_sec = seconds}};
    struct sigaction a = {.sa_handler = on_watchdog};

    snprintf(watchdog_text, sizeof watchdog_text,
             "plugflow: %.400s: reading the case takes longer than %d s; is there an endless loop in it?\n", path,
             seconds);
    sigaction(SIGALRM, &a, NULL);
    setitimer(ITIMER_REAL, &t, NULL);
}
