/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Fields of order 0, one value a cell (interface 1.4): means of a function, the mean of these, a continuous field
 * nearest to them, decay. */
#include <plugflow/term.h>

#define PF_SHAPE_mean  SCALAR
#define PF_SHAPE_flow  VECTOR
#define PF_SHAPE_total SCALAR

/* (a dm/dt + m - f) s_m */
TERM(means, PF_CELL, IN(VALUE(mean), DOT(mean), DATA(f, SCALAR)), OUT(TEST(mean, s_m)),
     PARAMS(REAL(a, "s", "time of decay")), .doc = "(a\\dot m+m-f)s", .cite = "definition")
{
    LANES (i)
        s_m[i] = a * mean_t[i] + mean[i] - f[i];
}

/* (M - m) X: M is the mean of the means; (T - m) s: the nearest T */
TERM(nearest, PF_CELL, IN(VALUE(mean), VALUE(total), T), OUT(TEST(total, X), s), PARAMS(), .doc = "(M-m)X+(T-m)s",
     .cite = "definition")
{
    LANES (i) {
        X[i] = total[i] - mean[i];
        s[i] = T[i] - mean[i];
    }
}

/* (w - m grad T) . W: a vector of each cell, that depends on the others nonlinearly */
TERM(flows, PF_CELL, IN(VALUE(flow), VALUE(mean), grad_T), OUT(TEST(flow, W)), PARAMS(), .flags = PF_OPTIONAL,
     .doc = "(w-m\\nabla T)\\cdot W", .cite = "definition")
{
    EACH (a)
        LANES (i)
            W[a][i] = flow[a][i] - mean[i] * grad_T[a][i];
}

PLUGIN(cells, "one value a cell",
       FIELDS(T, FIELD(mean, "1", "mean of a cell", .order = 0), FIELD(flow, "1", "flow of a cell", .order = 0),
              FIELD(total, "1", "mean of all", .support = PF_ON_PROBLEM)),
       TERMS(means, nearest, flows), .author = "plugflow")
#include PF_TWIN
