/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Where the kinetic energy of a run comes from and where it goes, and how large its cells are for the flow.
 *
 *     kinetic(end) - kinetic(start) = in - sum of the terms' work - carried out + made by the scheme
 *
 * At the solution of a step the powers of all terms add up to that of the reactions (solve/power_meter.h).  What
 * this leaves out is made, or lost, by the discretisation: the change of kinetic energy less the work of du/dt (the
 * time scheme's), and what leaves through the boundary less the work of convection (1/2 rho |u|^2 div u, which
 * vanishes for the flow but not for its approximation).  Where the domain of the fluid moves with bodies,
 * what their surfaces sweep is a part of both, once with each sign. */
#include "run/run.h"

#include "solve/power_meter.h"
#include "solve/vector.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Energy that convection may make: parts of the largest kinetic energy and of what was dissipated. */
#define MOST_MADE          1e-3
#define MOST_OF_DISSIPATED 0.05

struct flow_energy {
    power_meter meter;
    int known;                 /* the kinetic energy and its balance can be had       */
    int carries;               /* some term is convective                              */
    int field;                 /* the velocity, or -1                                  */
    double density, viscosity; /* 0: there is none                        */
    double start, now, largest;
    double (*work)[POWERS];    /* of the meter, up to the last step of the run */
    double reynolds, at[3], t; /* largest cell Reynolds number, where, when */
    int warned;
};

/* What the meter's readings add up to. */
typedef struct energy_sums {
    double in, out, dissipated;
    double by_time, by_convection; /* made by the scheme */
} energy_sums;

enum role { ROLE_NONE, ROLE_INERTIA, ROLE_CONVECTION, ROLE_GIVEN, ROLE_OTHER };

/* What a term is in the balance. */
static enum role role_of(const struct flow_energy *e, const space *s, const term_use *u)
{
    const pf_term *t = u->term;
    int rows = 0, unknowns = 0;

    for (uint32_t o = 0; o < t->n_out; o++)
        rows |= term_slot_field(&t->out[o]) && (e->meter.now.fields >> space_find_field(s, t->out[o].field) & 1);
    for (uint32_t k = 0; k < t->n_in; k++)
        unknowns |= term_is_unknown(&t->in[k]);
    if (!rows)
        return ROLE_NONE;
    if (term_stores(t, NULL))
        return ROLE_INERTIA;
    if (e->field >= 0 && problem_carries(u, s->field[e->field].name))
        return ROLE_CONVECTION;
    return unknowns ? ROLE_OTHER : ROLE_GIVEN;
}

/* Of the steps so far. */
static energy_sums add_up(const run *r)
{
    const struct flow_energy *e = r->energy;
    const assembly *a = &r->p->system.assembly;
    const double *meter = e->work[a->n_use], density = e->carries ? e->density : 0;
    energy_sums b = {.in = meter[METER_PRESCRIBED], .out = density * meter[METER_CARRIED]};
    double inertia = density * meter[METER_SWEPT], convection = -b.out - inertia;

    for (int i = 0; i < a->n_use; i++)
        switch (role_of(e, &r->p->space, a->use[i])) {
        case ROLE_INERTIA: /* without the rates its weight is left */
            inertia += e->work[i][POWER_ALL] - e->work[i][POWER_REST];
            b.in -= e->work[i][POWER_REST];
            break;
        case ROLE_CONVECTION:
            convection += e->work[i][POWER_ALL];
            break;
        case ROLE_GIVEN:
            b.in -= e->work[i][POWER_ALL];
            break;
        case ROLE_OTHER:
            b.dissipated += e->work[i][POWER_ALL];
            break;
        default:
            break;
        }
    b.by_time = e->now - e->start - inertia;
    b.by_convection = -convection;
    return b;
}

static double made(const energy_sums *b)
{
    return b->by_time + b->by_convection;
}

static double kinetic(const run *r)
{
    double sum = 0;

    for (int i = 0; i < r->p->system.assembly.n_use; i++)
        sum += r->energy->meter.now.use[i][POWER_KINETIC];
    return sum;
}

/* The kinetic energy of the state now, by the terms with inertia.  It is no part of the solution: terms that fail
 * there leave it unknown, and it does not count as an evaluation of the solver. */
