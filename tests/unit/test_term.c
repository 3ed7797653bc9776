/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Derivatives of terms: which one a term has, and that no other is taken in its place. */
#include "term/term.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <string.h>

enum { LANES = PF_LANES };

/* x^2, without a twin that goes with it */
static int square(const pf_batch *b, const double *const *in, double *const *out)
{
    for (uint32_t i = 0; i < b->ld; i++)
        out[0][i] = in[0][i] * in[0][i];
    return PF_OK;
}

static int square_complex(const pf_batch *b, const pf_complex *const *in, pf_complex *const *out)
{
    for (uint32_t i = 0; i < b->ld; i++)
        out[0][i] = in[0][i] * in[0][i];
    return PF_OK;
}

static int square_jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    for (uint32_t i = 0; i < b->ld; i++)
        jac[0][i] = 2 * in[0][i];
    return PF_OK;
}

static const pf_slot unknown[] = {{"x", "x", PF_VALUE, PF_SCALAR}}, data[] = {{"x", NULL, PF_DATA, PF_SCALAR}};

static pf_term term_of(const pf_slot *in, pf_residual_c_fn *twin, pf_jacobian_fn *jacobian)
{
    return (pf_term){.name = "square",
                     .in = in,
                     .n_in = 1,
                     .out = unknown,
                     .n_out = 1,
                     .residual = square,
                     .residual_c = twin,
                     .jacobian = jacobian};
}

/* d out / d in at x = 3; the status is returned, the report left in *r. */
static int derive(const pf_term *t, enum term_derivative how, double *slope, term_report *r)
{
    static _Alignas(64) pf_complex room[8 * LANES];
    double x[LANES], j[LANES] = {0};
    const double *in[] = {x};
    double *jac[] = {j};
    pf_batch b = {.size = sizeof b, .dim = 2, .n = LANES, .ld = LANES, .kernel = r, .host = &term_host};
    int status;

    *r = (term_report){.plugin = "powers", .term = t->name};
    assert_true(term_jacobian_room(t, 2, LANES) <= sizeof room);
    for (int i = 0; i < LANES; i++)
        x[i] = 3;
    status = term_jacobian(t, how, &b, in, jac, room);
    *slope = j[0];
    return status;
}

static void term_has_the_derivatives_that_it_brings_and_differences(void **state)
{
    const pf_term bare = term_of(unknown, NULL, NULL), twin = term_of(unknown, square_complex, NULL);
    const pf_term by_hand = term_of(unknown, NULL, square_jacobian);

    (void)state;
    assert_false(term_has_derivative(&bare, TERM_ANALYTIC));
    assert_false(term_has_derivative(&bare, TERM_COMPLEX));
    assert_false(term_has_derivative(&twin, TERM_ANALYTIC));
    assert_true(term_has_derivative(&twin, TERM_COMPLEX));
    assert_true(term_has_derivative(&by_hand, TERM_ANALYTIC));
    assert_false(term_has_derivative(&by_hand, TERM_COMPLEX));
    assert_true(term_has_derivative(&bare, TERM_FD) && term_has_derivative(&bare, TERM_AUTO));
    assert_true(term_has_derivative(&twin, TERM_FD) && term_has_derivative(&by_hand, TERM_FD));
}

static void term_without_unknowns_has_nothing_to_derive(void **state)
{
    const pf_term t = term_of(data, NULL, NULL);
    term_report r;
    double slope;

    (void)state;
    assert_true(term_has_derivative(&t, TERM_ANALYTIC) && term_has_derivative(&t, TERM_COMPLEX));
    assert_int_equal(derive(&t, TERM_ANALYTIC, &slope, &r), PF_OK);
    assert_true(slope == 0);
}

static void derivative_that_a_term_lacks_is_refused_and_not_replaced(void **state)
{
    const pf_term bare = term_of(unknown, NULL, NULL);
    term_report r;
    double slope;

    (void)state;
    assert_int_equal(derive(&bare, TERM_ANALYTIC, &slope, &r), PF_FAIL);
    assert_true(slope == 0);
    assert_int_equal(r.status, PF_FAIL);
    assert_non_null(strstr(r.text, "term powers.square"));
    assert_non_null(strstr(r.text, "\"analytic\""));
    assert_int_equal(derive(&bare, TERM_COMPLEX, &slope, &r), PF_FAIL);
    assert_non_null(strstr(r.text, "\"complex\""));
}

static void derivative_by_hand_complex_step_and_differences_agree(void **state)
{
    const pf_term t = term_of(unknown, square_complex, square_jacobian);
    term_report r;
    double slope;

    (void)state;
    for (int how = TERM_AUTO; how <= TERM_COMPLEX; how++) {
        assert_int_equal(derive(&t, (enum term_derivative)how, &slope, &r), PF_OK);
        assert_true(slope == 6);
    }
    assert_int_equal(derive(&t, TERM_FD, &slope, &r), PF_OK);
    assert_true(slope != 0 && slope > 6 - 1e-8 && slope < 6 + 1e-8);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(term_has_the_derivatives_that_it_brings_and_differences),
        cmocka_unit_test(term_without_unknowns_has_nothing_to_derive),
        cmocka_unit_test(derivative_that_a_term_lacks_is_refused_and_not_replaced),
        cmocka_unit_test(derivative_by_hand_complex_step_and_differences_agree),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
