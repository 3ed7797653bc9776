/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * boundary "..." {} of a case.  Conditions apply in the order of the case, "*" (what no other
 * line names) first; where two lines meet in a node the later one holds. */
#include "describe/describe.h"

#include <stdio.h>
#include <string.h>

static const pf_slot *data_slot(const pf_term *t)
{
    for (uint32_t k = 0; k < t->n_in; k++)
        if (t->in[k].eval == PF_DATA)
            return &t->in[k];
    return NULL;
}

/* PF_BY_BOUNDARY terms whose key stands on the line. */
static int read_fluxes(description *d, reader *r, boundary_line *l, error *err)
{
    for (int i = 0; i < d->n_use; i++) {
        const pf_term *t = d->use[i].term;
        const pf_slot *s = data_slot(t);
        value *v = &l->flux_value[l->n_flux];
        term_use *u;

        if (!(t->flags & PF_BY_BOUNDARY) || !s)
            continue;
        v->n = term_components(s->shape, d->dim);
        if (describe_value(r, s->name, t->doc, v->n, d->dim, v) <= 0)
            continue;
        ARENA_NEW(&d->memory, u, 1, err);
        *u = d->use[i];
        u->data[s - t->in] = v;
        l->flux[l->n_flux++] = u;
    }
    return 0;
}

/* Keys of PF_BY_BOUNDARY terms that are off, of the plugins in use. */
static void check_off(description *d, reader *r)
{
    for (int i = 0; i < d->n_use; i++)
        for (uint32_t k = 0; k < d->use[i].plugin->d.n_term; k++) {
            const pf_term *t = &d->use[i].plugin->term[k];
            const char *plugin = d->use[i].plugin->d.name;
            const pf_slot *s = t->flags & PF_BY_BOUNDARY ? data_slot(t) : NULL;

            if (!s || !reader_has(r, s->name) || reader_asked(r, s->name))
                continue;
            case_wrong(d->c, r->b, s->name,
                       "%s: \"%s\" belongs to %s.%s, which is off; switch it on with term \"%s.%s\" {}", r->what,
                       s->name, plugin, t->name, plugin, t->name);
            reader_note(r, s->name, t->doc);
        }
}

/* The key of a flux that acts on the same rows as the field: its name or what it is ("pressure"), or any. */
static const char *flux_instead(const description *d, int f)
{
    const char *any = NULL;

    for (int i = 0; i < d->n_use; i++) {
        const pf_slot *s = d->use[i].term->flags & PF_BY_BOUNDARY ? data_slot(d->use[i].term) : NULL;

        if (s && strcmp(s->name, d->fields.f[f].doc) == 0)
            return s->name;
        any = s ? s->name : any;
    }
    return any;
}

/* A prescribed value takes the place of the field's own equation; that must not be the balance of something else.
 */
static void refuse_value(description *d, reader *r, int f, const value *v)
{
    const field_spec *g = &d->fields.f[f];
    const char *flux = flux_instead(d, f);
    const term_use *row = NULL; /* the first term of its equation */
    char number[40] = "...", instead[200] = "";

    for (int i = d->n_use - 1; i >= 0; i--)
        for (uint32_t o = 0; o < d->use[i].term->n_out; o++)
            if (strcmp(d->use[i].term->out[o].field, g->name) == 0 && d->use[i].where <= PF_FLUID)
                row = &d->use[i];
    if (!v->f)
        snprintf(number, sizeof number, "%g", v->constant[0]);
    if (flux && strcmp(flux, g->doc) == 0)
        snprintf(instead, sizeof instead, "; a %s is given by %s = %s (normal traction -%s n)", g->doc, flux,
                 number, g->name);
    else if (flux)
        snprintf(instead, sizeof instead, "; a %s acts as a force: %s = -%s n (n points out of the domain)", g->doc,
                 flux, g->name);
    case_wrong(
        d->c, r->b, g->name,
        "%s: \"%s\" cannot be prescribed: its equation (%s%s%s) is a balance that does not contain %s, and would "
        "be lost there%s",
        r->what, g->name, row ? row->plugin->d.name : "none", row ? "." : "", row ? row->term->name : "", g->name,
        instead);
}