static int take_kinetic(run *r, error *err)
{
    problem *p = r->p;
    newton_time at = {.t = p->state.t,
                      .kept = p->state.kept,
                      .fluid = (const double(*)[6])p->state.fluid,
                      .bodies = problem_points(p),
                      .only = ASSEMBLE_INERTIA,
                      .power = power_meter_ask(&r->energy->meter)};
    int status = newton_residual(&p->system, &at, p->state.x, p->system.trial, err);

    p->system.evaluations--;
    if (status == ERR_MEMORY || status > ERR_SIGNAL)
        return status;
    r->energy->now = status ? NAN : kinetic(r);
    return 0;
}

int energy_open(run *r, error *err)
{
    problem *p = r->p;
    struct flow_energy *e;

    ARENA_NEW(&r->memory, e, 1, err);
    r->energy = e;
    e->field = -1;
    TRY(power_meter_create(&e->meter, &p->system.assembly, err));
    ARENA_NEW(&r->memory, e->work, e->meter.n_use + 1, err);
    for (int f = 0; f < p->space.n_field && e->field < 0; f++)
        if (e->meter.now.fields >> f & 1 && p->space.field[f].support == PF_ON_MESH)
            e->field = f;
    if (e->field < 0)
        return 0;
    problem_numbers(&p->description, p->space.field[e->field].name, &e->density, &e->viscosity);
    for (int i = 0; i < p->system.assembly.n_use; i++)
        e->carries |= role_of(e, &p->space, p->system.assembly.use[i]) == ROLE_CONVECTION;
    if (!p->description.time.unsteady)
        return 0;
    TRY(take_kinetic(r, err));
    e->start = e->largest = e->now;
    e->known = isfinite(e->start) && (!e->carries || e->density > 0);
    r->stepper->meter = e->known ? &e->meter : NULL;
    return 0;
}

void energy_close(run *r)
{
    if (r->energy)
        power_meter_destroy(&r->energy->meter);
}

/* Largest speed at the nodes of a cell that lie in the fluid. */
static double speed_in(const run *r, int64_t cell, double *x)
{
    const problem *p = r->p;
    const mesh *m = &p->mesh;
    const placement *now = p->bodies.now;
    double most = 0;

    for (int i = 0; i < m->type->n_node; i++) {
        int32_t node = m->cell[cell * m->type->n_node + i];
        const double *u = r->x + p->space.first[r->energy->field][node];
        double square = 0, at[3] = {0};

        for (int k = 0; k < m->dim; k++)
            square += u[k] * u[k];
        if (square <= most)
            continue;
        memcpy(at, m->x + (int64_t)node * m->dim, (size_t)m->dim * sizeof *at);
        if (now && now->cover[cell] && bodies_at(&p->bodies, now, cell, at, NULL) >= 0)
            continue;
        most = square;
        memcpy(x, at, sizeof at);
    }
    return sqrt(most);
}

/* The largest cell Reynolds number so far, rho |u| h / mu. */
static void take_reynolds(run *r)
{
    const problem *p = r->p;
    struct flow_energy *e = r->energy;

    for (int64_t c = 0; c < p->mesh.n_cell && e->density > 0 && e->viscosity > 0; c++) {
        double x[3] = {0}, re;

        if (p->bodies.now && p->bodies.now->cover[c] > COVER_PART)
            continue;
        re = e->density * speed_in(r, c, x) * p->mesh.h[c] / e->viscosity;
        if (re <= e->reynolds)
            continue;
        e->reynolds = re;
        e->t = p->state.t;
        memcpy(e->at, x, sizeof x);
    }
}

/* A warning, once, if convection has made more energy than one may pass over. */
static void warn_made(run *r)
{
    struct flow_energy *e = r->energy;
    energy_sums b = add_up(r);

    if (e->warned ||
        !(b.by_convection > MOST_MADE * e->largest && b.by_convection > MOST_OF_DISSIPATED * b.dissipated))
        return;
    e->warned = 1;
    warning_add(
        &r->p->warnings,
        "t = %.6g: the mesh does not resolve this flow: its convection has made %.3g J of kinetic energy out of "
        "nothing (%.2g %% of the largest there was; dissipated were %.3g J); the largest cell Reynolds number is "
        "%.3g, at %s.  Refine the mesh there, or switch on a term that stabilises convection (docs/cases.md)",
        r->p->state.t, b.by_convection, 100 * b.by_convection / e->largest, b.dissipated, e->reynolds,
        text_point(e->at, r->p->mesh.dim).s);
}

