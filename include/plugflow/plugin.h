/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * plugin.h -- all that an equation plugin needs to know about plugflow.
 *
 * A plugin is a shared object that includes this header (or fluid.h, which brings it), links against nothing
 * of plugflow and exports one symbol, pf_plugin_entry.  It describes terms; a term is a
 * function of what happens at a point.  The kernel owns mesh, unknowns, weights, matrix.
 *
 * Structs carry their size and grow only at the end; what the older side does not know
 * reads as zero.  Start from examples/scalar_transport.                              */
#ifndef PLUGFLOW_PLUGIN_H
#define PLUGFLOW_PLUGIN_H

#include <stddef.h>
#include <stdint.h>

#if defined __GNUC__ /* structs grow at the end: what an initialiser leaves out is zero, and that is meant */
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#endif

#ifdef __cplusplus
extern "C" {
typedef struct {
    double re, im;
} pf_complex;
#else
typedef double _Complex pf_complex;
#endif

#define PF_ABI_MAJOR 1u /* differs: refused                                            */
#define PF_ABI_MINOR 4u /* plugin newer than kernel: loads if its min_minor allows     */
#define PF_LANES     8u /* ld is a multiple of it; arrays are 64-byte aligned          */
#define PF_SIZES     ((uint32_t)(sizeof(double) << 16 | sizeof(void *) << 8 | sizeof(size_t)))

/* What a point function returns. */
enum pf_status {
    PF_OK = 0,
    PF_RETRY = 1, /* the step may be repeated with a smaller one  */
    PF_FAIL = -1  /* stop the run                                 */
};

/* Where a term acts: the entity class of its points. */
enum pf_where {
    PF_CELL = 1,     /* all of Omega                                              */
    PF_FLUID = 2,    /* Omega_f                                                   */
    PF_SOLID = 3,    /* Omega_Pk                                                  */
    PF_FACET = 4,    /* boundary facets; normal points out of Omega               */
    PF_SURFACE = 5,  /* surface of a particle; normal points out of the fluid     */
    PF_CUT = 6,      /* cells with too little fluid, see PF_DEFECT                */
    PF_PARTICLE = 7, /* once per particle, at its centre, weight 1 (1.4)          */
    PF_PAIR = 8      /* near pairs, particle-particle and particle-wall, weight 1; see PF_DEFECT, PF_OTHER */
};

/* What a slot holds.  For an output slot: what of the test function it multiplies (PF_VALUE, PF_GRAD or PF_DIV; on
 * PF_CUT PF_DEFECT; on PF_PAIR PF_DEFECT, PF_VALUE or PF_OTHER), or what becomes of it (PF_PROPERTY, PF_STATE,
 * PF_SHOW, PF_INTEGRAL).  A term either gives equations, or publishes properties, or gives what is shown; states
 * besides. */
enum pf_eval {
    PF_VALUE = 1,
    PF_GRAD = 2,
    PF_DIV = 3,
    PF_DOT = 4,  /* d/dt in the time scheme; the kernel applies pf_batch.shift in Jacobians */
    PF_OLD = 5,  /* value at t - dt                                                         */
    PF_DATA = 6, /* no unknown: a value or function of x and t from the case                */
    /* What differs: on PF_CUT the value minus the polynomial of the root cell, continued to here; on
     * PF_PAIR that of the first body minus that of the other (a wall rests). */
    PF_DEFECT = 7,
    /* Laplacian inside of the cell, of the shape of the value: sum_k d^2 u_a / d x_k^2, on curved cells with the
     * second derivatives of their mapping.  What the field does across facets is not in it.  Of fields on the
     * mesh; for input slots only (1.3) */
    PF_LAPLACE = 8,
    /* A quantity at the point that another term may publish, called `field`: "viscosity".  Of an input its value
     * and, in the Jacobian, d out / d property, which the kernel chains with the publisher's derivatives.  Where no
     * term publishes it, it is the number of that name that the case gives, in fluid{} or on the term's own line.
     * Of an output: the term publishes it, wherever some term asks for it (1.4) */
    PF_PROPERTY = 9,
    /* The key `field` of particle{}, a number (a vector) that every body has: particle { charge = 3 }.  On points
     * of bodies; on PF_PAIR of the first body.  No unknown (1.4) */
    PF_BODY_KEY = 10,
    PF_OTHER_KEY = 11, /* PF_PAIR: the same of the other body; 0 of a wall (1.4)                        */
    PF_OTHER = 12,     /* PF_PAIR: value of a body's field, or its test function, of the other body alone, as
                        * PF_VALUE is that of the first; a wall has 0, and what it is given is dropped (1.4) */
    /* Memory: a field of support PF_AT_POINTS (any points in cells) or PF_KEPT_BY_PARTICLE (PF_PARTICLE).  Input:
     * its value at the end of the last step; output: its value now, which is kept when the step is accepted (1.4)
     */
    PF_STATE = 13,
    PF_SHOW = 14,    /* output: a field in the files, projected; called like the slot; `field` NULL (1.4) */
    PF_INTEGRAL = 15 /* output: a column in the tables, the integral over the points: over the cells, over each
                      * boundary, over or of each body (in particles.csv); `field` NULL (1.4)             */
};

/* Components of a slot; a tensor is row-major, grad_u[a*dim + k] = d u_a / d x_k. */
enum pf_shape {
    PF_SCALAR = 1,
    PF_VECTOR = 2, /* dim                              */
    PF_TENSOR = 3, /* dim x dim                        */
    PF_SPIN = 4,   /* 1 in 2D, 3 in 3D (angular velocity) */
    /* (1.4) Symmetric tensor: xx, xy, yy in 2D; xx, xy, xz, yy, yz, zz in 3D; and what gradients of a symmetric and
     * of a full tensor are, [component of the tensor][k]. */
    PF_SYMMETRIC = 5,
    PF_SYMMETRIC_GRAD = 6,
    PF_TENSOR_GRAD = 7
};

/* One argument of a point function. */
typedef struct pf_slot {
    const char *name;  /* as messages and tests call it: "grad_u"                      */
    const char *field; /* the unknown: "u"; a property, a key; for PF_DATA, PF_SHOW, PF_INTEGRAL NULL */
    uint32_t eval;     /* enum pf_eval                                                 */
    uint32_t shape;    /* enum pf_shape of what arrives, e.g. PF_TENSOR for grad of u  */
    /* (1.4) Of PF_PROPERTY, PF_BODY_KEY and of outputs PF_SHOW, PF_INTEGRAL: "1/s", "shear rate". */
    const char *unit, *doc;
    double dflt; /* PF_BODY_KEY: of a body that does not say */
    /* Where the term makes sense, for each component; tests keep to it, and a body's key has to; min >= max:
     * everywhere. */
    double min, max;
    uint32_t flags; /* PF_DATA: PF_REQUIRED, the case must give it; else what it leaves out is 0 (1.4) */
} pf_slot;

/* Where the values of a field live. */
enum pf_support {
    PF_ON_MESH = 0,         /* nodes of the mesh, continuous                                */
    PF_ON_PROBLEM = 1,      /* one value (or vector) for the whole problem                  */
    PF_ON_PARTICLE = 2,     /* one value (vector, spin) per particle                       */
    PF_IN_PARTICLES = 3,    /* nodes of the mesh that particles cover (the active set)     */
    PF_AT_POINTS = 4,       /* memory of points in cells: no unknown, see PF_STATE (1.4)   */
    PF_KEPT_BY_PARTICLE = 5 /* memory of each particle, see PF_STATE (1.4)              */
};

/* A field.  Several plugins may declare the same one; shape, order and support must agree, texts are
 * those of the first.  A reaction is what the fluid side gives to a boundary where the field is
 * prescribed: column "<boundary>.<reaction>" of forces.csv (for a vector ".fx", ".fy", ... by the
 * first letter of its reaction). */
typedef struct pf_field {
    const char *name;          /* "u"; the key in boundary{}, initial{}, output{}    */
    const char *unit, *doc;    /* "m/s", "velocity"                                  */
    uint32_t shape;            /* PF_SCALAR, PF_VECTOR; on particles also PF_SPIN; PF_TENSOR, PF_SYMMETRIC (1.4) */
    uint32_t order;            /* polynomial order: 1 or 2, or 0, one value a cell (1.4); ignored off the mesh   */
    uint32_t support;          /* enum pf_support                                    */
    const char *reaction;      /* what its boundary reaction is: "force", "heat"; or NULL */
    const char *reaction_unit; /* "N"                                                     */
    const char *constrains;    /* PF_IN_PARTICLES: the field it holds; off where that one is prescribed.  NULL: it
                                * holds none, and lives on all cells that bodies reach into (1.4).
                                * PF_ON_PARTICLE: the field that moves with    the body inside of it (1.1) */
} pf_field;

enum pf_type {
    PF_T_REAL = 1,
    PF_T_INT = 2,
    PF_T_BOOL = 3,
    PF_T_CHOICE = 4, /* stored as int: index into choice[]                             */
    PF_T_VECTOR = 5  /* dim numbers, stored as double[3]                               */
};

enum pf_param_flag {
    PF_REQUIRED = 1,
    PF_SHARED = 2 /* taken from the case's fluid{} block unless the term's own line gives it */
};

/* One key of the line  term "plugin" { key = ... }.  A plugin's terms may list the same key, each for its
 * own struct; the line serves all of them. */
typedef struct pf_param {
    const char *name, *unit, *doc; /* "viscosity", "Pa s", "dynamic viscosity"         */
    uint32_t type, flags, offset;  /* offset into the term's own params struct         */
    double dflt, min, max;         /* closed interval; min >= max: unbounded           */
    const char *const *choice;     /* PF_T_CHOICE: NULL-terminated names               */
} pf_param;

struct pf_host;

/* One call: n points, structure of arrays, [component][ld]. */
typedef struct pf_batch {
    uint32_t size, dim, n, ld;      /* lanes n..ld-1 repeat other lanes: compute freely   */
    double t, dt, shift;            /* shift = d(dot u)/du of the time scheme; 0: steady  */
    const double *x, *arm, *normal; /* [dim][ld]; NULL where they have no meaning         */
    const double *h;                /* [ld] size of the element, m                        */
    const void *params;             /* the term's own struct                              */
    void *scratch;                  /* scratch_bytes, private to this thread              */
    void *kernel;                   /* the kernel's own; pass the batch on to host->fail  */
    const double *density;          /* [ld] of the particle, PF_SOLID and PF_SURFACE (1.1)     */
    const int32_t *id;              /* [ld] of the particle, from 0 (1.1)                      */
    /* PF_PAIR (1.1): one point a pair, in the middle of the gap, m; normal points from the other body, or
     * the wall, to the first.  Sizes: across, m; of a wall infinite, and its density 0. */
    const double *gap, *size_of, *other_size, *other_density;
    const struct pf_host *host; /* to say why a point fails: return b->host->fail(b, i, PF_RETRY, ...) (1.2) */
    /* For terms with PF_METRIC, else NULL (1.3): [dim*dim][ld], row-major, G^T G of the element, 1/m^2, with
     * G = dxi/dx.  Reference cells are [-1,1]^dim and the regular simplex with edges of length 2, so that it is
     * (2/h)^2 times the identity in a square, a cube and a regular simplex with edges of length h. */
    const double *metric;
    /* Of the body at the point, on PF_SOLID, PF_SURFACE, PF_PARTICLE, and of the first on PF_PAIR (1.4).  axes:
     * [dim*dim][ld], row-major, column k is the body's own axis k; inertia about the centre in the axes of space,
     * kg m^2, [1][ld] in 2D, [9][ld] in 3D.  In 2D a body has the volume of its cross-section, m^2. */
    const double *centre, *axes, *volume, *mass, *inertia;
    /* PF_PARTICLE: what the fluid did to it at the end of the last step, N [dim][ld], N m [1 or 3][ld] (1.4) */
    const double *fluid_force, *fluid_torque;
    /* PF_PAIR, of the other body (1.4); a wall has id -1 and no centre, axes and arm (zero).  The arms of a pair go
     * from the centres to the middle of the gap. */
    const int32_t *other_id;
    const double *other_centre, *other_axes, *other_arm;
    const double
        *curvature; /* PF_SURFACE: sum of the principal curvatures, 1/m; of a ball 2/R, of a disk 1/R (1.4) */
    const double *wall_distance; /* with PF_WALL_DISTANCE: to the nearest wall, m; [ld] (1.4) */
} pf_batch;

/* in[k], out[k]: [component][ld] of slot k.  The residual assigns every output.
 * jac[o*n_in + k]: [component of out o][component of in k][ld], zeroed beforehand; NULL where
 * in slot k is no unknown (PF_OLD, PF_DATA).  Return an enum pf_status (or host->fail()). */
typedef int pf_residual_fn(const pf_batch *, const double *const *in, double *const *out);
typedef int pf_residual_c_fn(const pf_batch *, const pf_complex *const *in, pf_complex *const *out);
typedef int pf_jacobian_fn(const pf_batch *, const double *const *in, double *const *jac);

/* Worked values: one point, numbers computed by hand; unit test and documentation at once. */
typedef struct pf_example {
    const char *name;
    uint32_t dim;
    const double *params;   /* one number per parameter (dim numbers for a vector); NULL: defaults */
    const double *in, *out; /* flat, in the order of the slots                                     */
    double tol;             /* relative to the largest output                                      */
} pf_example;

enum pf_term_flag {
    PF_LINEAR = 1,   /* the residual is linear (affine) in the unknown slots; tested       */
    PF_OPTIONAL = 2, /* off unless its own line, term "plugin.name" {}, switches it on      */
    /* Faded in from 0 to 1 when a steady case does not converge; all such terms of all plugins share one
     * factor, so flag what makes the problem nonlinear and what drives it. */
    PF_CONTINUATION = 4,
    /* PF_FACET: on where a boundary line has the name of its PF_DATA slot as a key:
     * boundary "left" { heat_flux = 3 } */
    PF_BY_BOUNDARY = 8,
    /* PF_SOLID, PF_SURFACE: its rows of particle fields, with the sign changed, are what the fluid does to the
     * body. Without it what the term gives a body is missing in particles.csv (1.1) */
    PF_FLUID_FORCE = 16,
    PF_METRIC = 32,        /* it reads pf_batch.metric; not on PF_CUT and PF_PAIR (1.3) */
    PF_WALL_DISTANCE = 64, /* it reads pf_batch.wall_distance (1.4)                  */
    PF_ONLY_2D = 128,      /* a case in 3D that switches it on is refused (1.4)      */
    PF_ONLY_3D = 256,
    PF_LAST = 512 /* evaluated after all terms without this flag (1.4)      */
};

/* What a term may know when a run starts, see pf_term.init (1.4). */
typedef struct pf_setup {
    uint32_t size, dim;
    int32_t n_body, unsteady;
    const struct pf_host *host;
} pf_setup;

typedef struct pf_term {
    uint32_t size, flags, where;
    uint32_t n_in, n_out, n_param, n_example;
    uint32_t slot_size, param_size, example_size; /* strides of the arrays below      */
    uint32_t params_bytes, scratch_bytes;
    const char *name, *doc, *cite; /* "stress", weak form in TeX, reference           */
    const pf_slot *in, *out;
    const pf_param *param;
    const pf_example *example;
    const uint8_t *depends; /* [n_out][n_in], 0 = certainly no coupling; NULL: all couple */
    int (*check)(const void *params, char *err, size_t nerr); /* across parameters        */
    pf_residual_fn *residual;
    pf_residual_c_fn *residual_c; /* the same source compiled for complex numbers         */
    pf_jacobian_fn *jacobian;     /* by hand, or NULL: complex step, or else differences  */
    /* PF_PAIR (1.2): gap, m, beyond which the term does nothing, for bodies of this size across, m, and cells of
     * size h, m; NULL: `size`.  The kernel looks for pairs as far as some term asks. */
    double (*reach)(const void *params, double size, double h);
    /* "momentum.viscous" (1.4): where both are on, that one is left out.  More than one: separated by blanks. */
    const char *replaces;
    /* (1.4) Before the first evaluation and after the last one of a run, for every line that switches the term on,
     * with that line's struct: to read a table, to make what parameters imply.  init returns 0, or 1 with why. */
    int (*init)(void *params, const pf_setup *setup, char *err, size_t nerr);
    void (*done)(void *params);
} pf_term;

typedef struct pf_plugin {
    uint32_t size, major, minor, min_minor, sizes;
    uint32_t n_term, n_field, field_size;
    const char *name, *version, *author, *license, *doc;
    const pf_term *const *term;
    const pf_field *field;
} pf_plugin;

/* What the kernel offers a plugin. */
typedef struct pf_host {
    uint32_t size, major, minor, sizes;
    const char *version;
    /* Reports why a point cannot be computed; returns status, so: return b->host->fail(b, i, PF_RETRY, ...);
     * the kernel adds plugin, term, coordinates, time and iteration. */
    int (*fail)(const pf_batch *, uint32_t lane, int status, const char *fmt, ...);
} pf_host;

typedef const pf_plugin *pf_entry_fn(const pf_host *, char *err, size_t nerr);

#if defined _WIN32
#define PF_EXPORT __declspec(dllexport)
#else
#define PF_EXPORT __attribute__((visibility("default")))
#endif
/* Returns the description, or NULL with the reason in err. */
PF_EXPORT const pf_plugin *pf_plugin_entry(const pf_host *, char *err, size_t nerr);

/* --- Writing a description in C ---
 *
 * What is the same in all plugins, so that a plugin says only what is its own.  Lists stand where they
 * are used, and are counted:
 *
 *     static const pf_term diffusion = {
 *         PF_TERM(diffusion),
 *         .where = PF_FLUID,
 *         .flags = PF_LINEAR,
 *         .doc = "k\\,\\nabla T\\cdot\\nabla s",
 *         .cite = "Fourier's law",
 *         PF_IN({"grad_T", "T", PF_GRAD, PF_VECTOR}),
 *         PF_OUT({"grad_s", "T", PF_GRAD, PF_VECTOR}),
 *         PF_PARAMS(struct heat, PF_NUMBER(struct heat, conductivity, "W/(m K)", "...", .flags = PF_REQUIRED)),
 *     };
 *     static const pf_plugin heat = {
 *         PF_PLUGIN, .name = "heat", ..., PF_FIELDS({.name = "T", ...}), PF_TERMS(&diffusion),
 *     };
 *     PF_ENTRY(heat)                                                                                   */

/* The sizes that tell the kernel which version of the structs this is. */
#define PF_TERM_SIZES                                                                                              \
    .size = sizeof(pf_term), .slot_size = sizeof(pf_slot), .param_size = sizeof(pf_param),                         \
    .example_size = sizeof(pf_example)
/* A term named after its point function, which twin_real.h and twin_complex.h made for both kinds of numbers. */
#define PF_TERM(FUNCTION)                                                                                          \
    PF_TERM_SIZES, .name = #FUNCTION, .residual = FUNCTION##_real, .residual_c = FUNCTION##_complex
#define PF_PLUGIN                                                                                                  \
    .size = sizeof(pf_plugin), .major = PF_ABI_MAJOR, .minor = PF_ABI_MINOR, .sizes = PF_SIZES,                    \
    .field_size = sizeof(pf_field)

#define PF_LIST(TYPE, ...)                                                                                         \
    (TYPE[])                                                                                                       \
    {                                                                                                              \
        __VA_ARGS__                                                                                                \
    }
#define PF_COUNT(TYPE, ...) (uint32_t)(sizeof((TYPE[]){__VA_ARGS__}) / sizeof(TYPE))
#define PF_IN(...)          .in = PF_LIST(const pf_slot, __VA_ARGS__), .n_in = PF_COUNT(pf_slot, __VA_ARGS__)
#define PF_OUT(...)         .out = PF_LIST(const pf_slot, __VA_ARGS__), .n_out = PF_COUNT(pf_slot, __VA_ARGS__)
#define PF_EXAMPLES(...)                                                                                           \
    .example = PF_LIST(const pf_example, __VA_ARGS__), .n_example = PF_COUNT(pf_example, __VA_ARGS__)
/* STRUCT: the term's own struct, in which the parameters go. */
#define PF_PARAMS(STRUCT, ...)                                                                                     \
    .param = PF_LIST(const pf_param, __VA_ARGS__), .n_param = PF_COUNT(pf_param, __VA_ARGS__),                     \
    .params_bytes = sizeof(STRUCT)
#define PF_FIELDS(...) .field = PF_LIST(const pf_field, __VA_ARGS__), .n_field = PF_COUNT(pf_field, __VA_ARGS__)
#define PF_TERMS(...)                                                                                              \
    .term = PF_LIST(const pf_term *const, __VA_ARGS__), .n_term = PF_COUNT(const pf_term *, __VA_ARGS__)

/* A parameter that is a real number: the key has the name of the struct's member; then default, range, flags. */
#ifdef __cplusplus /* whose designators keep to the order of the members: flags, dflt, min, max */
struct pf_number_rest {
    uint32_t flags;
    double dflt, min, max;
};
static inline pf_param pf_number(const char *name, const char *unit, const char *doc, size_t offset,
                                 pf_number_rest rest)
{
    const pf_param p = {name,      unit,     doc,      PF_T_REAL, rest.flags, (uint32_t)offset,
                        rest.dflt, rest.min, rest.max, NULL};

    return p;
}
#define PF_NUMBER(STRUCT, MEMBER, UNIT, DOC, ...)                                                                  \
    pf_number(#MEMBER, UNIT, DOC, offsetof(STRUCT, MEMBER), pf_number_rest{__VA_ARGS__})
#else
#define PF_NUMBER(STRUCT, MEMBER, UNIT, DOC, ...)                                                                  \
    {                                                                                                              \
        .name = #MEMBER, .unit = UNIT, .doc = DOC, .type = PF_T_REAL, .offset = offsetof(STRUCT, MEMBER),          \
        __VA_ARGS__                                                                                                \
    }
#endif
#define PF_NOT_NEGATIVE .min = 0, .max = 1e30

/* The exported symbol of a plugin that needs nothing of its host at the start. */
#define PF_ENTRY(PLUGIN)                                                                                           \
    const pf_plugin *pf_plugin_entry(const pf_host *host, char *err, size_t nerr)                                  \
    {                                                                                                              \
        (void)host, (void)err, (void)nerr;                                                                         \
        return &(PLUGIN);                                                                                          \
    }

#ifdef __cplusplus
}
#endif
#endif
