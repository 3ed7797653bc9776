/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * boundary "..." {} of a case.  Conditions apply in the order of the case, "*" (what no other
 * line names) first; where two lines meet in a node the later one holds. */
#include "problem/problem.h"

#include "base/order.h"

#include <lauxlib.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int read_fluxes(problem *p, reader *r, boundary_line *l)
{
    int any = 0;

    for (int i = 0; i < p->n_use; i++) {
        const pf_term *t = p->use[i].term;

        for (uint32_t k = 0; (t->flags & PF_BY_BOUNDARY) && k < t->n_in; k++) {
            value *v = &l->flux_value[l->n_flux];
            term_use *u;

            if (t->in[k].eval != PF_DATA)
                continue;
            v->n = term_components(t->in[k].shape, p->dim);
            if (reader_value(r, t->in[k].name, t->doc, v->n, p->dim, v) <= 0)
                continue;
            u = arena_alloc(&p->memory, 1, sizeof *u);
            if (!u)
                return 0;
            *u = p->use[i];
            u->data[k] = v;
            l->flux[l->n_flux++] = u;
            any = 1;
        }
    }
    return any;
}

/* A flux of a field that is prescribed as a whole, or anything beside natural = true, cannot be meant. */
static void check_conflicts(problem *p, const case_block *b, const char *what, const boundary_line *l)
{
    for (int i = 0; i < l->n_flux; i++) {
        const pf_term *t = l->flux[i]->term;
        int f = space_find_field(&p->space, t->out[0].field), free = 0, lost = 0;

        for (int k = 0; f >= 0 && k < p->space.field[f].n_comp; k++) {
            free |= l->value[f].free[k];
            lost |= !l->value[f].free[k] && l->flux_value[i].constant[k] != 0;
        }
        for (uint32_t k = 0; f >= 0 && l->has_value[f] && (!free || lost) && k < t->n_in; k++)
            if (t->in[k].eval == PF_DATA)
                case_wrong(p->c, b, t->in[k].name,
                           "%s: \"%s\" and \"%s\" are both given; where %s is prescribed, %s has no effect", what,
                           p->space.field[f].name, t->in[k].name, p->space.field[f].name, t->in[k].name);
    }
    for (int f = 0; l->natural && f < p->space.n_field; f++)
        if (l->has_value[f] || l->n_flux || l->symmetry) {
            case_wrong(p->c, b, "natural", "%s: natural = true says that nothing is prescribed, but something is",
                       what);
            break;
        }
}

static void read_line(problem *p, const case_block *b, boundary_line *l)
{
    char *what = arena_alloc(&p->memory, (b->name ? strlen(b->name) : 0) + 16, 1);
    int any = 0, n_periodic = 0;
    reader r;

    if (!what)
        return;
    if (b->name)
        sprintf(what, "boundary \"%s\"", b->name);
    else
        strcpy(what, "boundary");
    *l = (boundary_line){.block = b, .name = b->name};
    reader_open(&r, p->c, b, what);
    if (!b->name) {
        if (reader_strings(&r, "periodic", "two boundaries that are one", 2, l->periodic, &n_periodic) <= 0 ||
            n_periodic != 2)
            case_wrong(
                p->c, b, NULL,
                "boundary: expected a name, as in boundary \"left\" {...}, or periodic = {\"left\", \"right\"}");
        reader_close(&r);
        return;
    }
    if (reader_has(&r, "periodic"))
        case_wrong(p->c, b, "periodic", "%s: write boundary { periodic = {\"left\", \"right\"} }, without a name",
                   what);
    any |= reader_bool(&r, "symmetry", "no flow through, no shear", &l->symmetry) > 0;
    any |= reader_bool(&r, "natural", "nothing prescribed, no traction (outflow)", &l->natural) > 0;
    for (int f = 0; f < p->space.n_field; f++) {
        const space_field *g = &p->space.field[f];

        if (g->support != PF_ON_MESH)
            continue;
        l->has_value[f] = reader_value(&r, g->name, g->doc, g->n_comp, p->dim, &l->value[f]) > 0;
        any |= l->has_value[f] || reader_has(&r, g->name);
    }
    any |= read_fluxes(p, &r, l);
    reader_close(&r);
    check_conflicts(p, b, what, l);
    if (!any && !reader_has(&r, "periodic"))
        case_wrong(p->c, b, NULL, "%s gives no condition; natural = true says that nothing is prescribed", what);
}

int problem_read_boundaries(problem *p, error *err)
{
    const case_block *b;

    ARENA_NEW(&p->memory, p->line, PROBLEM_MAX_LINES, err);
    for (int k = 0; (b = case_find(p->c, "boundary", k)); k++) {
        if (p->n_line == PROBLEM_MAX_LINES)
            return error_set(err, ERR_CASE, "%s:%d: more than %d boundary lines", b->file, b->line,
                             PROBLEM_MAX_LINES);
        read_line(p, b, &p->line[p->n_line++]);
    }
    return 0;
}