int energy_step(run *r, error *err)
{
    struct flow_energy *e = r->energy;

    if (e->field < 0)
        return 0;
    take_reynolds(r);
    if (!e->known)
        return 0;
    e->now = kinetic(r);
    memcpy(e->work, e->meter.work, (size_t)(e->meter.n_use + 1) * sizeof *e->work);
    if (r->p->state.n_history == 1 &&
        r->stepper->order == 2) /* that step's solution is extrapolated from the one read */
        TRY(take_kinetic(r, err));
    e->largest = fmax(e->largest, e->now);
    warn_made(r);
    return 0;
}

void energy_log(const run *r, text *s)
{
    const struct flow_energy *e = r->energy;

    if (e->known) {
        energy_sums b = add_up(r);

        text_add(s, ", \"energy\": ");
        text_number(s, e->now);
        text_add(s, ", \"energy_made\": ");
        text_number(s, made(&b));
    }
    if (e->reynolds > 0) {
        text_add(s, ", \"largest_cell_reynolds\": ");
        text_number(s, e->reynolds);
    }
}

static void member(text *t, const char *name, double v)
{
    text_add(t, "\"%s\": ", name);
    text_number(t, v);
}

/* Work of the terms that dissipate (or drive, with the other sign), those of one name together. */
static void add_terms(const run *r, text *t)
{
    const assembly *a = &r->p->system.assembly;
    int n = 0;

    for (int i = 0; i < a->n_use; i++) {
        double sum = 0;
        int first = i;

        if (role_of(r->energy, &r->p->space, a->use[i]) != ROLE_OTHER)
            continue;
        for (int k = a->n_use - 1; k >= 0; k--)
            if (a->use[k]->term == a->use[i]->term) {
                sum += r->energy->work[k][POWER_ALL];
                first = k;
            }
        if (first != i)
            continue;
        text_add(t, "%s\"%s.%s\": ", n++ ? ", " : "", a->use[i]->plugin->d.name, a->use[i]->term->name);
        text_number(t, sum);
    }
}

void energy_summary(const run *r, text *t)
{
    const struct flow_energy *e = r->energy;
    energy_sums b;

    if (!e)
        return;
    if (e->reynolds > 0) {
        text_add(t, ",\n  \"resolution\": {");
        member(t, "largest_cell_reynolds", e->reynolds);
        text_add(t, ", \"at\": [");
        for (int k = 0; k < r->p->mesh.dim; k++) {
            text_add(t, k ? ", " : "");
            text_number(t, e->at[k]);
        }
        text_add(t, "], ");
        member(t, "t", e->t);
        text_add(t, "}");
    }
    if (!e->known)
        return;
    b = add_up(r);
    text_add(t, ",\n  \"energy\": {");
    member(t, "kinetic_start", e->start);
    text_add(t, ", ");
    member(t, "kinetic_end", e->now);
    text_add(t, ", ");
    member(t, "kinetic_largest", e->largest);
    text_add(t, ", ");
    member(t, "in", b.in);
    text_add(t, ", \"terms\": {");
    add_terms(r, t);
    text_add(t, "}, ");
    member(t, "convected_out", b.out);
    text_add(t, ", ");
    member(t, "made_by_scheme", made(&b));
    text_add(t, ", ");
    member(t, "made_by_time", b.by_time);
    text_add(t, ", ");
    member(t, "made_by_convection", b.by_convection);
    text_add(t, ", ");
    member(t, "made_relative", e->largest > 0 ? made(&b) / e->largest : 0);
    text_add(t, "}");
}

void energy_say(const run *r)
{
    const struct flow_energy *e = r->energy;
    energy_sums b = add_up(r);
    text t = {0};

    if (e->known)
        text_add(&t,
                 "  kinetic energy %.4g J at the start, %.4g at the end: %.4g put in, %.4g %s, %.4g carried out, "
                 "%.2g made by the scheme (%.2g %% of the largest)%s",
                 e->start, e->now, b.in, fabs(b.dissipated), b.dissipated < 0 ? "given by the terms" : "dissipated",
                 b.out, made(&b), e->largest > 0 ? 100 * made(&b) / e->largest : 0, e->reynolds > 0 ? "; " : "");
    if (e->reynolds > 0)
        text_add(&t, "%slargest cell Reynolds number %.3g at %s", e->known ? "" : "  ", e->reynolds,
                 text_point(e->at, r->p->mesh.dim).s);
    if (e->reynolds > 0 && r->p->description.time.unsteady)
        text_add(&t, ", t = %.6g", e->t);
    if (t.s && !t.failed && r->talk && r->talk->say)
        r->talk->say(r->talk->ctx, t.s);
    text_free(&t);
}
