/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What version 1.3 of the interface added, in a plugin that needs it: transport of a scalar by a flow, stabilised
 * by its residual (Brooks, Hughes 1982), which has the Laplacian of the scalar in it and a time scale made from the
 * metric of the element (Bazilevs et al. 2007). */
#include <plugflow/fluid.h>

#include <tgmath.h>

struct transport {
    double diffusivity; /* k, m^2/s                                        */
    double constant;    /* C of the inverse estimate |lap T| <= C |grad T| / h^2 */
};

#include <plugflow/twin_real.h>
#include "supg_equations.h"
#include <plugflow/twin_complex.h>
#include "supg_equations.h"

#define DIFFUSIVITY PF_NUMBER(struct transport, diffusivity, "m^2/s", "diffusivity", .dflt = 1, PF_NOT_NEGATIVE)

static const pf_term galerkin = {
    PF_TERM(galerkin),
    .where = PF_FLUID,
    .doc = "(\\partial_t T+u\\cdot\\nabla T-f)\\,s+k\\,\\nabla T\\cdot\\nabla s",
    .cite = "Brooks, Hughes (1982)",
    PF_IN({"u", "u", PF_VALUE, PF_VECTOR}, {"grad_T", "T", PF_GRAD, PF_VECTOR}, {"f", NULL, PF_DATA, PF_SCALAR},
          {"T_t", "T", PF_DOT, PF_SCALAR}),
    PF_OUT({"s", "T", PF_VALUE, PF_SCALAR}, {"grad_s", "T", PF_GRAD, PF_VECTOR}),
    PF_PARAMS(struct transport, DIFFUSIVITY),
};

static const pf_term supg = {
    PF_TERM(supg),
    .where = PF_FLUID,
    .flags = PF_METRIC,
    .doc = "\\tau\\,(\\partial_t T+u\\cdot\\nabla T-k\\,\\Delta T-f)\\,u\\cdot\\nabla s",
    .cite = "Brooks, Hughes (1982); Bazilevs et al. (2007)",
    PF_IN({"u", "u", PF_VALUE, PF_VECTOR}, {"grad_T", "T", PF_GRAD, PF_VECTOR},
          {"lap_T", "T", PF_LAPLACE, PF_SCALAR}, {"f", NULL, PF_DATA, PF_SCALAR}, {"T_t", "T", PF_DOT, PF_SCALAR}),
    PF_OUT({"grad_s", "T", PF_GRAD, PF_VECTOR}),
    PF_PARAMS(struct transport, DIFFUSIVITY,
              PF_NUMBER(struct transport, constant, "1", "of the inverse estimate", .dflt = 36, PF_NOT_NEGATIVE)),
    /* the metric of worked examples is (4 1; 1 2): u.Gu = 14, G:G = 22, tau = 1/6; residual 12 + 1 - 2 - 5 = 6 */
    PF_EXAMPLES({"u = (2, -1), grad T = (3, 5), lap T = 12, f = 5, dT/dt = 12", 2, (double[]){1.0 / 6, 36},
                 (double[]){2, -1, 3, 5, 12, 5, 12}, (double[]){2, -1}, 1e-14}),
};

static const pf_plugin plugin = {
    PF_PLUGIN,
    .min_minor = 3,
    .name = "supg",
    .version = "1.0",
    .author = "plugflow",
    .license = "GPL-3.0-or-later",
    .doc = "transport of a scalar, stabilised by its residual",
    PF_FIELDS(PF_FIELD_VELOCITY, {.name = "T", .unit = "K", .doc = "temperature", .shape = PF_SCALAR, .order = 2}),
    PF_TERMS(&galerkin, &supg),
};
PF_ENTRY(plugin)
