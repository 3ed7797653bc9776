/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Fields of tensors in all slots that there are: S (symmetric) spreads like heat, T (full) is what the case says,
 * G, H and L are made of the slopes, the Laplacian and the old value of those. */
#include <plugflow/plugin.h>

#include <plugflow/twin_real.h>
#include "tensors_equations.h"
#include <plugflow/twin_complex.h>
#include "tensors_equations.h"

#define ABOUT .where = PF_CELL, .flags = PF_LINEAR, .cite = "none"

static const pf_term spread = {
    PF_TERM(spread),
    ABOUT,
    .doc = "(\\partial_t S-f):s+\\nabla S\\cdot\\nabla s",
    PF_IN({"S_t", "S", PF_DOT, PF_SYMMETRIC}, {"grad_S", "S", PF_GRAD, PF_SYMMETRIC_GRAD},
          {"f", NULL, PF_DATA, PF_SYMMETRIC}),
    PF_OUT({"s", "S", PF_VALUE, PF_SYMMETRIC}, {"grad_s", "S", PF_GRAD, PF_SYMMETRIC_GRAD}),
};

static const pf_term given = {
    PF_TERM(given),
    ABOUT,
    .doc = "(T-f):t",
    PF_IN({"T", "T", PF_VALUE, PF_TENSOR}, {"g", NULL, PF_DATA, PF_TENSOR}),
    PF_OUT({"t", "T", PF_VALUE, PF_TENSOR}),
};

static const pf_term slopes_of_S = {
    PF_TERM(slopes_of_S),
    ABOUT,
    .doc = "(G_{ak}-(1+b)\\,\\partial_k S_{ab})\\,g_{ak}",
    PF_IN({"G", "G", PF_VALUE, PF_TENSOR}, {"grad_S", "S", PF_GRAD, PF_SYMMETRIC_GRAD}),
    PF_OUT({"g", "G", PF_VALUE, PF_TENSOR}),
};

static const pf_term slopes_of_T = {
    PF_TERM(slopes_of_T),
    ABOUT,
    .doc = "(H_{ab}-(1+k)\\,\\partial_k(T_{ab}+2T_{ba}))\\,h_{ab}",
    PF_IN({"H", "H", PF_VALUE, PF_SYMMETRIC}, {"grad_T", "T", PF_GRAD, PF_TENSOR_GRAD}),
    PF_OUT({"h", "H", PF_VALUE, PF_SYMMETRIC}),
};

static const pf_term laplacian = {
    PF_TERM(laplacian),
    ABOUT,
    .doc = "(L-\\Delta S-S(t-\\Delta t)):l",
    PF_IN({"L", "L", PF_VALUE, PF_SYMMETRIC}, {"lap_S", "S", PF_LAPLACE, PF_SYMMETRIC},
          {"old_S", "S", PF_OLD, PF_SYMMETRIC}),
    PF_OUT({"l", "L", PF_VALUE, PF_SYMMETRIC}),
};

#define FIELD(NAME, SHAPE)                                                                                         \
    {                                                                                                              \
        .name = #NAME, .unit = "1", .doc = "tensor " #NAME, .shape = SHAPE, .order = 2                             \
    }

static const pf_plugin plugin = {
    PF_PLUGIN,
    .min_minor = 4,
    .name = "tensors",
    .version = "1.0",
    .author = "plugflow",
    .license = "GPL-3.0-or-later",
    .doc = "fields of tensors that a case knows",
    PF_FIELDS(FIELD(S, PF_SYMMETRIC), FIELD(T, PF_TENSOR), FIELD(G, PF_TENSOR), FIELD(H, PF_SYMMETRIC),
              FIELD(L, PF_SYMMETRIC)),
    PF_TERMS(&spread, &given, &slopes_of_S, &slopes_of_T, &laplacian),
};
PF_ENTRY(plugin)
