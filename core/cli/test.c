/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * plugflow test PLUGIN|TERM|FILE.so: the blocks of a plugin in isolation.  Runs in a child, so
 * that a plugin that crashes is reported like one that is wrong. */
#include "cli/cli.h"

#include "term/selftest.h"

#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

enum { TEST_SECONDS = 60 };

static void print_line(void *ctx, int ok, const char *text)
{
    (void)ctx;
    printf("  %s  %s\n", ok ? "ok   " : "WRONG", text);
    fflush(stdout);
}

static int test(const cli *o, error *err)
{
    static registry r;
    selftest s = {.line = print_line};
    const char *name = o->operand[0], *dot, *only = NULL;
    const term_plugin *p;
    size_t n = strlen(name);

    if (n > 3 && strcmp(name + n - 3, ".so") == 0) {
        term_file *f;

        TRY(registry_create(&r, NULL, 0, err));
        TRY(registry_load(&r, name, &f, err));
        if (!f->plugin.path) {
            printf("%s: a %s plugin; it loads\n", f->path, f->kind);
            return 0;
        }
        p = &f->plugin;
    } else {
        char plugin[128];

        dot = strchr(name, '.');
        snprintf(plugin, sizeof plugin, "%.*s", dot ? (int)(dot - name) : 127, name);
        only = dot ? dot + 1 : NULL;
        TRY(registry_create(&r, o->plugin, o->n_plugin, err));
        TRY(registry_equation(&r, plugin, &p, err));
    }
    printf("%s %s (%s)\n", p->d.name, p->d.version, p->path);
    TRY(selftest_run(&s, p, only, err));
    printf("%d passed, %d failed\n", s.passed, s.failed);
    fflush(stdout);
    return s.failed
               ? error_set(err, ERR_PLUGIN, "%s: %d of %d checks failed", p->d.name, s.failed, s.passed + s.failed)
               : 0;
}

int cli_test(const cli *o, error *err)
{
    int status = 0;
    pid_t child;

    fflush(stdout);
    child = fork();
    if (child < 0)
        return test(o, err);
    if (child == 0) {
        struct rlimit cpu = {TEST_SECONDS, TEST_SECONDS + 5};

        cli_release_signals();
        setrlimit(RLIMIT_CPU, &cpu);
        status = test(o, err);
        if (status)
            fprintf(stderr, "plugflow: %s\n", err->text);
        fflush(stdout);
        _exit(status);
    }
    waitpid(child, &status, 0);
    *err->text = 0;
    if (WIFEXITED(status))
        return WEXITSTATUS(status);
    if (WTERMSIG(status) == SIGXCPU)
        return error_set(err, ERR_PLUGIN,
                         "%s: the test takes longer than %d s; is there an endless loop after the last line above?",
                         o->operand[0], TEST_SECONDS);
    return error_set(err, ERR_PLUGIN, "%s: the test ended by signal %d (%s); the lines above say where",
                     o->operand[0], WTERMSIG(status), strsignal(WTERMSIG(status)));
}
