/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Bodies and the terms of their formulation.  From what terms say: bodies that no term couples with the flow,
 * bodies that no term moves, terms on bodies without bodies.  Of the formulations that particulate writes also
 * which terms belong together, since one that is left out leaves a solution that looks right. */
#include "describe/describe.h"

#include <stdio.h>
#include <string.h>

enum { MOST_TERMS = 8 };

/* A term of a formulation, and the field to whose equation another plugin's term may add the same (NULL: none). */
typedef struct part {
    const char *term, *field;
} part;

/* The lines that particulate NAME stands for.  mark: the plugin that tells a formulation from the others. */
typedef struct formulation {
    const char *name, *mark;
    part needs[MOST_TERMS];
    const char * not [MOST_TERMS];
} formulation;

static const formulation formulations[] = {
    {"sharp",
     "surface",
     {{"surface.nitsche", NULL},
      {"surface.extension", NULL},
      {"rigid_body.translation", "U"},
      {"rigid_body.rotation", "omega"},
      {"rigid_body.buoyancy", "U"}},
     {"rigid_body.displaced", "continuity.pressure_smoothing"}},
    {"conservative",
     "multiplier",
     {{"multiplier.force", NULL},
      {"multiplier.rigid_motion", NULL},
      {"multiplier.reaction", NULL},
      {"rigid_body.translation", "U"},
      {"rigid_body.rotation", "omega"},
      {"rigid_body.displaced", "U"},
      {"continuity.pressure_smoothing", "p"}},
     {"rigid_body.buoyancy"}},
    {"appendix",
     "appendix",
     {{"appendix.force", NULL},
      {"appendix.fluid_zero", NULL},
      {"appendix.rigid_motion", NULL},
      {"appendix.translation", NULL},
      {"appendix.reaction", NULL},
      {"appendix.mean_curl", NULL}},
     {"rigid_body.translation", "rigid_body.rotation", "rigid_body.displaced", "rigid_body.buoyancy"}},
};

static int is_bundled(const char *plugin)
{
    static const char *const name[] = {"continuity", "momentum", "multiplier", "rigid_body",
                                       "surface",    "appendix", "contact"};

    for (size_t i = 0; i < sizeof name / sizeof *name; i++)
        if (strcmp(name[i], plugin) == 0)
            return 1;
    return 0;
}

static int is_body_term(const term_use *u)
{
    return u->where == PF_SOLID || u->where == PF_SURFACE || u->where == PF_CUT || u->where == PF_PARTICLE ||
           u->where == PF_PAIR;
}

/* Position of plugin.term among the terms that are on, or -1. */
static int find_use(const description *d, const char *full)
{
    char name[128];

    for (int i = 0; i < d->n_use; i++) {
        snprintf(name, sizeof name, "%s.%s", d->use[i].plugin->d.name, d->use[i].term->name);
        if (strcmp(name, full) == 0)
            return i;
    }
    return -1;
}

/* Position of the first term of a plugin, or -1. */
static int find_plugin(const description *d, const char *plugin)
{
    for (int i = 0; i < d->n_use; i++)
        if (strcmp(d->use[i].plugin->d.name, plugin) == 0)
            return i;
    return -1;
}

static int writes(const term_use *u, const char *field)
{
    for (uint32_t o = 0; o < u->term->n_out; o++)
        if (strcmp(u->term->out[o].field, field) == 0)
            return 1;
    return 0;
}

/* Whether a plugin of someone else adds to this field's equation in bodies. */
static int has_other(const description *d, const char *field)
{
    for (int i = 0; field && i < d->n_use; i++)
        if (is_body_term(&d->use[i]) && !is_bundled(d->use[i].plugin->d.name) && writes(&d->use[i], field))
            return 1;
    return 0;
}

/* Terms that a formulation lacks, and those that another one has. */
static void check_parts(const description *d, const formulation *f)
{
    int mark = find_plugin(d, f->mark);
    text lines = {0};

    for (int i = 0; i < MOST_TERMS && f->needs[i].term; i++)
        if (find_use(d, f->needs[i].term) < 0 && !has_other(d, f->needs[i].field))
            text_add(&lines, "%sterm \"%s\" {}", lines.n ? " and " : "", f->needs[i].term);
    if (lines.n)
        case_wrong(
            d->c, d->use_block[mark], NULL,
            "term \"%s\" belongs to the formulation \"%s\" of bodies, which needs more: add %s (particulate \"%s\" "
            "after fluid{} writes all its lines)",
            f->mark, f->name, lines.s, f->name);
    text_free(&lines);
    for (int i = 0; i < MOST_TERMS && f->not [i]; i++) {
        int k = find_use(d, f->not [i]);

        if (k >= 0)
            case_wrong(d->c, d->use_block[k], NULL,
                       "%s must be off with term \"%s\": the formulation \"%s\" accounts for it in another way "
                       "(particulate \"%s\" writes all its lines)",
                       f->not [i], f -> mark, f -> name, f -> name);
    }
}

