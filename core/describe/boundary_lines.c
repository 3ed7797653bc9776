/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * boundary "..." {} of a case.  Conditions apply in the order of the case, "*" (what no other
 * line names) first; where two lines meet in a node the later one holds. */
#include "describe/describe.h"

#include <lauxlib.h>

#include <stdio.h>
#include <string.h>

static int read_fluxes(description *d, reader *r, boundary_line *l)
{
    int any = 0;

    for (int i = 0; i < d->n_use; i++) {
        const pf_term *t = d->use[i].term;

        for (uint32_t k = 0; (t->flags & PF_BY_BOUNDARY) && k < t->n_in; k++) {
            value *v = &l->flux_value[l->n_flux];
            term_use *u;

            if (t->in[k].eval != PF_DATA)
                continue;
            v->n = term_components(t->in[k].shape, d->dim);
            if (reader_value(r, t->in[k].name, t->doc, v->n, d->dim, v) <= 0)
                continue;
            u = arena_alloc(&d->memory, 1, sizeof *u);
            if (!u)
                return 0;
            *u = d->use[i];
            u->data[k] = v;
            l->flux[l->n_flux++] = u;
            any = 1;
        }
    }
    return any;
}

/* A flux of a field that is prescribed as a whole, or anything beside natural = true, cannot be meant. */
static void check_conflicts(description *d, const case_block *b, const char *what, const boundary_line *l)
{
    for (int i = 0; i < l->n_flux; i++) {
        const pf_term *t = l->flux[i]->term;
        int f = fields_find(&d->fields, t->out[0].field), free = 0, lost = 0;

        for (int k = 0; f >= 0 && k < d->fields.f[f].n_comp; k++) {
            free |= l->value[f].free[k];
            lost |= !l->value[f].free[k] && l->flux_value[i].constant[k] != 0;
        }
        for (uint32_t k = 0; f >= 0 && l->has_value[f] && (!free || lost) && k < t->n_in; k++)
            if (t->in[k].eval == PF_DATA)
                case_wrong(d->c, b, t->in[k].name,
                           "%s: \"%s\" and \"%s\" are both given; where %s is prescribed, %s has no effect", what,
                           d->fields.f[f].name, t->in[k].name, d->fields.f[f].name, t->in[k].name);
    }
    for (int f = 0; l->natural && f < d->fields.n; f++)
        if (l->has_value[f] || l->n_flux || l->symmetry) {
            case_wrong(d->c, b, "natural", "%s: natural = true says that nothing is prescribed, but something is",
                       what);
            break;
        }
}

static void read_line(description *d, const case_block *b, boundary_line *l)
{
    char *what = arena_alloc(&d->memory, (b->name ? strlen(b->name) : 0) + 16, 1);
    int any = 0, n_periodic = 0;
    reader r;

    if (!what)
        return;
    if (b->name)
        sprintf(what, "boundary \"%s\"", b->name);
    else
        strcpy(what, "boundary");
    *l = (boundary_line){.block = b, .name = b->name};
    reader_open(&r, d->c, b, what);
    if (!b->name) {
        if (reader_strings(&r, "periodic", "two boundaries that are one", 2, l->periodic, &n_periodic) <= 0 ||
            n_periodic != 2)
            case_wrong(
                d->c, b, NULL,
                "boundary: expected a name, as in boundary \"left\" {...}, or periodic = {\"left\", \"right\"}");
        reader_close(&r);
        return;
    }
    if (reader_has(&r, "periodic"))
        case_wrong(d->c, b, "periodic", "%s: write boundary { periodic = {\"left\", \"right\"} }, without a name",
                   what);
    any |= reader_bool(&r, "symmetry", "no flow through, no shear", &l->symmetry) > 0;
    any |= reader_bool(&r, "natural", "nothing prescribed, no traction (outflow)", &l->natural) > 0;
    for (int f = 0; f < d->fields.n; f++) {
        const field_spec *g = &d->fields.f[f];

        if (g->support != PF_ON_MESH)
            continue;
        l->has_value[f] = reader_value(&r, g->name, g->doc, g->n_comp, d->dim, &l->value[f]) > 0;
        any |= l->has_value[f] || reader_has(&r, g->name);
    }
    any |= read_fluxes(d, &r, l);
    if (!d->incomplete)
        reader_close(&r);
    check_conflicts(d, b, what, l);
    if (!any && !d->incomplete && !reader_has(&r, "periodic"))
        case_wrong(d->c, b, NULL, "%s gives no condition; natural = true says that nothing is prescribed", what);
}

int describe_boundaries(description *d, error *err)
{
    const case_block *b;

    ARENA_NEW(&d->memory, d->line, DESCRIBE_MAX_LINES, err);
    for (int k = 0; (b = case_find(d->c, "boundary", k)); k++) {
        if (d->n_line == DESCRIBE_MAX_LINES)
            return error_set(err, ERR_CASE, "%s:%d: more than %d boundary lines", b->file, b->line,
                             DESCRIBE_MAX_LINES);
        read_line(d, b, &d->line[d->n_line++]);
    }
    return 0;
}
