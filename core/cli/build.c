/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * plugflow build DIR|FILE: compiles a plugin of one file, DIR/DIR.c or .cpp, into a shared object beside it. */
#include "cli/build.h"
#include "cli/cli.h"

#include "base/arena.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum { MOST_WORDS = 64 };

static int has_headers(const char *dir)
{
    char path[PATH_MAX];

    return snprintf(path, sizeof path, "%s/plugflow/term.h", dir) < (int)sizeof path && access(path, R_OK) == 0;
}

/* The folder of plugflow/term.h: beside the program that runs, or of the source that it was built from. */
static const char *headers(char room[PATH_MAX])
{
    ssize_t n = readlink("/proc/self/exe", room, PATH_MAX - 32);

    if (n > 0) {
        room[n] = 0;
        for (int up = 0; up < 2 && strrchr(room, '/'); up++)
            *strrchr(room, '/') = 0;
        strcat(room, "/include");
        if (has_headers(room))
            return room;
    }
    return has_headers(PF_HEADERS_OF_SOURCE) ? PF_HEADERS_OF_SOURCE : PF_HEADERS;
}

/* FILE.c, FILE.cpp, or of a folder the source of its name. */
static int find_source(const char *operand, char source[PATH_MAX], error *err)
{
    char path[PATH_MAX];
    const char *dot = strrchr(operand, '.'), *name;
    size_t n = strlen(operand);

    if (dot && (strcmp(dot, ".c") == 0 || strcmp(dot, ".cpp") == 0)) {
        snprintf(source, PATH_MAX, "%s", operand);
        return access(source, R_OK) == 0
                   ? 0
                   : error_set(err, ERR_IO, "%s: cannot be read: %s", source, strerror(errno));
    }
    while (n > 1 && operand[n - 1] == '/')
        n--;
    if (n > PATH_MAX / 2 - 16)
        return error_set(err, ERR_USAGE, "the name of the folder is too long");
    snprintf(path, sizeof path, "%.*s", (int)n, operand);
    name = strrchr(path, '/') ? strrchr(path, '/') + 1 : path;
    for (int cpp = 0; cpp < 2; cpp++) {
        if (snprintf(source, PATH_MAX, "%s/%s.%s", path, name, cpp ? "cpp" : "c") < PATH_MAX &&
            access(source, R_OK) == 0)
            return 0;
    }
    return error_set(err, ERR_IO, "%s: there is neither %s.c nor %s.cpp in it; plugflow new NAME makes a folder",
                     path, name, name);
}

/* The words of a variable of the environment, or one word. */
static int add_words(char **word, int n, const char *variable, const char *otherwise, arena *memory)
{
    const char *value = getenv(variable);
    char *s = arena_strdup(memory, value && *value ? value : otherwise), *rest = NULL;

    for (char *w = s ? strtok_r(s, " ", &rest) : NULL; w && n < MOST_WORDS - 24; w = strtok_r(NULL, " ", &rest))
        word[n++] = w;
    return n;
}

/* The child's messages, passed on as they come, and kept as far as there is room. */
static void pass_on(int from, char *kept, size_t room)
{
    char block[4096];
    size_t n = 0;
    ssize_t got;

    while ((got = read(from, block, sizeof block)) > 0 || (got < 0 && errno == EINTR)) {
        if (got < 0)
            continue;
        fwrite(block, 1, (size_t)got, stderr);
        for (ssize_t i = 0; i < got && n + 1 < room; i++)
            kept[n++] = block[i] ? block[i] : ' ';
    }
    kept[n] = 0;
}

static int compile(char **word, const char *object, error *err)
{
    static char said[1 << 18];
    int status = 0, end[2], useless;
    pid_t child;

    fflush(stdout);
    if (pipe(end) != 0)
        return error_set(err, ERR_MEMORY, "no process for the compiler: %s", strerror(errno));
    child = fork();
    if (child < 0)
        return error_set(err, ERR_MEMORY, "no process for the compiler: %s", strerror(errno));
    if (child == 0) {
        cli_release_signals();
        dup2(end[1], STDERR_FILENO);
        close(end[0]);
        close(end[1]);
        execvp(word[0], word);
        fprintf(stderr, "plugflow: %s: %s; CC and CXX of the environment name other compilers\n", word[0],
                strerror(errno));
        _exit(127);
    }
    close(end[1]);
    pass_on(end[0], said, sizeof said);
    close(end[0]);
    waitpid(child, &status, 0);
    useless = build_hints(said);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0 && !useless)
        return 0;
    if (useless)
        unlink(object);
    return error_set(err, ERR_PLUGIN, "the compiler did not accept it; the lines above say why");
}

int cli_build(const cli *o, error *err)
{
    static const char *const flags[] = {
        "-O3",     "-march=native", "-fno-math-errno", "-ffp-contract=fast",         "-fPIC",
        "-shared", "-Wall",         "-Wshadow=local",  "-Wno-unknown-warning-option"};
    char source[PATH_MAX], object[PATH_MAX], room[PATH_MAX], include[PATH_MAX + 8], *word[MOST_WORDS];
    arena memory = {0};
    int n, is_cpp, status;

    TRY(find_source(o->operand[0], source, err));
    is_cpp = strcmp(strrchr(source, '.'), ".cpp") == 0;
    snprintf(object, sizeof object, "%.*s.so", (int)(strrchr(source, '.') - source), source);
    snprintf(include, sizeof include, "-I%s", headers(room));
    n = add_words(word, 0, is_cpp ? "CXX" : "CC", is_cpp ? "c++" : "cc", &memory);
    word[n++] = is_cpp ? "-std=gnu++17" : "-std=gnu11";
    for (size_t i = 0; i < sizeof flags / sizeof *flags; i++)
        word[n++] = (char *)(intptr_t)flags[i];
    n = add_words(word, n, is_cpp ? "CXXFLAGS" : "CFLAGS", "", &memory);
    word[n++] = include;
    word[n++] = source;
    word[n++] = "-o";
    word[n++] = object;
    word[n++] = "-lm";
    word[n] = NULL;
    for (int i = 0; i < n; i++)
        printf("%s%s", word[i], i + 1 < n ? " " : "\n");
    status = compile(word, object, err);
    arena_free(&memory);
    TRY(status);
    printf("%s\n\n  plugflow test %s%s\n", object, *object == '/' || *object == '.' ? "" : "./", object);
    return 0;
}