/* Index of a boundary name, or -1 with a message. */
static int find_name(problem *p, const case_block *b, const char *name)
{
    const char *near, *names[MESH_MAX_NAMES];
    int i = mesh_find_name(&p->mesh, name);
    text t = {0};

    if (i >= 0)
        return i;
    for (int k = 0; k < p->mesh.n_name; k++) {
        names[k] = p->mesh.name[k];
        text_add(&t, "%s%s", k ? ", " : "", names[k]);
    }
    near = text_nearest(name, names, (size_t)p->mesh.n_name);
    case_wrong(p->c, b, NULL, "boundary: no boundary is called \"%s\"%s%s%s; the mesh has: %s", name,
               near ? "; did you mean \"" : "", near ? near : "", near ? "\"?" : "",
               t.s ? t.s : "no named boundary");
    text_free(&t);
    return -1;
}

/* Which facets belong to which line; facets without any are an error. */
static int attach_facets(problem *p, error *err)
{
    const mesh *m = &p->mesh;
    uint64_t named = 0, bit[PROBLEM_MAX_LINES] = {0}, bare_names = 0;
    int64_t bare = 0, first = -1;
    int star = 0;

    for (int i = 0; i < p->n_line; i++) {
        boundary_line *l = &p->line[i];
        const char *const *name = l->periodic[0] ? l->periodic : &l->name;

        ARENA_NEW(&p->memory, l->facet, m->n_facet, err);
        star |= l->name && strcmp(l->name, "*") == 0;
        for (int s = 0; s < (l->periodic[0] ? 2 : 1); s++) {
            int k = name[s] && strcmp(name[s], "*") ? find_name(p, l->block, name[s]) : -1;

            bit[i] |= k >= 0 ? (uint64_t)1 << k : 0;
        }
        named |= bit[i];
        if (l->periodic[0] && l->periodic[1] && strcmp(l->periodic[0], l->periodic[1]) == 0)
            case_wrong(p->c, l->block, "periodic", "boundary: \"%s\" cannot be periodic with itself",
                       l->periodic[0]);
    }
    for (int i = 0; i < p->n_line; i++)
        for (int k = 0; k < p->n_line; k++)
            if (i != k && p->line[i].periodic[0] && (bit[i] & bit[k]))
                case_wrong(p->c, p->line[k].block, NULL,
                           "boundary: a boundary that is periodic has another condition as well");
    for (int64_t f = 0; f < m->n_facet; f++) {
        for (int i = 0; i < p->n_line; i++)
            p->line[i].facet[f] = p->line[i].name && strcmp(p->line[i].name, "*") == 0
                                      ? !(m->facet[f].names & named)
                                      : (m->facet[f].names & bit[i]) != 0;
        if (!star && !(m->facet[f].names & named)) {
            first = bare++ ? first : f;
            bare_names |= m->facet[f].names;
        }
    }
    if (bare) {
        const int32_t *node = m->cell + (int64_t)m->facet[first].cell * m->type->n_node;
        const double *x = m->x + (int64_t)node[m->type->facet[m->facet[first].local][0]] * m->dim;
        text t = {0};

        for (int k = 0; k < m->n_name; k++)
            if (bare_names >> k & 1)
                text_add(&t, "%s\"%s\"", t.n ? ", " : "", m->name[k]);
        case_wrong(
            p->c, NULL, NULL,
            "%lld boundary facets have no condition: %s%s(the first at %s); give them one, or say "
            "boundary \"...\" { natural = true } if nothing is prescribed there; boundary \"*\" {} means all "
            "others",
            (long long)bare, t.s ? t.s : "without a name ", t.s ? " " : "", text_point(x, m->dim).s);
        text_free(&t);
    }
    return 0;
}

/* Adds the nodes of the line's facets that carry the field as one set; with axis >= 0 only facets
 * whose normal lies along that axis. */
static int add_set(problem *p, const boundary_line *l, int field, int comp, const value *v, const int8_t *axis_of,
                   int axis, error *err)
{
    const mesh *m = &p->mesh;
    int n_local = p->space.field[field].order == 2 ? m->type->facet_nodes : m->type->facet_vertices;
    dirichlet_set *d = &p->dirichlet[p->n_dirichlet];
    int64_t n = 0;

    for (int64_t f = 0; f < m->n_facet; f++)
        n += l->facet[f] && (axis < 0 || axis_of[f] == axis) ? n_local : 0;
    if (n == 0)
        return 0;
    *d = (dirichlet_set){.value = v, .comp = comp, .field = field};
    ARENA_NEW(&p->memory, d->node, n, err);
    n = 0;
    for (int64_t f = 0; f < m->n_facet; f++)
        for (int i = 0; l->facet[f] && (axis < 0 || axis_of[f] == axis) && i < n_local; i++)
            d->node[n++] =
                m->cell[(int64_t)m->facet[f].cell * m->type->n_node + m->type->facet[m->facet[f].local][i]];
    qsort(d->node, (size_t)n, sizeof *d->node, order_int32);
    for (int64_t i = 0; i < n; i++)
        if (i == 0 || d->node[i] != d->node[d->n - 1])
            d->node[d->n++] = d->node[i];
    for (int64_t i = 0; i < d->n; i++)
        for (int k = 0; k < p->space.field[field].n_comp; k++)
            if (comp < 0 ? !v->free[k] : comp == k)
                p->space.fixed[p->space.first[field][d->node[i]] + k] = 1;
    p->n_dirichlet++;
    return 0;
}

