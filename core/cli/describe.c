/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * plugflow describe [NAME]: what a plugin says of itself. */
#include "cli/describe.h"

#include <stdio.h>
#include <string.h>

static const char *const key_line[] = {"", "; from fluid{}", "; of boundary \"...\" {}", "; of particle{}"};

static void print_slots(const char *title, const pf_slot *s, uint32_t n)
{
    for (uint32_t i = 0; i < n; i++) {
        text what = {0};

        describe_slot(&what, &s[i]);
        printf("      %-7s %-22s %s, %s%s%s%s%s\n", i ? "" : title, s[i].name, what.s ? what.s : "",
               term_shape_name(s[i].shape), s[i].unit ? ", " : "", s[i].unit ? s[i].unit : "", s[i].doc ? ": " : "",
               s[i].doc ? s[i].doc : "");
        text_free(&what);
    }
}

static void print_keys(const described_keys *l, const char *all)
{
    for (int i = 0; i < l->n; i++) {
        const described_key *k = &l->key[i];
        const int is_required = strcmp(k->standard.s, "required") == 0;

        printf("  %-9s %-22s %s%s%s; %s%s%s%s%s%s%s\n", i ? "" : "keys", k->name, k->doc,
               *k->doc && *k->unit ? ", " : "", k->unit, is_required ? "" : "default ", k->standard.s,
               k->range.n ? "; " : "", k->range.n ? k->range.s : "", key_line[k->place], all ? "; " : "",
               !all                           ? ""
               : strcmp(k->terms.s, all) == 0 ? "of all terms"
                                              : k->terms.s);
    }
}

static void print_term(const term_plugin *p, const pf_term *t)
{
    text flags = {0};

    describe_flags(&flags, t, "; ");
    printf("  %s.%s%s\n      weak    %s\n      source  %s\n      points  %s; Jacobian %s%s\n", p->d.name, t->name,
           t->flags & PF_OPTIONAL ? " (only if its own line switches it on)" : "", t->doc, t->cite,
           describe_points(t), describe_derivative(t), flags.s ? flags.s : "");
    text_free(&flags);
    print_slots("in", t->in, t->n_in);
    print_slots("out", t->out, t->n_out);
}

/* "a, b, c" */
static void list_terms(text *t, const term_plugin *p)
{
    for (uint32_t i = 0; i < p->d.n_term; i++)
        text_add(t, "%s%s", i ? ", " : "", p->term[i].name);
}

static int print_plugin(const term_plugin *p, const char *only, error *err)
{
    described_keys keys;
    text all = {0};

    printf("%s %s: %s (%s)\n", p->d.name, p->d.version, p->d.doc ? p->d.doc : "", p->d.license);
    for (uint32_t i = 0; i < p->d.n_field; i++) {
        const pf_field *f = &p->d.field[i];

        printf("  field %s: %s, %s, %s %s%s%s\n", f->name, f->doc, f->unit, term_shape_name(f->shape),
               describe_support(f), f->reaction ? "; reaction on boundaries: " : "",
               f->reaction ? f->reaction : "");
    }
    for (uint32_t i = 0; i < p->d.n_term; i++)
        if (!only || strcmp(only, p->term[i].name) == 0)
            print_term(p, &p->term[i]);
    TRY(describe_keys(&keys, p, only, err));
    list_terms(&all, p);
    print_keys(&keys, only || p->d.n_term == 1 ? NULL : all.s);
    text_free(&all);
    describe_keys_free(&keys);
    return 0;
}

static int print_solver(const pf_solver *s, error *err)
{
    described_keys keys;

    printf("%s %s: %s\n  in a case: solve { solver = \"%s\" }\n", s->name, s->version, s->doc ? s->doc : "",
           strncmp(s->name, "solver_", 7) == 0 ? s->name + 7 : s->name);
    TRY(describe_solver_keys(&keys, s, err));
    print_keys(&keys, NULL);
    describe_keys_free(&keys);
    return 0;
}

static int print_file(const term_file *f, const char *only, error *err)
{
    if (f->plugin.path)
        return print_plugin(&f->plugin, only, err);
    if (f->solver)
        return print_solver(f->solver, err);
    printf("%s %s: reads meshes:", f->mesh_reader->name, f->mesh_reader->version);
    for (const char *const *s = f->mesh_reader->suffix; *s; s++)
        printf(" %s", *s);
    printf("\n");
    return 0;
}

int cli_describe(const cli *o, error *err)
{
    static registry r;
    const term_file *file;
    const char *term;

    if (o->all && !o->markdown)
        return error_set(err, ERR_USAGE, "--all DIR goes with --markdown; without it, plugflow describe shows all");
    TRY(registry_create(&r, o->plugin, o->n_plugin, err));
    if (o->markdown) {
        TRY(describe_markdown(o, &r, err));
    } else if (o->n_operand == 0) {
        TRY(registry_scan(&r, err));
        for (int i = 0; i < r.n_file; i++)
            if (!r.file[i].refused)
                TRY(print_file(&r.file[i], NULL, err));
    } else {
        TRY(describe_find(&r, o->operand[0], &file, &term, err));
        TRY(print_file(file, term, err));
    }
    registry_destroy(&r);
    return 0;
}
