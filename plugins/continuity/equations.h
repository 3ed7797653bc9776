/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Continuity (appendix A.1-A.6): what happens at one point. */

/* q div u */
static int F(divergence)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const NUM *restrict div_u = in[0];
    NUM *restrict q = out[0];

    PF_LANES_OF (b, i)
        q[i] = div_u[i];
    return PF_OK;
}
