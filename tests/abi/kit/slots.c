/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Slots of term.h that no other plugin here has: symmetric tensors with a Jacobian by hand, a published property,
 * Laplacians by their names, keys and fields of both bodies of a pair. */
#include <plugflow/term.h>

#define PF_SHAPE_tau SYMMETRIC

/* (tau + lap tau / 100) : w + (tau . x) . grad-like, each kind of block that a symmetric tensor has */
TERM(relax, PF_FLUID, IN(VALUE(tau), GRAD(tau), grad_u), OUT(TEST(tau, w), GRAD_TEST(tau, w), grad_v), PARAMS(),
     .jacobian = relax_jacobian, .doc = "\\tau:w+\\nabla\\tau:\\nabla w+\\tau:\\nabla v", .cite = "none")
{
    LANES (i) {
        EACH (a)
            EACH (k) {
                w[AT_SYM(a, k)][i] = tau[AT_SYM(a, k)][i] - grad_u[a][k][i] - grad_u[k][a][i];
                grad_v[a][k][i] = (1.0 + a) * tau[AT_SYM(a, k)][i];
            }
        EACH_SYM(n)
        EACH (l)
            grad_w[n][l][i] = (1.0 + n) * grad_tau[n][l][i];
    }
}

JACOBIAN(relax, IN(VALUE(tau), GRAD(tau), grad_u), PARAMS(),
         BLOCKS(BLOCK(TEST(tau, w), VALUE(tau)), BLOCK(TEST(tau, w), grad_u), BLOCK(grad_v, VALUE(tau)),
                BLOCK(GRAD_TEST(tau, w), GRAD(tau))))
{
    LANES (i) {
        EACH_SYM(n)
        dw_dtau[n][n][i] = 1;
        EACH (a)
            EACH (k) {
                dgrad_v_dtau[a][k][AT_SYM(a, k)][i] = 1.0 + a;
                if (a > k)
                    continue;
                dw_dgrad_u[AT_SYM(a, k)][a][k][i] -= 1;
                dw_dgrad_u[AT_SYM(a, k)][k][a][i] -= 1;
            }
        EACH_SYM(n)
        EACH (l)
            dgrad_w_dgrad_tau[n][l][n][l][i] = 1.0 + n;
    }
}

TERM(law, PF_FLUID, IN(grad_u), OUT(PROPERTY(viscosity, "Pa s", "dynamic viscosity", .min = 0, .max = 1e9)),
     PARAMS(), .flags = PF_OPTIONAL, .doc = "\\mu=1+|\\nabla u|^2", .cite = "none")
{
    LANES (i)
        viscosity[i] = 1;
    EACH (a)
        EACH (k)
            LANES (i)
                viscosity[i] += grad_u[a][k][i] * grad_u[a][k][i];
}

TERM(smooth, PF_FLUID, IN(lap_phi, lap_p), OUT(test_phi), PARAMS(), .flags = PF_OPTIONAL | PF_LINEAR,
     .doc = "-(\\Delta\\phi+\\Delta p)\\psi", .cite = "none")
{
    LANES (i)
        test_phi[i] = -lap_phi[i] - lap_p[i];
}

TERM(pull, PF_PAIR,
     IN(BODY_KEY(charge, "C", "charge"), OTHER_KEY(charge), BODY_KEY_VECTOR(moment, "A m^2", "moment"),
        OTHER_KEY_VECTOR(moment), U, OTHER(U)),
     OUT(V, OTHER_TEST(U, V)), PARAMS(), .flags = PF_OPTIONAL, .doc = "pull", .cite = "none")
{
    EACH (a)
        LANES (i) {
            V[a][i] = charge[i] * other_charge[i] * AT(b->normal, a) + moment[a][i] * other_U[a][i];
            other_V[a][i] = other_moment[a][i] * U[a][i] * U[a][i];
        }
}

PLUGIN(slots, "slots of term.h", FIELDS(u, p, phi, U, FIELD(tau, "Pa", "stress", .order = 1)),
       TERMS(relax, law, smooth, pull), .author = "plugflow")
#include PF_TWIN