/* Axis along which a facet's normal lies, or -1. */
static int facet_axis(const mesh *m, int64_t f)
{
    const int32_t *cell = m->cell + (int64_t)m->facet[f].cell * m->type->n_node;

    for (int k = 0; k < m->dim; k++) {
        double low = INFINITY, high = -INFINITY;

        for (int i = 0; i < m->type->facet_nodes; i++) {
            double x = m->x[(int64_t)cell[m->type->facet[m->facet[f].local][i]] * m->dim + k];

            low = fmin(low, x);
            high = fmax(high, x);
        }
        if (high - low < 1e-8 * m->h[m->facet[f].cell])
            return k;
    }
    return -1;
}

static int add_symmetry(problem *p, const boundary_line *l, error *err)
{
    const mesh *m = &p->mesh;
    int8_t *axis;

    ARENA_NEW(&p->memory, axis, m->n_facet, err);
    for (int64_t f = 0; f < m->n_facet; f++) {
        axis[f] = l->facet[f] ? (int8_t)facet_axis(m, f) : -1;
        if (l->facet[f] && axis[f] < 0) {
            case_wrong(
                p->c, l->block, "symmetry",
                "boundary \"%s\": symmetry needs a plane normal to x, y%s; facets of this boundary are oblique or "
                "curved",
                l->name, m->dim == 3 ? " or z" : "");
            return 0;
        }
    }
    for (int f = 0; f < p->space.n_field; f++)
        for (int k = 0;
             k < m->dim && p->space.field[f].shape == PF_VECTOR && p->space.field[f].support == PF_ON_MESH; k++)
            TRY(add_set(p, l, f, k, NULL, axis, k, err));
    return 0;
}

int problem_make_boundaries(problem *p, error *err)
{
    int sets = 0;

    TRY(attach_facets(p, err));
    TRY(case_finish(p->c, err));
    for (int i = 0; i < p->n_line; i++)
        sets += SPACE_MAX_FIELDS * (1 + p->line[i].symmetry * p->dim);
    ARENA_NEW(&p->memory, p->dirichlet, sets + 1, err);
    for (int star = 1; star >= 0; star--)
        for (int i = 0; i < p->n_line; i++) {
            const boundary_line *l = &p->line[i];

            if (l->periodic[0] || (strcmp(l->name, "*") == 0) != star)
                continue;
            if (l->symmetry)
                TRY(add_symmetry(p, l, err));
            for (int f = 0; f < p->space.n_field; f++)
                if (l->has_value[f])
                    TRY(add_set(p, l, f, -1, &l->value[f], NULL, -1, err));
        }
    return case_finish(p->c, err);
}

/* Velocity and spin of bodies whose motion is given; held components of free ones stay as they began. */
static int prescribed_motion(const problem *p, double t, double *x, error *err)
{
    for (int k = 0; k < p->n_particle; k++) {
        const particle *q = &p->particle[k];
        int64_t first[2] = {problem_particle_dof(p, k, PF_VECTOR), problem_particle_dof(p, k, PF_SPIN)};

        for (int s = 0; s < 2; s++) {
            const value *given = s ? &q->spin : &q->velocity;
            double v[VALUE_MAX];

            TRY(value_at(given, (double[3]){0}, t, v, err));
            for (int i = 0; first[s] >= 0 && i < given->n; i++)
                if (p->space.fixed[first[s] + i])
                    x[first[s] + i] = v[i];
        }
    }
    return 0;
}

int problem_dirichlet(void *problem_, double t, double *x, error *err)
{
    problem *p = problem_;

    for (int i = 0; i < p->n_dirichlet; i++) {
        const dirichlet_set *d = &p->dirichlet[i];

        for (int64_t n = 0; n < d->n; n++) {
            double at[3] = {0}, v[VALUE_MAX] = {0}, *to = x + p->space.first[d->field][d->node[n]];

            memcpy(at, p->mesh.x + (int64_t)d->node[n] * p->dim, (size_t)p->dim * sizeof *at);
            if (d->value)
                TRY(value_at(d->value, at, t, v, err));
            for (int k = 0; k < p->space.field[d->field].n_comp; k++)
                if (d->comp < 0 ? !d->value->free[k] : d->comp == k)
                    to[k] = v[k];
        }
    }
    return prescribed_motion(p, t, x, err);
}
