/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * selftest_parts.h -- the tests of a term by subject; each reports by bench_line. */
#ifndef TERM_SELFTEST_PARTS_H
#define TERM_SELFTEST_PARTS_H

#include "term/bench.h"

/* Outputs, batches, complex twin, on random values; 0 if the outputs are such that nothing else is worth a test. */
int selftest_values(bench *k);
/* Jacobian, dependencies, linearity, on random values. */
void selftest_jacobian(bench *k);
/* A worked example; leaves its parameters and inputs in the bench. */
void selftest_example(bench *k, const pf_example *e);

#endif
