/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A plugin built against plugin_1_1.h, the header as it was in version 1.1 of the interface, with what 1.1 added:
 * points of bodies, of pairs and of cut cells.  Neither file is ever changed. */
#include "plugin_1_1.h"

#include <stdio.h>

struct bodies {
    double density, range;
};

static const pf_host *host;

/* lambda . v + (rho_P - rho) U . V + rho (r . r) omega . xi inside of bodies */
#define INSIDE(NAME, T)                                                                                            \
    static int NAME(const pf_batch *b, const T *const *in, T *const *out)                                          \
    {                                                                                                              \
        const struct bodies *m = b->params;                                                                        \
                                                                                                                   \
        if (b->size < sizeof *b || !b->arm || !b->density || !b->id)                                               \
            return host->fail(b, 0, PF_FAIL, "a point of a body in a batch of %u bytes", b->size);                 \
        for (uint32_t a = 0; a < b->dim; a++)                                                                      \
            for (uint32_t i = 0; i < b->ld; i++) {                                                                 \
                out[0][a * b->ld + i] = in[0][a * b->ld + i];                                                      \
                out[1][a * b->ld + i] = (b->density[i] - m->density) * in[1][a * b->ld + i];                       \
            }                                                                                                      \
        for (uint32_t a = 0; a < (b->dim == 2 ? 1 : 3); a++)                                                       \
            for (uint32_t i = 0; i < b->ld; i++) {                                                                 \
                double r2 = 0;                                                                                     \
                                                                                                                   \
                for (uint32_t k = 0; k < b->dim; k++)                                                              \
                    r2 += b->arm[k * b->ld + i] * b->arm[k * b->ld + i];                                           \
                out[2][a * b->ld + i] = m->density * r2 * in[2][a * b->ld + i];                                    \
            }                                                                                                      \
        return PF_OK;                                                                                              \
    }
INSIDE(inside_real, double)
INSIDE(inside_complex, pf_complex)

/* (range - gap) (R_i + R_j) rho_j n . V between two bodies */
static int between_residual(const pf_batch *b, const double *const *in, double *const *out)
{
    const struct bodies *m = b->params;

    (void)in;
    if (!b->gap || !b->normal || !b->size_of || !b->other_size || !b->other_density)
        return host->fail(b, 0, PF_FAIL, "a pair in a batch of %u bytes", b->size);
    for (uint32_t a = 0; a < b->dim; a++)
        for (uint32_t i = 0; i < b->ld; i++)
            out[0][a * b->ld + i] = (m->range - b->gap[i]) * (b->size_of[i] + b->other_size[i]) *
                                    b->other_density[i] * b->normal[a * b->ld + i];
    return PF_OK;
}

/* du . dv / h^2 in cut cells */
static int tied_residual(const pf_batch *b, const double *const *in, double *const *out)
{
    for (uint32_t a = 0; a < b->dim; a++)
        for (uint32_t i = 0; i < b->ld; i++)
            out[0][a * b->ld + i] = in[0][a * b->ld + i] / (b->h[i] * b->h[i]);
    return PF_OK;
}

static const pf_field fields[] = {
    {"u", "m/s", "velocity", PF_VECTOR, 2, PF_ON_MESH, "force", "N", NULL},
    {"lambda", "m/s", "multiplier", PF_VECTOR, 2, PF_IN_PARTICLES, NULL, NULL, "u"},
    {"U", "m/s", "velocity of a particle", PF_VECTOR, 0, PF_ON_PARTICLE, NULL, NULL, "u"},
    {"omega", "rad/s", "angular velocity", PF_SPIN, 0, PF_ON_PARTICLE, NULL, NULL, NULL},
};

static const pf_param params[] = {
    {"density", "kg/m^3", "mass per volume", PF_T_REAL, PF_SHARED, offsetof(struct bodies, density), 1, 0, 9, NULL},
    {"range", "m", "of the force", PF_T_REAL, 0, offsetof(struct bodies, range), 1, 0, 9, NULL},
};

static const pf_slot motion[] = {{"lambda", "lambda", PF_VALUE, PF_VECTOR},
                                 {"U", "U", PF_VALUE, PF_VECTOR},
                                 {"omega", "omega", PF_VALUE, PF_SPIN}};
static const pf_slot of_motion[] = {
    {"v", "u", PF_VALUE, PF_VECTOR}, {"V", "U", PF_VALUE, PF_VECTOR}, {"xi", "omega", PF_VALUE, PF_SPIN}};
static const pf_slot of_pair[] = {{"V", "U", PF_DEFECT, PF_VECTOR}};
static const pf_slot defect[] = {{"du", "u", PF_DEFECT, PF_VECTOR}};

#define TERM(NAME, FLAGS, WHERE, ...)                                                                              \
    static const pf_term NAME = {.size = sizeof(pf_term),                                                          \
                                 .flags = FLAGS,                                                                   \
                                 .where = WHERE,                                                                   \
                                 .n_param = 2,                                                                     \
                                 .slot_size = sizeof(pf_slot),                                                     \
                                 .param_size = sizeof(pf_param),                                                   \
                                 .params_bytes = sizeof(struct bodies),                                            \
                                 .name = #NAME,                                                                    \
                                 .doc = "none",                                                                    \
                                 .cite = "none",                                                                   \
                                 .param = params,                                                                  \
                                 __VA_ARGS__}

TERM(inside, PF_LINEAR | PF_FLUID_FORCE, PF_SOLID, .in = motion, .n_in = 3, .out = of_motion, .n_out = 3,
     .residual = inside_real, .residual_c = inside_complex);
TERM(between, PF_LINEAR, PF_PAIR, .out = of_pair, .n_out = 1, .residual = between_residual);
TERM(tied, PF_LINEAR | PF_OPTIONAL, PF_CUT, .in = defect, .n_in = 1, .out = defect, .n_out = 1,
     .residual = tied_residual);
static const pf_term *const terms[] = {&inside, &between, &tied};

static const pf_plugin second = {
    .size = sizeof(pf_plugin),
    .major = PF_ABI_MAJOR,
    .minor = PF_ABI_MINOR,
    .min_minor = 1,
    .sizes = PF_SIZES,
    .n_term = 3,
    .n_field = 4,
    .field_size = sizeof(pf_field),
    .name = "second",
    .version = "1.1",
    .author = "plugflow",
    .license = "GPL-3.0-or-later",
    .doc = "what version 1.1 of the interface can say beyond 1.0",
    .term = terms,
    .field = fields,
};

PF_EXPORT const pf_plugin *pf_plugin_entry(const pf_host *h, char *err, size_t nerr)
{
    if (h->size < sizeof *h || h->major != 1 || h->minor < 1) {
        snprintf(err, nerr, "a host of %u bytes, interface %u.%u", h->size, h->major, h->minor);
        return NULL;
    }
    host = h;
    return &second;
}
