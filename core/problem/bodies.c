/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Bodies in the problem: cells attached to them, the active set of restricted fields, motion.
 *
 * Cells within a margin of a body are attached to it: their nodes couple with its velocity, and the
 * matrix has room for restricted unknowns (multipliers) at them.  While the body stays within
 * the margin only weights and flags change; beyond, the cells are attached anew. */
#include "problem/problem.h"

#include <math.h>
#include <string.h>

/* Margin of the attached cells, in sizes of a cell; the body may move by it less one cell's reach. */
#define MARGIN 1.07 /* no round number: bodies often lie along the lines of the mesh */

int64_t problem_particle_dof(const problem *p, int k, int shape)
{
    for (int f = 0; f < p->space.n_field; f++)
        if (p->space.field[f].support == PF_ON_PARTICLE && p->space.field[f].shape == shape)
            return p->space.first[f][p->mesh.n_node + 1 + k];
    return -1;
}

void problem_hold_particles(problem *p)
{
    int n_spin = p->dim == 2 ? 1 : 3;

    for (int k = 0; k < p->n_particle; k++) {
        const particle *q = &p->particle[k];
        int64_t u = problem_particle_dof(p, k, PF_VECTOR), w = problem_particle_dof(p, k, PF_SPIN);

        for (int i = 0; u >= 0 && i < p->dim; i++)
            p->space.fixed[u + i] = q->motion != PARTICLE_FREE || q->held[i];
        for (int i = 0; w >= 0 && i < n_spin; i++)
            p->space.fixed[w + i] = q->motion != PARTICLE_FREE || q->held[p->dim == 2 ? 5 : 3 + i];
    }
}

particle problem_image(const problem *p, int64_t attached)
{
    particle q = p->particle[p->space.attached_particle[attached]];

    for (int i = 0; i < 3; i++)
        q.at.x[i] += p->shift[attached][i];
    return q;
}

static int is_restricted(const problem *p, int f)
{
    return p->space.field[f].support == PF_IN_PARTICLES;
}

/* Integral of phi_i^2 over the domain (cell = whole cells) for the nodes of restricted fields. */
static int whole_norms(problem *p, error *err)
{
    const mesh *m = &p->mesh;
    const fe_cell *c = m->type;
    fe_rule rule;

    TRY(fe_rule_cell(c, 5, &rule, err));
    ARENA_NEW(&p->memory, p->whole, m->n_node, err);
    ARENA_NEW(&p->memory, p->inside, m->n_node, err);
    for (int q = 0; q < rule.n; q++) {
        double n[FE_MAX_NODES], dn[FE_MAX_NODES][3];

        fe_basis(c, 2, rule.x[q], n, dn);
        for (int64_t e = 0; e < m->n_cell; e++)
            for (int i = 0; i < c->n_node; i++)
                p->whole[space_carrier(&p->space, e, i)] +=
                    rule.w[q] / c->measure * pow(m->h[e], m->dim) * n[i] * n[i];
    }
    return 0;
}

static void warn_resolution(problem *p)
{
    for (int k = 0; k < p->n_particle; k++) {
        const particle *q = &p->particle[k];
        double h = 0;
        int64_t n = 0;

        for (int64_t a = 0; a < p->space.n_attached; a++)
            if (p->space.attached_particle[a] == k) {
                h += p->mesh.h[p->space.attached_cell[a]];
                n++;
            }
        h = n ? h / (double)n : INFINITY;
        if (q->shape.thickness < 3.99 * h && !p->coarse_warned) {
            text_add(&p->c->printed,
                     "warning: particle %d is %.3g wide, %.2g cells; below 4 cells across forces are off by more "
                     "than a few "
                     "per cent\n",
                     k, q->shape.thickness, q->shape.thickness / h);
            p->coarse_warned = 1;
        }
    }
}

