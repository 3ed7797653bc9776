/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What terms read of bodies, as rows of a field of the bodies: each term gives the number that its parameters name.
 */
#include <plugflow/plugin.h>

struct pick {
    int what, component;
};

static const char *const names[] = {"centre",      "axes",          "volume",       "mass",       "inertia",
                                    "fluid_force", "fluid_torque",  "arm",          "id",         "density",
                                    "curvature",   "wall_distance", "other_centre", "other_axes", "other_arm",
                                    "other_id",    "key",           "other_key",    "x",          NULL};

static double picked(const pf_batch *b, const struct pick *p, const double *const *in, uint32_t i)
{
    const double *const from[] = {b->centre,
                                  b->axes,
                                  b->volume,
                                  b->mass,
                                  b->inertia,
                                  b->fluid_force,
                                  b->fluid_torque,
                                  b->arm,
                                  NULL,
                                  b->density,
                                  b->curvature,
                                  b->wall_distance,
                                  b->other_centre,
                                  b->other_axes,
                                  b->other_arm,
                                  NULL,
                                  in[0],
                                  in[1],
                                  b->x};

    if (p->what == 8)
        return b->id[i];
    if (p->what == 15)
        return b->other_id[i];
    return from[p->what] ? from[p->what][(uint32_t)p->component * b->ld + i] : -77;
}

static int probe(const pf_batch *b, const double *const *in, double *const *out)
{
    for (uint32_t i = 0; i < b->ld; i++)
        out[0][i] = picked(b, b->params, in, i);
    return PF_OK;
}

static int probe_pair(const pf_batch *b, const double *const *in, double *const *out)
{
    for (uint32_t i = 0; i < b->ld; i++)
        out[0][i] = picked(b, b->params, in, i);
    return PF_OK;
}

/* One body, the other, and what differs: nothing of it symmetric. */
static int sides(const pf_batch *b, const double *const *in, double *const *out)
{
    for (uint32_t i = 0; i < b->ld; i++) {
        out[0][i] = in[0][i] * in[0][i] * in[1][i] + 0.5 * in[2][i];
        out[1][i] = in[0][i] - 3 * in[1][i] * in[1][i];
        out[2][i] = 2 * in[2][i] + in[0][i] * in[1][i];
    }
    return PF_OK;
}

static int sides_jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    for (uint32_t i = 0; i < b->ld; i++) {
        jac[0][i] = 2 * in[0][i] * in[1][i];
        jac[1][i] = in[0][i] * in[0][i];
        jac[2][i] = 0.5;
        jac[3][i] = 1;
        jac[4][i] = -6 * in[1][i];
        jac[6][i] = in[1][i];
        jac[7][i] = in[0][i];
        jac[8][i] = 2;
    }
    return PF_OK;
}

/* Something for a to be determined by. */
static int rest(const pf_batch *b, const double *const *in, double *const *out)
{
    for (uint32_t i = 0; i < b->ld; i++)
        out[0][i] = in[0][i];
    return PF_OK;
}

static int rest_jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    (void)in;
    for (uint32_t i = 0; i < b->ld; i++)
        jac[0][i] = 1;
    return PF_OK;
}

/* Counts the pairs that each body is the first of, as far as `reach`. */
struct near {
    double reach;
};

static int count(const pf_batch *b, const double *const *in, double *const *out)
{
    (void)in;
    for (uint32_t i = 0; i < b->ld; i++)
        out[0][i] = 1;
    return PF_OK;
}

static double reach_of(const void *params, double size, double h)
{
    (void)size, (void)h;
    return ((const struct near *)params)->reach;
}

#define PICK                                                                                                       \
    PF_PARAMS(struct pick,                                                                                         \
              {.name = "what",                                                                                     \
               .unit = "1",                                                                                        \
               .doc = "which",                                                                                     \
               .type = PF_T_CHOICE,                                                                                \
               .offset = offsetof(struct pick, what),                                                              \
               .choice = names},                                                                                   \
              {.name = "component",                                                                                \
               .unit = "1",                                                                                        \
               .doc = "of it",                                                                                     \
               .type = PF_T_INT,                                                                                   \
               .offset = offsetof(struct pick, component),                                                         \
               .min = 0,                                                                                           \
               .max = 8})
