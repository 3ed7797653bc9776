/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * cli.h -- the program: one file a command.  Results go to stdout, talk to stderr. */
#ifndef CLI_CLI_H
#define CLI_CLI_H

#include "base/error.h"
#include "problem/problem.h"
#include "term/term.h"

typedef struct cli {
    const char *operand[8];
    int n_operand;
    const char *set[CASE_MAX_SETS];
    int n_set;
    const char *plugin[16];
    int n_plugin;
    const char *out, *case_path;
    int n_thread, json, quiet;
    double memory_limit;
    /* picture */
    const char *field, *component, *slice;
    int width, arrows;
    double low, high;
    /* new */
    const char *fields, *on, *weak;
    /* describe */
    const char *all;
    int markdown;
} cli;

int cli_run(const cli *c, error *err);
int cli_check(const cli *c, error *err);
int cli_plugins(const cli *c, error *err);
int cli_describe(const cli *c, error *err);
int cli_test(const cli *c, error *err);
int cli_jacobian(const cli *c, error *err);
int cli_picture(const cli *c, error *err);
int cli_new(const cli *c, error *err);
int cli_build(const cli *c, error *err);

/* --- shared by the commands (main.c, signals.c) --- */

/* A case opened as the options say: case, registry, problem, in this order; closed by cli_close. */
typedef struct cli_case {
    case_file c;
    registry r;
    problem p;
} cli_case;
int cli_open(const cli *o, cli_case *k, error *err);
void cli_close(cli_case *k);

/* Before there is any other thread. */
void cli_catch_signals(void);
/* In a child process, which has no thread that takes them: SIGINT and SIGTERM end it. */
void cli_release_signals(void);
void cli_catch_crashes(void);
/* Ends the program with a message if the case file does not come back within `seconds` (0: off). */
void cli_watchdog(int seconds, const char *path);

#endif
