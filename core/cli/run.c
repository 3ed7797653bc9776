/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * plugflow run CASE. */
#include "base/clock.h"
#include "base/process.h"
#include "cli/cli.h"

#include "run/run.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef struct teller {
    int on_terminal, line_open;
    double start, last;
} teller;

static void say(void *ctx, const char *line)
{
    teller *t = ctx;

    if (t->line_open)
        fputc('\n', stderr);
    t->line_open = 0;
    if (*line && strspn(line, " ") < strlen(line))
        fprintf(stderr, "%s\n", line);
}

/* On a terminal one line that renews itself, ten times a second at most; else a line every ten seconds. */
static void progress(void *ctx, const run_progress *p)
{
    teller *t = ctx;
    double now = clock_seconds(), elapsed = now - t->start, rate = (double)p->step / (elapsed > 0 ? elapsed : 1);
    double left = (double)(p->steps - p->step) / rate;
    int last = p->step == p->steps;

    if (!last && now - t->last < (t->on_terminal ? 0.1 : 10) && p->step > 1)
        return;
    t->last = now;
    fprintf(stderr, "%s  step %ld/%ld  t %.5g  dt %.3g  newton %d  |r| %.1e  %.3g steps/s  %.0f s left%s",
            t->on_terminal ? "\r\033[K" : "", p->step, p->steps, p->t, p->dt, p->newton, p->residual, rate, left,
            t->on_terminal ? "" : "\n");
    t->line_open = t->on_terminal;
    fflush(stderr);
}

static void default_dir(const char *path, char *dir, size_t n)
{
    const char *slash = strrchr(path, '/'), *base = slash ? slash + 1 : path, *dot = strrchr(base, '.');

    snprintf(dir, n, "out/%.*s", (int)(dot ? dot - base : (long)strlen(base)), base);
}

static void introduce(const problem *p)
{
    char replaced[400];

    fprintf(stderr, "%s\n  %lld cells (%s), %lld unknowns (",
            p->description.c->title ? p->description.c->title : p->description.c->path, (long long)p->mesh.n_cell,
            p->mesh.type->name, (long long)p->space.n_dof);
    for (int f = 0; f < p->space.n_field; f++)
        fprintf(stderr, "%s%s", f ? ", " : "", p->space.field[f].name);
    fprintf(stderr, "), %d thread%s; set up in %.2g s\n", p->n_thread, p->n_thread > 1 ? "s" : "",
            p->setup_seconds);
    for (int i = 0; i < p->description.n_replaced; i++) {
        describe_tell_replaced(&p->description, i, replaced, sizeof replaced);
        fprintf(stderr, "  %s\n", replaced);
    }
}

static void conclude(const run_result *q, const char *dir)
{
    fprintf(stderr,
            "  %s in %.3g s: assemble %.2g, factor %.2g (%d), solve %.2g, output %.2g; peak memory %.3g MB\n",
            q->status, q->seconds_total, q->seconds_assemble, q->seconds_factor, q->factorisations,
            q->seconds_solve, q->seconds_output, q->peak_bytes / 1e6);
    for (int i = 0; i < q->n_error; i++)
        fprintf(stderr, "  error of %s: L2 %.3e, H1 %.3e (|%s| = %.3g)\n", q->error_norm[i].name,
                q->error_norm[i].l2, q->error_norm[i].h1, q->error_norm[i].name, q->error_norm[i].l2_exact);
    printf("%s/summary.json\n", dir);
}

static int print_file(const char *dir, const char *name)
{
    char path[4600], buffer[4096];
    size_t n;
    FILE *f;

    snprintf(path, sizeof path, "%s/%s", dir, name);
    f = fopen(path, "r");
    while (f && (n = fread(buffer, 1, sizeof buffer, f)) > 0)
        fwrite(buffer, 1, n, stdout);
    if (f)
        fclose(f);
    return 0;
}

int cli_run(const cli *o, error *err)
{
    cli_case *k = malloc(sizeof *k);
    teller t = {.start = clock_seconds()};
    run_talk talk = {.say = o->quiet ? NULL : say, .warn = say, .progress = o->quiet ? NULL : progress, .ctx = &t};
    const char *term = getenv("TERM");
    run_result result = {0};
    char dir[4096];
    size_t printed = 0;
    int status;

    if (!k)
        return error_memory(err, "case", sizeof *k);
    t.on_terminal = isatty(STDERR_FILENO) && !(term && strcmp(term, "dumb") == 0);
    if (o->out)
        snprintf(dir, sizeof dir, "%s", o->out);
    else
        default_dir(o->operand[0], dir, sizeof dir);
    status = cli_open(o, k, err);
    if (!status) {
        if (!o->quiet)
            introduce(&k->p);
        t.start = clock_seconds();
        printed = k->c.printed.n;
        status = run_problem(&k->p, dir, &talk, &process.stop, &result, err);
        if (t.line_open)
            fputc('\n', stderr);
        if (k->c.printed.n > printed && !o->quiet)
            fputs(k->c.printed.s + printed, stderr);
        if (result.status && o->json && (!status || status == ERR_CONVERGE))
            print_file(dir, "summary.json");
        if (!status && !o->quiet && !o->json)
            conclude(&result, dir);
        if (!status && process.stop) {
            error_set(err, 0, "stopped by a signal after %ld steps; what was computed until then is in %s",
                      result.steps, dir);
            status = 128 + process.stop;
        }
    }
    cli_close(k);
    free(k);
    return status;
}
