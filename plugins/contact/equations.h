/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Short-range repulsion (Glowinski et al. 1999): what happens to one body of a near pair.  n points
 * from the other to the body. */

/* -F0 (1 - gap / range)^2 n . V  for gap < range,  F0 = strength |rho_P - rho_f| |g| size^dim */
static int F(repulsion)(const pf_batch *b, const NUM *const *in, NUM *const *out)
{
    const struct contact *c = b->params;
    NUM *restrict V = out[0];
    double g = 0;

    (void)in;
    for (uint32_t a = 0; a < b->dim; a++)
        g += c->gravity[a] * c->gravity[a];
    for (uint32_t a = 0; a < b->dim; a++)
        PF_LANES_OF (b, i) {
            const double size = b->size_of[i], range = c->range > 0 ? c->range : 0.2 * size;
            const double weight =
                fabs(b->density[i] - c->density) * sqrt(g) * (b->dim == 2 ? size * size : size * size * size);
            const double s = 1 - b->gap[i] / range, force = c->force > 0 ? c->force : c->strength * weight;

            V[a * LD + i] = s > 0 ? -force * s * s * b->normal[a * LD + i] : 0;
        }
    return PF_OK;
}
