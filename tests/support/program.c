/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

static char *read_all(const char *path)
{
    FILE *f = fopen(path, "rb");
    char *s = NULL;
    long n = 0;

    if (f && fseek(f, 0, SEEK_END) == 0 && (n = ftell(f)) >= 0) {
        rewind(f);
        s = calloc(1, (size_t)n + 1);
        if (s && fread(s, 1, (size_t)n, f) != (size_t)n)
            s[0] = 0;
    }
    if (f)
        fclose(f);
    return s ? s : calloc(1, 1);
}

const char *scratch(void)
{
    static char dir[200];

    if (!*dir) {
        const char *tmp = getenv("TMPDIR");

        snprintf(dir, sizeof dir, "%.150s/plugflow-test-%ld", tmp && *tmp ? tmp : "/tmp", (long)getpid());
        mkdir(dir, 0777);
    }
    return dir;
}

static void __attribute__((destructor)) remove_scratch(void)
{
    char command[300];

    if (getenv("PLUGFLOW_KEEP_SCRATCH"))
        return;
    snprintf(command, sizeof command, "rm -rf '%s'", scratch());
    if (system(command) != 0)
        return;
}

const char *put_file(const char *name, const char *text)
{
    static char path[4][400];
    static int k;
    FILE *f;

    k = (k + 1) % 4;
    snprintf(path[k], sizeof path[k], "%s/%s", scratch(), name);
    f = fopen(path[k], "wb");
    assert_non_null(f);
    fputs(text, f);
    fclose(f);
    return path[k];
}

static ran run_line(const char *line)
{
    static ran r;
    char *command = NULL, out[400], err[400];
    int status;

    free(r.out);
    free(r.err);
    snprintf(out, sizeof out, "%s/stdout", scratch());
    snprintf(err, sizeof err, "%s/stderr", scratch());
    if (asprintf(&command, "( %s ) >'%s' 2>'%s' </dev/null", line, out, err) < 0)
        fail_msg("out of memory");
    status = system(command);
    free(command);
    r.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    r.out = read_all(out);
    r.err = read_all(err);
    return r;
}

ran shell(const char *fmt, ...)
{
    char *line = NULL;
    va_list ap;
    ran r;

    va_start(ap, fmt);
    if (vasprintf(&line, fmt, ap) < 0)
        line = NULL;
    va_end(ap);
    r = run_line(line);
    free(line);
    return r;
}

ran plugflow(const char *fmt, ...)
{
    char *arguments = NULL;
    va_list ap;
    ran r;

    va_start(ap, fmt);
    if (vasprintf(&arguments, fmt, ap) < 0)
        arguments = NULL;
    va_end(ap);
    r = shell("%s %s", getenv("PLUGFLOW_PROGRAM"), arguments);
    free(arguments);
    return r;
}

const char *strict(const char *path)
{
    const char *to = put_file("strict.lua", "");

    assert_int_equal(shell("{ cat %s; printf '\\nsolve { tolerance = 1e-11 }\\n'; } > %s", path, to).code, 0);
    return to;
}

double summary(const char *dir, const char *keys)
{
    char path[600], key[100], quoted[120];
    char *s, *at;
    double v = NAN;

    snprintf(path, sizeof path, "%s/%s/summary.json", *dir == '/' ? "" : scratch(), dir);
    s = read_all(path);
    at = s;
    while (at && *keys) {
        size_t n = strcspn(keys, ".");

        snprintf(key, sizeof key, "%.*s", (int)n, keys);
        snprintf(quoted, sizeof quoted, "\"%s\":", key);
        at = strstr(at, quoted);
        at = at ? at + strlen(quoted) : NULL;
        keys += n + (keys[n] == '.');
    }
    if (at && sscanf(at, "%lf", &v) != 1)
        v = NAN;
    free(s);
    return v;
}

int csv_column(const char *path, const char *column, double **v)
{
    char *s = read_all(path), *line = s, *end;
    int index = -1, n = 0, room = 0, k = 0;

    *v = NULL;
    end = strchr(line, '\n');
    for (char *p = line; end && p < end; k++) {
        size_t w = strcspn(p, ",\n");

        if (strlen(column) == w && strncmp(p, column, w) == 0)
            index = k;
        p += w + 1;
    }
    for (line = end ? end + 1 : NULL; index >= 0 && line && *line; line = end ? end + 1 : NULL) {
        char *p = line;

        end = strchr(line, '\n');
        for (int i = 0; i < index && p; i++)
            p = strchr(p, ',') + 1;
        if (n == room)
            *v = realloc(*v, (size_t)(room = 2 * room + 64) * sizeof **v);
        (*v)[n++] = *p == ',' || *p == '\n' ? NAN : strtod(p, NULL);
    }
    free(s);
    return n;
}

int step_column(const char *path, const char *column, double **v)
{
    int n = csv_column(path, column, v);

    assert_true(n > 0);
    memmove(*v, *v + 1, (size_t)(n - 1) * sizeof **v);
    return n - 1;
}

void support_between(const char *what, double v, double low, double high, const char *file, int line)
{
    if (v >= low && v <= high)
        return;
    print_error("%s:%d: %s = %.15g, expected %.15g to %.15g\n", file, line, what, v, low, high);
    fail();
}

void support_ran(ran r, int code, const char *const *texts, const char *file, int line)
{
    int ok = r.code == code;

    for (int i = 0; texts[i]; i++)
        if (!strstr(r.out, texts[i]) && !strstr(r.err, texts[i])) {
            print_error("%s:%d: not printed: \"%s\"\n", file, line, texts[i]);
            ok = 0;
        }
    if (ok)
        return;
    print_error("%s:%d: exit code %d, expected %d\n--- stdout\n%s\n--- stderr\n%s\n", file, line, r.code, code,
                r.out, r.err);
    fail();
}
