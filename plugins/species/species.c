/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A dissolved species in a fluid,
 *
 *     dc/dt + u . grad c = div(D grad c) - r(c) + f,     r = k_1 c + k_2 c^2 + V c/(K_m + c).
 *
 * Walls and bodies let nothing through unless a flux, or an uptake, is given there.  A plugin has one field: built
 * with a SUFFIX, "_2", the same source is another plugin for a second species, with a field and keys of its own. */
#include <plugflow/fluid.h>

#include <tgmath.h>

#ifndef SUFFIX
#define SUFFIX ""
#endif
#define FIELD "c" SUFFIX

struct species {
    double diffusivity; /* D, m^2/s */
};

struct reaction {
    double diffusivity;               /* D, m^2/s                  */
    double first_order, second_order; /* k_1, 1/s; k_2, m^3/(mol s) */
    double max_rate, half_saturation; /* V, mol/(m^3 s); K_m, mol/m^3 */
};

struct surface {
    double release, uptake; /* q, mol/(m^2 s); k, m/s */
};

struct tie {
    double diffusivity, g_c;
};

enum { C, C_T, GRAD_C, LAP_C, U, OLD_U, SOURCE };

#define NO_ZERO          1e-300
#define INVERSE_ESTIMATE 60.0 /* C in h |lap s| <= sqrt(C) |grad s| of second-order elements */

#include <plugflow/twin_real.h>
#include "equations.h"
#include <plugflow/twin_complex.h>
#include "equations.h"

#define NUMBER(STRUCT, MEMBER, UNIT, DOC, ...)                                                                     \
    {                                                                                                              \
        .name = #MEMBER SUFFIX, .unit = UNIT, .doc = DOC, .type = PF_T_REAL, .offset = offsetof(STRUCT, MEMBER),   \
        __VA_ARGS__                                                                                                \
    }
#define DIFFUSIVITY(STRUCT)                                                                                        \
    NUMBER(STRUCT, diffusivity, "m^2/s", "how fast " FIELD " spreads", .flags = PF_REQUIRED | PF_SHARED,           \
           PF_NOT_NEGATIVE)
#define REACTION                                                                                                   \
    NUMBER(struct reaction, first_order, "1/s", "k_1 of what is consumed, k_1 c", .flags = PF_SHARED),             \
        NUMBER(struct reaction, second_order, "m^3/(mol s)", "k_2 of k_2 c^2", .flags = PF_SHARED),                \
        NUMBER(struct reaction, max_rate, "mol/(m^3 s)", "V of V c/(K_m + c)", .flags = PF_SHARED,                 \
               PF_NOT_NEGATIVE),                                                                                   \
        NUMBER(struct reaction, half_saturation, "mol/m^3", "K_m, where half of V is reached", .flags = PF_SHARED, \
               .dflt = 1, .min = 1e-30, .max = 1e30)

#define VALUE_C                                                                                                    \
    {                                                                                                              \
        "c", FIELD, PF_VALUE, PF_SCALAR                                                                            \
    }
#define GIVEN                                                                                                      \
    {                                                                                                              \
        FIELD "_source", NULL, PF_DATA, PF_SCALAR                                                                  \
    }
#define TEST PF_OUT({"s", FIELD, PF_VALUE, PF_SCALAR})
#define BIRD "Bird, Stewart and Lightfoot 2002, Transport Phenomena, 19.1"

static const pf_term storage = {
    PF_TERM(storage),
    .where = PF_FLUID,
    .flags = PF_LINEAR,
    .doc = "\\partial_t c\\,s",
    .cite = BIRD,
    PF_IN({"c_t", FIELD, PF_DOT, PF_SCALAR}),
    TEST,
    PF_EXAMPLES({"dc/dt = 3", 2, NULL, (double[]){3}, (double[]){3}, 1e-15}),
};

static const pf_term advection = {
    PF_TERM(advection),
    .where = PF_FLUID,
    .flags = PF_CONTINUATION,
    .doc = "(u\\cdot\\nabla c)\\,s",
    .cite = BIRD,
    PF_IN({"u", "u", PF_VALUE, PF_VECTOR}, {"grad_c", FIELD, PF_GRAD, PF_VECTOR}),
    TEST,
    PF_EXAMPLES({"u = (1, -2), grad c = (3, 5)", 2, NULL, (double[]){1, -2, 3, 5}, (double[]){-7}, 1e-15}),
};

static const pf_term diffusion = {
    PF_TERM(diffusion),
    .where = PF_FLUID,
    .flags = PF_LINEAR,
    .doc = "D\\,\\nabla c\\cdot\\nabla s",
    .cite = "Fick's law",
    PF_IN({"grad_c", FIELD, PF_GRAD, PF_VECTOR}),
    PF_OUT({"grad_s", FIELD, PF_GRAD, PF_VECTOR}),
    PF_PARAMS(struct species, DIFFUSIVITY(struct species)),
    PF_EXAMPLES(
        {"D = 3, grad c = (1, -2, 5)", 3, (double[]){3}, (double[]){1, -2, 5}, (double[]){3, -6, 15}, 1e-15}),
};

