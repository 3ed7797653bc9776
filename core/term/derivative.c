/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Jacobians of point functions.
 *
 *     by hand          the term's own jacobian()
 *     complex step     Im f(x + i h) / h,  h = 1e-100: exact to round-off
 *     differences      (f(x + h) - f(x - h)) / 2h,  h = eps^(1/3) |x|max: about ten digits; of a linear term any h
 */
#include "term/term.h"

#include <complex.h>
#include <float.h>
#include <math.h>
#include <string.h>

#define COMPLEX_STEP 1e-100

/* Components of slot k that are derived by. */
static int derived(const pf_term *t, uint32_t k, double *const *jac, int dim)
{
    return term_is_derived(&t->in[k]) && jac[k] ? term_components(t->in[k].shape, dim) : 0;
}

static size_t lanes_of(const pf_slot *slot, uint32_t n, int dim)
{
    size_t k = 0;

    for (uint32_t i = 0; i < n; i++)
        k += (size_t)term_components(slot[i].shape, dim);
    return k;
}

size_t term_jacobian_room(const pf_term *t, int dim, uint32_t ld)
{
    return (lanes_of(t->in, t->n_in, dim) + 2 * lanes_of(t->out, t->n_out, dim)) * ld * sizeof(pf_complex);
}

/* Im z / COMPLEX_STEP; a product, as divisions would take longer than the term. */
static void take_imaginary(const pf_complex *z, uint32_t n, double *restrict d)
{
    const double *restrict part = (const double *)z;

    for (uint32_t i = 0; i < n; i++)
        d[i] = part[2 * i + 1] * (1 / COMPLEX_STEP);
}

static int by_complex_step(const pf_term *t, const pf_batch *b, const double *const *in, double *const *jac,
                           pf_complex *room)
{
    const pf_complex *z[TERM_MAX_SLOTS];
    pf_complex *w[TERM_MAX_SLOTS], *zk[TERM_MAX_SLOTS];
    uint32_t ld = b->ld;
    int dim = (int)b->dim;

    for (uint32_t k = 0; k < t->n_in; k++) {
        size_t n = (size_t)term_components(t->in[k].shape, dim) * ld;

        for (size_t i = 0; i < n; i++)
            room[i] = in[k][i];
        z[k] = zk[k] = room;
        room += n;
    }
    for (uint32_t o = 0; o < t->n_out; o++) {
        w[o] = room;
        room += (size_t)term_components(t->out[o].shape, dim) * ld;
    }
    for (uint32_t k = 0; k < t->n_in; k++)
        for (int c = 0, n_c = derived(t, k, jac, dim); c < n_c; c++) {
            int status;

            for (uint32_t i = 0; i < ld; i++)
                zk[k][(uint32_t)c * ld + i] += COMPLEX_STEP * I;
            status = t->residual_c(b, z, w);
            for (uint32_t i = 0; i < ld; i++)
                zk[k][(uint32_t)c * ld + i] = in[k][(uint32_t)c * ld + i];
            if (status)
                return status;
            for (uint32_t o = 0; o < t->n_out; o++)
                for (int a = 0; a < term_components(t->out[o].shape, dim); a++)
                    take_imaginary(w[o] + (uint32_t)a * ld, ld,
                                   jac[o * t->n_in + k] + (uint32_t)(a * n_c + c) * ld);
        }
    return 0;
}

static int by_differences(const pf_term *t, const pf_batch *b, const double *const *in, double *const *jac,
                          double *room)
{
    const double *z[TERM_MAX_SLOTS];
    double *plus[TERM_MAX_SLOTS], *minus[TERM_MAX_SLOTS], *zk[TERM_MAX_SLOTS];
    uint32_t ld = b->ld;
    int dim = (int)b->dim;

    for (uint32_t k = 0; k < t->n_in; k++) {
        size_t n = (size_t)term_components(t->in[k].shape, dim) * ld;

        memcpy(room, in[k], n * sizeof *room);
        z[k] = zk[k] = room;
        room += n;
    }
    for (uint32_t o = 0; o < t->n_out; o++) {
        size_t n = (size_t)term_components(t->out[o].shape, dim) * ld;

        plus[o] = room;
        minus[o] = room + n;
        room += 2 * n;
    }
    for (uint32_t k = 0; k < t->n_in; k++) {
        int n_c = derived(t, k, jac, dim);
        double size = 0, h;

        for (uint32_t i = 0; i < (uint32_t)n_c * ld; i++)
            size = fmax(size, fabs(in[k][i]));
        h = t->flags & PF_LINEAR ? fmax(size, 1) /* any step is exact; one of a value that is round-off is not */
                                 : cbrt(DBL_EPSILON) * (size > 0 ? size : 1);
        for (int c = 0; c < n_c; c++) {
            double *x = zk[k] + (uint32_t)c * ld;
            const double *x0 = in[k] + (uint32_t)c * ld;
            int status;

            for (uint32_t i = 0; i < ld; i++)
                x[i] = x0[i] + h;
            status = t->residual(b, z, plus);
            for (uint32_t i = 0; i < ld; i++)
                x[i] = x0[i] - h;
            status = status ? status : t->residual(b, z, minus);
            memcpy(x, x0, ld * sizeof *x);
            if (status)
                return status;
            for (uint32_t o = 0; o < t->n_out; o++)
                for (int a = 0; a < term_components(t->out[o].shape, dim); a++)
                    for (uint32_t i = 0; i < ld; i++)
                        jac[o * t->n_in + k][(uint32_t)(a * n_c + c) * ld + i] =
                            (plus[o][(uint32_t)a * ld + i] - minus[o][(uint32_t)a * ld + i]) /
                            ((x0[i] + h) - (x0[i] - h));
        }
    }
    return 0;
}

int term_has_derivative(const pf_term *t, enum term_derivative how)
{
    int unknowns = 0;

    for (uint32_t k = 0; k < t->n_in; k++)
        unknowns += term_is_derived(&t->in[k]);
    if (unknowns && how == TERM_ANALYTIC)
        return t->jacobian != NULL;
    if (unknowns && how == TERM_COMPLEX)
        return t->residual_c != NULL;
    return 1;
}

int term_derives_by_hand(const pf_term *t, enum term_derivative how)
{
    return t->jacobian && (how == TERM_AUTO || how == TERM_ANALYTIC);
}

int term_jacobian(const pf_term *t, enum term_derivative how, const pf_batch *b, const double *const *in,
                  double *const *jac, void *room)
{
    if (!term_has_derivative(t, how))
        return term_host.fail(b, b->ld, PF_FAIL,
                              "the case wants derivatives %s, and the term has none; \"auto\" is "
                              "what it has",
                              how == TERM_ANALYTIC ? "by hand (\"analytic\")" : "by complex step (\"complex\")");
    if (how == TERM_AUTO)
        how = t->jacobian ? TERM_ANALYTIC : t->residual_c ? TERM_COMPLEX : TERM_FD;
    if (how == TERM_ANALYTIC && t->jacobian)
        return t->jacobian(b, in, jac);
    if (how == TERM_COMPLEX && t->residual_c)
        return by_complex_step(t, b, in, jac, room);
    return by_differences(t, b, in, jac, room);
}
