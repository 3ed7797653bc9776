/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Dilute polymers in a viscous fluid (Oldroyd-B), in the plane:
 *
 *     tau_p = eta_p/lambda (c - I),     dc/dt + (u . grad) c - L c - c L^T = -(c - I)/lambda,     L = grad u,
 *
 * beside the solvent, whose viscosity is that of momentum.  The unknown is psi = log c, so that c is positive
 * definite whatever the mesh; its equation, without a decomposition of grad u that is singular where eigenvalues
 * are equal, is that of Knechtges et al. (2014), equivalent to Fattal and Kupferman's.  In space eigenvectors are
 * needed that no function of this kind gives, hence the plane only. */
#include <plugflow/fluid.h>

#include <tgmath.h>

struct polymer {
    double relaxation_time;   /* lambda, s                       */
    double polymer_viscosity; /* eta_p, Pa s                     */
    double streamline;        /* strength of the upwinding       */
    double g_psi;             /* tie of cells with little fluid  */
};

#define LOG_2 0.69314718055994530942

enum { PSI, PSI_T, GRAD_PSI, U, GRAD_U };

enum { SERIES = 9 }; /* terms for y < 1: the next one is below 1e-17 */
/* 2n/(2n+1)! */
static const double difference_factor[SERIES + 1] = {0,
                                                     1.0 / 3,
                                                     1.0 / 30,
                                                     1.0 / 840,
                                                     1.0 / 45360,
                                                     1.0 / 3991680,
                                                     1.0 / 518918400,
                                                     1.0 / 93405312000.0,
                                                     1.0 / 22230464256000.0,
                                                     1.0 / 6758061133824000.0};

static int only_in_the_plane(const pf_batch *b)
{
    return b->host->fail(b, 0, PF_FAIL, "this form of Oldroyd-B is for cases in two dimensions");
}

#include <plugflow/twin_real.h>
#include "equations.h"
#include <plugflow/twin_complex.h>
#include "equations.h"

#define RELAXATION                                                                                                 \
    PF_NUMBER(struct polymer, relaxation_time, "s", "time in which polymers relax",                                \
              .flags = PF_REQUIRED | PF_SHARED, .dflt = 1, .min = 1e-30, .max = 1e30)
#define VISCOSITY                                                                                                  \
    PF_NUMBER(struct polymer, polymer_viscosity, "Pa s", "what polymers add to the viscosity",                     \
              .flags = PF_REQUIRED | PF_SHARED, .dflt = 1, PF_NOT_NEGATIVE)

#define FIELD_PSI                                                                                                  \
    {                                                                                                              \
        .name = "psi", .unit = "1", .doc = "logarithm of the polymers' conformation", .shape = PF_SYMMETRIC,       \
        .order = 2                                                                                                 \
    }
#define IN_PSI                                                                                                     \
    {                                                                                                              \
        "psi", "psi", PF_VALUE, PF_SYMMETRIC                                                                       \
    }

static const pf_term stress = {
    PF_TERM(stress),
    .where = PF_FLUID,
    .flags = PF_CONTINUATION | PF_ONLY_2D,
    .doc = "\\frac{\\eta_p}{\\lambda}(e^\\psi-I):\\nabla v",
    .cite = "Oldroyd 1950, Proc. R. Soc. Lond. A 200:523",
    PF_IN(IN_PSI),
    PF_OUT({"grad_v", "u", PF_GRAD, PF_TENSOR}),
    PF_PARAMS(struct polymer, RELAXATION, VISCOSITY),
    /* eigenvalues log 4 and 0 along (1, 1) and (1, -1): c = 5/2 on the diagonal, 3/2 beside it */
    PF_EXAMPLES({"at rest, both eigenvalues are equal", 2, (double[]){2, 6}, (double[]){0, 0, 0},
                 (double[]){0, 0, 0, 0}, 1e-15},
                {"psi = log(2) I: eta_p/lambda (2 - 1)", 2, (double[]){2, 6}, (double[]){LOG_2, 0, LOG_2},
                 (double[]){3, 0, 0, 3}, 1e-15},
                {"eigenvalues of c 4 and 1 along the diagonals", 2, (double[]){2, 6},
                 (double[]){LOG_2, LOG_2, LOG_2}, (double[]){4.5, 4.5, 4.5, 4.5}, 1e-15}),
};