static void read_values(description *d, reader *r, boundary_line *l)
{
    for (int f = 0; f < d->fields.n; f++) {
        const field_spec *g = &d->fields.f[f];
        int open = 1;

        if (g->support != PF_ON_MESH)
            continue;
        if (g->order == 0) {
            if (reader_note(r, g->name, g->doc))
                case_wrong(d->c, r->b, g->name,
                           "%s: \"%s\" (%s) has one value a cell, and none on a boundary that could be prescribed",
                           r->what, g->name, g->doc);
            continue;
        }
        if (!describe_field_is_balanced(d, f)) {
            value v = {0};

            if (!reader_has(r, g->name))
                continue;
            if (reader_value(r, g->name, g->doc, g->n_comp, d->dim, &v) > 0)
                refuse_value(d, r, f, &v);
            continue;
        }
        l->has_value[f] = reader_value(r, g->name, g->doc, g->n_comp, d->dim, &l->value[f]) > 0;
        for (int k = 0; k < g->n_comp; k++)
            open = open && l->value[f].free[k];
        if (l->has_value[f] && open)
            case_wrong(d->c, r->b, g->name,
                       "%s: nothing of \"%s\" is prescribed: leave it out, or say natural = true", r->what,
                       g->name);
    }
}

/* A flux of a field that is prescribed as a whole has no effect. */
static void check_fluxes(const description *d, const char *what, const boundary_line *l)
{
    for (int i = 0; i < l->n_flux; i++) {
        const pf_term *t = l->flux[i]->term;
        int f = fields_find(&d->fields, t->out[0].field), free = 0, lost = 0;
        const char *flux = data_slot(t)->name;

        for (int k = 0; f >= 0 && k < d->fields.f[f].n_comp; k++) {
            free |= l->value[f].free[k];
            lost |= !l->value[f].free[k] && l->flux_value[i].n > 1 && l->flux_value[i].constant[k] != 0;
        }
        if (f >= 0 && l->has_value[f] && (!free || lost))
            case_wrong(d->c, l->block, flux,
                       "%s: \"%s\" and \"%s\" are both given; where %s is prescribed, %s has no effect", what,
                       d->fields.f[f].name, flux, d->fields.f[f].name, flux);
        if (f >= 0 && l->symmetry && d->fields.f[f].shape == PF_VECTOR)
            case_wrong(d->c, l->block, flux,
                       "%s: \"%s\" is given beside symmetry = true, which means no flow through and "
                       "no shear",
                       what, flux);
    }
}

/* What cannot be meant together. */
static void check_conflicts(const description *d, const char *what, const boundary_line *l)
{
    check_fluxes(d, what, l);
    for (int f = 0; l->symmetry && f < d->fields.n; f++)
        if (l->has_value[f] &&
            (d->fields.f[f].shape == PF_VECTOR || term_is_tensor((uint32_t)d->fields.f[f].shape)))
            case_wrong(
                d->c, l->block, d->fields.f[f].name,
                "%s: \"%s\" is given beside symmetry = true, which prescribes its %s as zero and leaves the others",
                what, d->fields.f[f].name,
                d->fields.f[f].shape == PF_VECTOR ? "normal component"
                                                  : "components of the normal with other directions");
    for (int f = 0; l->natural && f < d->fields.n; f++)
        if (l->has_value[f] || l->n_flux || l->symmetry) {
            case_wrong(d->c, l->block, "natural",
                       "%s: natural = true says that nothing is prescribed, but something is", what);
            break;
        }
}

