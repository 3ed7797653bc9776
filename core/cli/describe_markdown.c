/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * plugflow describe --markdown: a page for a plugin.  The same plugin gives the same bytes anywhere: no paths, no
 * dates, no versions of libraries. */
#include "cli/describe.h"
#include "io/file.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Words in a cell of a table or in a paragraph. */
static void put_words(text *t, const char *s)
{
    for (; s && *s; s++)
        text_add(t, strchr("|*_<>`\\", *s) ? "\\%c" : "%c", *s == '\n' ? ' ' : *s);
}

static void put_cell(text *t, const char *s)
{
    text_add(t, " ");
    put_words(t, s);
    text_add(t, " |");
}

static void put_code_cell(text *t, const char *s)
{
    text_add(t, " `%s` |", s);
}

/* "1.0 (Gmsh 4.8)" is 1.0: what a machine has installed does not belong here. */
static void put_title(text *t, const char *name, const char *version, const char *doc)
{
    text_add(t, "# %s %.*s\n\n", name, (int)strcspn(version, " "), version);
    put_words(t, doc);
    text_add(t, "\n");
}

static void put_fields(text *t, const term_plugin *p)
{
    if (!p->d.n_field)
        return;
    text_add(t, "\n## Fields\n\n| field | what | unit | shape | lives | reaction on boundaries |\n"
                "|---|---|---|---|---|---|\n");
    for (uint32_t i = 0; i < p->d.n_field; i++) {
        const pf_field *f = &p->d.field[i];
        text reaction = {0};

        if (f->reaction)
            text_add(&reaction, "%s, %s", f->reaction, f->reaction_unit ? f->reaction_unit : "1");
        text_add(t, "|");
        put_code_cell(t, f->name);
        put_cell(t, f->doc);
        put_cell(t, f->unit);
        put_cell(t, term_shape_name(f->shape));
        put_cell(t, describe_support(f));
        put_cell(t, reaction.s);
        text_add(t, "\n");
        text_free(&reaction);
    }
}

static void put_keys(text *t, const described_keys *l, enum key_place place, const char *title, int of_terms)
{
    int n = 0;

    for (int i = 0; i < l->n; i++) {
        const described_key *k = &l->key[i];

        if (k->place != place)
            continue;
        if (n++ == 0)
            text_add(t, "\n%s\n\n| key | what | unit | default | range |%s\n|---|---|---|---|---|%s\n", title,
                     of_terms ? " of terms |" : "", of_terms ? "---|" : "");
        text_add(t, "|");
        put_code_cell(t, k->name);
        put_cell(t, k->doc);
        put_cell(t, k->unit);
        put_cell(t, k->standard.s);
        put_cell(t, k->range.s);
        if (of_terms)
            put_cell(t, k->terms.s);
        text_add(t, "\n");
    }
}

static void put_slots(text *t, const char *kind, const pf_slot *s, uint32_t n)
{
    for (uint32_t i = 0; i < n; i++) {
        text what = {0};

        describe_slot(&what, &s[i]);
        text_add(t, "| %s |", kind);
        put_code_cell(t, s[i].name);
        put_cell(t, what.s);
        put_cell(t, term_shape_name(s[i].shape));
        put_cell(t, s[i].unit);
        put_cell(t, s[i].doc);
        text_add(t, "\n");
        text_free(&what);
    }
}

/* What of a term is found in the results. */
static void put_shown(text *t, const pf_term *term)
{
    static const char *const column[] = {[PF_CELL] = "column `%s` of integrals.csv",
                                         [PF_FLUID] = "column `%s` of integrals.csv",
                                         [PF_SOLID] = "column `%s` of particles.csv",
                                         [PF_FACET] = "column `BOUNDARY.%s` of integrals.csv, one a boundary",
                                         [PF_SURFACE] = "column `%s` of particles.csv",
                                         [PF_CUT] = "column `%s`",
                                         [PF_PARTICLE] = "column `%s` of particles.csv",
                                         [PF_PAIR] = "column `%s` of particles.csv"};
    int n = 0;

    for (uint32_t i = 0; i < term->n_out; i++) {
        const pf_slot *s = &term->out[i];

        if (s->eval != PF_SHOW && s->eval != PF_INTEGRAL)
            continue;
        text_add(t, n++ ? "; " : "Shown: ");
        text_add(t, s->eval == PF_SHOW ? "field `%s`" : column[term->where], s->name);
    }
    if (n)
        text_add(t, ".\n\n");
}

