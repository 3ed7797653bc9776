/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Conservation of volume, div u = 0 (appendix A.1-A.6). */
#include <plugflow/term.h>

/* q div u; A.3-A.5 */
TERM(divergence, PF_CELL, IN(div_u), OUT(q), PARAMS(), .flags = PF_LINEAR, .jacobian = divergence_jacobian,
     .doc = "q\\,\\nabla\\cdot u", .cite = "appendix A.1-A.6",
     PF_EXAMPLES({"div u = 3", 2, NULL, (double[]){3}, (double[]){3}, 1e-15}))
{
    LANES (i)
        q[i] = div_u[i];
}

JACOBIAN(divergence, IN(div_u), PARAMS(), BLOCKS(BLOCK(q, div_u)))
{
    LANES (i)
        dq_ddiv_u[i] = 1;
}

/* eps h^2 / (mu + rho c0 h^2 / dt) grad p . grad q inside bodies (numerics 4): there div u = 0 follows from the
 * rigid motion and leaves p undetermined */
TERM(pressure_smoothing, PF_SOLID, IN(grad_p), OUT(grad_q),
     PARAMS(DENSITY, VISCOSITY,
            REAL(epsilon, "1", "strength of the smoothing; 0.02 to 0.1", .dflt = 0.05, .min = 0, .max = 10)),
     .flags = PF_LINEAR | PF_OPTIONAL, .doc = "\\epsilon h^2/(\\mu+\\rho h^2/\\Delta t)\\,\\nabla p\\cdot\\nabla q",
     .cite = "numerics 4")
{
    EACH (a)
        LANES (i) {
            const double h2 = b->h[i] * b->h[i];

            grad_q[a][i] = epsilon * h2 / (viscosity + density * h2 * b->shift) * grad_p[a][i];
        }
}

PLUGIN(continuity, "conservation of volume", FIELDS(u, p), TERMS(divergence, pressure_smoothing), .min_minor = 0,
       .author = "plugflow", .license = "GPL-3.0-or-later")
#include PF_TWIN
