/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * random.h -- numbers that look random and are the same in every run: xorshift64* (S. Vigna, ACM Trans. Math.
 * Softw. 42 (2016) 30). */
#ifndef BASE_RANDOM_H
#define BASE_RANDOM_H

/* The state of a sequence at its start. */
#define RANDOM_SEED 88172645463325252ULL

/* The start of another sequence for every seed; random_start(0) is RANDOM_SEED. */
unsigned long long random_start(unsigned long long seed);
/* The next 64 bits of the sequence. */
unsigned long long random_bits(unsigned long long *state);
/* The next number of it, in [0, 1), a multiple of 2^-53. */
double random_next(unsigned long long *state);

#endif