static const pf_term constitutive = {
    PF_TERM(constitutive),
    .where = PF_FLUID,
    .flags = PF_METRIC | PF_ONLY_2D,
    .doc = "(\\partial_t\\psi+u\\cdot\\nabla\\psi-[W,\\psi]-2f(\\mathrm{ad}\\,\\psi)D-(e^{-\\psi}-I)/\\lambda):"
           "(s+\\tau\\,u\\cdot\\nabla s)",
    .cite = "Fattal and Kupferman 2004, J. Non-Newtonian Fluid Mech. 123:281; Knechtges, Behr and Elgeti 2014, J. "
            "Non-Newtonian Fluid Mech. 214:78",
    PF_IN(IN_PSI, {"psi_t", "psi", PF_DOT, PF_SYMMETRIC}, {"grad_psi", "psi", PF_GRAD, PF_SYMMETRIC_GRAD},
          {"u", "u", PF_VALUE, PF_VECTOR}, {"grad_u", "u", PF_GRAD, PF_TENSOR}),
    PF_OUT({"s", "psi", PF_VALUE, PF_SYMMETRIC}, {"grad_s", "psi", PF_GRAD, PF_SYMMETRIC_GRAD}),
    PF_PARAMS(struct polymer, RELAXATION,
              PF_NUMBER(struct polymer, streamline, "1", "strength of the upwinding along streamlines", .dflt = 1,
                        PF_NOT_NEGATIVE)),
    PF_EXAMPLES({"at rest psi grows by 2 D, D = (3 5; 5 -3), from equal eigenvalues", 2, (double[]){2, 0},
                 (double[]){0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 3, 4, 6, -3},
                 (double[]){-6, -10, 6, 0, 0, 0, 0, 0, 0}, 1e-15},
                {"a rotation with W = (0 1; -1 0) turns psi = (1 2; 2 -1); it relaxes infinitely slowly", 2,
                 (double[]){1e30, 0}, (double[]){1, 2, -1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, -1, 0},
                 (double[]){-4, 2, 4, 0, 0, 0, 0, 0, 0}, 1e-15},
                {"psi_t = (7 8 9) and u . grad psi = 2 (1 2 3) + 3 (4 5 6); psi = log(2) I: 1/2 (1/2 - 1)", 2,
                 (double[]){2, 0}, (double[]){LOG_2, 0, LOG_2, 7, 8, 9, 1, 4, 2, 5, 3, 6, 2, 3, 0, 0, 0, 0},
                 (double[]){21.25, 27, 33.25, 0, 0, 0, 0, 0, 0}, 1e-15}),
};

static const pf_term surface = {
    PF_TERM(surface),
    .where = PF_SURFACE,
    .flags = PF_FLUID_FORCE | PF_CONTINUATION | PF_ONLY_2D,
    .doc = "-\\frac{\\eta_p}{\\lambda}(e^\\psi-I)\\,n\\cdot(v-V-\\xi\\times r)",
    .cite = "as surface.nitsche; docs/theory.md",
    PF_IN(IN_PSI),
    PF_OUT({"v", "u", PF_VALUE, PF_VECTOR}, {"V", "U", PF_VALUE, PF_VECTOR}, {"xi", "omega", PF_VALUE, PF_SPIN}),
    PF_PARAMS(struct polymer, RELAXATION, VISCOSITY),
};

static const pf_term extension = {
    PF_TERM(extension),
    .where = PF_CUT,
    .flags = PF_LINEAR,
    .doc = "g_\\psi(1/\\lambda+c_0/\\Delta t)(\\psi-E\\psi):(s-Es)",
    .cite = "Badia, Neiva and Verdugo 2022, Comput. Methods Appl. Mech. Eng. 388:114232 (weak aggregation)",
    PF_IN({"dpsi", "psi", PF_DEFECT, PF_SYMMETRIC}),
    PF_OUT({"ds", "psi", PF_DEFECT, PF_SYMMETRIC}),
    PF_PARAMS(struct polymer, RELAXATION,
              PF_NUMBER(struct polymer, g_psi, "1", "tie of the conformation, in 1/lambda + c0/dt", .dflt = 1,
                        PF_NOT_NEGATIVE)),
};

static const pf_plugin oldroyd_b = {
    PF_PLUGIN,
    .min_minor = 4,
    .name = "oldroyd_b",
    .version = "1.0",
    .author = "plugflow",
    .license = "GPL-3.0-or-later",
    .doc = "stress of dilute polymers (Oldroyd-B) by the logarithm of their conformation",
    PF_FIELDS(FIELD_PSI, PF_FIELD_VELOCITY, PF_FIELD_BODY_VELOCITY(.constrains = "u"), PF_FIELD_BODY_SPIN),
    PF_TERMS(&stress, &constitutive, &surface, &extension),
};
PF_ENTRY(oldroyd_b)
