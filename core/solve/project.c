/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * L2 projection on the functions of the vertices, over the points that a quantity has (of the fluid: cut cells with
 * the part that is left to it),
 *
 *     sum_j (int phi_i phi_j) x_j = int q phi_i,
 *
 * by conjugate gradients with the diagonal: its condition is below 16 on whole cells (Wathen 1987, IMA J. Numer.
 * Anal. 7:449), whatever the mesh. */
#include "solve/shown.h"
#include "solve/vector.h"

#include <math.h>
#include <string.h>

enum { MOST_ITERATIONS = 500 };
/* What is left of the residual; more than a thousandth of the discretisation's own error it is never. */
#define SMALL  1e-13
#define ENOUGH 1e-8

/* One component of one field: vectors have an entry for each vertex. */
typedef struct projection {
    const shown *p;
    int where;
    int64_t n;                                /* vertices                       */
    const int32_t *at;                        /* [n_node] vertex of each node, -1: none */
    double *b, *x, *r, *z, *d, *y, *diagonal; /* [n] */
} projection;

/* y = M x; of x NULL its diagonal. */
static void multiply(const projection *j, const double *restrict x, double *restrict y)
{
    const mesh *m = j->p->from->mesh;
    const int nv = m->type->n_vertex;

    memset(y, 0, (size_t)j->n * sizeof *y);
    for (int k = 0; k < j->p->assembly.n_class; k++) {
        const assembly_class *c = &j->p->assembly.class_[k];
        const shown_class *s = &j->p->out.class_[k];
        const double *mass = s->mass;

        if (c->where != j->where || !s->projects)
            continue;
        for (int64_t i = 0; i < c->n_item; i++) {
            const int32_t *node = m->cell + (int64_t)c->cell[s->item[i]] * m->type->n_node;
            int32_t v[8];

            for (int a = 0; a < nv; a++)
                v[a] = j->at[node[m->type->vertex[a]]];
            for (int a = 0; a < nv; a++)
                for (int b = a; b < nv; b++, mass++) {
                    if (a == b)
                        y[v[a]] += x ? *mass * x[v[a]] : *mass;
                    else if (x) {
                        y[v[a]] += *mass * x[v[b]];
                        y[v[b]] += *mass * x[v[a]];
                    }
                }
        }
    }
}

/* Vertices that no point is near have a zero row. */
static void precondition(const projection *j, const double *r, double *z)
{
    for (int64_t i = 0; i < j->n; i++)
        z[i] = j->diagonal[i] > 0 ? r[i] / j->diagonal[i] : 0;
}

static int solve(const projection *j, error *err)
{
    double rz, first, left;

    memset(j->x, 0, (size_t)j->n * sizeof *j->x);
    memcpy(j->r, j->b, (size_t)j->n * sizeof *j->r);
    precondition(j, j->r, j->z);
    memcpy(j->d, j->z, (size_t)j->n * sizeof *j->d);
    first = left = rz = vector_dot(j->n, j->r, j->z);
    for (int k = 0; k < MOST_ITERATIONS && left > SMALL * SMALL * first; k++) {
        double alpha, before = rz;

        multiply(j, j->d, j->y);
        alpha = rz / vector_dot(j->n, j->d, j->y);
        vector_add(j->n, alpha, j->d, j->x);
        vector_add(j->n, -alpha, j->y, j->r);
        precondition(j, j->r, j->z);
        left = rz = vector_dot(j->n, j->r, j->z);
        for (int64_t i = 0; i < j->n; i++)
            j->d[i] = j->z[i] + rz / before * j->d[i];
    }
    if (!(left <= ENOUGH * ENOUGH * first))
        return error_set(err, ERR_CONVERGE,
                         "the projection of a shown field does not converge (%.2g of it is left)",
                         sqrt(left / first));
    return 0;
}

static int make_room(projection *j, arena *memory, error *err)
{
    double **v[] = {&j->b, &j->x, &j->r, &j->z, &j->d, &j->y, &j->diagonal};

    for (size_t i = 0; i < sizeof v / sizeof *v; i++)
        ARENA_NEW(memory, *v[i], j->n + 1, err);
    multiply(j, NULL, j->diagonal);
    return 0;
}

/* Numbers the vertices, those of a periodic pair as one. */
static int number(projection *j, int field, arena *memory, error *err)
{
    const space *s = &j->p->space;
    int32_t *at, *seen;

    ARENA_NEW(memory, at, s->mesh->n_node + 1, err);
    ARENA_NEW(memory, seen, s->n_dof + 1, err);
    j->at = at;
    for (int64_t i = 0; i < s->mesh->n_node; i++) {
        int32_t d = s->first[field][i];

        at[i] = -1;
        if (d < 0)
            continue;
        if (!seen[d])
            seen[d] = (int32_t)++j->n;
        at[i] = seen[d] - 1;
    }
    return 0;
}

static int project_one(projection *j, int field, int component, double *x, error *err)
{
    const shown *p = j->p;
    const int32_t *first = p->space.first[field];

    for (int64_t i = 0; i < p->space.mesh->n_node; i++)
        if (j->at[i] >= 0)
            j->b[j->at[i]] = p->out.load[first[i] + component];
    TRY(solve(j, err));
    for (int64_t i = 0; i < p->space.mesh->n_node; i++)
        if (j->at[i] >= 0)
            x[first[i] + component] = j->diagonal[j->at[i]] > 0 ? j->x[j->at[i]] : NAN;
    return 0;
}

int project_fields(shown *p, int where, error *err)
{
    projection j = {.p = p, .where = where};
    arena memory = {0};
    int status = 0;

    for (int f = 0; f < p->space.n_field && !status; f++) {
        if (p->field[f].where != where)
            continue;
        if (!j.n)
            status = number(&j, f, &memory, err);
        if (!status && !j.b)
            status = make_room(&j, &memory, err);
        for (int k = 0; k < p->space.field[f].n_comp && !status; k++)
            status = project_one(&j, f, k, p->x, err);
    }
    arena_free(&memory);
    return status;
}
