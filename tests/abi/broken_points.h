/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Point functions with one error each, next to the right Jacobian of convection.h. */

#include <signal.h>

static const pf_host *host;

/* What a write to no memory ends in; the signal itself, so that a sanitizer does not step in. */
static void point_at_nothing(void)
{
    raise(SIGSEGV);
}

/* --- residuals --- */

/* Sound: the parameter "order" is between 3 and 5, always. */
static int needs_order_residual(const pf_batch *b, const double *const *in, double *const *out)
{
    const struct fluid *fluid = b->params;

    if (fluid->order < 3 || fluid->order > 5)
        return host->fail(b, 0, PF_FAIL, "order %d", fluid->order);
    return convection_real(b, in, out);
}

/* Component 0 is forgotten. */
static int unwritten_residual(const pf_batch *b, const double *const *in, double *const *out)
{
    for (uint32_t a = 1; a < b->dim; a++)
        for (uint32_t i = 0; i < b->ld; i++)
            out[0][a * b->ld + i] = in[0][a * b->ld + i];
    return PF_OK;
}

static int added_residual(const pf_batch *b, const double *const *in, double *const *out)
{
    for (uint32_t i = 0; i < b->dim * b->ld; i++)
        out[0][i] += in[0][i];
    return PF_OK;
}

static int nan_output_residual(const pf_batch *b, const double *const *in, double *const *out)
{
    convection_real(b, in, out);
    out[0][3] = (in[0][3] - in[0][3]) / (in[0][3] - in[0][3]);
    return PF_OK;
}

/* 0/0 where u_0 = 1: in the worked example, never on random values. */
static int nan_at_one_residual(const pf_batch *b, const double *const *in, double *const *out)
{
    convection_real(b, in, out);
    for (uint32_t i = 0; i < b->ld; i++)
        out[0][i] *= (in[0][i] - 1) / (in[0][i] - 1);
    return PF_OK;
}

static int unrepeatable_residual(const pf_batch *b, const double *const *in, double *const *out)
{
    static double n_call;

    convection_real(b, in, out);
    out[0][0] += n_call++;
    return PF_OK;
}

/* The value of the next point instead of the own one. */
static int neighbour_residual(const pf_batch *b, const double *const *in, double *const *out)
{
    for (uint32_t a = 0; a < b->dim; a++)
        for (uint32_t i = 0; i < b->ld; i++)
            out[0][a * b->ld + i] = in[0][a * b->ld + (i + 1) % b->ld];
    return PF_OK;
}

/* u / max |u| with the maximum of the batch, which does not depend on the order of the points. */
static int batch_maximum_residual(const pf_batch *b, const double *const *in, double *const *out)
{
    double most = 0;

    for (uint32_t i = 0; i < b->dim * b->ld; i++)
        most = in[0][i] > most ? in[0][i] : -in[0][i] > most ? -in[0][i] : most;
    for (uint32_t i = 0; i < b->dim * b->ld; i++)
        out[0][i] = in[0][i] / most;
    return PF_OK;
}

static int fails_residual(const pf_batch *b, const double *const *in, double *const *out)
{
    convection_real(b, in, out);
    return host->fail(b, 2, PF_FAIL, "density %g is not possible", -4.5);
}

/* 1.2: without a host kept from the entry. */
static int host_of_batch_residual(const pf_batch *b, const double *const *in, double *const *out)
{
    convection_real(b, in, out);
    return b->host->fail(b, 2, PF_FAIL, "the host came with the batch");
}

static int fails_silently_residual(const pf_batch *b, const double *const *in, double *const *out)
{
    convection_real(b, in, out);
    return PF_RETRY;
}

static int crash_residual(const pf_batch *b, const double *const *in, double *const *out)
{
    convection_real(b, in, out);
    point_at_nothing();
    return PF_OK;
}

/* --- Jacobians --- */

