/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * With which order Newton's method has converged. */
#include "solve/solve.h"

#include <math.h>

/* Residuals between which the order of convergence is observed for what it says about the matrix. */
#define MOST  1e-2
#define LEAST 1e-12

/* A residual that says nothing. */
#define ROUND_OFF 1e-14

/* Whether the residual at k is what the step left, and not round-off or what its linear solution left. */
static int shows_order(const newton_report *r, const double *inexact, int k)
{
    return r->history[k] >= ROUND_OFF && r->history[k] > 1.5 * inexact[k - 1] * r->history[k - 1];
}

void observe_order(newton_report *r, const double *inexact)
{
    const double *h = r->history;
    int k = r->iterations;

    while (k >= 2 && !(shows_order(r, inexact, k) && shows_order(r, inexact, k - 1) && h[k - 1] < h[k - 2]))
        k--;
    r->order = k >= 2 ? log(h[k] / h[k - 1]) / log(h[k - 1] / h[k - 2]) : 0;
    r->ratio = k >= 2 ? h[k] / (h[k - 1] * h[k - 1]) : 0;
}

/* With the true matrix Newton's method ends with order two.  Three orders near one in a row, up to the end, mean
 * another matrix; the report then has their mean.  Counted are whole steps that clearly made the residual fall (so
 * that neither the way to the solution nor round-off is taken for it), by much less than linear systems solved to a
 * tolerance allow, and only where all constants are free to round-off: what is taken out of the residual for one
 * that is not quite so no step foresees. */
void observe_linear(newton_report *r, const double *length, const double *inexact)
{
    enum { IN_A_ROW = 3 };
    const double *h = r->history;
    double sum = 0;
    int k = r->iterations, n = 0;

    while (k > 1 && h[k] < LEAST)
        k--;
    for (; k > 1 && n < IN_A_ROW; k--, n++) {
        double fall = h[k] / h[k - 1], before = h[k - 1] / h[k - 2], order = log(fall) / log(before);

        if (h[k - 2] > MOST || length[k - 1] < 1 || length[k - 2] < 1 || !(fmax(fall, before) < 0.7) ||
            fall < 10 * inexact[k - 1] || before < 10 * inexact[k - 2] || order > 1.3)
            return;
        sum += order;
    }
    if (n == IN_A_ROW) {
        r->linear_only = 1;
        r->order = sum / IN_A_ROW;
    }
}