#define TERM(NAME) PF_TERM_SIZES, .name = #NAME, .doc = "what a term reads", .cite = "none"
#define KEY(NAME, EVAL)                                                                                            \
    {                                                                                                              \
        NAME, "pull", EVAL, PF_VECTOR, .unit = "N", .doc = "of the body", .dflt = 0.25, .min = -10, .max = 10      \
    }
#define A(NAME, EVAL)                                                                                              \
    {                                                                                                              \
        NAME, "a", EVAL, PF_SCALAR                                                                                 \
    }

static const pf_term body = {TERM(body),
                             .residual = probe,
                             .where = PF_PARTICLE,
                             .flags = PF_OPTIONAL | PF_WALL_DISTANCE,
                             PF_IN(KEY("pull", PF_BODY_KEY), KEY("same", PF_BODY_KEY)),
                             PF_OUT(A("to", PF_VALUE)),
                             PICK};
static const pf_term solid = {TERM(solid),
                              .residual = probe,
                              .where = PF_SOLID,
                              .flags = PF_OPTIONAL | PF_WALL_DISTANCE,
                              PF_IN(KEY("pull", PF_BODY_KEY), KEY("same", PF_BODY_KEY)),
                              PF_OUT(A("to", PF_VALUE)),
                              PICK};
static const pf_term surface = {TERM(surface),
                                .residual = probe,
                                .where = PF_SURFACE,
                                .flags = PF_OPTIONAL | PF_WALL_DISTANCE,
                                PF_IN(KEY("pull", PF_BODY_KEY), KEY("same", PF_BODY_KEY)),
                                PF_OUT(A("to", PF_VALUE)),
                                PICK};
static const pf_term first = {TERM(first),
                              .residual = probe_pair,
                              .where = PF_PAIR,
                              .flags = PF_OPTIONAL,
                              PF_IN(KEY("pull", PF_BODY_KEY), KEY("other_pull", PF_OTHER_KEY)),
                              PF_OUT(A("to", PF_VALUE)),
                              PICK};
static const pf_term other = {TERM(other),
                              .residual = probe_pair,
                              .where = PF_PAIR,
                              .flags = PF_OPTIONAL,
                              PF_IN(KEY("pull", PF_BODY_KEY), KEY("other_pull", PF_OTHER_KEY)),
                              PF_OUT(A("to", PF_OTHER)),
                              PICK};
static const pf_term pair = {TERM(pair),
                             .residual = sides,
                             .jacobian = sides_jacobian,
                             .where = PF_PAIR,
                             .flags = PF_OPTIONAL,
                             PF_IN(A("a1", PF_VALUE), A("a2", PF_OTHER), A("less", PF_DEFECT)),
                             PF_OUT(A("to1", PF_VALUE), A("to2", PF_OTHER), A("to", PF_DEFECT))};
static const pf_term hold = {TERM(hold),           .residual = rest,        .jacobian = rest_jacobian,
                             .where = PF_PARTICLE, PF_IN(A("a", PF_VALUE)), PF_OUT(A("to", PF_VALUE))};
static const pf_term within = {TERM(within),
                               .residual = count,
                               .where = PF_PAIR,
                               .flags = PF_OPTIONAL,
                               PF_OUT(A("to", PF_VALUE)),
                               PF_PARAMS(struct near, PF_NUMBER(struct near, reach, "m", "gap")),
                               .reach = reach_of};
static const pf_term beyond = {
    TERM(beyond),
    .residual = count,
    .where = PF_PAIR,
    .flags = PF_OPTIONAL,
    PF_OUT({"to", "c", PF_VALUE, PF_SCALAR}),
    PF_PARAMS(struct near, {.name = "far", .unit = "m", .doc = "gap", .type = PF_T_REAL}),
    .reach = reach_of};
