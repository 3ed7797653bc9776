/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Terms on points of cells, in the fluid, in bodies and on their surfaces that vanish where the Laplacian of T
 * is the function f of the case, and the metric of all elements is the diagonal matrix that the case says. */
#include <plugflow/fluid.h>

struct expected {
    double metric[3], weight;
};

#include <plugflow/twin_real.h>
#include "laplacians_equations.h"
#include <plugflow/twin_complex.h>
#include "laplacians_equations.h"

#define ON(NAME, WHERE)                                                                                            \
    static const pf_term NAME = {                                                                                  \
        PF_TERM_SIZES,                                                                                             \
        .name = #NAME,                                                                                             \
        .where = WHERE,                                                                                            \
        .flags = PF_METRIC | PF_LINEAR,                                                                            \
        .doc = "(\\Delta T-f)\\,s+(G-M):\\nabla s",                                                                \
        .cite = "none",                                                                                            \
        PF_IN({"lap_T", "T", PF_LAPLACE, PF_SCALAR}, {"f", NULL, PF_DATA, PF_SCALAR}),                             \
        PF_OUT({"s", "T", PF_VALUE, PF_SCALAR}, {"grad_s", "T", PF_GRAD, PF_VECTOR}),                              \
        PF_PARAMS(struct expected,                                                                                 \
                  {.name = "metric",                                                                               \
                   .unit = "1/m^2",                                                                                \
                   .doc = "diagonal of the metric",                                                                \
                   .type = PF_T_VECTOR,                                                                            \
                   .offset = offsetof(struct expected, metric)},                                                   \
                  PF_NUMBER(struct expected, weight, "m^2", "of what is wrong with the metric", .dflt = 1)),       \
        .residual = difference_real,                                                                               \
        .residual_c = difference_complex,                                                                          \
    }
ON(fluid, PF_FLUID);
ON(solid, PF_SOLID);
ON(surface, PF_SURFACE);
ON(cells, PF_CELL);

static const pf_plugin plugin = {
    PF_PLUGIN,
    .min_minor = 3,
    .name = "laplacians",
    .version = "1.0",
    .author = "plugflow",
    .license = "GPL-3.0-or-later",
    .doc = "whether Laplacians and metrics are what the case says",
    PF_FIELDS({.name = "T", .unit = "K", .doc = "temperature", .shape = PF_SCALAR, .order = 2}),
    PF_TERMS(&fluid, &solid, &surface, &cells),
};
PF_ENTRY(plugin)