/* Attaches the cells near each body and numbers the unknowns anew. */
static int attach(problem *p, error *err)
{
    space *s = &p->space;
    int32_t *list;
    int64_t n = 0;

    arena_free(&p->envelope_memory);
    ARENA_NEW(&p->envelope_memory, list, p->mesh.n_cell, err);
    for (int pass = 0; pass < 2; pass++) {
        n = 0;
        for (int k = 0; k < p->n_particle; k++) {
            const particle *q = &p->particle[k];

            for (int j = 0; j < p->n_image; j++) {
                double x[3] = {q->at.x[0] + p->image[j][0], q->at.x[1] + p->image[j][1], q->at.x[2] + p->image[j][2]};
                int64_t here = cell_grid_ball(&p->grid, x, q->shape.radius + MARGIN * p->h_max, list);

                for (int64_t i = 0; pass && i < here; i++) {
                    s->attached_cell[n + i] = list[i];
                    s->attached_particle[n + i] = k;
                    memcpy(p->shift[n + i], p->image[j], sizeof p->image[j]);
                }
                n += here;
            }
            memcpy(p->envelope + 3 * k, q->at.x, sizeof q->at.x);
        }
        if (pass)
            break;
        ARENA_NEW(&p->envelope_memory, s->attached_cell, n + 1, err);
        ARENA_NEW(&p->envelope_memory, s->attached_particle, n + 1, err);
        ARENA_NEW(&p->envelope_memory, p->shift, n + 1, err);
    }
    s->n_attached = n;
    fluid_forget(p);
    TRY(problem_link(p, 2 * MARGIN * p->h_max, err));
    ARENA_NEW(&p->envelope_memory, p->weight, n * p->cut.n + 1, err);
    ARENA_NEW(&p->envelope_memory, p->covered, n + 1, err);
    ARENA_NEW(&p->envelope_memory, p->whole_inside, n + 1, err);
    ARENA_NEW(&p->envelope_memory, p->cut_weight, n * p->cut.n + 1, err);
    ARENA_NEW(&p->envelope_memory, p->cut_cell, n + 1, err);
    p->n_covered = 0;
    for (int64_t d = 0; d < s->n_dof; d++) /* bit 1: restricted, and away from all bodies */
        s->fixed[d] = (uint8_t)((s->fixed[d] & 1) | (is_restricted(p, s->dof_field[d]) ? 2 : 0));
    for (int f = 0; f < s->n_field; f++)
        for (int64_t a = 0; is_restricted(p, f) && a < n; a++)
            for (int i = 0; i < p->mesh.type->n_node; i++) {
                int64_t d = s->first[f][space_carrier(s, p->mesh.n_cell + a, i)];

                for (int c = 0; c < s->field[f].n_comp; c++)
                    s->fixed[d + c] &= 1;
            }
    p->n_attach++;
    return 0;
}

/* Numbers the free unknowns and makes the pattern anew, and a linear solver for it. */
static int renew_matrix(problem *p, error *err)
{
    linear_stats stats = p->system.linear.stats;
    double limit = p->system.linear.memory_limit;

    TRY(space_constrain(&p->space, err));
    if (!p->system.linear.solver)
        return 0;
    linear_destroy(&p->system.linear);
    TRY(linear_create(&p->system.linear, p->solver, &p->space, p->n_thread, err));
    p->system.linear.stats = stats;
    p->system.linear.memory_limit = limit;
    return 0;
}

/* Weights of the cells that each body covers, corrected to its exact moments. */
static int cut(problem *p, error *err)
{
    const space *s = &p->space;
    int64_t a = 0;

    p->n_covered = p->surface.n = p->surface.n_last = 0;
    arena_free(&p->step_memory);
    for (int k = 0; k < p->n_particle; k++) {
        const particle *q = &p->particle[k];
        int64_t first = p->n_covered, n;
        double volume = 0, fraction;
        solid whole;
        double(*shift)[3];
        int32_t *cell;
        enum cut_cover cover;

        for (; a < s->n_attached && s->attached_particle[a] == k; a++) {
            particle image = problem_image(p, a);
            solid here = solid_at(&image.shape, &image.at);

            p->surface.now = (int32_t)a;
            TRY(cut_cell(&p->cut, &p->mesh, s->attached_cell[a], &here, p->weight + p->n_covered * p->cut.n,
                         p->has_surface ? fluid_add_surface : NULL, p, &cover, err));
            fluid_end_surface(p);
            if (cover != CUT_NONE) {
                p->whole_inside[p->n_covered] = cover == CUT_WHOLE;
                p->covered[p->n_covered++] = (int32_t)a;
            }
        }
        n = p->n_covered - first;
        ARENA_NEW(&p->step_memory, cell, n + 1, err);
        ARENA_NEW(&p->step_memory, shift, n + 1, err);
        for (int64_t i = 0; i < n; i++) {
            cell[i] = s->attached_cell[p->covered[first + i]];
            memcpy(shift[i], p->shift[p->covered[first + i]], sizeof *shift);
            for (int j = 0; j < p->cut.n; j++)
                volume +=
                    p->weight[(first + i) * p->cut.n + j] / p->mesh.type->measure * pow(p->mesh.h[cell[i]], p->dim);
        }
        if (volume < 1e-9 * q->shape.volume)
            return error_set(err, ERR_CONVERGE,
                             "particle %d has left the domain: its centre is at %s; for a body that may, stop "
                             "earlier, or make the "
                             "boundary periodic",
                             k, text_point(q->at.x, p->dim).s);
        fraction = 1; /* a body that reaches over the edge of the domain: half, quarter, eighth, or unknown */
        for (int i = 1; i <= 3; i++)
            if (fabs(volume / q->shape.volume - pow(0.5, i)) < 0.03 * pow(0.5, i))
                fraction = pow(0.5, i);
        if (fraction == 1 && fabs(volume / q->shape.volume - 1) > 0.05)
            fraction = 0;
        whole = solid_at(&q->shape, &q->at);
        TRY(cut_correct(&p->cut, &p->mesh, &whole, cell, (const double(*)[3])shift, p->weight + first * p->cut.n, n,
                        fraction, err));
    }
    return 0;
}