/* 1 if the terms make up one formulation, or none of those that are known. */
static int check_formulations(const description *d)
{
    const int before = d->c->n_wrong;
    const formulation *first = NULL;

    for (size_t i = 0; i < sizeof formulations / sizeof *formulations; i++) {
        const formulation *f = &formulations[i];
        int mark = find_plugin(d, f->mark);

        if (mark >= 0 && first) {
            case_wrong(d->c, d->use_block[mark], NULL,
                       "term \"%s\" (formulation \"%s\") beside term \"%s\" (\"%s\"): a case has one formulation "
                       "of bodies",
                       f->mark, f->name, first->mark, first->name);
            return 0;
        }
        first = mark >= 0 ? f : first;
    }
    if (first)
        check_parts(d, first);
    return d->c->n_wrong == before;
}

/* rigid_body gives bodies their weight less that of the fluid, so the fluid's own weight must be in p. */
static void check_pressure(const description *d)
{
    static const char *const weight[] = {"rigid_body.buoyancy", "rigid_body.displaced"};
    int k = find_use(d, "momentum.body_force");
    const pf_param *reduced = k >= 0 ? describe_param(&d->use[k], "reduced_pressure") : NULL,
                   *gravity = k >= 0 ? describe_param(&d->use[k], "gravity") : NULL;
    const char *params = k >= 0 ? d->use[k].params : NULL;
    double g[3];
    int on;

    if (!reduced || !gravity)
        return;
    memcpy(&on, params + reduced->offset, sizeof on);
    memcpy(g, params + gravity->offset, sizeof g);
    for (size_t i = 0; !on && (g[0] != 0 || g[1] != 0 || g[2] != 0) && i < sizeof weight / sizeof *weight; i++)
        if (find_use(d, weight[i]) >= 0) {
            case_wrong(
                d->c, case_find(d->c, "fluid", 0), NULL,
                "fluid: %s adds the buoyancy of bodies, which gravity in momentum.body_force gives as well; add "
                "reduced_pressure = true (particulate does), so that p is without its hydrostatic part",
                weight[i]);
            return;
        }
}

/* Repulsion is measured in weights under water, unless its force is given. */
static void check_repulsion(description *d)
{
    const int k = find_use(d, "contact.repulsion");
    const pf_param *gravity = k >= 0 ? describe_param(&d->use[k], "gravity") : NULL,
                   *density = k >= 0 ? describe_param(&d->use[k], "density") : NULL,
                   *force = k >= 0 ? describe_param(&d->use[k], "force") : NULL;
    const char *params = k >= 0 ? d->use[k].params : NULL;
    double g[3], rho, given;
    int weight = 0;

    if (!gravity || !density || !force)
        return;
    memcpy(g, params + gravity->offset, sizeof g);
    memcpy(&rho, params + density->offset, sizeof rho);
    memcpy(&given, params + force->offset, sizeof given);
    for (int i = 0; i < d->n_body; i++)
        weight |= d->body[i].density != rho && (g[0] != 0 || g[1] != 0 || g[2] != 0);
    if (!(given > 0) && !weight && d->n_body)
        describe_warn(
            d, d->use_block[k], NULL,
            "contact.repulsion does nothing: its force is a multiple of the bodies' weight under water, which is "
            "zero here; give it in N, as in term \"contact.repulsion\" { force = 1e-3 }");
}

/* --- from what terms say --- */

/* Ties of cells with little fluid presume that their fields have no equation inside of bodies; a multiplier that
 * they have one. */
static void check_regions(const description *d)
{
    for (int i = 0; i < d->n_use; i++)
        for (int k = 0; k < d->n_use; k++)
            for (int f = 0; f < d->fields.n; f++) {
                const field_spec *g = &d->fields.f[f];
                const term_use *tie = &d->use[i], *cells = &d->use[k];
                const char *held = g->support == PF_IN_PARTICLES ? g->constrains : NULL;

                if (tie->where == PF_CUT && cells->where == PF_CELL && g->support == PF_ON_MESH &&
                    writes(tie, g->name) && writes(cells, g->name)) {
                    case_wrong(
                        d->c, case_find(d->c, "fluid", 0), "region",
                        "%s.%s is for fluid that ends at the bodies' surfaces, but %s.%s acts inside of them, too: "
                        "add region = \"outside\" to fluid{} (particulate \"sharp\" after fluid{} does)",
                        tie->plugin->d.name, tie->term->name, cells->plugin->d.name, cells->term->name);
                    return;
                }
                if (held && cells->where == PF_FLUID && writes(cells, held) && writes(tie, g->name)) {
                    case_wrong(d->c, case_find(d->c, "fluid", 0), "region",
                               "%s.%s holds %s inside of bodies, but %s.%s acts outside of them only: leave %s out",
                               tie->plugin->d.name, tie->term->name, held, cells->plugin->d.name, cells->term->name,
                               cells->term->where == PF_FLUID ? "it" : "region = \"outside\" and over = \"fluid\"");
                    return;
                }
            }
}