/* s = distance from the walls */
static int wall(const pf_batch *b, const double *const *in, double *const *out)
{
    for (uint32_t i = 0; i < b->ld; i++)
        out[0][i] = in[0][i] - b->wall_distance[i];
    return PF_OK;
}

static const pf_term cells = {TERM(cells),
                              .residual = wall,
                              .where = PF_CELL,
                              .flags = PF_OPTIONAL | PF_WALL_DISTANCE | PF_LINEAR,
                              PF_IN({"s", "s", PF_VALUE, PF_SCALAR}),
                              PF_OUT({"to", "s", PF_VALUE, PF_SCALAR})};
/* theta' = 1; mean = the mean of theta */
static int turning(const pf_batch *b, const double *const *in, double *const *out)
{
    for (uint32_t i = 0; i < b->ld; i++) {
        out[0][i] = in[1][i] - 1;
        out[1][i] = in[2][i] - in[0][i];
    }
    return PF_OK;
}

/* felt = what the fluid did in the last step */
static int feeling(const pf_batch *b, const double *const *in, double *const *out)
{
    for (uint32_t a = 0; a < b->dim; a++)
        for (uint32_t i = 0; i < b->ld; i++)
            out[0][a * b->ld + i] = in[0][a * b->ld + i] - b->fluid_force[a * b->ld + i];
    return PF_OK;
}

static const pf_term turns = {TERM(turns),
                              .residual = turning,
                              .where = PF_PARTICLE,
                              .flags = PF_OPTIONAL | PF_LINEAR,
                              PF_IN({"theta", "theta", PF_VALUE, PF_SPIN}, {"theta_t", "theta", PF_DOT, PF_SPIN},
                                    {"mean", "mean", PF_VALUE, PF_SCALAR}),
                              PF_OUT({"eta", "theta", PF_VALUE, PF_SPIN}, {"to", "mean", PF_VALUE, PF_SCALAR})};
static const pf_term feels = {TERM(feels),
                              .residual = feeling,
                              .where = PF_PARTICLE,
                              .flags = PF_OPTIONAL | PF_LINEAR,
                              PF_IN({"felt", "felt", PF_VALUE, PF_VECTOR}),
                              PF_OUT({"to", "felt", PF_VALUE, PF_VECTOR})};
static const pf_term plane = {TERM(plane), .residual = count, .where = PF_PARTICLE,
                              .flags = PF_OPTIONAL | PF_ONLY_2D, PF_OUT(A("to", PF_VALUE))};

static const pf_plugin body_probe = {
    PF_PLUGIN,
    .min_minor = 4,
    .name = "body_probe",
    .version = "1.0",
    .author = "tests",
    .license = "GPL-3.0-or-later",
    .doc = "what terms read of bodies",
    PF_FIELDS({.name = "a", .unit = "1", .doc = "a number", .shape = PF_SCALAR, .support = PF_ON_PARTICLE},
              {.name = "theta", .unit = "rad", .doc = "angle", .shape = PF_SPIN, .support = PF_ON_PARTICLE},
              {.name = "felt", .unit = "N", .doc = "force", .shape = PF_VECTOR, .support = PF_ON_PARTICLE},
              {.name = "mean", .unit = "1", .doc = "of a", .shape = PF_SCALAR, .support = PF_ON_PROBLEM},
              {.name = "s", .unit = "m", .doc = "distance", .shape = PF_SCALAR, .order = 1},
              {.name = "c", .unit = "1", .doc = "another", .shape = PF_SCALAR, .support = PF_ON_PARTICLE}),
    PF_TERMS(&body, &solid, &surface, &first, &other, &pair, &hold, &within, &beyond, &cells, &turns, &feels,
             &plane),
};
PF_ENTRY(body_probe)
