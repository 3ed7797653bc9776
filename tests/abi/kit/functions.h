/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Each function that term.h and dual.hpp have: X(number, value, derivative by hand), of T[i]. */
#define LIST(X)                                                                                                    \
    X(0, sqrt(3 + T[i]), 0.5 / sqrt(3 + T[i]))                                                                     \
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
