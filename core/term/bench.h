/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * bench.h -- one term with all that its functions need, at points with random values: no mesh, no case.  Everything
 * that it is given lies between guarded zones, and every call is looked after. */
#ifndef TERM_BENCH_H
#define TERM_BENCH_H

#include "term/guard.h"
#include "term/selftest.h"
#include "term/surroundings.h"
#include "term/term.h"

/* Points, and lanes: those behind the points repeat others, as pf_batch says. */
enum { BENCH_N = 21, BENCH_LD = 24, BENCH_POINT_ARRAYS = 28 };

typedef struct bench {
    selftest *s;
    const term_plugin *p;
    const pf_term *t;
    int dim;
    int draw;        /* of the parameters; 0: their defaults                                      */
    char drawn[400]; /* the parameters of a later draw, for messages; "" for the defaults       */
    int quiet;       /* what is right is not told                                                 */
    int captured;    /* values are those of a case                                               */
    int initialised; /* the term's init has been called                                          */
    uint32_t live;   /* bit i: parameter i was seen to change something                          */
    void *params, *other_params;
    double *in[TERM_MAX_SLOTS], *out[TERM_MAX_SLOTS], *again[TERM_MAX_SLOTS];
    pf_complex *z[TERM_MAX_SLOTS], *w[TERM_MAX_SLOTS]; /* of the twin */
    double *jac[TERM_MAX_SLOTS * TERM_MAX_SLOTS], *truth[TERM_MAX_SLOTS * TERM_MAX_SLOTS];
    double *point[BENCH_POINT_ARRAYS]; /* what the batch has of the points, [rows][BENCH_LD] */
    int rows[BENCH_POINT_ARRAYS], n_point;
    int32_t *id, *other_id;
    void *room, *scratch;
    term_report report;
    pf_batch b;
    unsigned long long random; /* state of the random numbers */
    guard guard;
    surroundings surroundings;
    arena memory;
} bench;

/* Memory, points, default parameters and inputs; freed with bench_destroy whatever comes back. */
int bench_create(bench *k, selftest *s, const term_plugin *p, const pf_term *t, int dim, error *err);
void bench_destroy(bench *k);

/* A line of the report, and its count; ok = 0: what is wrong. */
void bench_line(bench *k, int ok, const char *fmt, ...) __attribute__((format(printf, 3, 4)));
int bench_components(const bench *k, const pf_slot *s);
double bench_number(bench *k, double low, double high);

/* --- bench_points.c --- */

/* The points and the batch, with what points of this kind have. */
int bench_points(bench *k, error *err);
/* Those that worked examples have: normal (0.6, -0.8) or (0.6, 0.48, 0.64), metric (4 1; 1 2), h = gap = 0.1,
 * density = sizes = 2. */
void bench_example_points(bench *k);
/* Points and inputs in the opposite order. */
void bench_reverse(bench *k);
/* Points, inputs and parameters of a batch of a case instead of random ones. */
void bench_capture(bench *k, const pf_batch *b, const double *const *in, const void *params);
/* Lanes behind the points repeat the first ones. */
void bench_repeat(double *row);

/* --- bench_values.c: parameters and inputs --- */

/* Other values in all inputs, in the ranges of their slots. */
void bench_random_inputs(bench *k);
/* The same of unknowns alone: a term is linear in these at given properties, data, old values and memory. */
void bench_random_state(bench *k);
/* 1 if some slot has a range. */
int bench_has_range(const bench *k);
/* Writes a parameter: one number, dim numbers of a vector. */
void bench_put_param(bench *k, const pf_param *p, const double *v);
/* How many draws show all branches of choices and booleans, and random values of the others. */
int bench_draws(const bench *k);
/* Unknowns, old values and memory of a fluid at rest, all zero; or scalars below zero: where their ranges allow it.
 */
void bench_put_state(bench *k, int negative);
/* Another number of one parameter, the n-th that is tried. */
void bench_put_other(bench *k, const pf_param *p, int n);
/* Parameters of a draw, the first of which are the defaults; 0: the term's check refuses them. */
int bench_params(bench *k, int draw);

/* --- bench_call.c --- */

/* Round every call of a function of the term: bench_left is 0, and a line is out, if it did what it must not. */
void bench_enter(bench *k, const char *what);
int bench_left(bench *k, const char *what);
/* Calls the residual; its status.  A line is out if it did what it must not, and *sound is 0. */
int bench_status(bench *k, double *const *out, const char *what, int *sound);
/* The same; 1 if it went well, else the line is out. */
int bench_call(bench *k, double *const *out, const char *what);
/* init and done of the term, where it has them; 0: a line is out. */
int bench_init(bench *k);
void bench_done(bench *k);

#endif
