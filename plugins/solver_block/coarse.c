/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "coarse.h"

#include "aggregate.h"

#include <umfpack.h>

#include <string.h>

/* Rows from which factors would cost more than all the rest: aggregates that do not become fewer. */
enum { MOST_ROWS = 20000 };

int coarse_factor(coarse *c, const sparse *a, pool *p)
{
    sparse t;
    double control[UMFPACK_CONTROL];
    void *symbolic = NULL;
    int status;

    *c = (coarse){.n = a->n};
    if (a->n > MOST_ROWS || a->row[a->n] > INT32_MAX)
        return 0;
    sparse_transpose(a, &t, p); /* by columns, and they ascend */
    TAKE(p, c->row, a->n + 1);
    if (p->failed)
        return PF_SOLVER_MEMORY;
    for (int32_t i = 0; i <= a->n; i++)
        c->row[i] = (int32_t)t.row[i];
    c->col = t.col;
    c->value = t.value;
    umfpack_di_defaults(control);
    status = umfpack_di_symbolic(a->n, a->n, c->row, c->col, c->value, &symbolic, control, NULL);
    if (status == UMFPACK_OK)
        status = umfpack_di_numeric(c->row, c->col, c->value, symbolic, &c->factors, control, NULL);
    umfpack_di_free_symbolic(&symbolic);
    if (status != UMFPACK_OK)
        umfpack_di_free_numeric(&c->factors);
    return status == UMFPACK_ERROR_out_of_memory ? PF_SOLVER_MEMORY : 0;
}

int coarse_solve(const coarse *c, const double *b, double *x)
{
    int done = c->factors &&
               umfpack_di_solve(UMFPACK_A, c->row, c->col, c->value, x, b, c->factors, NULL, NULL) == UMFPACK_OK;

    if (!done)
        memset(x, 0, (size_t)c->n * sizeof *x);
    return done;
}

void coarse_destroy(coarse *c)
{
    umfpack_di_free_numeric(&c->factors);
}
