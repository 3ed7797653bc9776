/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * fluid.h -- fields and parameters that the equations of a fluid with bodies share, so that plugins
 * which know nothing of each other declare them alike.  Names, units and texts are what a user reads. */
#ifndef PLUGFLOW_FLUID_H
#define PLUGFLOW_FLUID_H

#include <plugflow/plugin.h>

/* Fields, for PF_FIELDS.  Those with (...) take what is particular to a formulation, e.g. .constrains = "u". */
#define PF_FIELD_VELOCITY                                                                                          \
    {                                                                                                              \
        .name = "u", .unit = "m/s", .doc = "velocity", .shape = PF_VECTOR, .order = 2, .reaction = "force",        \
        .reaction_unit = "N"                                                                                       \
    }
#define PF_FIELD_PRESSURE                                                                                          \
    {                                                                                                              \
        .name = "p", .unit = "Pa", .doc = "pressure", .shape = PF_SCALAR, .order = 1                               \
    }
#define PF_FIELD_BODY_VELOCITY(...)                                                                                \
    {                                                                                                              \
        .name = "U", .unit = "m/s", .doc = "velocity of a particle", .shape = PF_VECTOR,                           \
        .support = PF_ON_PARTICLE, __VA_ARGS__                                                                     \
    }
#define PF_FIELD_BODY_SPIN                                                                                         \
    {                                                                                                              \
        .name = "omega", .unit = "rad/s", .doc = "angular velocity of a particle", .shape = PF_SPIN,               \
        .support = PF_ON_PARTICLE                                                                                  \
    }
#define PF_FIELD_MULTIPLIER(...)                                                                                   \
    {                                                                                                              \
        .name = "lambda", .unit = "m/s", .doc = "multiplier of the rigid motion", .shape = PF_VECTOR, .order = 2,  \
        __VA_ARGS__                                                                                                \
    }

/* Parameters of the case's fluid{}, for PF_PARAMS: each into the member of its name of the term's struct. */
#define PF_DENSITY(STRUCT)                                                                                         \
    PF_NUMBER(STRUCT, density, "kg/m^3", "mass per volume", .flags = PF_REQUIRED | PF_SHARED, PF_NOT_NEGATIVE)
#define PF_VISCOSITY(STRUCT)                                                                                       \
    PF_NUMBER(STRUCT, viscosity, "Pa s", "dynamic viscosity", .flags = PF_REQUIRED | PF_SHARED, PF_NOT_NEGATIVE)
#define PF_GRAVITY(STRUCT)                                                                                         \
    {                                                                                                              \
        .name = "gravity", .unit = "m/s^2", .doc = "acceleration of gravity", .type = PF_T_VECTOR,                 \
        .flags = PF_SHARED, .offset = offsetof(STRUCT, gravity)                                                    \
    }
#define PF_REDUCED_PRESSURE(STRUCT)                                                                                \
    {                                                                                                              \
        .name = "reduced_pressure", .unit = "1", .doc = "p without its hydrostatic part rho g.x",                  \
        .type = PF_T_BOOL, .flags = PF_SHARED, .offset = offsetof(STRUCT, reduced_pressure)                        \
    }

/* The same as properties at a point, for PF_IN: what a term publishes, or else the parameter of that name, which
 * the term has to list, too. */
#define PF_TAKES_DENSITY                                                                                           \
    {                                                                                                              \
        .name = "rho", .field = "density", .eval = PF_PROPERTY, .shape = PF_SCALAR, .unit = "kg/m^3",              \
        .doc = "mass per volume", PF_NOT_NEGATIVE                                                                  \
    }
#define PF_TAKES_VISCOSITY                                                                                         \
    {                                                                                                              \
        .name = "mu", .field = "viscosity", .eval = PF_PROPERTY, .shape = PF_SCALAR, .unit = "Pa s",               \
        .doc = "dynamic viscosity", .min = 1e-30, .max = 1e30                                                      \
    }

/* The struct of a term that has no parameters of its own.  A term lists those of its members that it reads. */
typedef struct pf_fluid {
    double density;       /* rho, kg/m^3 */
    double viscosity;     /* mu, Pa s    */
    double gravity[3];    /* g, m/s^2    */
    int reduced_pressure; /* 1: p is the pressure without rho g.x, so gravity is no force */
} pf_fluid;

#endif
