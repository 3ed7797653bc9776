/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Boundary conditions on a mesh.  Lines apply in the order of the case, "*" (what no other line names) first; where
 * two meet in a node the later one holds, but for the normal components of a vector field (corners.c). */
#include "space/conditions.h"

#include "base/order.h"
#include "mesh/facet.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Adds the nodes of the line's facets that carry the field as one set; with axis >= 0 only facets
 * whose normal lies along that axis. */
static int add_set(conditions *c, space *s, int line, int field, int comp, const value *v, const int8_t *axis_of,
                   int axis, error *err)
{
    const mesh *m = s->mesh;
    const uint8_t *on = c->facet[line];
    int n_local = s->field[field].order == 2 ? m->type->facet_nodes : m->type->facet_vertices;
    dirichlet_set *d = &c->set[c->n_set];
    int64_t n = 0;

    for (int64_t f = 0; f < m->n_facet; f++)
        n += on[f] && (axis < 0 || axis_of[f] == axis) ? n_local : 0;
    if (n == 0)
        return 0;
    *d = (dirichlet_set){.value = v, .comp = comp, .field = field};
    ARENA_NEW(&c->memory, d->node, n, err);
    n = 0;
    for (int64_t f = 0; f < m->n_facet; f++)
        for (int i = 0; on[f] && (axis < 0 || axis_of[f] == axis) && i < n_local; i++)
            d->node[n++] =
                m->cell[(int64_t)m->facet[f].cell * m->type->n_node + m->type->facet[m->facet[f].local][i]];
    qsort(d->node, (size_t)n, sizeof *d->node, order_int32);
    for (int64_t i = 0; i < n; i++)
        if (i == 0 || d->node[i] != d->node[d->n - 1])
            d->node[d->n++] = d->node[i];
    for (int64_t i = 0; i < d->n; i++)
        for (int k = 0; k < s->field[field].n_comp; k++)
            if (comp < 0 ? !v->free[k] : comp == k)
                s->fixed[s->first[field][d->node[i]] + k] = SPACE_PRESCRIBED;
    c->n_set++;
    return 0;
}

/* Components that the mirror turns are zero: of a vector the normal one, of a tensor those with the normal once. */
static int add_symmetry(conditions *c, const description *d, space *s, int line, error *err)
{
    const mesh *m = s->mesh;
    const boundary_line *l = &d->line[line];
    int8_t *axis;

    ARENA_NEW(&c->memory, axis, m->n_facet, err);
    for (int64_t f = 0; f < m->n_facet; f++) {
        axis[f] = c->facet[line][f] ? (int8_t)facet_axis(m, f) : -1;
        if (c->facet[line][f] && axis[f] < 0) {
            case_wrong(
                d->c, l->block, "symmetry",
                "boundary \"%s\": symmetry needs a plane normal to x, y%s; facets of this boundary are oblique or "
                "curved",
                l->name, m->dim == 3 ? " or z" : "");
            return 0;
        }
    }
    for (int f = 0; f < s->n_field; f++)
        for (int a = 0; a < m->dim && s->field[f].support == PF_ON_MESH && s->field[f].order; a++)
            for (int k = 0; k < s->field[f].n_comp; k++)
                if (term_turns_sign((uint32_t)s->field[f].shape, s->field[f].n_comp, k, a))
                    TRY(add_set(c, s, line, f, k, NULL, axis, a, err));
    return 0;
}

/* rank[n_line]: "*" first, then the order of the case. */
static void rank_lines(const description *d, int *rank)
{
    int n = 0;

    for (int star = 1; star >= 0; star--)
        for (int i = 0; i < d->n_line; i++) {
            const char *name = d->line[i].name;

            if ((name && strcmp(name, "*") == 0) == star)
                rank[i] = n++;
        }
}

/* Everything that holds at the start, for the first time: what is wrong with it is told. */
static int try_out(const conditions *c, const space *s, warning_list *w, error *err)
{
    double t = c->description->time.start, excess = 0, *x = calloc((size_t)s->n_dof + 1, sizeof *x);
    int status =
        x ? conditions_apply(c, s, t, x, err) : error_memory(err, "boundary values", 8.0 * (double)s->n_dof);

    if (!status)
        status = corners_apply(&c->corners, c->description, s, t, x, w, err);
    if (!status)
        status = net_flow_check(c, s, x, t, &excess, err);
    if (!status && excess > 1e-9)
        warning_add(w,
                    "what flows in through the boundaries does not quite flow out: %.2g of it; it is spread over "
                    "the domain",
                    excess);
    free(x);
    return status;
}

int conditions_create(conditions *c, const description *d, space *s, warning_list *w, error *err)
{
    int sets = 0, rank[DESCRIBE_MAX_LINES];

    memset(c, 0, sizeof *c);
    c->description = d;
    c->n_line = d->n_line;
    rank_lines(d, rank);
    ARENA_NEW(&c->memory, c->facet, d->n_line + 1, err);
    for (int i = 0; i < d->n_line; i++) {
        ARENA_NEW(&c->memory, c->facet[i], s->mesh->n_facet + 1, err);
        describe_facets(d, s->mesh, i, c->facet[i]);
        sets += SPACE_MAX_FIELDS * (1 + d->line[i].symmetry * d->dim * VALUE_MAX);
    }
    ARENA_NEW(&c->memory, c->set, sets + 1, err);
    for (int at = 0; at < d->n_line; at++)
        for (int i = 0; i < d->n_line; i++) {
            const boundary_line *l = &d->line[i];

            if (rank[i] != at || l->periodic[0])
                continue;
            if (l->symmetry)
                TRY(add_symmetry(c, d, s, i, err));
            for (int f = 0; f < s->n_field; f++)
                if (l->has_value[f])
                    TRY(add_set(c, s, i, f, -1, &l->value[f], NULL, -1, err));
        }
    for (int f = 0; f < s->n_field; f++)
        if (s->field[f].shape == PF_VECTOR && s->field[f].support == PF_ON_MESH && s->field[f].order == 2)
            TRY(corners_find(&c->corners, d, s, c->facet, rank, f, err));
    TRY(net_flow_create(c, d, s, err));
    TRY(case_finish(d->c, err));
    return try_out(c, s, w, err);
}

int conditions_values(const conditions *c, const space *s, double t, double *x, error *err)
{
    int dim = s->mesh->dim;

    for (int i = 0; i < c->n_set; i++) {
        const dirichlet_set *d = &c->set[i];

        for (int64_t n = 0; n < d->n; n++) {
            double at[3] = {0}, v[VALUE_MAX] = {0}, *to = x + s->first[d->field][d->node[n]];

            memcpy(at, s->mesh->x + (int64_t)d->node[n] * dim, (size_t)dim * sizeof *at);
            if (d->value)
                TRY(value_at(d->value, at, t, v, err));
            for (int k = 0; k < s->field[d->field].n_comp; k++)
                if (d->comp < 0 ? !d->value->free[k] : d->comp == k)
                    to[k] = v[k];
        }
    }
    return corners_apply(&c->corners, c->description, s, t, x, NULL, err);
}

int conditions_apply(const conditions *c, const space *s, double t, double *x, error *err)
{
    double ignored;

    TRY(conditions_values(c, s, t, x, err));
    return c->flow.of_time ? net_flow_check(c, s, x, t, &ignored, err) : 0;
}

void conditions_destroy(conditions *c)
{
    corners_destroy(&c->corners);
    arena_free(&c->memory);
    memset(c, 0, sizeof *c);
}
