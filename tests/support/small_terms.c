/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The terms of small_system.h: residuals, and Jacobians by hand. */
#include "support/small_system.h"

#include <math.h>
#include <string.h>

#define NUMBERS_OF(B) ((const small_numbers *)(B)->params)

static int cubic(const pf_batch *b, const double *const *in, double *const *out) /* a^3 + a - 2 = 0: a = 1 */
{
    for (uint32_t i = 0; i < b->ld; i++)
        out[0][i] = in[0][i] * in[0][i] * in[0][i] + in[0][i] - 2;
    return PF_OK;
}

static int cubic_jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    for (uint32_t i = 0; i < b->ld; i++)
        jac[0][i] = NUMBERS_OF(b)->wrong * (3 * in[0][i] * in[0][i] + 1);
    return PF_OK;
}

static int arctangent(const pf_batch *b, const double *const *in, double *const *out) /* atan a = 0 */
{
    for (uint32_t i = 0; i < b->ld; i++)
        out[0][i] = atan(in[0][i]);
    return PF_OK;
}

static int arctangent_jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    for (uint32_t i = 0; i < b->ld; i++)
        jac[0][i] = 1 / (1 + in[0][i] * in[0][i]);
    return PF_OK;
}

static int plain(const pf_batch *b, const double *const *in, double *const *out) /* c a - 1 = 0 */
{
    for (uint32_t i = 0; i < b->ld; i++)
        out[0][i] = NUMBERS_OF(b)->c * in[0][i] - 1;
    return PF_OK;
}

static int plain_jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    (void)in;
    for (uint32_t i = 0; i < b->ld; i++)
        jac[0][i] = NUMBERS_OF(b)->c;
    return PF_OK;
}

/* b - c |a| = 0, smooth in 1e-10: where a = 0 its derivative says nothing. */
static int follower(const pf_batch *b, const double *const *in, double *const *out)
{
    for (uint32_t i = 0; i < b->ld; i++)
        out[0][i] = in[1][i] - NUMBERS_OF(b)->c * sqrt(in[0][i] * in[0][i] + 1e-20);
    return PF_OK;
}

static int follower_jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    for (uint32_t i = 0; i < b->ld; i++) {
        jac[0][i] = -NUMBERS_OF(b)->c * in[0][i] / sqrt(in[0][i] * in[0][i] + 1e-20);
        jac[1][i] = 1;
    }
    return PF_OK;
}

static int sum_of_both(const pf_batch *b, const double *const *in, double *const *out) /* a + b - 1 = 0 */
{
    for (uint32_t i = 0; i < b->ld; i++)
        out[0][i] = in[0][i] + in[1][i] - 1;
    return PF_OK;
}

static int sum_of_both_jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    (void)in;
    for (uint32_t i = 0; i < b->ld; i++)
        jac[0][i] = jac[1][i] = 1;
    return PF_OK;
}

static int first_only_jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    (void)in;
    for (uint32_t i = 0; i < b->ld; i++)
        jac[0][i] = 1;
    return PF_OK;
}

static int nan_output(const pf_batch *b, const double *const *in, double *const *out)
{
    for (uint32_t i = 0; i < b->ld; i++)
        out[0][i] = in[0][i] - 1 + (b->x[i] > 0.5 ? NAN : 0);
    return PF_OK;
}

static int zero(const pf_batch *b, const double *const *in, double *const *out) /* a = 0 */
{
    memcpy(out[0], in[0], b->ld * sizeof(double));
    return PF_OK;
}

static int nan_jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    (void)in;
    for (uint32_t i = 0; i < b->ld; i++)
        jac[0][i] = b->x[i] > 0.5 ? NAN : 1;
    return PF_OK;
}

/* sqrt(a): no number where a < 0. */
static int root(const pf_batch *b, const double *const *in, double *const *out)
{
    for (uint32_t i = 0; i < b->ld; i++)
        out[0][i] = sqrt(in[0][i]) + 1;
    return PF_OK;
}

static int root_jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    for (uint32_t i = 0; i < b->ld; i++)
        jac[0][i] = 0.5 / sqrt(in[0][i]) * 1e-6;
    return PF_OK;
}

/* c grad a . grad s + (reaction) a s - x s; values: a, then grad a. */
static int enclosed(const pf_batch *b, const double *const *in, double *const *out)
{
    for (uint32_t i = 0; i < b->ld; i++) {
        out[0][i] = NUMBERS_OF(b)->c * in[0][i] - b->x[i];
        out[1][i] = in[1][i];
        out[1][b->ld + i] = in[1][b->ld + i];
    }
    return PF_OK;
}

