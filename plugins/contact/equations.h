/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Short-range forces between the bodies of a near pair, or a body and a wall.  n points from the other
 * to the first; V is what the test function of the first has more than that of the other, so that what
 * one gets the other gives. */

/* -F0 (1 - gap / range)^2 n . V  for gap < range,  F0 = strength |rho_P - rho_f| |g| size^dim of the heavier one */
static int F(repulsion)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const struct contact *c = b->params;
    NUM *restrict V = out[0];

    (void)in;
    for (uint32_t a = 0; a < b->dim; a++)
        PF_LANES_OF (b, i) {
            const double range = c->range > 0 ? c->range : 0.2 * fmin(b->size_of[i], b->other_size[i]);
            const double s = fmax(1 - b->gap[i] / range, 0);

            V[a * LD + i] = -force_of(b, c, i) * s * s * b->normal[a * LD + i];
        }
    return PF_OK;
}

/* c (U . n) (V . n),  U the velocity of approach (a wall has R_j = inf), R = R_i R_j / (R_i + R_j),
 *
 *     c = 6 pi mu R^2 (1/gap - 1/range) of spheres,
 *     c = 3 sqrt(2) pi mu ((R/gap)^3/2 - (R/range)^3/2) of cylinders, per length */
static int F(lubrication)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const struct film *f = b->params;
    const NUM *restrict U = in[0], *restrict mu = in[1];
    NUM *restrict V = out[0];

    PF_LANES_OF (b, i) {
        const double R = 0.5 * b->size_of[i] / (1 + b->size_of[i] / b->other_size[i]);
        const double near = R / fmax(b->gap[i], f->floor * b->h[i]), far = R / (f->range * b->h[i]);
        const NUM c = b->dim == 2 ? 3 * sqrt(2) * PI * mu[i] * (near * sqrt(near) - far * sqrt(far))
                                  : 6 * PI * mu[i] * R * (near - far);
        NUM U_n = 0;

        for (uint32_t a = 0; a < b->dim; a++)
            U_n += U[a * LD + i] * b->normal[a * LD + i];
        for (uint32_t a = 0; a < b->dim; a++)
            V[a * LD + i] = near > far ? c * U_n * b->normal[a * LD + i] : 0;
    }
    return PF_OK;
}