/* d v_a / d u_k = rho du_a/dx_k,  d v_a / d (du_a/dx_k) = rho u_k */
static int jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    const struct fluid *fluid = b->params;
    const uint32_t d = b->dim, ld = b->ld;

    for (uint32_t a = 0; a < d; a++)
        for (uint32_t k = 0; k < d; k++)
            for (uint32_t i = 0; i < ld; i++) {
                jac[0][(a * d + k) * ld + i] = fluid->density * in[1][(a * d + k) * ld + i];
                jac[1][(a * d * d + a * d + k) * ld + i] = fluid->density * in[0][k * ld + i];
            }
    return PF_OK;
}

static int scaled_jacobian(const pf_batch *b, const double *const *in, double *const *jac, double factor)
{
    jacobian(b, in, jac);
    for (uint32_t i = 0; i < b->dim * b->dim * b->ld; i++)
        jac[0][i] *= factor;
    return PF_OK;
}

static int sign_jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    return scaled_jacobian(b, in, jac, -1);
}

static int factor_jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    return scaled_jacobian(b, in, jac, 2);
}

static int missing_jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    return scaled_jacobian(b, in, jac, 0);
}

static int nan_jacobian_jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    jacobian(b, in, jac);
    jac[0][1] = (in[0][1] - in[0][1]) / (in[0][1] - in[0][1]);
    return PF_OK;
}

/* du_k/dx_a instead of du_a/dx_k */
static int transpose_jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    const struct fluid *fluid = b->params;
    const uint32_t d = b->dim, ld = b->ld;

    jacobian(b, in, jac);
    for (uint32_t a = 0; a < d; a++)
        for (uint32_t k = 0; k < d; k++)
            for (uint32_t i = 0; i < ld; i++)
                jac[0][(a * d + k) * ld + i] = fluid->density * in[1][(k * d + a) * ld + i];
    return PF_OK;
}

/* The derivative to du_k/dx_a where that to du_a/dx_k belongs. */
static int exchanged_jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    const struct fluid *fluid = b->params;
    const uint32_t d = b->dim, ld = b->ld;

    jacobian(b, in, jac);
    memset(jac[1], 0, d * d * d * ld * sizeof(double));
    for (uint32_t a = 0; a < d; a++)
        for (uint32_t k = 0; k < d; k++)
            for (uint32_t i = 0; i < ld; i++)
                jac[1][(a * d * d + k * d + a) * ld + i] = fluid->density * in[0][k * ld + i];
    return PF_OK;
}

/* Only the rows of the first component. */
static int incomplete_jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    const uint32_t row = b->dim * b->dim * b->ld;

    jacobian(b, in, jac);
    memset(jac[1] + row, 0, (b->dim - 1) * row * sizeof(double));
    return PF_OK;
}

static int failing_jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    jacobian(b, in, jac);
    return host->fail(b, 0, PF_FAIL, "no derivative at %d", 1);
}

static int crashing_jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    jacobian(b, in, jac);
    if (!jac[2]) /* the block of the data slot, which is no unknown: to write there is to crash */
        point_at_nothing();
    return PF_OK;
}

/* --- complex twins --- */

static int different_twin(const pf_batch *b, const pf_complex *const *in, pf_complex *const *out)
{
    convection_complex(b, in, out);
    out[0][0] *= 1.001;
    return PF_OK;
}

static int nan_twin_twin(const pf_batch *b, const pf_complex *const *in, pf_complex *const *out)
{
    convection_complex(b, in, out);
    out[0][0] = (in[0][0] - in[0][0]) / (in[0][0] - in[0][0]);
    return PF_OK;
}

static int failing_twin_twin(const pf_batch *b, const pf_complex *const *in, pf_complex *const *out)
{
    convection_complex(b, in, out);
    return PF_FAIL;
}

static int crashing_twin_twin(const pf_batch *b, const pf_complex *const *in, pf_complex *const *out)
{
    convection_complex(b, in, out);
    point_at_nothing();
    return PF_OK;
}

/* Right for real numbers, but the imaginary part does not carry the derivative. */
static int not_analytic_twin(const pf_batch *b, const pf_complex *const *in, pf_complex *const *out)
{
    convection_complex(b, in, out);
    for (uint32_t i = 0; i < b->dim * b->ld; i++)
        out[0][i] = __builtin_creal(out[0][i]);
    return PF_OK;
}
