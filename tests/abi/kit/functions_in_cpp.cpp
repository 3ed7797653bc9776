/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Each function of dual.hpp once, with its derivative by hand: the self-test compares that with the dual numbers.
 */
#include <plugflow/dual.hpp>

#include "functions.h"

#define ADD_VALUE(WEIGHT, VALUE, SLOPE) sum += (1 + 0.1 * (WEIGHT)) * (VALUE);
#define ADD_SLOPE(WEIGHT, VALUE, SLOPE) jac[0][i] += (1 + 0.1 * (WEIGHT)) * (SLOPE);

struct functions {
    double added;

    template <class num> int point(const pf_batch &b, const num *const *in, num *const *out) const
    {
        using plugflow::max;
        using plugflow::min;
        const num *T = in[0];

        for (uint32_t i = 0; i < b.ld; i++) {
            num sum = 0;

            LIST(ADD_VALUE)
            out[0][i] = sum + added;
        }
        return PF_OK;
    }
};

static int jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    const double *T = in[0];

    for (uint32_t i = 0; i < b->ld; i++) {
        LIST(ADD_SLOPE)
    }
    return PF_OK;
}

static const pf_field fields[] = {{"T", "K", "temperature", PF_SCALAR, 2, PF_ON_MESH, nullptr, nullptr, nullptr}};
static const pf_slot in[] = {{"T", "T", PF_VALUE, PF_SCALAR}}, out[] = {{"s", "T", PF_VALUE, PF_SCALAR}};
static const pf_param keys[] = {
    {"added", "1", "added", PF_T_REAL, 0, offsetof(functions, added), 0, 0, 0, nullptr}};

const pf_plugin *pf_plugin_entry(const pf_host *, char *, size_t)
{
    static pf_term term = plugflow::term<functions>("functions", PF_CELL, in, out, keys);
    static const pf_term *const terms[] = {&term};
    static const pf_plugin plugin = plugflow::plugin("functions_in_cpp", fields, terms);

    term.doc = "f(T)s", term.cite = "calculus", term.jacobian = jacobian;
    return &plugin;
}
