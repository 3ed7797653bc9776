/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * twin_complex.h -- see twin_real.h. */
#undef NUM
#undef F
#define NUM     pf_complex
#define F(name) name##_complex