static const pf_term reaction = {
    PF_TERM(reaction),
    .where = PF_FLUID,
    .flags = PF_OPTIONAL,
    .doc = "(k_1c+k_2c^2+V\\frac{c}{K_m+c}-f)\\,s",
    .cite = "Michaelis and Menten 1913, Biochem. Z. 49:333",
    PF_IN(VALUE_C, GIVEN),
    TEST,
    PF_PARAMS(struct reaction, REACTION),
    PF_EXAMPLES(
        {"c = 3: 2 3 + 5 9 + 8 3/(1 + 3) - 7", 2, (double[]){2, 5, 8, 1}, (double[]){3, 7}, (double[]){50}, 1e-15},
        {"c = -1, below zero: -2 + 5 - 8/2", 2, (double[]){2, 5, 8, 2}, (double[]){-1, 0}, (double[]){-1}, 1e-15}),
};

static const pf_term streamline = {
    PF_TERM(streamline),
    .where = PF_FLUID,
    .flags = PF_OPTIONAL | PF_CONTINUATION | PF_METRIC,
    .doc = "\\tau\\,(\\partial_t c+u\\cdot\\nabla c-D\\Delta c+r(c)-f)\\,w\\cdot\\nabla s",
    .cite = "Brooks and Hughes 1982, Comput. Methods Appl. Mech. Eng. 32:199",
    PF_IN(VALUE_C, {"c_t", FIELD, PF_DOT, PF_SCALAR}, {"grad_c", FIELD, PF_GRAD, PF_VECTOR},
          {"lap_c", FIELD, PF_LAPLACE, PF_SCALAR}, {"u", "u", PF_VALUE, PF_VECTOR},
          {"old_u", "u", PF_OLD, PF_VECTOR}, GIVEN),
    PF_OUT({"grad_s", FIELD, PF_GRAD, PF_VECTOR}),
    PF_PARAMS(struct reaction, DIFFUSIVITY(struct reaction), REACTION),
    /* the metric of worked examples is (4 1; 1 2), the factor of the time scheme 15: m = 900 + 214 + 60/4 22 =
     * 38^2; residual 13 + (3 - 10) + 7/2 + 2 5 - 1/2 = 19 */
    PF_EXAMPLES(
        {"D = 1/2, k_1 = 2; u = (1, -2) is carried by w = (2, 9), c = 5, grad c = (3, 5), lap c = -7, dc/dt = "
         "13, f = 1/2",
         2, (double[]){0.5, 2, 0, 0, 1}, (double[]){5, 13, 3, 5, -7, 1, -2, 2, 9, 0.5}, (double[]){1, 4.5}, 1e-14}),
};

static const pf_term flux = {
    PF_TERM(flux),
    .where = PF_FACET,
    .flags = PF_LINEAR | PF_BY_BOUNDARY,
    .doc = "-q\\,s",
    .cite = BIRD,
    PF_IN({FIELD "_flux", NULL, PF_DATA, PF_SCALAR}),
    TEST,
    PF_EXAMPLES({"q = 3 mol/(m^2 s) into the fluid", 2, NULL, (double[]){3}, (double[]){-3}, 1e-15}),
};

static const pf_term uptake = {
    PF_TERM(uptake),
    .where = PF_FACET,
    .flags = PF_BY_BOUNDARY,
    .doc = "k\\,c\\,s",
    .cite = BIRD,
    PF_IN(VALUE_C, {FIELD "_uptake", NULL, PF_DATA, PF_SCALAR}),
    TEST,
    PF_EXAMPLES({"k = 2 m/s, c = 3", 2, NULL, (double[]){3, 2}, (double[]){6}, 1e-15}),
};

static const pf_term body = {
    PF_TERM(body),
    .where = PF_SURFACE,
    .flags = PF_OPTIONAL | PF_LINEAR,
    .doc = "(k\\,c-q)\\,s",
    .cite = BIRD,
    PF_IN(VALUE_C),
    TEST,
    PF_PARAMS(struct surface,
              NUMBER(struct surface, release, "mol/(m^2 s)", "what surfaces of bodies give to the fluid, q"),
              NUMBER(struct surface, uptake, "m/s", "k of what they take from it, k c", PF_NOT_NEGATIVE)),
};

static const pf_term extension = {
    PF_TERM(extension),
    .where = PF_CUT,
    .flags = PF_LINEAR,
    .doc = "g_c(D/h^2+c_0/\\Delta t)(c-Ec)(s-Es)",
    .cite = "Badia, Neiva and Verdugo 2022, Comput. Methods Appl. Mech. Eng. 388:114232 (weak aggregation)",
    PF_IN({"dc", FIELD, PF_DEFECT, PF_SCALAR}),
    PF_OUT({"ds", FIELD, PF_DEFECT, PF_SCALAR}),
    PF_PARAMS(struct tie, DIFFUSIVITY(struct tie),
              NUMBER(struct tie, g_c, "1", "tie of cells with little fluid, in D/h^2 + c0/dt", .dflt = 0.1,
                     PF_NOT_NEGATIVE)),
};

static const pf_plugin species = {
    PF_PLUGIN,
    .min_minor = 3,
    .name = "species" SUFFIX,
    .version = "1.0",
    .author = "plugflow",
    .license = "GPL-3.0-or-later",
    .doc = "a dissolved species that a fluid carries, that spreads and reacts",
    PF_FIELDS({.name = FIELD,
               .unit = "mol/m^3",
               .doc = "concentration " FIELD,
               .shape = PF_SCALAR,
               .order = 2,
               .reaction = "rate",
               .reaction_unit = "mol/s"},
              PF_FIELD_VELOCITY),
    PF_TERMS(&storage, &advection, &diffusion, &reaction, &streamline, &flux, &uptake, &body, &extension),
};
PF_ENTRY(species)
