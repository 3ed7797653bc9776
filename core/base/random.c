/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * xorshift64*: three shifts, and a factor that scrambles the result. */
#include "base/random.h"

unsigned long long random_start(unsigned long long seed)
{
    unsigned long long s = RANDOM_SEED + 2 * seed;

    return s ? s : RANDOM_SEED; /* from 0 it would not move */
}

unsigned long long random_bits(unsigned long long *state)
{
    unsigned long long s = *state;

    s ^= s >> 12;
    s ^= s << 25;
    s ^= s >> 27;
    *state = s;
    return s * 2685821657736338717ULL;
}

double random_next(unsigned long long *state)
{
    return (double)(random_bits(state) >> 11) * 0x1p-53;
}
