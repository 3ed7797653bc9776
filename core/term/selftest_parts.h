/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * selftest_parts.h -- the tests of a term by subject; each reports by bench_line. */
#ifndef TERM_SELFTEST_PARTS_H
#define TERM_SELFTEST_PARTS_H

#include "term/bench.h"

/* Outputs, batches, complex twin, on random values; 0 if the outputs are such that nothing else is worth a test. */
int selftest_values(bench *k);
/* Derivatives on the values of the bench; 1, else the line is out. */
int selftest_derive(bench *k, enum term_derivative how, double **jac, const char *what);
/* Jacobian, dependencies, linearity, on random values. */
void selftest_jacobian(bench *k);
/* Outputs and derivatives of a fluid at rest, and of scalars below zero; leaves random values. */
void selftest_states(bench *k);
/* Looks for parameters that change something, to k->live; and of all terms of a plugin: those that change nothing.
 */
void selftest_keys(bench *k);
void selftest_dead_keys(selftest *s, const term_plugin *p, const uint32_t *live);
/* Every property that the term takes must come from somewhere. */
void selftest_takes(bench *k);
/* A worked example; leaves its parameters and inputs in the bench. */
void selftest_example(bench *k, const pf_example *e);

#endif