/* Terms on bodies, and no bodies. */
static void check_absent(const description *d)
{
    for (int i = 0; i < d->n_use; i++)
        if (is_body_term(&d->use[i])) {
            case_wrong(d->c, d->use_block[i], NULL,
                       "term \"%s\" (or the particulate that writes it) acts on bodies, and the case has none: add "
                       "particle { shape = %s { radius = 0.1 }, density = 1, at = {...} }, or leave this line out",
                       d->use_block[i]->name, d->dim == 2 ? "disk" : "sphere");
            return;
        }
}

/* Whether a term on bodies has a slot of a field of the mesh: a vector, if there are vectors. */
static int is_coupled(const description *d)
{
    int any_vector = 0, any_fluid = 0;

    for (int f = 0; f < d->fields.n; f++)
        any_vector |= d->fields.f[f].support == PF_ON_MESH && d->fields.f[f].shape == PF_VECTOR;
    for (int i = 0; i < d->n_use; i++) {
        const term_use *u = &d->use[i];

        any_fluid |= u->where == PF_FLUID;
        for (uint32_t k = 0; k < u->term->n_in + u->term->n_out; k++) {
            const pf_slot *s = k < u->term->n_in ? &u->term->in[k] : &u->term->out[k - u->term->n_in];
            int f = term_slot_field(s) ? fields_find(&d->fields, s->field) : -1;

            if (f >= 0 && (u->where == PF_SOLID || u->where == PF_SURFACE) &&
                d->fields.f[f].support == PF_ON_MESH && (!any_vector || d->fields.f[f].shape == PF_VECTOR))
                return 1;
        }
    }
    return !any_vector && any_fluid; /* a scalar in the fluid only: bodies are holes in its domain */
}

/* Whether some term gives bodies inertia, and one turns them. */
static int is_moved(const description *d)
{
    int inertia = 0, turns = 0;

    for (int i = 0; i < d->n_use; i++)
        for (uint32_t o = 0; o < d->use[i].term->n_out; o++) {
            const pf_term *t = d->use[i].term;
            int f = fields_find(&d->fields, t->out[o].field);

            if (f < 0 || d->fields.f[f].support != PF_ON_PARTICLE || d->use[i].where == PF_PAIR)
                continue;
            turns |= d->fields.f[f].shape == PF_SPIN;
            for (uint32_t k = 0; k < t->n_in && d->fields.f[f].shape == PF_VECTOR; k++)
                inertia |= t->in[k].eval == PF_DOT && strcmp(t->in[k].field, t->out[o].field) == 0;
        }
    return inertia && turns;
}

/* The history of a field of bodies' own is of fixed places, not of those that bodies carry along. */
static void check_history(const description *d)
{
    const body_spec *moves = NULL;

    for (int i = d->n_body - 1; i >= 0; i--)
        moves = d->body[i].motion != BODY_FIXED ? &d->body[i] : moves;
    for (int i = 0; moves && d->time.unsteady && i < d->n_use; i++)
        for (uint32_t k = 0; d->use[i].where == PF_SOLID && k < d->use[i].term->n_in; k++) {
            const pf_slot *s = &d->use[i].term->in[k];
            const int f = s->eval == PF_DOT ? fields_find(&d->fields, s->field) : -1;

            if (f < 0 || d->fields.f[f].support != PF_IN_PARTICLES || d->fields.f[f].constrains)
                continue;
            case_wrong(d->c, moves->block, "motion",
                       "%s.%s is about what a body keeps (%s), and does not go along with one that moves: motion = "
                       "\"fixed\", or term \"%s\" { without = {\"%s\"} }, if the body keeps next to nothing",
                       d->use[i].plugin->d.name, d->use[i].term->name, d->fields.f[f].doc, d->use[i].plugin->d.name,
                       d->use[i].term->name);
            return;
        }
}

static void check_bodies(const description *d)
{
    const body_spec *first = NULL;

    for (int i = d->n_body - 1; i >= 0; i--)
        first = d->body[i].motion == BODY_FREE ? &d->body[i] : first;
    if (!is_coupled(d))
        case_wrong(
            d->c, d->body[0].block, NULL,
            "%s: no term couples the flow with bodies, which it would not feel: add particulate \"sharp\" after "
            "fluid{}",
            d->body[0].block->kind);
    else if (first && !is_moved(d))
        case_wrong(
            d->c, first->block, NULL,
            "%s: the body is free, but no term says how it moves: add particulate \"sharp\" (or the line term "
            "\"rigid_body\" {}), or motion = \"fixed\"",
            first->block->kind);
}

void describe_check_formulation(description *d)
{
    int any_block = case_find(d->c, "particle", 0) || case_find(d->c, "particles", 0);

    if (d->incomplete)
        return;
    if (!any_block) {
        check_absent(d);
        return;
    }
    if (!check_formulations(d))
        return;
    check_pressure(d);
    check_repulsion(d);
    check_regions(d);
    if (d->n_body) {
        check_bodies(d);
        check_history(d);
    }
}
