/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A plugin built against plugin_1_2.h, the header as it was in version 1.2 of the interface, with what 1.2 added:
 * the host in the batch, the reach of terms on pairs, descriptions by macros.  Neither file is ever changed. */
#include "plugin_1_2.h"

struct contact {
    double range, stiffness;
};

/* stiffness grad T . grad s */
#define CONDUCTION(NAME, T)                                                                                        \
    static int NAME(const pf_batch *b, const T *const *in, T *const *out)                                          \
    {                                                                                                              \
        const struct contact *m = b->params;                                                                       \
                                                                                                                   \
        if (b->size < sizeof *b || !b->host || b->host->size < sizeof(pf_host))                                    \
            return PF_FAIL;                                                                                        \
        for (uint32_t i = 0; i < b->dim * b->ld; i++)                                                              \
            out[0][i] = m->stiffness * in[0][i];                                                                   \
        return PF_OK;                                                                                              \
    }
CONDUCTION(conduction_real, double)
CONDUCTION(conduction_complex, pf_complex)

/* stiffness (range - gap) n . V between two bodies */
static int repulsion_residual(const pf_batch *b, const double *const *in, double *const *out)
{
    const struct contact *m = b->params;

    (void)in;
    if (!b->gap || !b->normal)
        return b->host->fail(b, 0, PF_FAIL, "a pair in a batch of %u bytes", b->size);
    for (uint32_t a = 0; a < b->dim; a++)
        for (uint32_t i = 0; i < b->ld; i++)
            out[0][a * b->ld + i] = m->stiffness * (m->range - b->gap[i]) * b->normal[a * b->ld + i];
    return PF_OK;
}

static double repulsion_reach(const void *params, double size, double h)
{
    const struct contact *m = params;

    (void)size, (void)h;
    return m->range;
}

#define PARAMETERS                                                                                                 \
    PF_PARAMS(struct contact, PF_NUMBER(struct contact, range, "m", "of the force", .dflt = 1, PF_NOT_NEGATIVE),   \
              PF_NUMBER(struct contact, stiffness, "N/m", "of the force", .dflt = 2))

static const pf_term conduction = {
    PF_TERM(conduction),
    .where = PF_FLUID,
    .flags = PF_LINEAR,
    .doc = "none",
    .cite = "none",
    PF_IN({"grad_T", "T", PF_GRAD, PF_VECTOR}),
    PF_OUT({"grad_s", "T", PF_GRAD, PF_VECTOR}),
    PARAMETERS,
    PF_EXAMPLES({"one point", 2, NULL, (double[]){3, -1}, (double[]){6, -2}, 1e-15}),
};

static const pf_term repulsion = {
    PF_TERM_SIZES,
    .name = "repulsion",
    .where = PF_PAIR,
    .flags = PF_LINEAR | PF_OPTIONAL,
    .doc = "none",
    .cite = "none",
    PF_OUT({"V", "U", PF_DEFECT, PF_VECTOR}),
    PARAMETERS,
    .residual = repulsion_residual,
    .reach = repulsion_reach,
};

static const pf_plugin third = {
    PF_PLUGIN,
    .min_minor = 2,
    .name = "third",
    .version = "1.2",
    .author = "plugflow",
    .license = "GPL-3.0-or-later",
    .doc = "what version 1.2 of the interface can say beyond 1.1",
    PF_FIELDS({.name = "T", .unit = "K", .doc = "temperature", .shape = PF_SCALAR, .order = 2},
              {.name = "U", .unit = "m/s", .doc = "velocity", .shape = PF_VECTOR, .support = PF_ON_PARTICLE}),
    PF_TERMS(&conduction, &repulsion),
};
PF_ENTRY(third)
