/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * plugflow plugins; plugflow describe [TERM]. */
#include "cli/cli.h"

#include <stdio.h>
#include <string.h>

int cli_plugins(const cli *o, error *err)
{
    static registry r;
    int refused = 0;

    TRY(registry_create(&r, o->plugin, o->n_plugin, err));
    TRY(registry_scan(&r, err));
    for (int i = 0; i < r.n_file; i++) {
        const term_file *f = &r.file[i];

        if (f->refused) {
            refused++;
            continue;
        }
        if (f->plugin.path) {
            printf("%-16s %-8s %s\n%-16s terms:", f->plugin.d.name, f->plugin.d.version, f->path, "");
            for (uint32_t k = 0; k < f->plugin.d.n_term; k++)
                printf(" %s", f->plugin.term[k].name);
            printf("\n");
        } else if (f->solver) {
            printf("%-16s %-8s %s\n%-16s linear solver: %s\n", f->solver->name, f->solver->version, f->path, "",
                   f->solver->doc);
        } else {
            printf("%-16s %-8s %s\n%-16s reads meshes:", f->mesh_reader->name, f->mesh_reader->version, f->path,
                   "");
            for (const char *const *s = f->mesh_reader->suffix; *s; s++)
                printf(" %s", *s);
            printf("\n");
        }
    }
    printf("\nlooked in:\n");
    for (int i = 0; i < r.n_dir; i++)
        printf("  %s\n", r.dir[i]);
    if (refused)
        printf("refused:\n");
    for (int i = 0; i < r.n_file; i++)
        if (r.file[i].refused)
            printf("  %s\n", r.file[i].refused);
    registry_destroy(&r);
    return 0;
}

static void print_slots(const char *title, const pf_slot *s, uint32_t n, int by_boundary)
{
    static const char *const shape[] = {"",
                                        "scalar",
                                        "vector",
                                        "tensor",
                                        "spin",
                                        "symmetric tensor",
                                        "gradient of a symmetric tensor",
                                        "gradient of a tensor"};

    for (uint32_t i = 0; i < n; i++)
        printf("      %-7s %-22s %s%s%s, %s%s%s%s%s%s\n", i ? "" : title, s[i].name, term_eval_name(s[i].eval),
               s[i].field ? " of " : "", s[i].field ? s[i].field : "", shape[s[i].shape], s[i].unit ? ", " : "",
               s[i].unit ? s[i].unit : "", s[i].doc ? ": " : "", s[i].doc ? s[i].doc : "",
               s[i].flags & PF_REQUIRED ? "; required" : "");
    for (uint32_t i = 0; by_boundary && i < n; i++)
        if (s[i].eval == PF_DATA)
            printf("      in a case: boundary \"...\" { %s = ... }\n", s[i].name);
    for (uint32_t i = 0; i < n; i++)
        if (s[i].eval == PF_BODY_KEY) {
            printf("      in a case: particle { %s = ... }  %s, %s; default %g", s[i].field, s[i].doc, s[i].unit,
                   s[i].dflt);
            if (s[i].min < s[i].max)
                printf("; %g to %g", s[i].min, s[i].max);
            printf("\n");
        }
}

static void print_params(const pf_term *t)
{
    for (uint32_t i = 0; i < t->n_param; i++) {
        const pf_param *p = &t->param[i];

        printf("      %-7s %-22s %s, %s", i ? "" : "key", p->name, p->doc, p->unit);
        if (p->flags & PF_REQUIRED)
            printf("; required");
        else if (p->type == PF_T_CHOICE)
            printf("; default \"%s\"", p->choice[(int)p->dflt]);
        else
            printf("; default %g", p->dflt);
        if (p->min < p->max)
            printf("; %g to %g", p->min, p->max);
        if (p->flags & PF_SHARED)
            printf("; from fluid{}");
        printf("\n");
    }
}

static void print_term(const term_plugin *p, const pf_term *t)
{
    static const char *const point_name[] = {"",
                                             "all cells",
                                             "outside of bodies",
                                             "inside of bodies",
                                             "boundary facets",
                                             "surfaces of bodies",
                                             "cells with too little fluid (differences from their roots)",
                                             "bodies, once each",
                                             "near pairs of bodies or body and wall"};

    printf("  %s.%s%s\n      weak    %s\n      source  %s\n      points  %s; Jacobian %s%s%s%s%s\n", p->d.name,
           t->name, t->flags & PF_OPTIONAL ? " (only if its own line switches it on)" : "", t->doc, t->cite,
           point_name[t->where],
           t->jacobian     ? "by hand"
           : t->residual_c ? "by complex step"
                           : "by differences",
           t->flags & PF_LINEAR ? "; linear" : "", t->flags & PF_CONTINUATION ? "; faded in by continuation" : "",
           t->flags & PF_METRIC ? "; reads the metric of the element" : "",
           t->flags & PF_FLUID_FORCE ? "; what it gives a body is the fluid's force" : "");
    print_slots("in", t->in, t->n_in, (t->flags & PF_BY_BOUNDARY) != 0);
    print_slots("out", t->out, t->n_out, 0);
    print_params(t);
}

static int print_plugin(const term_plugin *p, const char *only, error *err)
{
    int found = !only;

    for (uint32_t i = 0; only && i < p->d.n_term; i++)
        found |= strcmp(only, p->term[i].name) == 0;
    if (!found)
        return error_set(err, ERR_USAGE, "plugin \"%s\" has no term \"%s\"; plugflow describe %s lists its terms",
                         p->d.name, only, p->d.name);
    printf("%s %s: %s (%s)\n", p->d.name, p->d.version, p->d.doc ? p->d.doc : "", p->d.license);
    for (uint32_t i = 0; i < p->d.n_field; i++)
        printf("  field %s: %s, %s, %s of order %u%s%s\n", p->d.field[i].name, p->d.field[i].doc,
               p->d.field[i].unit, term_shape_name(p->d.field[i].shape), p->d.field[i].order,
               p->d.field[i].reaction ? "; reaction on boundaries: " : "",
               p->d.field[i].reaction ? p->d.field[i].reaction : "");
    for (uint32_t i = 0; i < p->d.n_term; i++)
        if (!only || strcmp(only, p->term[i].name) == 0)
            print_term(p, &p->term[i]);
    return 0;
}

int cli_describe(const cli *o, error *err)
{
    static registry r;
    const term_plugin *p;
    char name[128];
    const char *dot;

    TRY(registry_create(&r, o->plugin, o->n_plugin, err));
    if (o->n_operand == 0) {
        TRY(registry_scan(&r, err));
        for (int i = 0; i < r.n_file; i++)
            if (!r.file[i].refused && r.file[i].plugin.path)
                TRY(print_plugin(&r.file[i].plugin, NULL, err));
    } else if (strlen(o->operand[0]) > 3 && strcmp(o->operand[0] + strlen(o->operand[0]) - 3, ".so") == 0) {
        term_file *f;

        TRY(registry_load(&r, o->operand[0], &f, err));
        if (f->plugin.path)
            TRY(print_plugin(&f->plugin, NULL, err));
    } else {
        dot = strchr(o->operand[0], '.');
        snprintf(name, sizeof name, "%.*s", dot ? (int)(dot - o->operand[0]) : 127, o->operand[0]);
        TRY(registry_equation(&r, name, &p, err));
        TRY(print_plugin(p, dot ? dot + 1 : NULL, err));
    }
    registry_destroy(&r);
    return 0;
}
