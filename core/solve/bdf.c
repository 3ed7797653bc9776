/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Backward differentiation with steps of any length, w = dt / dt_previous (Hairer, Norsett, Wanner I, III.5):
 *
 *     du/dt = c0 u^{n+1} + c1 u^n + c2 u^{n-1}
 *     order 1:  c0 = 1 / dt,  c1 = -1 / dt
 *     order 2:  c0 = (1 + 2w) / (1 + w) / dt,  c1 = -(1 + w) / dt,  c2 = w^2 / (1 + w) / dt */
#include "solve/stepper.h"

bdf bdf_of(int order, double dt, double dt_previous)
{
    double w = order == 2 ? dt / dt_previous : 0;
    bdf b = {.order = order, .shift = 1 / dt, .c = {-1 / dt, 0}};

    if (order == 2) {
        b.shift = (1 + 2 * w) / (1 + w) / dt;
        b.c[0] = -(1 + w) / dt;
        b.c[1] = w * w / (1 + w) / dt;
    }
    return b;
}
