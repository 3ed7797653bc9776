/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * plugflow COMMAND [options]: options, dispatch, exit codes. */
#include "cli/cli.h"

#include <errno.h>
#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { MOST_THREADS = 256 };

static const struct command {
    const char *name, *operands, *doc;
    int (*run)(const cli *, error *);
    int n_min, n_max;
} commands[] = {
    {"run", "CASE", "solve a case and write its results", cli_run, 1, 1},
    {"check", "CASE", "read, mesh and assemble once: unknowns, memory, cost; writes nothing", cli_check, 1, 1},
    {"plugins", "", "what is found, where, which version, what was refused and why", cli_plugins, 0, 0},
    {"describe", "[PLUGIN|TERM]", "weak form, keys, slots, citation; --markdown: as a page", cli_describe, 0, 1},
    {"test", "PLUGIN|TERM|FILE.so", "every block of a plugin in isolation; --case CASE: of a case", cli_test, 0, 1},
    {"jacobian", "CASE", "derivatives on the real problem, per pair of blocks", cli_jacobian, 1, 1},
    {"new", "NAME", "a folder with a new plugin that runs: --fields, --on, --weak FORM", cli_new, 1, 1},
    {"build", "DIR|FILE.c", "compile a plugin", cli_build, 1, 1},
    {"picture", "DIR", "a field of a finished run as PNG or SVG", cli_picture, 1, 1},
};

static const char options_text[] =
    "options:\n"
    "  --set NAME=VALUE     a parameter of the case\n"
    "  --out DIR|FILE       folder of the results (run), file of the picture (picture)\n"
    "  --threads N          threads (default: all cores)\n"
    "  --plugin FILE.so     load this plugin, too (may be repeated; PLUGFLOW_PLUGIN_PATH adds folders)\n"
    "  --memory GB          stop if the factors need more (default: what is free)\n"
    "  --case CASE          test the terms of this case with its parameters, on its points and states (test)\n"
    "  --json               machine-readable summary on stdout (run, check, test)\n"
    "  --quiet              only warnings and errors on stderr\n"
    "  picture: --field NAME --component x|y|z|magnitude --range LOW,HIGH --slice z=0.5 --width PIXELS --arrows\n"
    "  new: --on cells|fluid|solid|facets|surface|bodies|pairs --fields u,T,NAME:scalar|vector:ORDER --weak FORM\n"
    "  describe: --markdown; with --all DIR a page for each plugin of the first folder that is looked in\n"
    "exit codes: 0 ok, 2 usage, 3 case, 4 mesh, 5 plugin, 6 did not converge, 7 input/output, 8 memory, 128+n "
    "signal\n";

static void usage(FILE *f)
{
    fprintf(f, "plugflow %s: incompressible and particulate flow from terms that are plugins\n\n", PF_VERSION);
    for (size_t i = 0; i < sizeof commands / sizeof *commands; i++)
        fprintf(f, "  plugflow %-9s%-21s %s\n", commands[i].name, commands[i].operands, commands[i].doc);
    fprintf(f, "\n%s", options_text);
}

/* The value of option `name` if argv[*i] is it, as "--name value" or "--name=value". */
static const char *option(int argc, char **argv, int *i, const char *name, int *bad)
{
    size_t n = strlen(name);

    if (strncmp(argv[*i], name, n) != 0)
        return NULL;
    if (argv[*i][n] == '=')
        return argv[*i] + n + 1;
    if (argv[*i][n])
        return NULL;
    if (*i + 1 < argc)
        return argv[++*i];
    *bad = 1;
    return "";
}

static int number_option(const char *name, const char *s, double low, double *out, error *err)
{
    char *end;
    double v = strtod(s, &end);

    if (*end || end == s || !(v >= low))
        return error_set(err, ERR_USAGE, "%s %s: expected a number of at least %g", name, s, low);
    *out = v;
    return 0;
}

