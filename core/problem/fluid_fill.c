/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Values of nodes that lie in bodies, where the fluid's unknowns have no equations: the motion of the body.
 * They are what history finds where its path (moving_frame.c) leads below the surface. */
#include "problem/problem.h"

#include <string.h>

void problem_motion(const problem *p, const double *x, int k, const double *at, double *v)
{
    int64_t u = problem_particle_dof(p, k, PF_VECTOR), w = problem_particle_dof(p, k, PF_SPIN);
    double r[3] = {0}, spin[3] = {0};

    for (int b = 0; b < p->dim; b++)
        r[b] = at[b] - p->particle[k].at.x[b];
    for (int b = 0; w >= 0 && b < (p->dim == 2 ? 1 : 3); b++)
        spin[p->dim == 2 ? 2 : b] = x[w + b];
    for (int b = 0; b < p->dim; b++) {
        const int i = (b + 1) % 3, j = (b + 2) % 3;

        v[b] = x[u + b] + spin[i] * r[j] - spin[j] * r[i];
    }
}

/* Nodes of the cells that body pair `a` covers. */
static void fill_cell(problem *p, double *x, int f, int64_t a)
{
    const space *s = &p->space;
    int body = s->attached_particle[a];

    for (int i = 0; i < p->mesh.type->n_node; i++) {
        int32_t node = p->mesh.cell[(int64_t)s->attached_cell[a] * p->mesh.type->n_node + i];
        int64_t d = s->first[f][node];
        double at[3] = {0}, v[3];

        if (!s->idle[d] || p->filled[s->dof_node[d]] == p->n_fill)
            continue;
        p->filled[s->dof_node[d]] = p->n_fill;
        for (int k = 0; k < p->dim; k++) /* in the frame of the body itself, not of its image */
            at[k] = p->mesh.x[(int64_t)node * p->dim + k] - p->shift[a][k];
        problem_motion(p, x, body, at, v);
        for (int k = 0; k < p->dim; k++)
            if (!s->fixed[d + k])
                x[d + k] = v[k];
    }
}

void problem_fill(problem *p, double *x)
{
    const space *s = &p->space;

    p->n_fill++;
    for (int g = 0; g < s->n_field; g++) {
        int f = s->field[g].support == PF_ON_PARTICLE && s->field[g].shape == PF_VECTOR && s->field[g].constrains
                    ? space_find_field(s, s->field[g].constrains)
                    : -1;

        for (int64_t k = 0; f >= 0 && p->fluid_only[f] && k < p->n_covered; k++)
            fill_cell(p, x, f, p->covered[k]);
    }
}
