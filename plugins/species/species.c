/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A dissolved species in a fluid,
 *
 *     dc/dt + u . grad c = div(D grad c) - r(c) + f,     r = k_1 c + k_2 c^2 + V c/(K_m + c).
 *
 * Walls and bodies let nothing through unless a flux, or an uptake, is given there.  A plugin has one field: with
 * other names for SPECIES and the keys the same source is another plugin, for a second species (species_2). */
#include <plugflow/term.h>

#ifndef SPECIES
#define SPECIES     c
#define PLUGIN_NAME species
#endif

#define NO_ZERO          1e-150 /* so that fluid may be at rest; above the square of an imaginary part, 1e-200 */
#define INVERSE_ESTIMATE 60.0   /* C in h |lap s| <= sqrt(C) |grad s| of second-order elements */

#define VALUE_C SLOT(conc, SPECIES, VALUE, SCALAR)
#define GRAD_C  SLOT(grad_c, SPECIES, GRAD, VECTOR)
#define RATE_C  SLOT(c_t, SPECIES, DOT, SCALAR)
#define TEST_C  SLOT(s, SPECIES, VALUE, SCALAR)
#define BIRD    "Bird, Stewart and Lightfoot 2002, Transport Phenomena, 19.1"

#define DIFFUSIVITY                                                                                                \
    REAL(diffusivity, "m^2/s", "how fast it spreads, D", .flags = PF_REQUIRED | PF_SHARED, PF_NOT_NEGATIVE)
#define REACTION                                                                                                   \
    REAL(first_order, "1/s", "k_1 of what is consumed, k_1 c", .flags = PF_SHARED),                                \
        REAL(second_order, "m^3/(mol s)", "k_2 of k_2 c^2", .flags = PF_SHARED),                                   \
        REAL(max_rate, "mol/(m^3 s)", "V of V c/(K_m + c)", .flags = PF_SHARED, PF_NOT_NEGATIVE),                  \
        REAL(half_saturation, "mol/m^3", "K_m, where half of V is reached", .flags = PF_SHARED, .dflt = 1,         \
             .min = 1e-30, .max = 1e30)

/* r(c); where an iteration makes c negative the last part goes on with its slope at 0 */
static inline NUM F(consumed)(NUM c, double k_1, double k_2, double V, double K_m)
{
    return k_1 * c + k_2 * c * c + V * c / (K_m + (creal(c) > 0 ? c : 0));
}

/* dc/dt s */
TERM(storage, PF_FLUID, IN(RATE_C), OUT(TEST_C), PARAMS(), .flags = PF_LINEAR, .doc = "\\partial_t c\\,s",
     .cite = BIRD, PF_EXAMPLES({"dc/dt = 3", 2, NULL, (double[]){3}, (double[]){3}, 1e-15}))
{
    LANES (i)
        s[i] = c_t[i];
}

/* (u . grad c) s */
TERM(advection, PF_FLUID, IN(u, GRAD_C), OUT(TEST_C), PARAMS(), .flags = PF_CONTINUATION,
     .doc = "(u\\cdot\\nabla c)\\,s", .cite = BIRD,
     PF_EXAMPLES({"u = (1, -2), grad c = (3, 5)", 2, NULL, (double[]){1, -2, 3, 5}, (double[]){-7}, 1e-15}))
{
    LANES (i)
        s[i] = 0;
    EACH (k)
        LANES (i)
            s[i] += u[k][i] * grad_c[k][i];
}

/* D grad c . grad s */
TERM(diffusion, PF_FLUID, IN(GRAD_C), OUT(SLOT(grad_s, SPECIES, GRAD, VECTOR)), PARAMS(DIFFUSIVITY),
     .flags = PF_LINEAR, .doc = "D\\,\\nabla c\\cdot\\nabla s", .cite = "Fick's law",
     PF_EXAMPLES({"D = 3, grad c = (1, -2, 5)", 3, (double[]){3}, (double[]){1, -2, 5}, (double[]){3, -6, 15},
                  1e-15}))
{
    EACH (k)
        LANES (i)
            grad_s[k][i] = diffusivity * grad_c[k][i];
}

/* (r(c) - f) s */
TERM(reaction, PF_FLUID, IN(VALUE_C, DATA(c_source, SCALAR)), OUT(TEST_C), PARAMS(REACTION), .flags = PF_OPTIONAL,
     .doc = "(k_1c+k_2c^2+V\\frac{c}{K_m+c}-f)\\,s", .cite = "Michaelis and Menten 1913, Biochem. Z. 49:333",
     PF_EXAMPLES(
         {"c = 3: 2 3 + 5 9 + 8 3/(1 + 3) - 7", 2, (double[]){2, 5, 8, 1}, (double[]){3, 7}, (double[]){50}, 1e-15},
         {"c = -1, below zero: -2 + 5 - 8/2", 2, (double[]){2, 5, 8, 2}, (double[]){-1, 0}, (double[]){-1}, 1e-15}))
{
    LANES (i)
        s[i] = F(consumed)(conc[i], first_order, second_order, max_rate, half_saturation) - c_source[i];
}

/* tau (dc/dt + u . grad c - D lap c + r(c) - f) w . grad s,  1/tau^2 = 4 c0^2 + w . G w + C D^2 G : G, with the
 * metric G and the factor c0 of the time scheme.  w is the velocity; in unsteady flow that of a step ago.  The
 * metric of worked examples is (4 1; 1 2), c0 = 15: 1/tau^2 = 900 + 214 + 60/4 22 = 38^2; residual 13 + (3 - 10) +
 * 7/2 + 2 5 - 1/2 = 19. */