static int enclosed_jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    (void)in;
    for (uint32_t i = 0; i < b->ld; i++) {
        jac[0][i] = NUMBERS_OF(b)->c;
        jac[3][i] = jac[3][3 * b->ld + i] = 1;
    }
    return PF_OK;
}

/* The same with the reaction a - tanh a and a large source: free up to a constant at a = 0, and nowhere else. */
static int released(const pf_batch *b, const double *const *in, double *const *out)
{
    enclosed(b, in, out);
    for (uint32_t i = 0; i < b->ld; i++)
        out[0][i] = in[0][i] - tanh(in[0][i]) - 1000 * b->x[i];
    return PF_OK;
}

static int released_jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    enclosed_jacobian(b, in, jac);
    for (uint32_t i = 0; i < b->ld; i++)
        jac[0][i] = tanh(in[0][i]) * tanh(in[0][i]);
    return PF_OK;
}

/* grad w : grad v - v_0 of a vector: nothing holds its constants, and something moves them. */
static int floating(const pf_batch *b, const double *const *in, double *const *out)
{
    memcpy(out[0], in[0], 4 * b->ld * sizeof(double));
    for (uint32_t i = 0; i < b->ld; i++) {
        out[1][i] = -1;
        out[1][b->ld + i] = 0;
    }
    return PF_OK;
}

static int floating_jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    (void)in;
    for (uint32_t k = 0; k < 4; k++)
        for (uint32_t i = 0; i < b->ld; i++)
            jac[0][(k * 4 + k) * b->ld + i] = 1;
    return PF_OK;
}

static const pf_slot value_a[] = {{"a", "a", PF_VALUE, PF_SCALAR}, {"b", "b", PF_VALUE, PF_SCALAR}};
static const pf_slot value_and_grad[] = {{"a", "a", PF_VALUE, PF_SCALAR}, {"grad_a", "a", PF_GRAD, PF_VECTOR}};
static const pf_slot test_a[] = {{"s", "a", PF_VALUE, PF_SCALAR}, {"grad_s", "a", PF_GRAD, PF_VECTOR}};
static const pf_slot value_b[] = {{"b", "b", PF_VALUE, PF_SCALAR}};
static const pf_slot test_b[] = {{"s", "b", PF_VALUE, PF_SCALAR}};
static const pf_slot grad_w[] = {{"grad_w", "w", PF_GRAD, PF_TENSOR}, {"w", "w", PF_VALUE, PF_VECTOR}};

#define TERM(NAME, JACOBIAN, IN, N_IN, OUT, N_OUT)                                                                 \
    {                                                                                                              \
        .size = sizeof(pf_term), .name = #NAME, .where = PF_CELL, .residual = NAME, .jacobian = JACOBIAN,          \
        .in = IN, .n_in = N_IN, .out = OUT, .n_out = N_OUT, .slot_size = sizeof(pf_slot),                          \
        .params_bytes = sizeof(small_numbers)                                                                      \
    }
const pf_term small_cubic = TERM(cubic, cubic_jacobian, value_a, 1, test_a, 1);
const pf_term small_arctangent = TERM(arctangent, arctangent_jacobian, value_a, 1, test_a, 1);
const pf_term small_plain = TERM(plain, plain_jacobian, value_a, 1, test_a, 1);
const pf_term small_follower = TERM(follower, follower_jacobian, value_a, 2, test_b, 1);
const pf_term small_sum_a = TERM(sum_of_both, sum_of_both_jacobian, value_a, 2, test_a, 1);
const pf_term small_sum_b = TERM(sum_of_both, sum_of_both_jacobian, value_a, 2, test_b, 1);
const pf_term small_a_for_b = TERM(zero, first_only_jacobian, value_a, 1, test_b, 1);
const pf_term small_nan_a = TERM(nan_output, first_only_jacobian, value_a, 1, test_a, 1);
const pf_term small_zero_b = TERM(zero, first_only_jacobian, value_b, 1, test_b, 1);
const pf_term small_nan_b = TERM(nan_output, first_only_jacobian, value_b, 1, test_b, 1);
const pf_term small_zero = TERM(zero, first_only_jacobian, value_a, 1, test_a, 1);
const pf_term small_nan_jacobian = TERM(zero, nan_jacobian, value_b, 1, test_b, 1);
const pf_term small_root = TERM(root, root_jacobian, value_a, 1, test_a, 1);
const pf_term small_enclosed = TERM(enclosed, enclosed_jacobian, value_and_grad, 2, test_a, 2);
const pf_term small_released = TERM(released, released_jacobian, value_and_grad, 2, test_a, 2);
const pf_term small_floating = TERM(floating, floating_jacobian, grad_w, 1, grad_w, 2);