/* Which restricted unknowns take part: int over the bodies of phi_i^2 > tau int over the domain. */
static void activate(problem *p, double *x)
{
    space *s = &p->space;
    const fe_cell *c = p->mesh.type;
    int any = 0;

    for (int f = 0; f < s->n_field; f++)
        any |= is_restricted(p, f);
    if (!any)
        return;
    for (int64_t a = 0; a < s->n_attached; a++)
        for (int i = 0; i < c->n_node; i++)
            p->inside[space_carrier(s, p->mesh.n_cell + a, i)] = 0;
    for (int64_t k = 0; k < p->n_covered; k++)
        for (int i = 0; i < c->n_node; i++) {
            double sum = 0;

            for (int q = 0; q < p->cut.n; q++) {
                double b = p->cut_basis[q * c->n_node + i];

                sum += p->weight[k * p->cut.n + q] * b * b;
            }
            p->inside[space_carrier(s, p->mesh.n_cell + p->covered[k], i)] +=
                sum / c->measure * pow(p->mesh.h[s->attached_cell[p->covered[k]]], p->dim);
        }
    for (int f = 0; f < s->n_field; f++) {
        int holds = s->field[f].constrains ? space_find_field(s, s->field[f].constrains) : -1;

        for (int64_t a = 0; is_restricted(p, f) && a < s->n_attached; a++)
            for (int i = 0; i < c->n_node; i++) {
                int32_t node = space_carrier(s, p->mesh.n_cell + a, i);
                int64_t d = s->first[f][node], u = holds >= 0 ? s->first[holds][node] : -1;

                for (int k = 0; k < s->field[f].n_comp; k++) {
                    s->idle[d + k] =
                        !(p->inside[node] > p->active_threshold * p->whole[node]) || (u >= 0 && s->fixed[u + k]);
                    if (s->idle[d + k])
                        x[d + k] = 0;
                }
            }
    }
    for (int64_t d = 0; d < s->n_dof; d++)
        if (s->fixed[d] & 2)
            x[d] = 0;
}

