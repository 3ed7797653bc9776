/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * How exactly the linear systems of Newton's method are solved: what is left of one is a small part of what the
 * step itself is expected to leave, as the method converges quadratically (Eisenstat and Walker 1996, SIAM J. Sci.
 * Comput. 17:16, choice 2), or of what is small enough. */
#include "solve/solve.h"

#include <math.h>

#define LEFT        0.05
#define LEFT_ENOUGH 0.003

/* Expected of the second step.  The first one is often linear, from rest, and its fall says nothing about the next.
 */
#define SECOND_FALL 0.2

double forcing(const newton_system *s, const newton_options *o, const newton_report *r, const double *length,
               double enough, int k)
{
    const double *h = r->history;
    double fall = k == 0 ? s->last_fall : SECOND_FALL;

    if (k > 1)
        fall = length[k - 1] == 1 ? pow(h[k] / h[k - 1], 2) : 1;
    return fmin(fmax(fmax(LEFT * fall, FORCING_LEAST), LEFT_ENOUGH * enough / h[k]), o->linear_tolerance);
}