TERM(streamline, PF_FLUID,
     IN(VALUE_C, RATE_C, GRAD_C, SLOT(lap_c, SPECIES, LAPLACE, SCALAR), u, old_u, DATA(c_source, SCALAR)),
     OUT(SLOT(grad_s, SPECIES, GRAD, VECTOR)), PARAMS(DIFFUSIVITY, REACTION),
     .flags = PF_OPTIONAL | PF_CONTINUATION | PF_METRIC,
     .doc = "\\tau\\,(\\partial_t c+u\\cdot\\nabla c-D\\Delta c+r(c)-f)\\,w\\cdot\\nabla s",
     .cite = "Brooks and Hughes 1982, Comput. Methods Appl. Mech. Eng. 32:199",
     PF_EXAMPLES(
         {"D = 1/2, k_1 = 2; u = (1, -2) is carried by w = (2, 9), c = 5, grad c = (3, 5), lap c = -7, dc/dt = "
          "13, f = 1/2",
          2, (double[]){0.5, 2, 0, 0, 1}, (double[]){5, 13, 3, 5, -7, 1, -2, 2, 9, 0.5}, (double[]){1, 4.5},
          1e-14}))
{
    LANES (i) {
        NUM r = c_t[i] - diffusivity * lap_c[i] - c_source[i], m = 4 * b->shift * b->shift + NO_ZERO;

        r += F(consumed)(conc[i], first_order, second_order, max_rate, half_saturation);
        EACH (j) {
            r += u[j][i] * grad_c[j][i];
            EACH (k) {
                const NUM w_w = b->shift > 0 ? old_u[j][i] * old_u[k][i] : u[j][i] * u[k][i];
                const double G = AT(b->metric, j, k);

                m += G * w_w + INVERSE_ESTIMATE * diffusivity * diffusivity * G * G;
            }
        }
        EACH (k)
            grad_s[k][i] = r / sqrt(m) * (b->shift > 0 ? old_u[k][i] : u[k][i]);
    }
}

/* -q s on a boundary, q > 0 into the fluid */
TERM(flux, PF_FACET, IN(DATA(c_flux, SCALAR)), OUT(TEST_C), PARAMS(), .flags = PF_LINEAR | PF_BY_BOUNDARY,
     .doc = "-q\\,s", .cite = BIRD,
     PF_EXAMPLES({"q = 3 mol/(m^2 s) into the fluid", 2, NULL, (double[]){3}, (double[]){-3}, 1e-15}))
{
    LANES (i)
        s[i] = -c_flux[i];
}

/* k c s on a boundary that consumes the species */
TERM(uptake, PF_FACET, IN(VALUE_C, DATA(c_uptake, SCALAR)), OUT(TEST_C), PARAMS(), .flags = PF_BY_BOUNDARY,
     .doc = "k\\,c\\,s", .cite = BIRD,
     PF_EXAMPLES({"k = 2 m/s, c = 3", 2, NULL, (double[]){3, 2}, (double[]){6}, 1e-15}))
{
    LANES (i)
        s[i] = c_uptake[i] * conc[i];
}

/* (k c - q) s on the surface of a body, which releases q and consumes k c */
TERM(body, PF_SURFACE, IN(VALUE_C), OUT(TEST_C),
     PARAMS(REAL(release, "mol/(m^2 s)", "what surfaces of bodies give to the fluid, q"),
            REAL(uptake, "m/s", "k of what they take from it, k c", PF_NOT_NEGATIVE)),
     .flags = PF_OPTIONAL | PF_LINEAR, .doc = "(k\\,c-q)\\,s", .cite = BIRD,
     PF_EXAMPLES({"q = 5, k = 2, c = 3", 2, (double[]){5, 2}, (double[]){3}, (double[]){1}, 1e-15}))
{
    LANES (i)
        s[i] = uptake * conc[i] - release;
}

/* g (D/h^2 + c0) dc ds, d: what differs from the polynomial of the root */
TERM(extension, PF_CUT, IN(SLOT(dc, SPECIES, DEFECT, SCALAR)), OUT(SLOT(ds, SPECIES, DEFECT, SCALAR)),
     PARAMS(DIFFUSIVITY,
            REAL(tie, "1", "of cells with little fluid, in D/h^2 + c0/dt", .dflt = 0.1, PF_NOT_NEGATIVE)),
     .flags = PF_LINEAR, .doc = "g(D/h^2+c_0/\\Delta t)(c-Ec)(s-Es)",
     .cite = "Badia, Neiva and Verdugo 2022, Comput. Methods Appl. Mech. Eng. 388:114232 (weak aggregation)")
{
    LANES (i)
        ds[i] = tie * (diffusivity / (b->h[i] * b->h[i]) + b->shift) * dc[i];
}

PLUGIN(PLUGIN_NAME, "a dissolved species that a fluid carries, that spreads and reacts",
       FIELDS(FIELD(SPECIES, "mol/m^3", "concentration", .order = 2, .reaction = "flow", .reaction_unit = "mol/s"),
              u),
       TERMS(storage, advection, diffusion, reaction, streamline, flux, uptake, body, extension),
       .author = "plugflow", .license = "GPL-3.0-or-later")
#include PF_TWIN
