/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A plugin built against plugin_1_3.h, the header as it was in version 1.3 of the interface, with what 1.3 added: the
 * Laplacian of a field and the metric of the element.  Neither file is ever changed. */
#include "plugin_1_3.h"

struct layer {
    double diffusivity;
};

/* (tr G) (T - k lap T) s */
#define LEVELS(NAME, T)                                                                                            \
    static int NAME(const pf_batch *b, const T *const *in, T *const *out)                                          \
    {                                                                                                              \
        const struct layer *p = b->params;                                                                         \
                                                                                                                   \
        if (b->size < sizeof *b || !b->metric)                                                                     \
            return PF_FAIL;                                                                                        \
        for (uint32_t i = 0; i < b->ld; i++) {                                                                     \
            double trace = 0;                                                                                      \
                                                                                                                   \
            for (uint32_t k = 0; k < b->dim; k++)                                                                  \
                trace += b->metric[(k * b->dim + k) * b->ld + i];                                                  \
            out[0][i] = trace * (in[0][i] - p->diffusivity * in[1][i]);                                            \
        }                                                                                                          \
        return PF_OK;                                                                                              \
    }
LEVELS(levels_real, double)
LEVELS(levels_complex, pf_complex)

/* With the metric (4 1; 1 2) and k = 2: 6 (7 - 2 * 3) */
static const pf_term levels = {
    PF_TERM(levels),
    .where = PF_FLUID,
    .flags = PF_LINEAR | PF_METRIC,
    .doc = "none",
    .cite = "none",
    PF_IN({"T", "T", PF_VALUE, PF_SCALAR}, {"lap_T", "T", PF_LAPLACE, PF_SCALAR}),
    PF_OUT({"s", "T", PF_VALUE, PF_SCALAR}),
    PF_PARAMS(struct layer, PF_NUMBER(struct layer, diffusivity, "m^2/s", "of T", .dflt = 2)),
    PF_EXAMPLES({"one point", 2, NULL, (double[]){7, 3}, (double[]){6}, 1e-15}),
};

static const pf_plugin fourth = {
    PF_PLUGIN,
    .min_minor = 3,
    .name = "fourth",
    .version = "1.3",
    .author = "plugflow",
    .license = "GPL-3.0-or-later",
    .doc = "what version 1.3 of the interface can say beyond 1.2",
    PF_FIELDS({.name = "T", .unit = "K", .doc = "temperature", .shape = PF_SCALAR, .order = 2}),
    PF_TERMS(&levels),
};
PF_ENTRY(fourth)
