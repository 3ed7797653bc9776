/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * From a case to a system of equations: read everything, complain about everything, then build. */
#include "problem/problem.h"

#include "base/clock.h"

#include <string.h>

static int make_periodic(const description *d, mesh *m, error *err)
{
    for (int i = 0; i < d->n_line; i++) {
        const boundary_line *l = &d->line[i];
        int a = l->periodic[0] ? mesh_find_name(m, l->periodic[0]) : -1;
        int b = l->periodic[1] ? mesh_find_name(m, l->periodic[1]) : -1;
        int status = a >= 0 && b >= 0 ? mesh_make_periodic(m, a, b, err) : 0;

        if (status) {
            error_prefix(err, "%s:%d: ", l->block->file, l->block->line);
            return status;
        }
    }
    return 0;
}

/* Where bodies start can be judged before there is a mesh if it is a plain box: on one cell. */
static int check_places_in_box(const description *d, error *err)
{
    mesh_box box = d->mesh.box;
    mesh m = {0};
    cell_grid grid = {0};
    error ignored;
    int status;

    if (!describe_is_box(d) || d->n_body == 0)
        return 0;
    box.simplex = 0;
    for (int k = 0; k < 3; k++) {
        box.n[k] = 1;
        box.ticks[k] = NULL;
    }
    status = mesh_create_box(&box, &m, err);
    if (!status)
        status = mesh_measure(&m, err);
    if (!status)
        status = cell_grid_create(&grid, &m, err);
    if (!status && !make_periodic(d, &m, &ignored)) /* else the mesh itself will say so */
        status = bodies_check_places(d, &m, &grid, err);
    cell_grid_destroy(&grid);
    mesh_destroy(&m);
    return status;
}

/* What a steady case may be continued in. */
static void plan_continuation(problem *p)
{
    const description *d = &p->description;
    continuation *c = &p->continuation;

    for (int i = 0; i < d->n_use; i++)
        c->fades |= (d->use[i].term->flags & PF_CONTINUATION) && !(d->use[i].term->flags & PF_BY_BOUNDARY);
    for (int i = 0; i < d->n_line; i++)
        for (int k = 0; k < d->line[i].n_flux; k++)
            c->fades |= (d->line[i].flux[k]->term->flags & PF_CONTINUATION) != 0;
    c->n_parameter = d->solve.n_continued;
    for (int i = 0; i < c->n_parameter; i++) {
        c->parameter[i] = d->solve.continued[i];
        c->from[i] = d->solve.from[i];
        c->to[i] = d->solve.to[i];
    }
}

/* Terms by the points that they act on: one class for the cells, one each for what follows the bodies, one
 * for terms on all facets, one for each boundary line with fluxes. */
static int make_system(problem *p, const linear_choice *solvers, error *err)
{
    description *d = &p->description;
    assembly_spec spec[DESCRIBE_MAX_LINES + PF_PAIR + 2] = {{0}};
    term_use *on[PF_PAIR + 1][DESCRIBE_MAX_TERMS];
    uint8_t *all;
    int n = 0, n_on[PF_PAIR + 1] = {0};

    for (int i = 0; i < d->n_use; i++) {
        term_use *u = &d->use[i];
        int where = u->where == PF_FLUID && d->n_body == 0 ? PF_CELL : u->where;

        if (!(u->term->flags & PF_BY_BOUNDARY))
            on[where][n_on[where]++] = u;
    }
    ARENA_NEW(&p->memory, all, p->mesh.n_facet + 1, err);
    memset(all, 1, (size_t)p->mesh.n_facet);
    for (int where = PF_CELL; where <= PF_PAIR; where++)
        if (n_on[where]) {
            spec[n++] = (assembly_spec){.where = where,
                                        .use = on[where],
                                        .n_use = n_on[where],
                                        .facet_on = all,
                                        .rule = where == PF_SOLID ? &p->bodies.cut : NULL};
            if (where == PF_FLUID) { /* whole cells, and then cut ones */
                spec[n] = spec[n - 1];
                spec[n++].rule = &p->bodies.cut;
            }
        }
    for (int i = 0; i < d->n_line; i++)
        if (d->line[i].n_flux)
            spec[n++] = (assembly_spec){.where = PF_FACET,
                                        .use = d->line[i].flux,
                                        .n_use = d->line[i].n_flux,
                                        .facet_on = p->conditions.facet[i]};
    TRY(system_create(&p->system, &p->space, spec, n, solvers, p->n_thread, err));
    p->system.linear.warnings = &p->warnings;
    p->system.assembly.walls = p->bodies.has_walls ? &p->bodies.walls : NULL;
    p->system.gauge.sharp = p->bodies.has_surface;
    return 0;
}