/* "`p` = 1, `u` = (1, 2)": the numbers of a list of slots; the end of them. */
static const double *put_values(text *t, const pf_slot *s, uint32_t n, int dim, const double *v)
{
    for (uint32_t i = 0; i < n; i++) {
        const int m = term_components(s[i].shape, dim);

        text_add(t, "%s`%s` = %s", i ? ", " : "", s[i].name, m > 1 ? "(" : "");
        for (int c = 0; c < m; c++)
            text_add(t, "%s%.6g", c ? ", " : "", *v++);
        text_add(t, m > 1 ? ")" : "");
    }
    return v;
}

static void put_params(text *t, const pf_term *term, int dim, const double *v)
{
    for (uint32_t i = 0; v && i < term->n_param; i++) {
        const pf_param *p = &term->param[i];

        text_add(t, "%s`%s` = ", i ? ", " : "", p->name);
        if (p->type == PF_T_CHOICE)
            text_add(t, "%s", p->choice[(int)*v++]);
        else
            for (int c = 0, m = p->type == PF_T_VECTOR ? dim : 1; c < m; c++)
                text_add(t, "%s%.6g%s", c ? ", " : m > 1 ? "(" : "", *v++, m > 1 && c == m - 1 ? ")" : "");
    }
}

static void put_examples(text *t, const pf_term *term)
{
    if (!term->n_example)
        return;
    text_add(t, "\n| worked example | with | of | gives |\n|---|---|---|---|\n");
    for (uint32_t i = 0; i < term->n_example; i++) {
        const pf_example *e = &term->example[i];

        text_add(t, "|");
        put_cell(t, e->name);
        text_add(t, " %uD%s", e->dim, e->params && term->n_param ? ", " : "");
        put_params(t, term, (int)e->dim, e->params);
        text_add(t, " | ");
        put_values(t, term->in, term->n_in, (int)e->dim, e->in);
        text_add(t, " | ");
        put_values(t, term->out, term->n_out, (int)e->dim, e->out);
        text_add(t, " |\n");
    }
}

static void put_term(text *t, const term_plugin *p, const pf_term *term)
{
    text_add(t, "\n## %s.%s\n\n", p->d.name, term->name);
    if (term->flags & PF_OPTIONAL)
        text_add(t, "On only with a line of its own: `term \"%s.%s\" {}`.\n\n", p->d.name, term->name);
    if (term->flags & PF_BY_BOUNDARY)
        text_add(t, "Acts on the boundaries that give its key.\n\n");
    text_add(t, "$$\n%s\n$$\n\nPoints: %s. Jacobian %s", term->doc, describe_points(term),
             describe_derivative(term));
    describe_flags(t, term, "; ");
    text_add(t, ". Source: ");
    put_words(t, term->cite);
    text_add(t, "%s\n\n", *term->cite && term->cite[strlen(term->cite) - 1] == '.' ? "" : ".");
    put_shown(t, term);
    text_add(t, "| | slot | is | shape | unit | what |\n|---|---|---|---|---|---|\n");
    put_slots(t, "in", term->in, term->n_in);
    put_slots(t, "out", term->out, term->n_out);
    put_examples(t, term);
}

static int put_equations(text *t, const term_plugin *p, const char *only, error *err)
{
    described_keys keys;
    text title = {0};

    put_title(t, p->d.name, p->d.version, p->d.doc);
    text_add(t, "\n`term \"%s\" {}`; licence %s. Terms:", p->d.name, p->d.license);
    for (uint32_t i = 0; i < p->d.n_term; i++)
        text_add(t, "%s %s", i ? "," : "", p->term[i].name);
    text_add(t, ".\n");
    put_fields(t, p);
    TRY(describe_keys(&keys, p, only, err));
    if (keys.n)
        text_add(t, "\n## Keys\n");
    text_add(&title, "Of the line `term \"%s\" {}`:", p->d.name);
    put_keys(t, &keys, KEY_OF_TERM, title.s ? title.s : "", 1);
    put_keys(t, &keys, KEY_OF_FLUID, "Of `fluid {}`, unless the term's own line gives them:", 1);
    put_keys(t, &keys, KEY_OF_BOUNDARY, "Of `boundary \"...\" {}`:", 1);
    put_keys(t, &keys, KEY_OF_BODY, "Of `particle {}`:", 1);
    text_free(&title);
    describe_keys_free(&keys);
    for (uint32_t i = 0; i < p->d.n_term; i++)
        if (!only || strcmp(only, p->term[i].name) == 0)
            put_term(t, p, &p->term[i]);
    return 0;
}