int problem_cut(problem *p, double *x, error *err)
{
    double start = solve_seconds();
    int again = p->space.n_attached == 0, moved = 0, fresh = 0;

    if (p->n_particle == 0)
        return 0;
    for (int k = 0; k < p->n_particle; k++) {
        double d = 0;

        for (int i = 0; i < p->dim; i++)
            d += pow(p->particle[k].at.x[i] - p->envelope[3 * k + i], 2);
        moved |= p->particle[k].motion != PARTICLE_FIXED;
        again |= sqrt(d) > 0.95 * MARGIN * p->h_max;
    }
    if (again)
        TRY(attach(p, err));
    if (again || moved || p->n_covered == 0) { /* bodies that stand are cut as they were */
        TRY(cut(p, err));
        if (p->surface.failed)
            return error_memory(err, "pieces of surface", 0);
        TRY(fluid_weights(p, err));
        if (p->has_ties)
            TRY(fluid_ties(p, &fresh, err));
        if (p->tie.n_rootless > 0 && p->rootless++ == 0)
            text_add(&p->c->printed,
                     "warning: %lld cells with little fluid have no neighbour to be tied to (a gap narrower than a "
                     "cell?); summary.json counts how often that happens\n",
                     (long long)p->tie.n_rootless);
    }
    if (again || fresh)
        TRY(renew_matrix(p, err));
    activate(p, x);
    if (p->any_fluid_only)
        fluid_activate(p, x);
    problem_find_pairs(p);
    if (p->system.linear.solver && moved)
        linear_forget(&p->system.linear); /* the old factors know the old cells */
    if (p->system.linear.solver)
        TRY(assembly_set_bodies(&p->system.assembly,
                                &(body_points){.particle = p->particle,
                                               .shift = (const double(*)[3])p->shift,
                                               .off = p->fluid_off,
                                               .n_pair = p->n_pair,
                                               .pair = p->pair,
                                               .n_solid = p->n_covered,
                                               .n_cut = p->n_cut,
                                               .solid = p->covered,
                                               .cut = p->cut_cell,
                                               .solid_weight = p->weight,
                                               .cut_weight = p->cut_weight,
                                               .n_surface = p->surface.n,
                                               .surface = p->surface.attached,
                                               .surface_ref = (const double(*)[3])p->surface.ref,
                                               .surface_normal = (const double(*)[3])p->surface.normal,
                                               .surface_weight = p->surface.weight,
                                               .n_tie = p->tie.n,
                                               .tie = p->tie.group,
                                               .tie_cell = p->tie.cell,
                                               .tie_weight = p->tie.weight,
                                               .tie_ref = (const double(*)[3])p->tie.ref},
                                err));
    p->geometry_seconds += solve_seconds() - start;
    return 0;
}

int problem_make_particles(problem *p, error *err)
{
    if (p->n_particle == 0)
        return 0;
    p->active_threshold = p->active_threshold > 0 ? p->active_threshold : 0.1;
    for (int64_t e = 0; e < p->mesh.n_cell; e++)
        p->h_mean += p->mesh.h[e] / (double)p->mesh.n_cell;
    p->h_max = p->h_mean;
    TRY(cut_rule_create(&p->cut, p->mesh.type, err));
    ARENA_NEW(&p->memory, p->cut_basis, p->cut.n * p->mesh.type->n_node, err);
    for (int q = 0; q < p->cut.n; q++) {
        double ignored[FE_MAX_NODES][3];

        fe_basis(p->mesh.type, 2, p->cut.x[q], p->cut_basis + q * p->mesh.type->n_node, ignored);
    }
    p->n_image = mesh_images(&p->mesh, p->image);
    TRY(fluid_create(p, err));
    ARENA_NEW(&p->memory, p->envelope, 3 * p->n_particle, err);
    for (int i = 0; i < 3; i++)
        ARENA_NEW(&p->memory, p->remembered[i], p->n_particle, err);
    ARENA_NEW(&p->memory, p->paths.body, p->n_particle * p->n_image, err);
    ARENA_NEW(&p->memory, p->paths.cell, p->mesh.n_cell, err);
    TRY(whole_norms(p, err));
    TRY(problem_cut(p, p->x, err));
    warn_resolution(p);
    return 0;
}

int problem_move(void *problem_, enum move what, int slot, double dt, const double *u0, double *u1, error *err)
{
    problem *p = problem_;

    for (int k = 0; k < p->n_particle; k++) {
        particle *q = &p->particle[k];
        int64_t u = problem_particle_dof(p, k, PF_VECTOR), w = problem_particle_dof(p, k, PF_SPIN);
        double turn[3] = {0};

        if (what == MOVE_REMEMBER) {
            p->remembered[slot][k] = *q;
            continue;
        }
        if (what == MOVE_KEEP) {
            p->remembered[2][k] = p->remembered[slot][k];
            continue;
        }
        *q = p->remembered[slot][k];
        if (what == MOVE_RESTORE || q->motion == PARTICLE_FIXED)
            continue;
        for (int i = 0; u >= 0 && i < p->dim; i++)
            q->at.x[i] += 0.5 * dt * (u0[u + i] + u1[u + i]);
        for (int i = 0; w >= 0 && i < (p->dim == 2 ? 1 : 3); i++)
            turn[p->dim == 2 ? 2 : i] = 0.5 * dt * (u0[w + i] + u1[w + i]);
        pose_turn(&q->at, p->dim, turn);
        mesh_wrap(&p->mesh, q->at.x); /* one that left through a periodic boundary comes in on the other side */
    }
    if (what == MOVE_PLACE)
        problem_fill(p, u1);
    return what == MOVE_PREDICT ? problem_cut(p, u1, err) : 0;
}
