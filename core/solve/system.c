/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The nonlinear system: residual and matrix at a state. */
#include "solve/solve.h"

#include "base/clock.h"

#include <omp.h>
#include <string.h>

_Static_assert(SPACE_MAX_FIELDS <= 32, "newton_system.coupled has a bit per field");

/* Fields that a property depends on: bit f. */
static uint32_t fields_behind(const space *s, const term_use *law, const char *property)
{
    const pf_term *t = law->term;
    const int o = term_publishes(t, property);
    uint32_t fields = 0;

    for (uint32_t k = 0; k < t->n_in; k++)
        if (t->depends && !t->depends[(uint32_t)o * t->n_in + k])
            continue;
        else if (term_is_unknown(&t->in[k]))
            fields |= 1u << space_find_field(s, t->in[k].field);
        else if (law->law[k])
            fields |= fields_behind(s, law->law[k], t->in[k].field);
    return fields;
}

/* Couplings as the terms declare them.  The matrix of one state would not do: a derivative may vanish there. */
static void couple_fields(newton_system *s, const term_use *u)
{
    const pf_term *t = u->term;

    for (uint32_t o = 0; o < t->n_out; o++)
        for (uint32_t k = 0; k < t->n_in; k++) {
            uint32_t *coupled;

            if (!term_slot_field(&t->out[o]) || (t->depends && !t->depends[o * t->n_in + k]))
                continue;
            coupled = &s->coupled[space_find_field(s->space, t->out[o].field)];
            if (term_is_unknown(&t->in[k]))
                *coupled |= 1u << space_find_field(s->space, t->in[k].field);
            else if (u->law[k] && u->where != PF_PAIR)
                *coupled |= fields_behind(s->space, u->law[k], t->in[k].field);
        }
}

int system_create(newton_system *s, space *sp, const assembly_spec *spec, int n_spec, const linear_choice *solvers,
                  int n_thread, error *err)
{
    memset(s, 0, sizeof *s);
    s->space = sp;
    s->last_fall = 1;
    omp_set_num_threads(n_thread); /* of this thread's loops over vectors, which know of no system */
    TRY(assembly_create(&s->assembly, sp, spec, n_spec, n_thread, err));
    TRY(linear_create(&s->linear, solvers, sp, n_thread, err));
    ARENA_NEW(&s->memory, s->residual, sp->n_dof, err);
    ARENA_NEW(&s->memory, s->trial, sp->n_dof, err);
    ARENA_NEW(&s->memory, s->step, sp->n_dof, err);
    ARENA_NEW(&s->memory, s->rhs, sp->n_dof, err);
    ARENA_NEW(&s->memory, s->scale, sp->n_dof, err);
    ARENA_NEW(&s->memory, s->work, sp->n_dof, err);
    for (int k = 0; k < n_spec; k++)
        for (int u = 0; u < spec[k].n_use; u++)
            couple_fields(s, spec[k].use[u]);
    return 0;
}

int system_renew(newton_system *s, error *err)
{
    TRY(space_constrain(s->space, err));
    return linear_renew(&s->linear, err);
}

void system_destroy(newton_system *s)
{
    assembly_destroy(&s->assembly);
    linear_destroy(&s->linear);
    arena_free(&s->memory);
    memset(s, 0, sizeof *s);
}

/* What the assembly is told; s->work is the rate. */
static assembly_state state_of(newton_system *s, const newton_time *time, const double *x)
{
    for (int64_t d = 0; d < s->space->n_dof; d++)
        s->work[d] = time->history ? time->shift * x[d] + time->history[d] : 0;
    return (assembly_state){.t = time->t,
                            .dt = time->dt,
                            .shift = time->shift,
                            .x = x,
                            .dot = s->work,
                            .old = time->old ? time->old : x,
                            .kept = time->kept,
                            .fluid = time->fluid,
                            .bodies = time->bodies,
                            .frame = time->frame,
                            .faded = time->faded,
                            .only = time->only,
                            .power = time->power};
}

int system_evaluate(newton_system *s, const newton_time *time, const double *x, int with_matrix, int diagnose,
                    error *err)
{
    double start = clock_seconds();
    assembly_state st = state_of(s, time, x);
    int status;

    gauge_use(s, time->bodies);
    status = assembly_run(&s->assembly, &st, s->residual, with_matrix ? s->linear.value : NULL, diagnose, err);
    s->evaluations++;
    s->matrices += with_matrix;
    s->assemble_seconds += clock_seconds() - start;
    return status;
}

int system_is_linear(const newton_system *s, const newton_time *time)
{
    int linear = 1;

    for (int k = 0; k < s->assembly.n_class; k++)
        for (int u = 0; u < s->assembly.class_[k].n_use; u++) {
            const plan_use *p = &s->assembly.class_[k].use[u];
            const term_use *use = p->use;

            linear &= ((use->term->flags & PF_LINEAR) && !p->varies) ||
                      ((use->term->flags & PF_CONTINUATION) && time->faded == 1);
        }
    return linear;
}

int system_keep(newton_system *s, const newton_time *time, const double *x, double *kept, error *err)
{
    const assembly_state st = state_of(s, time, x);

    return s->space->kept.n ? assembly_keep(&s->assembly, &st, kept, err) : 0;
}

int newton_residual(newton_system *s, const newton_time *time, const double *x, double *residual, error *err)
{
    TRY(system_evaluate(s, time, x, 0, 0, err));
    memcpy(residual, s->residual, (size_t)s->space->n_dof * sizeof *residual);
    return 0;
}
