/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * plugflow check CASE: all of a run but the solution. */
#include "cli/cli.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void print_parameters(const case_file *c)
{
    for (int i = 0; i < c->n_param; i++)
        printf("  --set %s=%s%s%s%s%s\n", c->param[i].name, c->param[i].value, *c->param[i].doc ? "    " : "",
               c->param[i].doc, "    default ", c->param[i].dflt);
}

/* Per field: on which boundaries it is prescribed. */
static void print_conditions(const problem *p)
{
    for (int f = 0; f < p->space.n_field; f++) {
        const field_spec *g = &p->space.field[f];
        int any = 0;

        printf("  %s (%s, %s): prescribed on", g->name, g->doc, g->unit);
        for (int i = 0; i < p->description.n_line; i++)
            if (p->description.line[i].has_value[f] ||
                (p->description.line[i].symmetry && g->n_comp > 1 &&
                 (g->shape == PF_VECTOR || term_is_tensor((uint32_t)g->shape)))) {
                printf(" \"%s\"%s", p->description.line[i].name,
                       p->description.line[i].has_value[f] ? ""
                       : g->shape == PF_VECTOR             ? " (normal component)"
                                                           : " (components of the normal with others)");
                any = 1;
            }
        printf("%s\n", any ? "" : " no boundary");
    }
}

/* The terms that take a property from this publisher. */
static void print_takers(const term_use *use, int n, const term_use *law, const char *property)
{
    for (int i = 0; i < n; i++)
        for (uint32_t k = 0; k < use[i].term->n_in; k++)
            if (use[i].law[k] == law && strcmp(use[i].term->in[k].field, property) == 0)
                printf(" %s.%s", use[i].plugin->d.name, use[i].term->name);
}

/* Who publishes what, and who takes it. */
static void print_properties(const description *d)
{
    for (int i = 0; i < d->law.n; i++)
        for (uint32_t o = 0; o < d->law.use[i].term->n_out; o++) {
            const term_use *law = &d->law.use[i];
            const pf_slot *s = &law->term->out[o];

            printf("  %s (%s, %s): published by %s.%s for", s->field, s->doc, s->unit, law->plugin->d.name,
                   law->term->name);
            print_takers(d->use, d->n_use, law, s->field);
            print_takers(d->law.use, d->law.n, law, s->field);
            print_takers(d->shown.use, d->shown.n, law, s->field);
            printf("\n");
        }
}

/* Data that the terms ask for, and that the case leaves out. */
static void print_no_data(const term_use *use, int n)
{
    for (int i = 0; i < n; i++)
        for (uint32_t k = 0; k < use[i].term->n_in; k++)
            if (use[i].no_data >> k & 1)
                printf("  %s of %s.%s: not given, 0\n", use[i].term->in[k].name, use[i].plugin->d.name,
                       use[i].term->name);
}

/* Which linear solver, and its predicted price. */
static void print_solver(const linear *l)
{
    const pf_solver_cost *c = &l->stats.cost;

    if (!linear_approximates(linear_solver(l))) {
        printf(
            "  linear solver: %s; factors (predicted): %.3g entries, %.3g MB, %.3g operations, about %.2g s each\n",
            linear_solver(l)->name, c->fill, c->bytes / 1e6, c->flops, c->flops / 1e10);
        if (*l->stats.why)
            printf("    not the iterative one: %s\n", l->stats.why);
        return;
    }
    printf(
        "  linear solver: %s, iterative (predicted): %.3g MB, %.3g operations of a set-up, %.3g of an iteration\n",
        linear_solver(l)->name, c->bytes / 1e6, c->flops, 4 * c->fill);
    if (l->stats.direct_flops > 0)
        printf("    a factorisation would take about %.2g operations\n", l->stats.direct_flops);
}

static int check(const problem *p, const linear *l, int json)
{
    char replaced[400];
    double matrix = 8.0 * (double)p->space.row[p->space.n_free] + 4.0 * (double)p->space.n_col;

    if (json) {
        printf("{\"cells\": %lld, \"unknowns\": %lld, \"free_unknowns\": %lld, \"matrix_entries\": %lld, "
               "\"solver\": \"%s\", \"factor_entries\": %.6g, \"factor_bytes\": %.6g, \"factor_flops\": %.6g}\n",
               (long long)p->mesh.n_cell, (long long)p->space.n_dof, (long long)p->space.n_free,
               (long long)p->space.row[p->space.n_free], linear_solver(l)->name, l->stats.cost.fill,
               l->stats.cost.bytes, l->stats.cost.flops);
        return 0;
    }
    printf("%s: ok\n", p->description.c->path);
    print_parameters(p->description.c);
    printf("  mesh: %lld cells (%s), %lld nodes, boundaries:", (long long)p->mesh.n_cell, p->mesh.type->name,
           (long long)p->mesh.n_node);
    for (int i = 0; i < p->mesh.n_name; i++)
        printf(" %s", p->mesh.name[i]);
    printf("\n  terms:");
    for (int i = 0; i < p->description.n_use; i++) {
        const term_use *u = &p->description.use[i];

        printf(u->label ? " %s.%s (%s)" : " %s.%s", u->plugin->d.name, u->term->name, u->label);
    }
    printf("\n");
    for (int i = 0; i < p->description.n_replaced; i++) {
        describe_tell_replaced(&p->description, i, replaced, sizeof replaced);
        printf("    %s\n", replaced);
    }
    print_properties(&p->description);
    print_no_data(p->description.use, p->description.n_use);
    print_no_data(p->description.law.use, p->description.law.n);
    print_no_data(p->description.shown.use, p->description.shown.n);
    print_conditions(p);
    printf("  unknowns: %lld, of which %lld are free; matrix: %lld entries, %.3g MB\n", (long long)p->space.n_dof,
           (long long)p->space.n_free, (long long)p->space.row[p->space.n_free], matrix / 1e6);
    print_solver(l);
    return 0;
}

int cli_check(const cli *o, error *err)
{
    cli_case *k = malloc(sizeof *k);
    int status;

    if (!k)
        return error_memory(err, "case", sizeof *k);
    status = cli_open(o, k, err);
    if (!status)
        status = problem_initial(&k->p, err);
    if (!status) {
        const time_spec *time = &k->p.description.time;
        assembly_state s = {.t = time->start,
                            .dt = 1,
                            .x = k->p.state.x,
                            .dot = k->p.system.step,
                            .old = k->p.state.x,
                            .kept = k->p.state.kept,
                            .bodies = problem_points(&k->p)};

        s.shift = time->unsteady ? 1.5 / time->step : 0;
        status = assembly_run(&k->p.system.assembly, &s, k->p.system.residual, k->p.system.linear.value, 1, err);
    }
    if (!status)
        status = linear_predict(&k->p.system.linear, err);
    for (int i = 0; !status && i < k->p.warnings.n; i++)
        fprintf(stderr, "  warning: %s\n", k->p.warnings.text[i]);
    if (!status)
        check(&k->p, &k->p.system.linear, o->json);
    cli_close(k);
    free(k);
    return status;
}