/* Everything on the mesh. */
static int build(problem *p, const linear_choice *solvers, error *err)
{
    description *d = &p->description;

    TRY(space_number(&p->space, &d->fields, &p->mesh, d->n_body, err));
    TRY(kept_create(&p->space.kept, &d->kept, &p->mesh, d->n_body, &p->memory, err));
    TRY(conditions_create(&p->conditions, d, &p->space, &p->warnings, err));
    TRY(problem_check_resolution(p, err));
    TRY(bodies_create(&p->bodies, d, &p->space, &p->grid, &p->conditions, &p->warnings, err));
    TRY(space_constrain(&p->space, err));
    TRY(make_system(p, solvers, err));
    plan_continuation(p);
    p->newton = (newton_options){.tolerance = d->solve.tolerance,
                                 .fall = d->solve.fall,
                                 .max_iterations = d->solve.max_iterations,
                                 .linear_tolerance = d->solve.linear_tolerance};
    return state_create(&p->state, p->space.n_dof, d->n_body, p->space.kept.n_value, err);
}

int problem_create(problem *p, case_file *c, registry *r, int n_thread, error *err)
{
    description *d = &p->description;
    linear_choice solvers = {0};
    double start = clock_seconds();

    memset(p, 0, sizeof *p);
    p->n_thread = n_thread;
    TRY(describe(d, c, r, &p->warnings, err));
    TRY(check_places_in_box(d, err));
    TRY(case_finish(c, err));
    TRY(problem_make_mesh(d, r, &p->mesh, err));
    p->mesh_seconds = clock_seconds() - start;
    TRY(describe_check(d, &p->mesh, err));
    TRY(make_periodic(d, &p->mesh, err));
    TRY(cell_grid_create(&p->grid, &p->mesh, err));
    if (!describe_is_box(d)) {
        TRY(bodies_check_places(d, &p->mesh, &p->grid, err));
        TRY(case_finish(c, err));
    }
    solvers = (linear_choice){.each_step = describe_moves(d), .params = d->solve.solver_params};
    TRY(linear_find(&solvers, r, d->solve.solver, err));
    TRY(build(p, &solvers, err));
    p->setup_seconds = clock_seconds() - start;
    return 0;
}

int problem_create_coarse(problem *p, const problem *fine, error *err)
{
    memset(p, 0, sizeof *p);
    p->n_thread = fine->n_thread;
    p->description = fine->description;
    p->description.memory = (arena){0};
    p->description.n_started = 0;
    TRY(problem_halve(&p->description.mesh.box, &p->memory, err));
    TRY(problem_make_mesh(&p->description, NULL, &p->mesh, err));
    TRY(make_periodic(&p->description, &p->mesh, err));
    TRY(cell_grid_create(&p->grid, &p->mesh, err));
    return build(p, &fine->system.linear.choice, err);
}

const body_points *problem_points(const problem *p)
{
    return p->bodies.now ? &p->bodies.now->points : NULL;
}

int problem_initial(problem *p, error *err)
{
    const description *d = &p->description;
    const space *s = &p->space;
    double t = d->time.start, *to = p->state.x;

    p->state.t = p->state.written = t;
    for (int f = 0; f < s->n_field; f++)
        for (int64_t c = 0; d->has_initial[f] && c < s->n_carrier; c++) {
            double x[3] = {0}, v[VALUE_MAX] = {0};

            if (s->first[f][c] < 0 || s->field[f].support == PF_ON_PARTICLE)
                continue;
            space_place(s, c, x);
            TRY(value_at(&d->initial[f], x, t, v, err));
            memcpy(to + s->first[f][c], v, (size_t)s->field[f].n_comp * sizeof *v);
        }
    for (int k = 0; k < d->n_body; k++)
        p->state.pose[k] = p->state.pose_before[k] = p->state.pose_before2[k] = d->body[k].start;
    TRY(kept_start(&s->kept, d->kept_initial, d->has_kept, p->state.pose, t, p->state.kept, err));
    if (d->n_body) {
        TRY(bodies_start(&p->bodies, t, to, err));
        TRY(bodies_fill(&p->bodies, p->bodies.now, to, err));
    }
    TRY(stepper_prescribe(&p->conditions, &p->bodies, t, to, err));
    if (d->n_body)
        bodies_clear(&p->bodies, p->bodies.now, to);
    return 0;
}

void problem_destroy(problem *p)
{
    state_destroy(&p->state);
    system_destroy(&p->system);
    bodies_destroy(&p->bodies);
    conditions_destroy(&p->conditions);
    space_destroy(&p->space);
    cell_grid_destroy(&p->grid);
    mesh_destroy(&p->mesh);
    describe_destroy(&p->description);
    warning_free(&p->warnings);
    arena_free(&p->memory);
    memset(p, 0, sizeof *p);
}
