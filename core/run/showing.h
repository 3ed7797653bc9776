/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * showing.h -- what the terms of a case that give no equations show, in files and tables; nothing is done where
 * there are none. */
#ifndef RUN_SHOWING_H
#define RUN_SHOWING_H

#include "io/vtu.h"
#include "run/run.h"
#include "space/locate.h"

typedef struct showing showing;

enum { SHOWING_MOST_COLUMNS = 192 }; /* of particles.csv; showing_plan refuses more */

/* Before the tables are planned; r->showing stays NULL if the case has no such terms. */
int showing_open(run *r, error *err);
void showing_close(run *r);
/* The solution is another one. */
void showing_forget(run *r);

/* integrals.csv: its columns; a row. */
int showing_plan(run *r, text *units, error *err);
int showing_row(run *r, double t, error *err);
/* Columns of particles.csv that come last: their number, which may be more than there is room for, names and units;
 * the values of a body. */
int showing_body_columns(const run *r, int most, char (*name)[96], const char **unit);
/* Returns where the row goes on, NULL: an error. */
double *showing_body_row(run *r, int body, double *row, error *err);

/* Fields that are shown, projected; 0 of them if r->showing is NULL. */
int showing_fields(const run *r, const field_spec **f);
int showing_take(run *r, error *err); /* what they are now: before the next two */
/* Value of one at a place; NaN where it has none.  in: the body that holds x, or NULL. */
void showing_value(const run *r, int field, const located *at, const body_place *in, double *v);
/* The part of a file of fields. */
vtu_more showing_file(const run *r);
/* Evaluates the terms at this state; whoever watches it sees them. */
int showing_look(run *r, const assembly_state *at, error *err);
/* Mean over its points. */
const double *showing_mean(const run *r, int field);

#endif