static int parse_option(int argc, char **argv, int *i, cli *c, error *err)
{
    const char *v, *here = argv[*i];
    double x;
    int bad = 0;

    if ((v = option(argc, argv, i, "--set", &bad))) {
        if (c->n_set == CASE_MAX_SETS)
            return error_set(err, ERR_USAGE, "more than %d --set", CASE_MAX_SETS);
        c->set[c->n_set++] = v;
    } else if ((v = option(argc, argv, i, "--plugin", &bad))) {
        if (c->n_plugin == 16)
            return error_set(err, ERR_USAGE, "more than 16 --plugin");
        c->plugin[c->n_plugin++] = v;
    } else if ((v = option(argc, argv, i, "--out", &bad))) {
        c->out = v;
    } else if ((v = option(argc, argv, i, "--case", &bad))) {
        c->case_path = v;
    } else if ((v = option(argc, argv, i, "--threads", &bad))) {
        if (!bad)
            TRY(number_option("--threads", v, 1, &x, err));
        if (!bad && (x > MOST_THREADS || x != floor(x)))
            return error_set(err, ERR_USAGE, "--threads %s: expected a whole number up to %d", v, MOST_THREADS);
        c->n_thread = bad ? 1 : (int)x;
    } else if ((v = option(argc, argv, i, "--memory", &bad))) {
        if (!bad)
            TRY(number_option("--memory", v, 0, &x, err));
        c->memory_limit = bad ? 0 : 1e9 * x;
    } else if ((v = option(argc, argv, i, "--field", &bad))) {
        c->field = v;
    } else if ((v = option(argc, argv, i, "--component", &bad))) {
        c->component = v;
    } else if ((v = option(argc, argv, i, "--slice", &bad))) {
        c->slice = v;
    } else if ((v = option(argc, argv, i, "--fields", &bad))) {
        c->fields = v;
    } else if ((v = option(argc, argv, i, "--on", &bad))) {
        c->on = v;
    } else if ((v = option(argc, argv, i, "--weak", &bad))) {
        c->weak = v;
    } else if ((v = option(argc, argv, i, "--width", &bad))) {
        if (!bad)
            TRY(number_option("--width", v, 1, &x, err));
        c->width = bad ? 0 : (int)fmin(x, 1e9);
    } else if ((v = option(argc, argv, i, "--range", &bad))) {
        if (sscanf(v, "%lf,%lf", &c->low, &c->high) != 2 || !(c->low < c->high))
            return error_set(err, ERR_USAGE, "--range %s: expected LOW,HIGH", v);
    } else if ((v = option(argc, argv, i, "--all", &bad))) {
        c->all = v;
    } else if (strcmp(here, "--markdown") == 0) {
        c->markdown = 1;
    } else if (strcmp(here, "--json") == 0) {
        c->json = 1;
    } else if (strcmp(here, "--quiet") == 0 || strcmp(here, "-q") == 0) {
        c->quiet = 1;
    } else if (strcmp(here, "--arrows") == 0) {
        c->arrows = 1;
    } else {
        return error_set(err, ERR_USAGE, "unknown option %s; plugflow --help lists them", here);
    }
    return bad ? error_set(err, ERR_USAGE, "%s needs a value", here) : 0;
}

static int parse(int argc, char **argv, cli *c, error *err)
{
    c->n_thread = omp_get_max_threads();
    for (int i = 2; i < argc; i++) {
        if (argv[i][0] == '-' && argv[i][1]) {
            TRY(parse_option(argc, argv, &i, c, err));
        } else {
            if (c->n_operand == 8)
                return error_set(err, ERR_USAGE, "too many arguments");
            c->operand[c->n_operand++] = argv[i];
        }
    }
    return 0;
}

static const struct command *find_command(const char *name, error *err)
{
    const char *names[16];
    size_t n = sizeof commands / sizeof *commands;

    for (size_t i = 0; i < n; i++) {
        names[i] = commands[i].name;
        if (strcmp(name, names[i]) == 0)
            return &commands[i];
    }
    error_set(err, ERR_USAGE, "unknown command \"%s\"%s; plugflow --help lists them", name,
              text_hint(text_nearest(name, names, n)).s);
    return NULL;
}

static int dispatch(int argc, char **argv, error *err)
{
    const int help = strcmp(argv[1], "help") == 0; /* of a command */
    const struct command *command = find_command(argv[1 + help], err);
    cli c = {0};

    if (!command)
        return err->code;
    for (int i = 2; i < argc; i++)
        if (help || strcmp(argv[i], "--help") == 0) {
            usage(stdout);
            return 0;
        }
    TRY(parse(argc, argv, &c, err));
    if (c.n_operand < command->n_min || c.n_operand > command->n_max)
        return error_set(err, ERR_USAGE, "usage: plugflow %s %s [options]", command->name, command->operands);
    return command->run(&c, err);
}

int main(int argc, char **argv)
{
    static error err;
    int status;

    if (argc < 2 || strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0 ||
        (argc == 2 && strcmp(argv[1], "help") == 0)) {
        usage(argc < 2 ? stderr : stdout);
        return argc < 2 ? ERR_USAGE : 0;
    }
    if (strcmp(argv[1], "--version") == 0) {
        printf("plugflow %s\n", PF_VERSION);
        return 0;
    }
    if (strcmp(argv[1], "test") != 0 && strcmp(argv[1], "build") != 0) /* these fork, which wants one thread */
        cli_catch_signals();
    cli_catch_crashes();
    status = dispatch(argc, argv, &err);
    if (status && *err.text)
        fprintf(stderr, "plugflow: %s\n", err.text);
    if (!status && fflush(stdout) != 0) {
        fprintf(stderr, "plugflow: standard output cannot be written: %s\n", strerror(errno));
        status = ERR_IO;
    }
    return status;
}
