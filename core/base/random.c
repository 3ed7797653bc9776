/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * xorshift64*: three shifts, and a factor that scrambles the result. */
#include "base/random.h"

unsigned long long random_start(unsigned long long seed)
{
    return RANDOM_SEED + 2 * seed;
}

double random_next(unsigned long long *state)
{
    unsigned long long s = *state;

    s ^= s >> 12;
    s ^= s << 25;
    s ^= s >> 27;
    *state = s;
    return (double)((s * 2685821657736338717ULL) >> 11) * 0x1p-53;
}