static int put_solver(text *t, const pf_solver *s, error *err)
{
    described_keys keys;

    put_title(t, s->name, s->version, s->doc);
    text_add(t, "\nA linear solver: `solve { solver = \"%s\" }`%s.\n",
             strncmp(s->name, "solver_", 7) == 0 ? s->name + 7 : s->name,
             s->flags & PF_SOLVER_APPROXIMATE ? ", inside of the kernel's Krylov iteration" : "");
    TRY(describe_solver_keys(&keys, s, err));
    put_keys(t, &keys, KEY_OF_TERM, "Keys of `solve {}` with it:", 0);
    if (!keys.n)
        text_add(t, "\nIt has no keys of its own.\n");
    describe_keys_free(&keys);
    return 0;
}

static void put_reader(text *t, const pf_mesh_reader *m)
{
    put_title(t, m->name, m->version, "Reads meshes.");
    text_add(t, "\n`mesh { file = \"...\" }` with a file of the kind");
    for (const char *const *s = m->suffix; *s; s++)
        text_add(t, "%s `%s`", s == m->suffix ? "" : ",", *s);
    text_add(t, ". It has no keys of its own.\n");
}

static int put_file(text *t, const term_file *f, const char *only, error *err)
{
    if (f->plugin.path)
        return put_equations(t, &f->plugin, only, err);
    if (f->solver)
        return put_solver(t, f->solver, err);
    put_reader(t, f->mesh_reader);
    return 0;
}

static const char *name_of(const term_file *f)
{
    return f->plugin.path ? f->plugin.d.name : f->solver ? f->solver->name : f->mesh_reader->name;
}

static int by_name(const void *a, const void *b)
{
    return strcmp(name_of(*(const term_file *const *)a), name_of(*(const term_file *const *)b));
}

static int write_page(const char *dir, const char *name, const text *t, error *err)
{
    char path[PATH_MAX];

    if (t->failed)
        return error_memory(err, "page", (double)t->n);
    if (snprintf(path, sizeof path, "%s/%s.md", dir, name) >= (int)sizeof path)
        return error_set(err, ERR_USAGE, "the name of the folder is too long");
    return file_write(path, t->s, t->n, err);
}

/* Those of the first folder that is looked in, by name: what else is installed is not of the same set. */
static int choose(registry *r, const term_file **list, error *err)
{
    char first[PATH_MAX];
    size_t n = 0, length;

    TRY(registry_scan(r, err));
    if (!r->n_dir || !realpath(r->dir[0], first))
        return 0;
    length = strlen(first);
    for (int i = 0; i < r->n_file; i++) {
        const term_file *f = &r->file[i];

        if (strncmp(f->path, first, length) != 0 || f->path[length] != '/')
            continue;
        if (f->refused)
            return error_set(err, ERR_PLUGIN, "%s", f->refused);
        list[n++] = f;
    }
    qsort(list, n, sizeof *list, by_name);
    return 0;
}

static int write_all(const char *dir, registry *r, error *err)
{
    const term_file *list[TERM_MAX_FILES] = {0};
    text index = {0};
    int status = 0;

    TRY(choose(r, list, err));
    if (!list[0])
        return error_set(err, ERR_PLUGIN, "no plugin in %s", r->n_dir ? r->dir[0] : "any folder");
    text_add(&index, "# Plugins\n\nGenerated from what the plugins say of themselves (`./pf reference`); not to be "
                     "edited.\n\n| plugin | what |\n|---|---|\n");
    status = file_make_dir(dir, err);
    for (int i = 0; !status && i < TERM_MAX_FILES && list[i]; i++) {
        const term_file *f = list[i];
        text page = {0};

        text_add(&index, "| [%s](%s.md) |", name_of(f), name_of(f));
        put_cell(&index, f->plugin.path ? f->plugin.d.doc : f->solver ? f->solver->doc : "reads meshes");
        text_add(&index, "\n");
        status = put_file(&page, f, NULL, err);
        if (!status)
            status = write_page(dir, name_of(f), &page, err);
        text_free(&page);
    }
    if (!status)
        status = write_page(dir, "README", &index, err);
    text_free(&index);
    return status;
}

int describe_markdown(const cli *o, registry *r, error *err)
{
    const term_file *file;
    const char *term;
    text page = {0};

    if (o->all && o->n_operand)
        return error_set(err, ERR_USAGE, "describe --markdown: a plugin, or --all DIR, not both");
    if (o->all)
        return write_all(o->all, r, err);
    if (!o->n_operand)
        return error_set(err, ERR_USAGE, "describe --markdown needs the name of a plugin, or --all DIR");
    TRY(describe_find(r, o->operand[0], &file, &term, err));
    TRY(put_file(&page, file, term, err));
    if (page.failed)
        return error_memory(err, "page", (double)page.n);
    fputs(page.s, stdout);
    text_free(&page);
    return 0;
}
