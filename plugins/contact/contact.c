/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What keeps bodies apart where the mesh no longer resolves the film between them: a repulsive force
 * of short range and the viscous resistance of the film, between the bodies of a near pair or a body and a wall.
 * n points from the other to the first; V is what the test function of the first has more than that of the other,
 * so that what one gets the other gives. */
#include <plugflow/term.h>

#define PI 3.14159265358979323846

#define FORCE_KEYS                                                                                                 \
    DENSITY, GRAVITY, REAL(range, "m", "gap at which the force begins; 0: a fifth of the body", PF_NOT_NEGATIVE),  \
        REAL(strength, "1", "force at contact, in units of the weight under water of a box round the body",        \
             .dflt = 5, PF_NOT_NEGATIVE),                                                                          \
        REAL(force, "N", "force at contact, instead of strength", PF_NOT_NEGATIVE)
#define FILM_KEYS                                                                                                  \
    VISCOSITY,                                                                                                     \
        REAL(range, "1", "gap below which the mesh does not resolve the film, in cells", .dflt = 2,                \
             PF_NOT_NEGATIVE),                                                                                     \
        REAL(floor, "1", "gap below which the resistance grows no more (roughness), in cells", .dflt = 0.1,        \
             .min = 1e-6, .max = 1e30)

/* -F0 (1 - gap / range)^2 n . V  for gap < range,  F0 = strength |rho_P - rho_f| |g| size^dim of the heavier one */
TERM(repulsion, PF_PAIR, IN(), OUT(SLOT(V, U, DEFECT, VECTOR)), PARAMS(FORCE_KEYS), .flags = PF_LINEAR,
     .reach = repulsion_reach, .doc = "-F_0(1-\\mathrm{gap}/\\mathrm{range})^2\\,n\\cdot V",
     .cite = "Glowinski et al. 1999, Int. J. Multiphase Flow 25:755")
{
    double g = 0;

    EACH (a)
        g += gravity[a] * gravity[a];
    LANES (i) {
        const double begins = range > 0 ? range : 0.2 * min(b->size_of[i], b->other_size[i]);
        const double s = max(1 - b->gap[i] / begins, 0);
        const double first = fabs(b->density[i] - density) * pow(b->size_of[i], DIM);
        const double other =
            b->other_density[i] > 0 ? fabs(b->other_density[i] - density) * pow(b->other_size[i], DIM) : 0;
        const double F0 = force > 0 ? force : strength * sqrt(g) * max(first, other);

        EACH (a)
            V[a][i] = -F0 * s * s * AT(b->normal, a);
    }
}

REACH(repulsion, PARAMS(FORCE_KEYS))
{
    return range > 0 ? range : 0.2 * size;
}

/* c (U . n) (V . n),  U the velocity of approach (a wall has R_j = inf), R = R_i R_j / (R_i + R_j),
 *
 *     c = 6 pi mu R^2 (1/gap - 1/range) of spheres,
 *     c = 3 sqrt(2) pi mu ((R/gap)^3/2 - (R/range)^3/2) of cylinders, per length */
TERM(lubrication, PF_PAIR, IN(SLOT(U, U, DEFECT, VECTOR), mu), OUT(SLOT(V, U, DEFECT, VECTOR)), PARAMS(FILM_KEYS),
     .flags = PF_LINEAR | PF_OPTIONAL, .reach = lubrication_reach,
     .doc = "6\\pi\\mu R^2\\left(\\frac1{\\mathrm{gap}}-\\frac1{\\mathrm{range}}\\right)(U\\cdot n)(V\\cdot n)"
            "\\ \\text{(3D)},\\ R=\\frac{R_iR_j}{R_i+R_j}",
     .cite =
         "Kim and Karrila 1991, Microhydrodynamics, ch. 9; 2D: Jeffrey and Onishi 1981, Q. J. Mech. Appl. Math. "
         "34:129")
{
    LANES (i) {
        const double R = 0.5 * b->size_of[i] / (1 + b->size_of[i] / b->other_size[i]);
        const double near = R / max(b->gap[i], floor * b->h[i]), far = R / (range * b->h[i]);
        const NUM c = DIM == 2 ? 3 * sqrt(2) * PI * mu[i] * (near * sqrt(near) - far * sqrt(far))
                               : 6 * PI * mu[i] * R * (near - far);
        NUM U_n = 0;

        EACH (a)
            U_n += U[a][i] * AT(b->normal, a);
        EACH (a)
            V[a][i] = near > far ? c * U_n * AT(b->normal, a) : 0;
    }
}

REACH(lubrication, PARAMS(FILM_KEYS))
{
    return range * h;
}

PLUGIN(contact, "short-range forces between bodies and walls", FIELDS(U), TERMS(repulsion, lubrication),
       .author = "plugflow", .license = "GPL-3.0-or-later")
#include PF_TWIN
