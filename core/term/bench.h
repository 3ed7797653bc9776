/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * bench.h -- one term with all that its functions need, at points with random values: no mesh, no case. */
#ifndef TERM_BENCH_H
#define TERM_BENCH_H

#include "term/selftest.h"
#include "term/term.h"

enum { BENCH_LD = 24 }; /* points */

typedef struct bench {
    selftest *s;
    const term_plugin *p;
    const pf_term *t;
    int dim;
    void *params;
    double *in[TERM_MAX_SLOTS], *out[TERM_MAX_SLOTS], *again[TERM_MAX_SLOTS];
    double *jac[TERM_MAX_SLOTS * TERM_MAX_SLOTS], *truth[TERM_MAX_SLOTS * TERM_MAX_SLOTS];
    double *x, *normal, *h, *arm, *density, *metric;
    int32_t *id;
    void *room, *scratch;
    term_report report;
    pf_batch b;
    unsigned long long random; /* state of the random numbers */
    arena memory;
} bench;

/* Memory, points, parameters and inputs; freed with arena_free(&k->memory) whatever comes back. */
int bench_create(bench *k, selftest *s, const term_plugin *p, const pf_term *t, int dim, error *err);

/* A line of the report, and its count; ok = 0: what is wrong. */
void bench_line(bench *k, int ok, const char *fmt, ...) __attribute__((format(printf, 3, 4)));
int bench_components(const bench *k, const pf_slot *s);
/* Other values in all inputs. */
void bench_random_inputs(bench *k);
/* In all but properties: a term is linear at given ones. */
void bench_random_state(bench *k);
/* Writes a parameter: one number, dim numbers of a vector. */
void bench_put_param(bench *k, const pf_param *p, const double *v);
/* Calls the residual; 1 if it went well, else the line is out. */
int bench_call(bench *k, double *const *out, const char *what);

#endif
