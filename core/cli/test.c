/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * plugflow test PLUGIN|TERM|FILE.so: the blocks of a plugin in isolation, or a linear solver on systems of known
 * solution.  Runs in a child, so
 * that a plugin that crashes is reported like one that is wrong. */
#include "cli/test.h"
#include "cli/watched.h"

#include "base/text.h"
#include "solve/trial.h"
#include "term/surroundings.h"

#include <stdio.h>
#include <string.h>

/* One test as it goes on. */
typedef struct test_run {
    const cli *o;
    watched *w;
} test_run;

static void print_line(void *ctx, int ok, const char *text)
{
    test_run *t = ctx;

    if (t->o->json) {
        struct text line = {0};

        text_json(&line, text);
        printf("%s\n  {\"ok\": %s, \"text\": %s}", t->w->passed + t->w->failed ? "," : "", ok ? "true" : "false",
               line.s ? line.s : "null");
        text_free(&line);
    } else {
        printf("  %s  %s\n", ok ? "ok   " : "WRONG", text);
    }
    *(ok ? &t->w->passed : &t->w->failed) += 1;
    fflush(stdout);
}

static void on_call(void *ctx, const char *plugin, const char *term, const char *what)
{
    test_run *t = ctx;
    char subject[200];

    if (term)
        snprintf(subject, sizeof subject, "term %.80s.%.80s", plugin, term);
    else
        snprintf(subject, sizeof subject, "%.80s", plugin);
    watched_enter(t->w, subject, what);
}

/* A case finds a plugin by the name of its file. */
static void check_name(selftest *s, const char *path, const char *name)
{
    const char *file = strrchr(path, '/') ? strrchr(path, '/') + 1 : path;
    const size_t n = strlen(name);
    char text[500];

    if (strncmp(file, name, n) == 0 && strcmp(file + n, ".so") == 0)
        return;
    s->failed++;
    snprintf(text, sizeof text,
             "the file %.180s holds a plugin \"%.180s\": they must have the same name, by which a case finds it",
             file, name);
    s->line(s->ctx, 0, text);
}

/* Loads the plugin that the operand means. */
static int load(const cli *o, watched *w, registry *r, term_file **file, const term_plugin **p,
                const pf_solver **solver, const char **only, error *err)
{
    const char *name = o->operand[0], *dot = strchr(name, '.');
    const size_t n = strlen(name);
    char plugin[128], why[300];
    surroundings before;
    int status;

    *file = NULL, *only = NULL, *p = NULL, *solver = NULL;
    surroundings_take(&before);
    TRY(registry_create(r, o->plugin, o->n_plugin, err));
    watched_enter(w, name, "while it is loaded");
    if (n > 3 && strcmp(name + n - 3, ".so") == 0) {
        status = registry_load(r, name, file, err);
        *p = status ? NULL : &(*file)->plugin;
        *solver = status ? NULL : (*file)->solver;
    } else if (strncmp(name, "solver_", 7) == 0) {
        status = registry_solver(r, name, solver, err);
    } else {
        snprintf(plugin, sizeof plugin, "%.*s", dot ? (int)(dot - name) : 127, name);
        *only = dot ? dot + 1 : NULL;
        status = registry_equation(r, plugin, p, err);
    }
    watched_enter(w, name, NULL);
    if (!status && surroundings_changed(&before, why, sizeof why))
        status = error_set(err, ERR_PLUGIN, "%s: loading it %s", name, why);
    surroundings_release(&before);
    return status;
}

static int finish(const cli *o, const selftest *s, const char *subject, error *err)
{
    if (!o->json)
        printf("%d passed, %d failed\n", s->passed, s->failed);
    return s->failed
               ? error_set(err, ERR_PLUGIN, "%s: %d of %d checks failed", subject, s->failed, s->passed + s->failed)
               : 0;
}

static int test(watched *w, void *arg, error *err)
{
    static registry r;
    const cli *o = arg;
    test_run t = {o, w};
    selftest s = {.line = print_line, .enter = on_call, .ctx = &t};
    const term_plugin *p;
    const pf_solver *solver;
    const char *only;
    term_file *f;

    if (o->case_path) {
        TRY(cli_test_case(o, &s, err));
        return finish(o, &s, o->case_path, err);
    }
    TRY(load(o, w, &r, &f, &p, &solver, &only, err));
    if (solver) {
        if (!o->json)
            printf("%s %s: %s\n", solver->name, solver->version, solver->doc);
        TRY(trial_run(&s, solver, err));
        return finish(o, &s, solver->name, err);
    }
    if (f && !f->plugin.path) {
        if (!o->json)
            printf("%s: a %s plugin; it loads\n", f->path, f->kind);
        return 0;
    }
    if (!o->json)
        printf("%s %s (%s)\n", p->d.name, p->d.version, p->path);
    if (f)
        check_name(&s, f->path, p->d.name);
    TRY(selftest_run(&s, p, only, err));
    return finish(o, &s, p->d.name, err);
}

int cli_test(const cli *o, error *err)
{
    watched w = {0};
    text t = {0};
    int status;

    if (!o->n_operand && !o->case_path)
        return error_set(err, ERR_USAGE,
                         "usage: plugflow test PLUGIN|TERM|FILE.so [options], or plugflow test --case CASE");
    if (o->json)
        printf("{\"checks\": [");
    status = watched_run(test, (void *)o, o->n_operand ? o->operand[0] : o->case_path, &w, err);
    if (!o->json)
        return status;
    text_json(&t, err->text);
    printf("\n], \"passed\": %d, \"failed\": %d, \"exit\": %d, \"error\": %s}\n", w.passed, w.failed, status,
           *err->text ? t.s : "null");
    text_free(&t);
    return status;
}
