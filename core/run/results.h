/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * results.h -- results(function(r) ... return { cd = ... } end) of a case: derived values for the summary.
 *
 *     r.t                    times of the rows of forces.csv and probes.csv
 *     r.series["wall.fx"]    a column of those, as a list;  r.last["wall.fx"] its last value
 *     r.last["p0.fx"]        columns of particles.csv, by number of the body
 *     r.mean.u[1]            mean of a field's component over the domain
 *     r.errors.u             { l2, h1, l2_exact } of fields with an exact solution
 *     r.dt                   length of a time step                                                     */
#ifndef RUN_RESULTS_H
#define RUN_RESULTS_H

#include "base/error.h"
#include "base/text.h"
#include "base/value.h"
#include "case/case.h"

/* What the function of the case gets. */
typedef struct results_column {
    const char *name;    /* as r.series and r.last know it: "top.fx", "p0.fx" */
    const double *first; /* value in the first row                            */
    long stride, n;      /* from row to row; rows                             */
} results_column;

typedef struct results_mean {
    const char *name;
    int n_comp;
    double mean[VALUE_MAX];
} results_mean;

typedef struct results_norm {
    const char *name;
    double l2, h1, l2_exact;
} results_norm;

typedef struct results_input {
    results_column t; /* without a name */
    int n_column, n_mean, n_norm;
    results_column *column; /* [n_column] */
    results_mean *mean;     /* [n_mean]   */
    results_norm *norm;     /* [n_norm]   */
    double dt;
} results_input;

/* Calls the case's function (if it has one) once with ones for all numbers; of *in only the names, their numbers
 * and n_comp count.  ERR_CASE, with the line and the names that there are, if it asks for a column, a mean, a norm
 * or a part of r that does not exist; ERR_SIGNAL + n.  Any other error is ignored, since the numbers are not real;
 * what it prints is dropped. */
int results_check(case_file *c, const results_input *in, error *err);
/* Calls it with the real numbers; adds what it returns to *json: the members of an object, sorted by name, without
 * the braces.  A value may be a finite number, a boolean, a string of UTF-8, a list of values, or a table of values
 * with plain names; all of them go into *json, or none and ERR_CASE that names the one that is something else. */
int results_call(case_file *c, const results_input *in, text *json, error *err);

/* --- results_json.c; both raise errors of Lua --- */

/* The string keys of a table, sorted, n of them; pushes what holds the list. */
const char **results_names(lua_State *l, int table, size_t *n);
/* Adds the table on top of the stack to *json, as results_call says. */
void results_put(lua_State *l, case_file *c, text *json);

#endif
