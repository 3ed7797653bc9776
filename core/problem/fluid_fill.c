/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Values of nodes that lie in bodies, where the fluid's unknowns have no equations: they are the history of a
 * node when it comes out.  It is the motion of the body, and near the surface what the fluid there, continued
 * into the body to first order, has more than that.  The motion alone costs a first order in time where
 * a body turns as it moves (torque 2 % off at one cell a step); all of the continuation overshoots where the
 * boundary layer is as thin as a cell (a falling disk 3 % slow at 0.7 cells a step): so it is limited. */
#include "problem/problem.h"

#include "space/locate.h"

#include <math.h>
#include <string.h>

#define DEEPEST 2.5  /* h below the surface up to which the fluid is continued */
#define LIMIT   0.15 /* of the speed of the surface: what the continuation may add    */

void problem_motion(const problem *p, const double *x, int k, const double *at, double *v)
{
    int64_t u = problem_particle_dof(p, k, PF_VECTOR), w = problem_particle_dof(p, k, PF_SPIN);
    double r[3] = {0}, spin[3] = {0};

    for (int b = 0; b < p->dim; b++)
        r[b] = at[b] - p->particle[k].x[b];
    for (int b = 0; w >= 0 && b < (p->dim == 2 ? 1 : 3); b++)
        spin[p->dim == 2 ? 2 : b] = x[w + b];
    for (int b = 0; b < p->dim; b++) {
        const int i = (b + 1) % 3, j = (b + 2) % 3;

        v[b] = x[u + b] + spin[i] * r[j] - spin[j] * r[i];
    }
}

/* The point of the surface that the level's gradient leads to; 0 if it is further away than `reach`. */
static int find_foot(const particle *q, const double *x, double reach, double *foot)
{
    double r[3][3];

    particle_rotation(q, r);
    memcpy(foot, x, 3 * sizeof *foot);
    for (int i = 0; i < 30; i++) {
        double level = particle_level(q, (const double(*)[3])r, foot), g[3] = {0}, size = 0, away = 0;

        particle_slope(q, (const double(*)[3])r, foot, g);
        for (int k = 0; k < q->shape.dim; k++)
            size += g[k] * g[k];
        if (!(size > 0))
            return 0;
        for (int k = 0; k < q->shape.dim; k++) {
            foot[k] -= level * g[k] / size;
            away += (foot[k] - x[k]) * (foot[k] - x[k]);
        }
        if (!(away < 16 * reach * reach))
            return 0;
        if (fabs(level) < 1e-12)
            return away < reach * reach;
    }
    return 0;
}

/* Adds what the fluid at the foot, continued to first order, has more than the motion of the body: c = grad u (x -
 * foot) - omega x (x - foot), limited to c / (1 + |c| / (LIMIT |u_foot|)); nothing if the foot lies in no cell of
 * the fluid. */
static void continue_fluid(problem *p, const double *x, int f, const particle *here, int body, const double *at,
                           double *v)
{
    double foot[3], own[2][3] = {{0}}, rigid[2][3], value[3], gradient[9], c[3], size = 0, speed = 0, h;
    located l = {.cell = -1};
    int64_t n;

    n = cell_grid_ball(&p->grid, at, 0, p->near_cell);
    h = n ? p->mesh.h[p->near_cell[0]] : p->h_mean;
    if (!find_foot(here, at, DEEPEST * h, foot))
        return;
    n = cell_grid_ball(&p->grid, foot, 1e-9 * h, p->near_cell);
    for (int64_t i = 0; i < n && l.cell < 0; i++)
        if (p->fluid_off[p->near_cell[i]] != 2 && locate_in_cell(&p->mesh, p->near_cell[i], foot, l.xi) > 0)
            l.cell = p->near_cell[i];
    if (l.cell < 0)
        return;
    locate_value(&p->space, &l, f, x, value, gradient);
    for (int k = 0; k < p->dim; k++) { /* in the frame of the body itself, not of its image */
        own[0][k] = foot[k] - here->x[k] + p->particle[body].x[k];
        own[1][k] = at[k] - here->x[k] + p->particle[body].x[k];
    }
    for (int i = 0; i < 2; i++)
        problem_motion(p, x, body, own[i], rigid[i]);
    for (int a = 0; a < p->dim; a++) {
        c[a] = rigid[0][a] - rigid[1][a];
        for (int k = 0; k < p->dim; k++)
            c[a] += gradient[a * p->dim + k] * (at[k] - foot[k]);
        size += c[a] * c[a];
        speed += rigid[0][a] * rigid[0][a];
    }
    for (int a = 0; a < p->dim && speed > 0; a++)
        v[a] += c[a] / (1 + sqrt(size) / (LIMIT * sqrt(speed)));
}

/* Nodes of the cells that body pair `a` covers. */
static void fill_cell(problem *p, double *x, int f, int64_t a)
{
    const space *s = &p->space;
    int body = s->attached_particle[a];
    particle here = problem_image(p, a);

    for (int i = 0; i < p->mesh.type->n_node; i++) {
        int32_t node = p->mesh.cell[(int64_t)s->attached_cell[a] * p->mesh.type->n_node + i];
        int64_t d = s->first[f][node];
        double at[3] = {0}, own[3] = {0}, v[3];

        if (!s->idle[d] || p->filled[s->dof_node[d]] == p->n_fill)
            continue;
        p->filled[s->dof_node[d]] = p->n_fill;
        for (int k = 0; k < p->dim; k++) {
            at[k] = p->mesh.x[(int64_t)node * p->dim + k];
            own[k] = at[k] - p->shift[a][k];
        }
        problem_motion(p, x, body, own, v);
        continue_fluid(p, x, f, &here, body, at, v);
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
