/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * plugflow new NAME: a folder with a plugin that is sound, a case in which it runs, and what to do next.  The term
 * comes from a weak form: the given one, or one that suits the fields. */
#include "cli/new.h"

#include "base/text.h"

#include <ctype.h>
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const struct place {
    const char *name, *where;
    int bodies;
} places[] = {{"cells", "PF_CELL", 0},   {"fluid", "PF_FLUID", 0},     {"solid", "PF_SOLID", 1},
              {"facets", "PF_FACET", 0}, {"surface", "PF_SURFACE", 1}, {"bodies", "PF_PARTICLE", 1},
              {"pairs", "PF_PAIR", 2}};
enum { N_PLACE = sizeof places / sizeof *places };

static int find_place(const cli *o, const struct place **p, error *err)
{
    const char *name = o->on ? o->on : "fluid", *names[N_PLACE];

    for (int i = 0; i < N_PLACE; i++) {
        names[i] = places[i].name;
        *p = &places[i];
        if (strcmp(name, names[i]) == 0)
            return 0;
    }
    return error_set(err, ERR_USAGE, "--on %s%s: expected cells, fluid, solid, facets, surface, bodies or pairs",
                     name, text_hint(text_nearest(name, names, N_PLACE)).s);
}

/* The name is that of the plugin, of its term and of its files; nothing of it is there. */
static int check_name(const char *name, error *err)
{
    static registry r;
    const char *near;
    int known;

    if (!isalpha((unsigned char)*name) ||
        strspn(name, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_") != strlen(name) ||
        strlen(name) > 40)
        return error_set(
            err, ERR_USAGE,
            "\"%s\": the name of a plugin begins with a letter and has letters, digits and _ (40 at most); "
            "the folder is made here",
            name);
    if (strlen(name) < 2)
        return error_set(err, ERR_USAGE, "\"%s\": give the plugin a name of at least two letters", name);
    if (access(name, F_OK) == 0)
        return error_set(err, ERR_IO,
                         "%s exists already; nothing is written over it: choose another name or remove it", name);
    TRY(registry_create(&r, NULL, 0, err));
    known = registry_knows(&r, name, &near);
    registry_destroy(&r);
    if (known)
        return error_set(err, ERR_USAGE,
                         "there is a plugin \"%s\" already (plugflow describe %s); choose another name", name,
                         name);
    return 0;
}

/* A form that suits the last of the fields. */
static int usual_form(const cli *o, const struct place *p, text *form, error *err)
{
    const int inside = p->where[3] == 'C' || strcmp(p->name, "fluid") == 0;
    const char *fields = o->fields ? o->fields : inside ? "T" : strcmp(p->name, "solid") == 0 ? "U" : "u";
    char name[40], test[48];
    int rank;

    TRY(weak_last_field(fields, name, &rank, test, err));
    if (!inside && strcmp(name, "u") != 0 && strcmp(name, "U") != 0)
        return error_set(err, ERR_USAGE,
                         "--on %s --fields %s: %s needs an equation inside, too; give the form of yours by --weak",
                         p->name, fields, name);
    if (rank && (!inside || strcmp(name, "u") == 0))
        text_add(form, "resistance*dot(%s, %s)", name, test);
    else if (rank)
        text_add(form, "resistance*dot(%s, %s) + diffusivity*inner(grad(%s), grad(%s))", name, test, name, test);
    else
        text_add(form, "diffusivity*dot(grad(%s), grad(%s))", name, test);
    if (!rank && strncmp(fields, "u,", 2) == 0 && strcmp(name, "p") != 0)
        text_add(form, " + dot(u, grad(%s))*%s", name, test);
    return 0;
}

static int write_file(const char *dir, const char *name, const char *extension, const text *t, error *err)
{
    char path[200];
    FILE *f;
    int bad;

    snprintf(path, sizeof path, "%s/%s%s", dir, name, extension);
    if (t->failed)
        return error_memory(err, path, (double)t->n);
    f = fopen(path, "w");
    if (!f)
        return error_set(err, ERR_IO, "%s cannot be written: %s", path, strerror(errno));
    bad = fwrite(t->s, 1, t->n, f) != t->n;
    bad |= fclose(f) != 0;
    return bad ? error_set(err, ERR_IO, "%s cannot be written: %s", path, strerror(errno)) : 0;
}

static int write_all(const new_plugin *n, error *err)
{
    text c = {0}, readme = {0};
    int status;

    new_case(n, &c);
    new_readme(n, &readme);
    status = mkdir(n->name, 0777) != 0
                 ? error_set(err, ERR_IO, "the folder %s cannot be made: %s", n->name, strerror(errno))
                 : write_file(n->name, n->name, ".c", &n->weak.source, err);
    if (!status)
        status = write_file(n->name, n->name, ".lua", &c, err);
    if (!status)
        status = write_file(n->name, "README", ".md", &readme, err);
    text_free(&c);
    text_free(&readme);
    return status;
}

static void say(const new_plugin *n)
{
    const char *s = n->name;

    printf("%s/%s.c  %s/%s.lua  %s/README.md\n\n", s, s, s, s, s);
    printf("  plugflow build %s\n  plugflow test ./%s/%s.so\n  plugflow run %s/%s.lua --plugin ./%s/%s.so\n", s, s,
           s, s, s, s, s);
}

int cli_new(const cli *o, error *err)
{
    new_plugin n = {.name = o->operand[0]};
    const struct place *p;
    text form = {0};
    int status;

    TRY(find_place(o, &p, err));
    TRY(check_name(n.name, err));
    n.where = p->where;
    n.bodies = p->bodies;
    if (strcmp(p->name, "pairs") == 0 || strcmp(p->name, "bodies") == 0) {
        if (o->weak || o->fields)
            return error_set(err, ERR_USAGE,
                             "--on %s: --weak and --fields are for cells, fluid, solid, facets, surface", p->name);
        new_body_source(&n, &n.weak.source);
        status = write_all(&n, err);
    } else {
        weak_request r = {.name = n.name, .form = o->weak, .where = p->where, .new_fields = o->fields};

        status = o->weak ? 0 : usual_form(o, p, &form, err);
        r.form = o->weak ? o->weak : form.s;
        n.form = r.form;
        if (!status)
            status = weak_source(&r, &n.weak, err);
        if (!status)
            status = write_all(&n, err);
    }
    weak_free(&n.weak);
    text_free(&form);
    if (!status)
        say(&n);
    return status;
}
