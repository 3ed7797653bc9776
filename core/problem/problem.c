/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * From a case to a system of equations: read everything, complain about everything, then build. */
#include "problem/problem.h"

#include <string.h>

/* In cut cells Gauss's theorem holds as exactly as their quadrature; with an outflow the constant is off by
 * the square root of its share of all cells. */
#define CUT_CLOSURE 3e-4

static int make_periodic(problem *p, error *err)
{
    for (int i = 0; i < p->n_line; i++) {
        const char *const *name = p->line[i].periodic;
        int a, b;

        if (!name[0])
            continue;
        a = mesh_find_name(&p->mesh, name[0]);
        b = mesh_find_name(&p->mesh, name[1]);
        if (a >= 0 && b >= 0)
            TRY(mesh_make_periodic(&p->mesh, a, b, err));
    }
    return 0;
}

/* Terms by the points that they act on: one class for the cells, one each for what follows the bodies, one
 * for terms on all facets, one for each boundary line with fluxes. */
static int make_system(problem *p, error *err)
{
    assembly_spec spec[PROBLEM_MAX_LINES + 8] = {{0}};
    term_use *on[PF_PAIR + 1][ASSEMBLE_MAX_USES];
    uint8_t *all;
    int n = 0, n_on[PF_PAIR + 1] = {0};

    for (int i = 0; i < p->n_use; i++) {
        term_use *u = &p->use[i];
        int where = u->where == PF_FLUID && p->n_particle == 0 ? PF_CELL : u->where;

        if (!(u->term->flags & PF_BY_BOUNDARY))
            on[where][n_on[where]++] = u;
    }
    ARENA_NEW(&p->memory, p->continuation.use, p->n_use + p->n_line * ASSEMBLE_MAX_USES + 1, err);
    p->continuation.n_use = 0;
    for (int i = 0; i < p->n_use; i++)
        if ((p->use[i].term->flags & PF_CONTINUATION) && !(p->use[i].term->flags & PF_BY_BOUNDARY))
            p->continuation.use[p->continuation.n_use++] = &p->use[i];
    for (int i = 0; i < p->n_line; i++)
        for (int k = 0; k < p->line[i].n_flux; k++)
            if (p->line[i].flux[k]->term->flags & PF_CONTINUATION)
                p->continuation.use[p->continuation.n_use++] = p->line[i].flux[k];
    ARENA_NEW(&p->memory, all, p->mesh.n_facet + 1, err);
    memset(all, 1, (size_t)p->mesh.n_facet);
    for (int where = PF_CELL; where <= PF_PAIR; where++)
        if (n_on[where]) {
            spec[n++] = (assembly_spec){.where = where,
                                        .use = on[where],
                                        .n_use = n_on[where],
                                        .facet_on = all,
                                        .rule = where == PF_SOLID ? &p->cut : NULL};
            if (where == PF_FLUID) { /* whole cells, and then cut ones */
                spec[n] = spec[n - 1];
                spec[n++].rule = &p->cut;
            }
        }
    for (int i = 0; i < p->n_line; i++)
        if (p->line[i].n_flux)
            spec[n++] = (assembly_spec){.where = PF_FACET,
                                        .use = p->line[i].flux,
                                        .n_use = p->line[i].n_flux,
                                        .facet_on = p->line[i].facet};
    TRY(registry_solver(p->r, "solver_umfpack", &p->solver, err));
    TRY(system_create(&p->system, &p->space, spec, n, p->solver, p->n_thread, err));
    if (p->has_surface)
        p->system.gauge.tolerance = CUT_CLOSURE;
    return 0;
}

int problem_create(problem *p, case_file *c, registry *r, int n_thread, error *err)
{
    double start = solve_seconds();

    memset(p, 0, sizeof *p);
    p->c = c;
    p->r = r;
    p->n_thread = n_thread;
    TRY(problem_read_mesh(p, err));
    if (p->dim == 0)
        p->dim = 2; /* the mesh block is wrong and said so; go on to find what else is */
    TRY(problem_read_terms(p, err));
    TRY(problem_read_boundaries(p, err));
    TRY(problem_read_particles(p, err));
    TRY(problem_read_settings(p, err));
    TRY(case_finish(c, err));
    TRY(problem_make_mesh(p, err));
    TRY(make_periodic(p, err));
    TRY(cell_grid_create(&p->grid, &p->mesh, err));
    p->space.n_particle = p->n_particle;
    TRY(space_number(&p->space, &p->mesh, err));
    ARENA_NEW(&p->memory, p->x, p->space.n_dof, err);
    TRY(problem_make_boundaries(p, err));
    problem_hold_particles(p);
    TRY(problem_make_outputs(p, err));
    if (p->n_particle)
        TRY(problem_make_particles(p, err));
    else
        TRY(space_constrain(&p->space, err));
    TRY(make_system(p, err));
    TRY(problem_cut(p, p->x, err));
    p->setup_seconds = solve_seconds() - start;
    return 0;
}

int problem_initial(problem *p, error *err)
{
    const space *s = &p->space;

    for (int f = 0; f < s->n_field; f++)
        for (int64_t c = 0; p->has_initial[f] && c < s->n_carrier; c++) {
            double x[3] = {0}, v[VALUE_MAX] = {0};

            if (s->first[f][c] < 0 || s->field[f].support == PF_ON_PARTICLE)
                continue;
            if (c < p->mesh.n_node)
                memcpy(x, p->mesh.x + c * p->dim, (size_t)p->dim * sizeof *x);
            TRY(value_at(&p->initial[f], x, p->time.start, v, err));
            memcpy(p->x + s->first[f][c], v, (size_t)s->field[f].n_comp * sizeof *v);
        }
    for (int k = 0; k < p->n_particle; k++) {
        int64_t u = problem_particle_dof(p, k, PF_VECTOR), w = problem_particle_dof(p, k, PF_SPIN);

        if (u >= 0)
            TRY(value_at(&p->particle[k].velocity, (double[3]){0}, p->time.start, p->x + u, err));
        if (w >= 0)
            TRY(value_at(&p->particle[k].spin, (double[3]){0}, p->time.start, p->x + w, err));
    }
    problem_fill(p, p->x);
    return problem_dirichlet(p, p->time.start, p->x, err);
}

void problem_destroy(problem *p)
{
    fluid_destroy(p);
    cut_rule_destroy(&p->cut);
    cell_grid_destroy(&p->grid);
    system_destroy(&p->system);
    arena_free(&p->envelope_memory);
    arena_free(&p->step_memory);
    space_destroy(&p->space);
    mesh_destroy(&p->mesh);
    arena_free(&p->memory);
    memset(p, 0, sizeof *p);
}
