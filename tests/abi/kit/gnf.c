/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A generalised Newtonian fluid on term.h: power law and Carreau, in place of momentum's stress. */
#include <plugflow/term.h>

#define POWER_LAW 0
#define CARREAU   1

#define KEYS                                                                                                       \
    CHOICE(model, "viscosity law", "power_law", "carreau"),                                                        \
        REAL(consistency, "Pa s^n", "K of K rate^(n-1)", .dflt = 1, PF_NOT_NEGATIVE),                              \
        REAL(n, "1", "exponent", .dflt = 1, .min = 0, .max = 10),                                                  \
        REAL(eps, "1/s", "rate that regularises", .dflt = 1e-4, PF_NOT_NEGATIVE),                                  \
        REAL(mu_0, "Pa s", "viscosity at rest", .dflt = 1, PF_NOT_NEGATIVE),                                       \
        REAL(mu_inf, "Pa s", "viscosity at infinite rate", PF_NOT_NEGATIVE),                                       \
        REAL(time, "s", "time constant", .dflt = 1, PF_NOT_NEGATIVE)

/* (2 mu(rate) D - p I) : grad v,   rate^2 = 2 D : D + eps^2 */
TERM(stress, PF_FLUID, IN(grad_u, p), OUT(grad_v), PARAMS(KEYS), .check = stress_check,
     .doc = "(2\\mu(\\dot\\gamma)D(u)-pI):\\nabla v", .cite = "Bird, Armstrong, Hassager 1987",
     PF_EXAMPLES({"power law, shear 3: mu = 2*3", 2, (double[]){0, 2, 2, 0, 1, 0, 1}, (double[]){0, 3, 0, 0, 7},
                  (double[]){-7, 18, 18, -7}, 1e-14},
                 {"Carreau, time 1, shear sqrt 3: mu = 1 + 4/2", 2, (double[]){1, 2, 0, 0, 5, 1, 1},
                  (double[]){0, 1.7320508075688772, 0, 0, 0},
                  (double[]){0, 3 * 1.7320508075688772, 3 * 1.7320508075688772, 0}, 1e-14}))
{
    LANES (i) {
        NUM rate2 = eps * eps, mu;

        EACH (a)
            EACH (k)
                rate2 += 0.5 * pow(grad_u[a][k][i] + grad_u[k][a][i], 2);
        if (model == POWER_LAW)
            mu = consistency * pow(rate2, 0.5 * (n - 1));
        else
            mu = mu_inf + (mu_0 - mu_inf) * pow(1 + time * time * rate2, 0.5 * (n - 1));
        EACH (a)
            EACH (k)
                grad_v[a][k][i] = mu * (grad_u[a][k][i] + grad_u[k][a][i]) - (a == k ? p[i] : 0);
    }
}

CHECK(stress, PARAMS(KEYS))
{
    REFUSE_UNLESS(model != POWER_LAW || consistency > 0, "power_law needs consistency > 0");
    REFUSE_UNLESS(model != CARREAU || mu_0 > 0, "carreau needs mu_0 > 0");
}

PLUGIN(gnf, "generalised Newtonian stress", FIELDS(u, p), TERMS(stress), .author = "plugflow")
#include PF_TWIN
