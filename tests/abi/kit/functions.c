/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Each function of term.h once, with its derivative by hand: the self-test compares that with the complex twin. */
#include <plugflow/term.h>

#include "functions.h"

TERM(functions, PF_CELL, IN(T), OUT(s), PARAMS(), .doc = "f(T)s", .cite = "calculus",
     .jacobian = functions_jacobian)
{
    LANES (i) {
        NUM sum = 0;

#define TIMES_WEIGHT(WEIGHT, VALUE, SLOPE) sum += (1 + 0.1 * (WEIGHT)) * (VALUE);
        LIST(TIMES_WEIGHT)
        s[i] = sum;
    }
}

#if PF_ONCE
int functions_jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    const double *T = in[0];

    LANES (i) {
#define ADD_SLOPE(WEIGHT, VALUE, SLOPE) jac[0][i] += (1 + 0.1 * (WEIGHT)) * (SLOPE);
        LIST(ADD_SLOPE)
    }
    return PF_OK;
}
#endif

PLUGIN(functions, "functions of term.h", FIELDS(T), TERMS(functions))
#include PF_TWIN
