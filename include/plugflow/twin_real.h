/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * twin_real.h, twin_complex.h -- compile the point functions of one source twice, for real
 * numbers and for complex ones.  The second copy gives the kernel exact derivatives (complex
 * step), so a term needs no Jacobian of its own:
 *
 *     #include <plugflow/twin_real.h>
 *     #include "equations.h"
 *     #include <plugflow/twin_complex.h>
 *     #include "equations.h"
 *
 * equations.h defines   static int F(name)(const pf_batch *b, const NUM *const *in, NUM *const *out)
 * and so makes name_real and name_complex. */
#ifndef PF_LANES_OF
#define PF_LANES_OF(b, i) for (uint32_t i = 0; i < (b)->ld; i++)
#define LD                ((b)->ld)
#endif
#undef NUM
#undef F
#define NUM     double
#define F(name) name##_real
