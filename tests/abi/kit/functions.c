/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Each function of term.h once, with its derivative by hand: the self-test compares that with the complex twin. */
#include <plugflow/term.h>

#define LIST(X)                                                                                                    \
    X(0, sqrt(2 + T[i]), 0.5 / sqrt(2 + T[i]))                                                                     \
    X(1, exp(T[i]), exp(T[i]))                                                                                     \
    X(2, log(3 + T[i]), 1 / (3 + T[i]))                                                                            \
    X(3, sin(T[i]), cos(T[i]))                                                                                     \
    X(4, cos(T[i]), -sin(T[i]))                                                                                    \
    X(5, tan(0.3 * T[i]), 0.3 / (cos(0.3 * T[i]) * cos(0.3 * T[i])))                                               \
    X(6, tanh(T[i]), 1 / (cosh(T[i]) * cosh(T[i])))                                                                \
    X(7, atan(T[i]), 1 / (1 + T[i] * T[i]))                                                                        \
    X(8, fabs(T[i] - 1.5), T[i] < 1.5 ? -1 : 1)                                                                    \
    X(9, pow(T[i] - 1.5, 3), 3 * (T[i] - 1.5) * (T[i] - 1.5))                                                      \
    X(10, pow(2, T[i]), log(2) * pow(2, T[i]))                                                                     \
    X(11, pow(1 + T[i] * T[i], T[i]),                                                                              \
      pow(1 + T[i] * T[i], T[i]) * (log(1 + T[i] * T[i]) + 2 * T[i] * T[i] / (1 + T[i] * T[i])))                   \
    X(12, max(T[i], 1.2), T[i] > 1.2 ? 1 : 0)                                                                      \
    X(13, min(T[i] * T[i], 1), T[i] * T[i] < 1 ? 2 * T[i] : 0)

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