/* boundary { periodic = {a, b} }; 0: it is wrong. */
static int read_periodic(description *d, reader *r, boundary_line *l)
{
    const char *name[8] = {NULL};
    int n = 0, status = reader_strings(r, "periodic", "two boundaries that are one", 8, name, &n);

    if (status > 0 && n == 2) {
        memcpy(l->periodic, name, sizeof l->periodic);
        reader_close(r);
        return 1;
    }
    d->boundary_unread = 1;
    if (status > 0)
        case_wrong(d->c, r->b, "periodic",
                   "boundary: \"periodic\": expected the names of 2 boundaries, as in boundary { periodic = "
                   "{\"left\", \"right\"} }, got %d",
                   n);
    if (status == 0)
        case_wrong(d->c, r->b, NULL,
                   "boundary: expected a name, as in boundary \"left\" {...}, or periodic = {\"left\", \"right\"}");
    return 0;
}

/* Adds the line, unless it says nothing. */
static int read_line(description *d, const case_block *b, error *err)
{
    boundary_line *l = &d->line[d->n_line];
    const int before = d->c->n_wrong;
    int any = 0;
    char *what;
    reader r;

    ARENA_NEW(&d->memory, what, (b->name ? strlen(b->name) : 0) + 16, err);
    if (b->name)
        sprintf(what, "boundary \"%s\"", b->name);
    else
        strcpy(what, "boundary");
    *l = (boundary_line){.block = b, .name = b->name};
    reader_open(&r, d->c, b, what);
    if (!b->name) {
        d->n_line += read_periodic(d, &r, l);
        return 0;
    }
    d->n_line++;
    if (reader_has(&r, "periodic")) {
        reader_note(&r, "periodic", "two boundaries that are one");
        case_wrong(d->c, b, "periodic", "%s: write boundary { periodic = {\"left\", \"right\"} }, without a name",
                   what);
    }
    reader_bool(&r, "symmetry", "no flow through, no shear", &l->symmetry);
    reader_bool(&r, "natural", "nothing prescribed, no traction (outflow)", &l->natural);
    read_values(d, &r, l);
    TRY(read_fluxes(d, &r, l, err));
    check_off(d, &r);
    if (!d->incomplete)
        reader_close(&r);
    check_conflicts(d, what, l);
    any = l->symmetry || l->natural || l->n_flux;
    for (int f = 0; f < d->fields.n; f++)
        any |= l->has_value[f];
    if (!any && !d->incomplete && d->c->n_wrong == before)
        case_wrong(d->c, b, NULL, "%s gives no condition; natural = true says that nothing is prescribed", what);
    return 0;
}

/* Two lines of one name that say the same thing, or contradict each other. */
static void check_twice(const description *d, const boundary_line *a, const boundary_line *b)
{
    if (!a->name || !b->name || strcmp(a->name, b->name))
        return;
    for (int f = 0; f < d->fields.n; f++)
        if (a->has_value[f] && b->has_value[f])
            case_wrong(d->c, b->block, d->fields.f[f].name,
                       "boundary \"%s\": \"%s\" is prescribed already by line %d; leave one of the two out",
                       b->name, d->fields.f[f].name, a->block->line);
    if (a->natural || b->natural)
        case_wrong(
            d->c, b->block, NULL,
            "boundary \"%s\": line %d says natural = true, nothing prescribed, and line %d is about the same "
            "boundary",
            b->name, a->natural ? a->block->line : b->block->line, a->natural ? b->block->line : a->block->line);
}

int describe_boundaries(description *d, error *err)
{
    const case_block *b;

    ARENA_NEW(&d->memory, d->line, DESCRIBE_MAX_LINES, err);
    for (int k = 0; (b = case_find(d->c, "boundary", k)); k++) {
        if (d->n_line == DESCRIBE_MAX_LINES)
            return error_set(err, ERR_CASE, "%s:%d: more than %d boundary lines", b->file, b->line,
                             DESCRIBE_MAX_LINES);
        TRY(read_line(d, b, err));
    }
    for (int i = 0; i < d->n_line; i++)
        for (int k = 0; k < i; k++)
            check_twice(d, &d->line[k], &d->line[i]);
    return 0;
}
