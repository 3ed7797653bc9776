/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A plugin in C++: the resistance of a porous medium after Darcy and Forchheimer,
 *
 *     (mu / K u + rho c_F / sqrt(K) |u| u) . v                                                             */
#include <plugflow/dual.hpp>
#include <plugflow/fluid.h>

struct drag {
    double density, viscosity, permeability, forchheimer;

    template <class num> int point(const pf_batch &b, const num *const *in, num *const *out) const
    {
        const plugflow::rows<const num> u(b, in[0]);
        const plugflow::rows<num> v(b, out[0]);

        for (uint32_t i = 0; i < b.ld; i++) {
            num speed2 = 1e-300;

            for (uint32_t a = 0; a < b.dim; a++)
                speed2 += u(a, i) * u(a, i);
            for (uint32_t a = 0; a < b.dim; a++)
                v(a, i) =
                    (viscosity / permeability + density * forchheimer / std::sqrt(permeability) * sqrt(speed2)) *
                    u(a, i);
        }
        return PF_OK;
    }
};

static const pf_field fields[] = {{"u", "m/s", "velocity", PF_VECTOR, 2, PF_ON_MESH, "force", "N", nullptr}};
static const pf_slot in[] = {{"u", "u", PF_VALUE, PF_VECTOR}}, out[] = {{"v", "u", PF_VALUE, PF_VECTOR}};
static const pf_param keys[] = {
    PF_DENSITY(drag),
    PF_VISCOSITY(drag),
    PF_NUMBER(drag, permeability, "m^2", "K", .flags = PF_REQUIRED, .min = 1e-30, .max = 1e30),
    PF_NUMBER(drag, forchheimer, "1", "c_F", .dflt = 0.55, PF_NOT_NEGATIVE),
};

/* 3/4 (3, 4) + 2 (1/2) / 2 |(3, 4)| (3, 4) */
static const double param_values[] = {2, 3, 4, 0.5}, in_values[] = {3, 4}, out_values[] = {9.75, 13};
static const pf_example examples[] = {
    {"rho = 2, mu = 3, K = 4, c_F = 1/2", 2, param_values, in_values, out_values, 1e-14}};

static pf_term describe()
{
    pf_term t = plugflow::term<drag>("drag", PF_FLUID, in, out, keys);

    t.doc = "(\\mu/K+\\rho c_F/\\sqrt K\\,|u|)\\,u\\cdot v";
    t.cite = "Nield and Bejan 2017, Convection in Porous Media, 1.5";
    t.example = examples, t.n_example = 1;
    return t;
}

const pf_plugin *pf_plugin_entry(const pf_host *, char *, size_t)
{
    static const pf_term term = describe();
    static const pf_term *const terms[] = {&term};
    static const pf_plugin plugin = plugflow::plugin("drag", fields, terms);

    return &plugin;
}
