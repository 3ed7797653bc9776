/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The quantities at a point. */

#define ARGUMENTS const pf_batch *b, const double *const *in, double *const *out

/* a_ik + a_ki of lane i: 2 D(u) of grad u */
static inline double twice_strain(const pf_batch *b, const double *grad_u, uint32_t a, uint32_t k, uint32_t i)
{
    return grad_u[(a * b->dim + k) * LD + i] + grad_u[(k * b->dim + a) * LD + i];
}

/* 2 D : D = 1/2 (2 D) : (2 D) */
static void strain_squared(const pf_batch *b, const double *grad_u, double *restrict to)
{
    PF_LANES_OF (b, i)
        to[i] = 0;
    for (uint32_t a = 0; a < b->dim; a++)
        for (uint32_t k = 0; k < b->dim; k++)
            PF_LANES_OF (b, i) {
                const double e = twice_strain(b, grad_u, a, k, i);

                to[i] += 0.5 * e * e;
            }
}

static int shear_rate(ARGUMENTS)
{
    strain_squared(b, in[0], out[0]);
    PF_LANES_OF (b, i)
        out[0][i] = sqrt(out[0][i]);
    return PF_OK;
}

static int dissipation(ARGUMENTS)
{
    const double *restrict mu = in[1];

    strain_squared(b, in[0], out[0]);
    PF_LANES_OF (b, i)
        out[1][i] = out[0][i] *= mu[i];
    return PF_OK;
}

/* d u_y / dx - d u_x / dy; in 3D component a is d u_{a+2} / d x_{a+1} - d u_{a+1} / d x_{a+2} */
static void curl(const pf_batch *b, const double *restrict grad_u, double *restrict to)
{
    const uint32_t d = b->dim, n = d == 2 ? 1 : 3;

    for (uint32_t a = 0; a < n; a++) {
        const uint32_t p = d == 2 ? 0 : (a + 1) % 3, q = d == 2 ? 1 : (a + 2) % 3;

        PF_LANES_OF (b, i)
            to[a * LD + i] = grad_u[(q * d + p) * LD + i] - grad_u[(p * d + q) * LD + i];
    }
}

static int vorticity(ARGUMENTS)
{
    curl(b, in[0], out[0]);
    return PF_OK;
}

static int enstrophy(ARGUMENTS)
{
    const uint32_t d = b->dim;

    PF_LANES_OF (b, i)
        out[0][i] = 0;
    for (uint32_t p = 0; p < d; p++)
        for (uint32_t q = p + 1; q < d; q++)
            PF_LANES_OF (b, i) {
                const double w = in[0][(q * d + p) * LD + i] - in[0][(p * d + q) * LD + i];

                out[0][i] += 0.5 * w * w;
            }
    return PF_OK;
}

static int kinetic_energy(ARGUMENTS)
{
    const double *restrict rho = in[1];

    PF_LANES_OF (b, i)
        out[0][i] = 0;
    for (uint32_t a = 0; a < b->dim; a++)
        PF_LANES_OF (b, i)
            out[0][i] += 0.5 * rho[i] * in[0][a * LD + i] * in[0][a * LD + i];
    return PF_OK;
}

/* a . n */
static void through(const pf_batch *b, const double *restrict a, double factor, double *restrict to)
{
    PF_LANES_OF (b, i)
        to[i] = 0;
    for (uint32_t k = 0; k < b->dim; k++)
        PF_LANES_OF (b, i)
            to[i] += factor * a[k * LD + i] * b->normal[k * LD + i];
}

static int flow_rate(ARGUMENTS)
{
    through(b, in[0], 1, out[0]);
    return PF_OK;
}

static int heat_flux(ARGUMENTS)
{
    const conductor *c = b->params;

    through(b, in[0], -c->conductivity, out[0]);
    return PF_OK;
}

/* The true pressure at lane i: a reduced one is without rho g.x. */
static inline double true_pressure(const pf_batch *b, const double *p, uint32_t i)
{
    const pf_fluid *f = b->params;
    double sum = p[i];

    for (uint32_t k = 0; f->reduced_pressure && k < b->dim; k++)
        sum += f->density * f->gravity[k] * b->x[k * LD + i];
    return sum;
}

static int mean_pressure(ARGUMENTS)
{
    PF_LANES_OF (b, i) {
        out[0][i] = true_pressure(b, in[0], i);
        out[1][i] = 1;
    }
    return PF_OK;
}

/* -2 mu D n */
static void shear(const pf_batch *b, const double *grad_u, const double *restrict mu, double *restrict to)
{
    for (uint32_t a = 0; a < b->dim; a++) {
        PF_LANES_OF (b, i)
            to[a * LD + i] = 0;
        for (uint32_t k = 0; k < b->dim; k++)
            PF_LANES_OF (b, i)
                to[a * LD + i] -= mu[i] * twice_strain(b, grad_u, a, k, i) * b->normal[k * LD + i];
    }
}

/* -(2 mu D - p) n of grad u, mu, p */
static void traction(const pf_batch *b, const double *const *in, double *restrict to)
{
    const double *p = in[2];

    shear(b, in[0], in[1], to);
    PF_LANES_OF (b, i) {
        const double pressure = true_pressure(b, p, i);

        for (uint32_t a = 0; a < b->dim; a++)
            to[a * LD + i] += pressure * b->normal[a * LD + i];
    }
}

static int wall_force(ARGUMENTS)
{
    traction(b, in, out[0]);
    return PF_OK;
}

static int wall_shear(ARGUMENTS)
{
    double *restrict t = out[0];

    shear(b, in[0], in[1], t);
    PF_LANES_OF (b, i) {
        double normal = 0;

        for (uint32_t a = 0; a < b->dim; a++)
            normal += t[a * LD + i] * b->normal[a * LD + i];
        for (uint32_t a = 0; a < b->dim; a++)
            t[a * LD + i] -= normal * b->normal[a * LD + i];
    }
    return PF_OK;
}

static int surface_force(ARGUMENTS)
{
    const uint32_t d = b->dim, n = d == 2 ? 1 : 3;
    const double *f = out[0];

    traction(b, in, out[0]);
    for (uint32_t a = 0; a < n; a++) {
        const uint32_t p = d == 2 ? 0 : (a + 1) % 3, q = d == 2 ? 1 : (a + 2) % 3;

        PF_LANES_OF (b, i)
            out[1][a * LD + i] = b->arm[p * LD + i] * f[q * LD + i] - b->arm[q * LD + i] * f[p * LD + i];
    }
    return PF_OK;
}

static int surface_area(ARGUMENTS)
{
    (void)in;
    PF_LANES_OF (b, i)
        out[0][i] = 1;
    return PF_OK;
}

static int covered_volume(ARGUMENTS)
{
    return surface_area(b, in, out);
}
