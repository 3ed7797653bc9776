/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Memory (interface 1.4): strain that adds up, a structure that shear breaks and rest restores, the largest shear
 * so far, and what nothing changes, in the fluid and inside of bodies. */
#include <plugflow/term.h>

static inline NUM F(rate_of)(const NUM *grad_u, const pf_batch *b, uint32_t i)
{
    NUM rate2 = 0;

    EACH (a)
        EACH (k)
            rate2 += 0.5 * pow(AT(grad_u, a, k) + AT(grad_u, k, a), 2);
    return sqrt(rate2 + 1e-300);
}

TERM(strain, PF_FLUID, IN(grad_u, STATE(old_strain, strain, SCALAR), STATE(old_total, total, SYMMETRIC)),
     OUT(STATE(strain, strain, SCALAR), STATE(total, total, SYMMETRIC)),
     PARAMS(REAL(longest, "s", "longest step", .dflt = 1e300)), .doc = "\\dot\\gamma_s=\\dot\\gamma",
     .cite = "definition")
{
    LANES (i) {
        if (b->dt > longest)
            FAIL(PF_RETRY, "a step of %g is too long", b->dt);
        strain[i] = old_strain[i] + b->dt * F(rate_of)(grad_u[0][0], b, i);
    }
    for (uint32_t a = 0, c = 0; a < DIM; a++)
        for (uint32_t k = a; k < DIM; k++, c++)
            LANES (i)
                total[c][i] = old_total[c][i] + 0.5 * b->dt * (grad_u[a][k][i] + grad_u[k][a][i]);
}

/* l = (l_old + dt a) / (1 + dt (a + b rate)); stress mu_s l (grad u + grad u^T) */
TERM(structure, PF_FLUID, IN(grad_u, STATE(old_structure, structure, SCALAR)),
     OUT(grad_v, STATE(structure, structure, SCALAR)),
     PARAMS(REAL(builds, "1/s", "a", .dflt = 1), REAL(breaks, "1", "b", .dflt = 1), REAL(mu_s, "Pa s", "mu_s")),
     .flags = PF_OPTIONAL,
     .doc = "\\mu_s\\lambda\\,2D:\\nabla v,\\ \\dot\\lambda=a(1-\\lambda)-b\\lambda\\dot\\gamma",
     .cite = "Moore 1959")
{
    LANES (i) {
        const NUM l =
            (old_structure[i] + b->dt * builds) / (1 + b->dt * (builds + breaks * F(rate_of)(grad_u[0][0], b, i)));

        structure[i] = l;
        EACH (a)
            EACH (k)
                grad_v[a][k][i] = mu_s * l * (grad_u[a][k][i] + grad_u[k][a][i]);
    }
}

/* the same as a law, with the structure at the end of the last step */
TERM(law, PF_CELL, IN(STATE(old_structure, structure, SCALAR)), OUT(PROPERTY(viscosity, "Pa s", "viscosity")),
     PARAMS(REAL(mu_0, "Pa s", "mu_0", .dflt = 0.5), REAL(mu_s, "Pa s", "mu_s", .dflt = 3)), .flags = PF_OPTIONAL,
     .doc = "\\mu=\\mu_0+\\mu_s\\lambda", .cite = "Moore 1959")
{
    LANES (i)
        viscosity[i] = mu_0 + mu_s * old_structure[i];
}

TERM(peak, PF_CELL, IN(grad_u, STATE(old_peak, peak, SCALAR)), OUT(STATE(peak, peak, SCALAR)), PARAMS(),
     .flags = PF_OPTIONAL, .doc = "\\max\\dot\\gamma", .cite = "definition")
{
    LANES (i)
        peak[i] = max(old_peak[i], F(rate_of)(grad_u[0][0], b, i));
}

TERM(mark, PF_FLUID, IN(STATE(old_mark, mark, SCALAR)), OUT(STATE(mark, mark, SCALAR)), PARAMS(),
     .flags = PF_OPTIONAL, .doc = "\\dot m=0", .cite = "definition")
{
    LANES (i)
        mark[i] = old_mark[i];
}

TERM(brand, PF_SOLID, IN(STATE(old_brand, brand, SCALAR)), OUT(STATE(brand, brand, SCALAR)), PARAMS(),
     .flags = PF_OPTIONAL, .doc = "\\dot m=0", .cite = "definition")
{
    LANES (i)
        brand[i] = old_brand[i];
}

/* of a body: the way that it has gone, and the largest force of the fluid up to the last step */
TERM(odometer, PF_PARTICLE, IN(U, STATE(old_way, way, SCALAR), STATE(old_most, most, SCALAR)),
     OUT(STATE(way, way, SCALAR), STATE(most, most, SCALAR)), PARAMS(), .flags = PF_OPTIONAL,
     .doc = "\\dot s=|U|,\\ \\max|F|", .cite = "definition")
{
    LANES (i) {
        NUM speed2 = 1e-300;
        double force2 = 0;

        EACH (a) {
            speed2 += U[a][i] * U[a][i];
            force2 += AT(b->fluid_force, a) * AT(b->fluid_force, a);
        }
        way[i] = old_way[i] + b->dt * sqrt(speed2);
        most[i] = max(old_most[i], sqrt(force2));
    }
}

#define PF_SHAPE_way       SCALAR
#define PF_SHAPE_most      SCALAR
#define PF_SHAPE_strain    SCALAR
#define PF_SHAPE_total     SYMMETRIC
#define PF_SHAPE_structure SCALAR
#define PF_SHAPE_peak      SCALAR
#define PF_SHAPE_mark      SCALAR
#define PF_SHAPE_brand     SCALAR
#define AT_POINTS          .support = PF_AT_POINTS
PLUGIN(memory, "what fluids remember",
       FIELDS(u, U, FIELD(strain, "1", "strain that has added up", AT_POINTS),
              FIELD(total, "1", "the same of the tensor", AT_POINTS), FIELD(structure, "1", "structure", AT_POINTS),
              FIELD(peak, "1/s", "largest rate of shear so far", AT_POINTS), FIELD(mark, "1", "mark", AT_POINTS),
              FIELD(way, "m", "way that it has gone", .support = PF_KEPT_BY_PARTICLE),
              FIELD(most, "N", "largest force so far", .support = PF_KEPT_BY_PARTICLE),
              FIELD(brand, "1", "mark of bodies", AT_POINTS)),
       TERMS(strain, structure, law, peak, mark, brand, odometer), .author = "plugflow")
#include PF_TWIN
