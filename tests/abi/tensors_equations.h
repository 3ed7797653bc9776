/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What the terms of tensors.c do at a point. */

/* Component (a, b) of a symmetric tensor. */
static inline uint32_t F(at)(uint32_t d, uint32_t a, uint32_t b)
{
    const uint32_t low = a < b ? a : b, high = a < b ? b : a;

    return low * d - low * (low + 1) / 2 + high;
}

static int F(spread)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const uint32_t n = b->dim * (b->dim + 1) / 2;

    for (uint32_t c = 0; c < n; c++)
        PF_LANES_OF (b, i)
            out[0][c * LD + i] = in[0][c * LD + i] - in[2][c * LD + i];
    for (uint32_t c = 0; c < n * b->dim; c++)
        PF_LANES_OF (b, i)
            out[1][c * LD + i] = in[1][c * LD + i];
    return PF_OK;
}

static int F(given)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    for (uint32_t c = 0; c < b->dim * b->dim; c++)
        PF_LANES_OF (b, i)
            out[0][c * LD + i] = in[0][c * LD + i] - in[1][c * LD + i];
    return PF_OK;
}

static int F(slopes_of_S)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const uint32_t d = b->dim;

    for (uint32_t a = 0; a < d; a++)
        for (uint32_t k = 0; k < d; k++)
            PF_LANES_OF (b, i) {
                NUM sum = in[0][(a * d + k) * LD + i];

                for (uint32_t c = 0; c < d; c++)
                    sum -= (1.0 + c) * in[1][(F(at)(d, a, c) * d + k) * LD + i];
                out[0][(a * d + k) * LD + i] = sum;
            }
    return PF_OK;
}

static int F(slopes_of_T)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const uint32_t d = b->dim;

    for (uint32_t a = 0; a < d; a++)
        for (uint32_t c = a; c < d; c++)
            PF_LANES_OF (b, i) {
                NUM sum = in[0][F(at)(d, a, c) * LD + i];

                for (uint32_t k = 0; k < d; k++)
                    sum -= (1.0 + k) *
                           (in[1][((a * d + c) * d + k) * LD + i] + 2 * in[1][((c * d + a) * d + k) * LD + i]);
                out[0][F(at)(d, a, c) * LD + i] = sum;
            }
    return PF_OK;
}

static int F(laplacian)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    for (uint32_t c = 0; c < b->dim * (b->dim + 1) / 2; c++)
        PF_LANES_OF (b, i)
            out[0][c * LD + i] = in[0][c * LD + i] - in[1][c * LD + i] - in[2][c * LD + i];
    return PF_OK;
}
