/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Generalised Newtonian fluids: a viscosity that depends on the shear rate, g^2 = 2 D(u):D(u).
 *
 *     power_law   mu = K g^(n-1)
 *     carreau     mu = mu_inf + (mu_0 - mu_inf) (1 + (t g)^2)^((n-1)/2)
 *     cross       mu = mu_inf + (mu_0 - mu_inf) / (1 + (t g)^(1-n))
 *     bingham     mu = mu_p + tau_y (1 - exp(-m g)) / g            (Papanastasiou)
 *
 * It publishes "viscosity"; whatever takes it (momentum.viscous, surface.nitsche, ...) has this one and no other.
 */
#include <plugflow/term.h>

#define KEYS                                                                                                       \
    CHOICE(law, "which law", "power_law", "carreau", "cross", "bingham"),                                          \
        REAL(consistency, "Pa s^n", "K of the power law", .min = 0, .max = 1e30),                                  \
        REAL(exponent, "1", "n; below 1 the fluid gets thinner by shear", .dflt = 1, .min = 0.05, .max = 5),       \
        REAL(zero_shear_viscosity, "Pa s", "mu_0 of carreau and cross", .min = 0, .max = 1e30),                    \
        REAL(infinite_shear_viscosity, "Pa s", "mu_inf of carreau and cross", .min = 0, .max = 1e30),              \
        REAL(time_constant, "s", "t of carreau and cross", .min = 0, .max = 1e30),                                 \
        REAL(plastic_viscosity, "Pa s", "mu_p of bingham", .min = 0, .max = 1e30),                                 \
        REAL(yield_stress, "Pa", "tau_y of bingham", .min = 0, .max = 1e30),                                       \
        REAL(regularisation, "s", "m of bingham: solid below shear rates of about 1/m", .dflt = 1000,              \
             .min = 1e-10, .max = 1e30),                                                                           \
        REAL(least_rate, "1/s", "added to the shear rate, as squares, so that rest has a viscosity", .dflt = 1e-6, \
             .min = 1e-30, .max = 1e30)

#if PF_ONCE
enum { POWER_LAW, CARREAU, CROSS, BINGHAM };
#endif

/* (1 - exp(-x)) / x */
static inline NUM F(fall)(NUM x)
{
    return creal(x) < 1e-2 ? 1 - x / 2 * (1 - x / 3 * (1 - x / 4 * (1 - x / 5))) : (1 - exp(-x)) / x;
}

TERM(law, PF_FLUID, IN(grad_u), OUT(mu), PARAMS(KEYS), .doc = "\\mu(\\dot\\gamma),\\ \\dot\\gamma^2=2D(u):D(u)",
     .cite = "Bird, Armstrong, Hassager (1987), 4.1; Papanastasiou 1987, J. Rheol. 31:385", .check = law_check,
     .jacobian = law_jacobian,
     PF_EXAMPLES({"power law, K = 2, n = 0.5: grad u = (0 3; 1 0), rate 4", 2,
                  (double[]){0, 2, 0.5, 0, 0, 0, 0, 0, 1, 1e-9}, (double[]){0, 3, 1, 0}, (double[]){1}, 1e-12},
                 {"carreau, mu_0 = 3, mu_inf = 1, t = 0.75, n = 0.5: 1 + 2 10^(-1/4)", 2,
                  (double[]){1, 0, 0.5, 3, 1, 0.75, 0, 0, 1, 1e-9}, (double[]){0, 3, 1, 0},
                  (double[]){2.1246826503806982}, 1e-12},
                 {"cross, mu_0 = 3, mu_inf = 1, t = 1, n = 0.5: 1 + 2/(1 + 2)", 2,
                  (double[]){2, 0, 0.5, 3, 1, 1, 0, 0, 1, 1e-9}, (double[]){0, 3, 1, 0}, (double[]){5.0 / 3},
                  1e-12},
                 {"bingham, mu_p = 2, tau_y = 3, m = 100: 2 + 3/4", 2,
                  (double[]){3, 0, 1, 0, 0, 0, 2, 3, 100, 1e-9}, (double[]){0, 3, 1, 0}, (double[]){2.75}, 1e-12}))
{
    const double jump = zero_shear_viscosity - infinite_shear_viscosity, t2 = time_constant * time_constant;

    LANES (i) {
        NUM rate2 = least_rate * least_rate;

        EACH (a)
            EACH (k)
                rate2 += 0.5 * (grad_u[a][k][i] + grad_u[k][a][i]) * (grad_u[a][k][i] + grad_u[k][a][i]);
        if (law == POWER_LAW)
            mu[i] = consistency * pow(rate2, 0.5 * (exponent - 1));
        else if (law == CARREAU)
            mu[i] = infinite_shear_viscosity + jump * pow(1 + t2 * rate2, 0.5 * (exponent - 1));
        else if (law == CROSS)
            mu[i] = infinite_shear_viscosity + jump / (1 + pow(t2 * rate2, 0.5 * (1 - exponent)));
        else
            mu[i] = plastic_viscosity + yield_stress * regularisation * F(fall)(regularisation * sqrt(rate2));
    }
}

/* With s = grad u + (grad u)^T:  d g^2 / d grad u = 2 s. */
JACOBIAN(law, IN(grad_u), PARAMS(KEYS), BLOCKS(BLOCK(mu, grad_u)))
{
    const double jump = zero_shear_viscosity - infinite_shear_viscosity, t2 = time_constant * time_constant;

    LANES (i) {
        double rate2 = least_rate * least_rate, slope; /* d mu / d g^2 */

        EACH (a)
            EACH (k)
                rate2 += 0.5 * (grad_u[a][k][i] + grad_u[k][a][i]) * (grad_u[a][k][i] + grad_u[k][a][i]);
        if (law == POWER_LAW) {
            slope = consistency * 0.5 * (exponent - 1) * pow(rate2, 0.5 * (exponent - 3));
        } else if (law == CARREAU) {
            slope = jump * 0.5 * (exponent - 1) * t2 * pow(1 + t2 * rate2, 0.5 * (exponent - 3));
        } else if (law == CROSS) {
            const double x = pow(t2 * rate2, 0.5 * (1 - exponent));

            slope = -jump * x * 0.5 * (1 - exponent) / (rate2 * (1 + x) * (1 + x));
        } else {
            const double x = regularisation * sqrt(rate2);
            const double bend = x < 1e-2 ? -0.5 + x / 3 * (1 - 3 * x / 8 * (1 - 4 * x / 15))
                                         : ((1 + x) * exp(-x) - 1) / (x * x); /* d fall / dx */

            slope = yield_stress * regularisation * regularisation * regularisation * bend / (2 * x);
        }
        EACH (a)
            EACH (k)
                dmu_dgrad_u[a][k][i] = 2 * slope * (grad_u[a][k][i] + grad_u[k][a][i]);
    }
}

#if PF_ONCE
int law_check(const void *params, char *err, size_t nerr)
{
    const struct law_params *p = params;
    const char *lacks = p->law == POWER_LAW ? (p->consistency > 0 ? NULL : "consistency")
                        : p->law == BINGHAM ? (p->plastic_viscosity > 0 ? NULL : "plastic_viscosity")
                                            : (p->zero_shear_viscosity > 0 ? NULL : "zero_shear_viscosity");

    if (lacks)
        snprintf(err, nerr, "this law needs \"%s\", a positive number", lacks);
    return lacks != NULL;
}
#endif

PLUGIN(generalised_newtonian, "viscosity that depends on the shear rate", FIELDS(u), TERMS(law),
       .author = "plugflow", .license = "GPL-3.0-or-later")
#include PF_TWIN
