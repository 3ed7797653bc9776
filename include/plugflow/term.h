/* clang-format off */
/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * term.h -- the short way to write a plugin in C: one file, each term once, its physics in symbols.
 *
 *     #include <plugflow/term.h>
 *
 *     // rho (u . grad) u . v
 *     TERM(convection, PF_CELL, IN(u, grad_u), OUT(v), PARAMS(DENSITY),
 *          .doc = "\\rho(u\\cdot\\nabla)u\\cdot v", .cite = "Batchelor 1967, 3.3")
 *     {
 *         EACH (a)
 *             LANES (i) {
 *                 v[a][i] = 0;
 *                 EACH (k)
 *                     v[a][i] += density * u[k][i] * grad_u[a][k][i];
 *             }
 *     }
 *
 *     PLUGIN(drift, "convection", FIELDS(u), TERMS(convection), .author = "me")
 *     #include PF_TWIN
 *
 * The block is the point function.  Every slot and every parameter is there under its name: a scalar is p[i], a
 * vector u[a][i], a tensor grad_u[a][k][i], i the lane; a parameter is density, gravity[a].  The last line compiles
 * the file a second time for complex numbers (NUM), which gives exact derivatives.  Functions of the file's own
 * that are needed once stand between #if PF_ONCE and #endif; those of NUM are called F(name).
 *
 * --- In a term ---
 * IN(...), OUT(...)      slots, see "Slots" below: standard ones by their names, u, grad_u, p, ...
 * PARAMS(...)            keys of the term's line: REAL, VECTOR, INT, SWITCH, CHOICE, or DENSITY, VISCOSITY, ...
 * .flags = ..., and so on: all other members of pf_term
 * CHECK(stress, PARAMS(...)) { REFUSE_UNLESS(n > 0, "n is %g; ...", n); }
 * REACH(force, PARAMS(...)) { return range * h; }
 *                        after the term, which has .check = stress_check, .reach = force_reach: what is wrong with
 *                        parameters; the gap beyond which a term on pairs does nothing (`size` of the body, `h` of
 *                        cells).  NAME_init and NAME_done are declared, too, to be defined in #if PF_ONCE
 * --- By hand, where speed matters: without it the complex numbers give the derivatives ---
 * JACOBIAN(convection, IN(u, grad_u), PARAMS(DENSITY), BLOCKS(BLOCK(v, u), BLOCK(v, grad_u)))
 *                        after the term, which has .jacobian = convection_jacobian; in its block dv_du[a][k][i] is
 *                        d v_a / d u_k, dv_dgrad_u[a][k][l][i] d v_a / d grad_u_kl; all are zero before
 * --- In its block ---
 * LANES (i)              for all points of the batch, i
 * EACH (a)               for all directions of space, a
 * EACH_SPIN (a)          for all components of a spin: 1 in 2D, 3 in 3D
 * EACH_SYM (n)           for all components of a symmetric tensor: 3 in 2D, 6 in 3D
 * tau[AT_SYM(a, k)][i]   the component of a symmetric tensor that has row a and column k, in either order
 * DIM                    2 or 3
 * AT(b->normal, a)       component a at lane i of what the batch b has: x, arm, normal, centre, ...
 * AT(b->axes, a, k)      component a, k of its tensors: axes, metric
 * FAIL(PF_RETRY, ...)    leaves: point i cannot be computed, and why, as in printf
 * sqrt exp log sin cos tan tanh atan fabs pow max min
 *                        of real and of complex numbers
 * creal(x)               to compare: if (creal(u) < 0)
 *
 * A term has up to 12 slots IN, 12 OUT and 32 keys, a plugin 16 fields; other lists have up to 32 entries. */
/* clang-format on */
#ifndef PLUGFLOW_TERM_H
#define PLUGFLOW_TERM_H

#include <plugflow/fluid.h>
#include <plugflow/twin_real.h>

#include <complex.h>
#include <math.h>
#include <stdio.h>
#undef I /* a name that equations need; the imaginary unit is the kernel's business */

#if defined __GNUC__ /* what a plugin says replaces the defaults; slots are pointers to rows of ld lanes */
#pragma GCC diagnostic ignored "-Woverride-init"
#pragma GCC diagnostic ignored "-Wvla"
#endif
#if defined __clang__
#pragma clang diagnostic ignored "-Winitializer-overrides"
#pragma clang diagnostic ignored "-Wgnu-zero-variadic-macro-arguments"
#endif

#define PF_ONCE 1 /* 0 where the file is compiled again for complex numbers */
#ifndef PF_TWIN   /* the file itself; compilers without __FILE_NAME__: #define PF_TWIN "this_file.c" before */
#define PF_TWIN __FILE_NAME__
#endif

#define LANES(i)     PF_LANES_OF (b, i)
#define EACH(a)      for (uint32_t a = 0; a < b->dim; a++)
#define EACH_SPIN(a) for (uint32_t a = 0; a < PF_SPINS; a++)
#define EACH_SYM(n)  for (uint32_t n = 0; n < PF_N_SYM; n++)
#define DIM          (b->dim)
#define PF_SPINS     (b->dim == 2 ? 1u : 3u)

/* The upper triangle, row after row. */
#define PF_N_SYM        (b->dim == 2 ? 3u : 6u)
#define AT_SYM(a, k)    ((a) < (k) ? PF_SYM_OF(a, k) : PF_SYM_OF(k, a))
#define PF_SYM_OF(a, k) ((a) * (2 * DIM - 1 - (a)) / 2 + (k))

#define AT(...)                  PF_PICK(__VA_ARGS__, PF_AT2, PF_AT1, )(__VA_ARGS__)
#define PF_PICK(a, b, c, d, ...) d
#define PF_AT1(array, a)         (array)[(a)*LD + i]
#define PF_AT2(array, a, k)      (array)[((a)*DIM + (k)) * LD + i]

#define FAIL(STATUS, ...)                                                                                          \
    do {                                                                                                           \
        *pf_status = b->host->fail(b, i, STATUS, __VA_ARGS__);                                                     \
        return;                                                                                                    \
    } while (0)

/* clang-format off */
/* --- Slots.  Those of the standard fields go by their names alone: u, grad_u, u_t, old_u, lap_u, v, grad_v, ...
 *
 * VALUE(F) GRAD(F) DIV(F) DOT(F) OLD(F) LAPLACE(F)   F, grad_F, div_F, F_t, old_F, lap_F
 * TEST(F, w) GRAD_TEST(F, w) DIV_TEST(F, w)          w, grad_w, div_w: of the test function of F
 * OTHER(U), OTHER_TEST(U, V)                         other_U, other_V: of the other body of a pair
 * SLOT(dU, U, DEFECT, VECTOR)                        what is left, in full
 * DATA(flux, SCALAR)                                 a number or a function of the case
 * PROPERTY(viscosity, "Pa s", doc)                   to publish it
 * PROPERTY_AS(k, conductivity, "W/(m K)")            to take it as k; rho and mu are those of fluid{}
 * BODY_KEY(charge, "C", doc)                         a key of particle{}, a number; on pairs of the first body
 * BODY_KEY_VECTOR(moment, "A m^2", doc)              the same, a vector
 * OTHER_KEY(charge), OTHER_KEY_VECTOR(moment)        other_charge, other_moment: of the other body of a pair
 * STATE(name, field, SHAPE)                          memory
 * SHOW(rate, SCALAR, "1/s", doc)                     shown in the files
 * INTEGRAL(power, SCALAR, "W", doc)                  shown in the tables
 *
 * After all of them members of pf_slot: .min = 0, .max = 1.  A new field: #define PF_SHAPE_tau SYMMETRIC, and then
 * VALUE(tau), ... --- */
/* clang-format on */
#define PF_SLOT_VALUE(F)                            PF_SHAPE_##F, F, #F, PF_VALUE
#define PF_SLOT_GRAD(F)                             PF_SHAPE_OF_GRAD(PF_SHAPE_##F), grad_##F, #F, PF_GRAD
#define PF_SLOT_DIV(F)                              PF_SHAPE_OF_DIV(PF_SHAPE_##F), div_##F, #F, PF_DIV
#define PF_SLOT_DOT(F)                              PF_SHAPE_##F, F##_t, #F, PF_DOT
#define PF_SLOT_OLD(F)                              PF_SHAPE_##F, old_##F, #F, PF_OLD
#define PF_SLOT_LAPLACE(F)                          PF_SHAPE_##F, lap_##F, #F, PF_LAPLACE
#define PF_SLOT_TEST(F, NAME)                       PF_SHAPE_##F, NAME, #F, PF_VALUE
#define PF_SLOT_GRAD_TEST(F, NAME)                  PF_SHAPE_OF_GRAD(PF_SHAPE_##F), grad_##NAME, #F, PF_GRAD
#define PF_SLOT_DIV_TEST(F, NAME)                   PF_SHAPE_OF_DIV(PF_SHAPE_##F), div_##NAME, #F, PF_DIV
#define PF_SLOT_OTHER(F)                            PF_SHAPE_##F, other_##F, #F, PF_OTHER
#define PF_SLOT_OTHER_TEST(F, NAME)                 PF_SHAPE_##F, other_##NAME, #F, PF_OTHER
#define PF_SLOT_SLOT(NAME, FIELD, EVAL, SHAPE, ...) SHAPE, NAME, #FIELD, PF_##EVAL, __VA_ARGS__
#define PF_SLOT_DATA(NAME, SHAPE, ...)              SHAPE, NAME, NULL, PF_DATA, __VA_ARGS__
#define PF_SLOT_PROPERTY(NAME, UNIT, DOC, ...)                                                                     \
    SCALAR, NAME, #NAME, PF_PROPERTY, .unit = UNIT, .doc = DOC, __VA_ARGS__
#define PF_SLOT_PROPERTY_AS(NAME, PUBLISHED, UNIT, ...)                                                            \
    SCALAR, NAME, #PUBLISHED, PF_PROPERTY, .unit = UNIT, __VA_ARGS__
#define PF_SLOT_BODY_KEY(NAME, UNIT, DOC, ...)                                                                     \
    SCALAR, NAME, #NAME, PF_BODY_KEY, .unit = UNIT, .doc = DOC, __VA_ARGS__
#define PF_SLOT_BODY_KEY_VECTOR(NAME, UNIT, DOC, ...)                                                              \
    VECTOR, NAME, #NAME, PF_BODY_KEY, .unit = UNIT, .doc = DOC, __VA_ARGS__
#define PF_SLOT_OTHER_KEY(NAME, ...)              SCALAR, other_##NAME, #NAME, PF_OTHER_KEY, __VA_ARGS__
#define PF_SLOT_OTHER_KEY_VECTOR(NAME, ...)       VECTOR, other_##NAME, #NAME, PF_OTHER_KEY, __VA_ARGS__
#define PF_SLOT_STATE(NAME, FIELD, SHAPE, ...)    SHAPE, NAME, #FIELD, PF_STATE, __VA_ARGS__
#define PF_SLOT_SHOW(NAME, SHAPE, UNIT, DOC, ...) SHAPE, NAME, NULL, PF_SHOW, .unit = UNIT, .doc = DOC, __VA_ARGS__
#define PF_SLOT_INTEGRAL(NAME, SHAPE, UNIT, DOC, ...)                                                              \
    SHAPE, NAME, NULL, PF_INTEGRAL, .unit = UNIT, .doc = DOC, __VA_ARGS__

#define PF_SHAPE_OF_GRAD(S)        PF_SHAPE_OF_GRAD_I(S)
#define PF_SHAPE_OF_GRAD_I(S)      PF_SHAPE_OF_GRAD_##S
#define PF_SHAPE_OF_GRAD_SCALAR    VECTOR
#define PF_SHAPE_OF_GRAD_VECTOR    TENSOR
#define PF_SHAPE_OF_GRAD_TENSOR    TENSOR_GRAD
#define PF_SHAPE_OF_GRAD_SYMMETRIC SYMMETRIC_GRAD
#define PF_SHAPE_OF_DIV(S)         PF_SHAPE_OF_DIV_I(S)
#define PF_SHAPE_OF_DIV_I(S)       PF_SHAPE_OF_DIV_##S
#define PF_SHAPE_OF_DIV_VECTOR     SCALAR
#define PF_SHAPE_OF_DIV_TENSOR     VECTOR
#define PF_SHAPE_OF_DIV_SYMMETRIC  VECTOR

/* The standard fields: velocity u, pressure p, temperature T, concentration c, level set phi; velocity U and spin
 * omega of a body, multiplier lambda of the rigid motion. */
#define PF_SHAPE_u      VECTOR
#define PF_SHAPE_p      SCALAR
#define PF_SHAPE_T      SCALAR
#define PF_SHAPE_c      SCALAR
#define PF_SHAPE_phi    SCALAR
#define PF_SHAPE_U      VECTOR
#define PF_SHAPE_omega  SPIN
#define PF_SHAPE_lambda VECTOR

#define PF_SLOT_u           PF_SLOT_VALUE(u)
#define PF_SLOT_grad_u      PF_SLOT_GRAD(u)
#define PF_SLOT_div_u       PF_SLOT_DIV(u)
#define PF_SLOT_u_t         PF_SLOT_DOT(u)
#define PF_SLOT_old_u       PF_SLOT_OLD(u)
#define PF_SLOT_lap_u       PF_SLOT_LAPLACE(u)
#define PF_SLOT_p           PF_SLOT_VALUE(p)
#define PF_SLOT_grad_p      PF_SLOT_GRAD(p)
#define PF_SLOT_p_t         PF_SLOT_DOT(p)
#define PF_SLOT_old_p       PF_SLOT_OLD(p)
#define PF_SLOT_lap_p       PF_SLOT_LAPLACE(p)
#define PF_SLOT_T           PF_SLOT_VALUE(T)
#define PF_SLOT_grad_T      PF_SLOT_GRAD(T)
#define PF_SLOT_T_t         PF_SLOT_DOT(T)
#define PF_SLOT_old_T       PF_SLOT_OLD(T)
#define PF_SLOT_lap_T       PF_SLOT_LAPLACE(T)
#define PF_SLOT_c           PF_SLOT_VALUE(c)
#define PF_SLOT_grad_c      PF_SLOT_GRAD(c)
#define PF_SLOT_c_t         PF_SLOT_DOT(c)
#define PF_SLOT_old_c       PF_SLOT_OLD(c)
#define PF_SLOT_lap_c       PF_SLOT_LAPLACE(c)
#define PF_SLOT_phi         PF_SLOT_VALUE(phi)
#define PF_SLOT_grad_phi    PF_SLOT_GRAD(phi)
#define PF_SLOT_phi_t       PF_SLOT_DOT(phi)
#define PF_SLOT_old_phi     PF_SLOT_OLD(phi)
#define PF_SLOT_lap_phi     PF_SLOT_LAPLACE(phi)
#define PF_SLOT_U           PF_SLOT_VALUE(U)
#define PF_SLOT_U_t         PF_SLOT_DOT(U)
#define PF_SLOT_old_U       PF_SLOT_OLD(U)
#define PF_SLOT_omega       PF_SLOT_VALUE(omega)
#define PF_SLOT_omega_t     PF_SLOT_DOT(omega)
#define PF_SLOT_old_omega   PF_SLOT_OLD(omega)
#define PF_SLOT_lambda      PF_SLOT_VALUE(lambda)
#define PF_SLOT_grad_lambda PF_SLOT_GRAD(lambda)
#define PF_SLOT_div_lambda  PF_SLOT_DIV(lambda)
#define PF_SLOT_lambda_t    PF_SLOT_DOT(lambda)
#define PF_SLOT_old_lambda  PF_SLOT_OLD(lambda)
#define PF_SLOT_lap_lambda  PF_SLOT_LAPLACE(lambda)
/* Their test functions: v, q, s; V, xi, eta; of c and phi test_c and test_phi. */
#define PF_SLOT_v             PF_SLOT_TEST(u, v)
#define PF_SLOT_grad_v        PF_SLOT_GRAD_TEST(u, v)
#define PF_SLOT_div_v         PF_SLOT_DIV_TEST(u, v)
#define PF_SLOT_q             PF_SLOT_TEST(p, q)
#define PF_SLOT_grad_q        PF_SLOT_GRAD_TEST(p, q)
#define PF_SLOT_s             PF_SLOT_TEST(T, s)
#define PF_SLOT_grad_s        PF_SLOT_GRAD_TEST(T, s)
#define PF_SLOT_test_c        PF_SLOT_TEST(c, test_c)
#define PF_SLOT_grad_test_c   PF_SLOT_GRAD_TEST(c, test_c)
#define PF_SLOT_test_phi      PF_SLOT_TEST(phi, test_phi)
#define PF_SLOT_grad_test_phi PF_SLOT_GRAD_TEST(phi, test_phi)
#define PF_SLOT_V             PF_SLOT_TEST(U, V)
#define PF_SLOT_xi            PF_SLOT_TEST(omega, xi)
#define PF_SLOT_eta           PF_SLOT_TEST(lambda, eta)
#define PF_SLOT_grad_eta      PF_SLOT_GRAD_TEST(lambda, eta)
#define PF_SLOT_div_eta       PF_SLOT_DIV_TEST(lambda, eta)

/* Properties of the fluid, see PF_PROPERTY; the term lists the keys DENSITY and VISCOSITY, too. */
#define PF_SLOT_rho                                                                                                \
    SCALAR, rho, "density", PF_PROPERTY, .unit = "kg/m^3", .doc = "mass per volume", .min = 0, .max = 1e30
#define PF_SLOT_mu                                                                                                 \
    SCALAR, mu, "viscosity", PF_PROPERTY, .unit = "Pa s", .doc = "dynamic viscosity", .min = 1e-30, .max = 1e30

/* What a slot is in the point function. */
#define PF_ROWS_SCALAR(NUMBER, NAME)         NUMBER *restrict NAME
#define PF_ROWS_VECTOR(NUMBER, NAME)         NUMBER(*restrict NAME)[b->ld]
#define PF_ROWS_SPIN(NUMBER, NAME)           NUMBER(*restrict NAME)[b->ld]
#define PF_ROWS_SYMMETRIC(NUMBER, NAME)      NUMBER(*restrict NAME)[b->ld]
#define PF_ROWS_TENSOR(NUMBER, NAME)         NUMBER(*restrict NAME)[b->dim][b->ld]
#define PF_ROWS_SYMMETRIC_GRAD(NUMBER, NAME) NUMBER(*restrict NAME)[b->dim][b->ld]
#define PF_ROWS_TENSOR_GRAD(NUMBER, NAME)    NUMBER(*restrict NAME)[b->dim][b->dim][b->ld]

/* --- Parameters: name, unit, what it is, then members of pf_param: REAL(range, "m", "gap", .flags = PF_REQUIRED,
 * PF_NOT_NEGATIVE), VECTOR(at, "m", "place"), INT(order, "order"), SWITCH(wet, "whether"), CHOICE(law, "which law",
 * "power", "carreau"), the first being the default.  Those of fluid{}: DENSITY, VISCOSITY, GRAVITY. --- */
#define DENSITY REAL(density, "kg/m^3", "mass per volume", .flags = PF_REQUIRED | PF_SHARED, .min = 0, .max = 1e30)
#define VISCOSITY                                                                                                  \
    REAL(viscosity, "Pa s", "dynamic viscosity", .flags = PF_REQUIRED | PF_SHARED, .min = 0, .max = 1e30)
#define GRAVITY          VECTOR(gravity, "m/s^2", "acceleration of gravity", .flags = PF_SHARED)
#define REDUCED_PRESSURE SWITCH(reduced_pressure, "p without its hydrostatic part rho g.x", .flags = PF_SHARED)

#define PF_KEY_REAL(NAME, UNIT, DOC, ...)   double, NAME, , const double, PF_T_REAL, UNIT, DOC, __VA_ARGS__
#define PF_KEY_VECTOR(NAME, UNIT, DOC, ...) double, NAME, [3], const double *, PF_T_VECTOR, UNIT, DOC, __VA_ARGS__
#define PF_KEY_INT(NAME, DOC, ...)          int, NAME, , const int, PF_T_INT, "1", DOC, __VA_ARGS__
#define PF_KEY_SWITCH(NAME, DOC, ...)       int, NAME, , const int, PF_T_BOOL, "1", DOC, __VA_ARGS__
#define PF_KEY_CHOICE(NAME, DOC, ...)                                                                              \
    int, NAME, , const int, PF_T_CHOICE, "1", DOC, .choice = PF_LIST(const char *const, __VA_ARGS__, NULL)

/* --- Terms --- */
/* The function the kernel calls has the block in it twice, for 2D and 3D, so that loops over directions are
 * unrolled and the loop over lanes is one of vectors. */
#define TERM(NAME, WHERE, INPUT, OUTPUT, KEYS, ...)                                                                \
    PF_TERM_ONCE(NAME, WHERE, PF_OPEN_##INPUT, PF_OPEN_##OUTPUT, PF_OPEN_##KEYS, __VA_ARGS__)                      \
    PF_POINT(NAME, PF_OPEN_##INPUT, PF_OPEN_##OUTPUT, PF_OPEN_##KEYS);                                             \
    static int F(NAME)(const pf_batch *b, const NUM *const *in, NUM *const *out)                                   \
    {                                                                                                              \
        const struct NAME##_params *pf_keys = b->params;                                                           \
        int pf_status = PF_OK;                                                                                     \
                                                                                                                   \
        (void)in, (void)out, (void)pf_keys;                                                                        \
        if (b->dim == 2)                                                                                           \
            PF_CALL(NAME, PF_OPEN_##INPUT, PF_OPEN_##OUTPUT, PF_OPEN_##KEYS);                                      \
        else if (b->dim == 3)                                                                                      \
            PF_CALL(NAME, PF_OPEN_##INPUT, PF_OPEN_##OUTPUT, PF_OPEN_##KEYS);                                      \
        return pf_status;                                                                                          \
    }                                                                                                              \
    PF_POINT(NAME, PF_OPEN_##INPUT, PF_OPEN_##OUTPUT, PF_OPEN_##KEYS)

#define PF_POINT(NAME, INPUT, OUTPUT, KEYS)                                                                        \
    __attribute__((always_inline)) static inline void F(NAME##_at_point)(                                          \
        PF_UNUSED int *pf_status, PF_UNUSED const pf_batch *b PF_EACH(PF_IN_ARGUMENT, NAME, INPUT)                 \
                                      PF_EACH(PF_OUT_ARGUMENT, NAME, OUTPUT) PF_EACH(PF_KEY_ARGUMENT, NAME, KEYS))
#define PF_CALL(NAME, INPUT, OUTPUT, KEYS)                                                                         \
    F(NAME##_at_point)                                                                                             \
    (&pf_status,                                                                                                   \
     b PF_EACH(PF_IN_PASSED, NAME, INPUT) PF_EACH(PF_OUT_PASSED, NAME, OUTPUT) PF_EACH(PF_KEY_PASSED, NAME, KEYS))

#define PF_TERM_ONCE(NAME, WHERE, INPUT, OUTPUT, KEYS, ...)                                                        \
    enum {                                                                                                         \
        PF_EACH(PF_IN_NUMBER, NAME, INPUT) PF_EACH(PF_OUT_NUMBER, NAME, OUTPUT) NAME##_n_in =                      \
            0 PF_EACH(PF_PLUS_ONE, NAME, INPUT)                                                                    \
    };                                                                                                             \
    struct NAME##_params {                                                                                         \
        PF_EACH(PF_KEY_MEMBER, NAME, KEYS)                                                                         \
        char none;                                                                                                 \
    };                                                                                                             \
    static int NAME##_real(const pf_batch *, const double *const *, double *const *);                              \
    static int NAME##_complex(const pf_batch *, const pf_complex *const *, pf_complex *const *);                   \
    PF_LOCAL int NAME##_jacobian(const pf_batch *, const double *const *, double *const *);                        \
    PF_LOCAL int NAME##_check(const void *, char *, size_t);                                                       \
    PF_LOCAL int NAME##_init(void *, const pf_setup *, char *, size_t);                                            \
    PF_LOCAL void NAME##_done(void *);                                                                             \
    PF_LOCAL double NAME##_reach(const void *, double, double);                                                    \
    static const pf_term NAME = {                                                                                  \
        PF_TERM(NAME),                                                                                             \
        .where = WHERE,                                                                                            \
        .in = (const pf_slot[]){PF_EACH(PF_SLOT_ENTRY, NAME, INPUT){0}},                                           \
        .n_in = sizeof((const pf_slot[]){PF_EACH(PF_SLOT_ENTRY, NAME, INPUT){0}}) / sizeof(pf_slot) - 1,           \
        .out = (const pf_slot[]){PF_EACH(PF_SLOT_ENTRY, NAME, OUTPUT){0}},                                         \
        .n_out = sizeof((const pf_slot[]){PF_EACH(PF_SLOT_ENTRY, NAME, OUTPUT){0}}) / sizeof(pf_slot) - 1,         \
        .param = (const pf_param[]){PF_EACH(PF_KEY_ENTRY, NAME, KEYS){0}},                                         \
        .n_param = sizeof((const pf_param[]){PF_EACH(PF_KEY_ENTRY, NAME, KEYS){0}}) / sizeof(pf_param) - 1,        \
        .params_bytes = sizeof(struct NAME##_params),                                                              \
        __VA_ARGS__};

/* A Jacobian by hand: the same way, always of real numbers. */
#define JACOBIAN(NAME, INPUT, KEYS, PARTS)                                                                         \
    PF_JACOBIAN_ONCE(NAME, INPUT, KEYS, PARTS)                                                                     \
    PF_JACOBIAN_POINT(NAME, PF_OPEN_##INPUT, PF_OPEN_##KEYS, PF_OPEN_##PARTS)

#define PF_JACOBIAN_ONCE(NAME, INPUT, KEYS, PARTS)                                                                 \
    PF_JACOBIAN_POINT(NAME, PF_OPEN_##INPUT, PF_OPEN_##KEYS, PF_OPEN_##PARTS);                                     \
    int NAME##_jacobian(const pf_batch *b, const double *const *in, double *const *jac)                            \
    {                                                                                                              \
        const struct NAME##_params *pf_keys = b->params;                                                           \
        int pf_status = PF_OK;                                                                                     \
                                                                                                                   \
        (void)in, (void)pf_keys;                                                                                   \
        if (b->dim == 2)                                                                                           \
            PF_JACOBIAN_CALL(NAME, PF_OPEN_##INPUT, PF_OPEN_##KEYS, PF_OPEN_##PARTS);                              \
        else if (b->dim == 3)                                                                                      \
            PF_JACOBIAN_CALL(NAME, PF_OPEN_##INPUT, PF_OPEN_##KEYS, PF_OPEN_##PARTS);                              \
        return pf_status;                                                                                          \
    }
#define PF_JACOBIAN_POINT(NAME, INPUT, KEYS, PARTS)                                                                \
    __attribute__((always_inline)) PF_UNUSED static inline void F(NAME##_jacobian_at_point)(                       \
        PF_UNUSED int *pf_status, PF_UNUSED const pf_batch *b PF_EACH(PF_REAL_ARGUMENT, NAME, INPUT) PF_EACH(      \
                                      PF_BLOCK_ARGUMENT, NAME, PARTS) PF_EACH(PF_KEY_ARGUMENT, NAME, KEYS))
#define PF_JACOBIAN_CALL(NAME, INPUT, KEYS, PARTS)                                                                 \
    F(NAME##_jacobian_at_point)                                                                                    \
    (&pf_status, b PF_EACH(PF_IN_PASSED, NAME, INPUT) PF_EACH(PF_BLOCK_PASSED, NAME, PARTS)                        \
                     PF_EACH(PF_KEY_PASSED, NAME, KEYS))

/* A block has the indices of the output, then those of the input. */
#define PF_BLOCK_SCALAR(IN, NAME)         PF_ROWS_##IN(double, NAME)
#define PF_BLOCK_VECTOR(IN, NAME)         double(*restrict NAME) PF_EXTENT_##IN[b->ld]
#define PF_BLOCK_SPIN(IN, NAME)           double(*restrict NAME) PF_EXTENT_##IN[b->ld]
#define PF_BLOCK_SYMMETRIC(IN, NAME)      double(*restrict NAME) PF_EXTENT_##IN[b->ld]
#define PF_BLOCK_TENSOR(IN, NAME)         double(*restrict NAME)[b->dim] PF_EXTENT_##IN[b->ld]
#define PF_BLOCK_SYMMETRIC_GRAD(IN, NAME) double(*restrict NAME)[b->dim] PF_EXTENT_##IN[b->ld]
#define PF_BLOCK_TENSOR_GRAD(IN, NAME)    double(*restrict NAME)[b->dim][b->dim] PF_EXTENT_##IN[b->ld]
#define PF_EXTENT_SCALAR
#define PF_EXTENT_VECTOR         [b->dim]
#define PF_EXTENT_SPIN           [PF_SPINS]
#define PF_EXTENT_SYMMETRIC      [PF_N_SYM]
#define PF_EXTENT_TENSOR         [b->dim][b->dim]
#define PF_EXTENT_SYMMETRIC_GRAD [PF_N_SYM][b->dim]
#define PF_EXTENT_TENSOR_GRAD    [b->dim][b->dim][b->dim]

#define PF_UNUSED           __attribute__((unused))
#define PF_LOCAL            __attribute__((visibility("hidden")))
#define PF_OPEN_IN(...)     __VA_ARGS__
#define PF_OPEN_OUT(...)    __VA_ARGS__
#define PF_OPEN_PARAMS(...) __VA_ARGS__
#define PF_OPEN_BLOCKS(...) __VA_ARGS__

/* For one entry A, number K of the list, of the term X: "u" becomes what PF_SLOT_u says, VALUE(u) what
 * PF_SLOT_VALUE(u) says, REAL(...) what PF_KEY_REAL(...) says. */
#define PF_IN_ARGUMENT(X, K, A)     PF_APPLY(PF_IN_ARGUMENT_I, K, PF_SLOT_##A)
#define PF_OUT_ARGUMENT(X, K, A)    PF_APPLY(PF_OUT_ARGUMENT_I, K, PF_SLOT_##A)
#define PF_IN_PASSED(X, K, A)       , (void *)in[K]
#define PF_OUT_PASSED(X, K, A)      , (void *)out[K]
#define PF_SLOT_ENTRY(X, K, A)      PF_APPLY(PF_SLOT_ENTRY_I, K, PF_SLOT_##A)
#define PF_KEY_ARGUMENT(X, K, A)    PF_APPLY(PF_KEY_ARGUMENT_I, K, PF_KEY_##A)
#define PF_KEY_PASSED(X, K, A)      PF_APPLY(PF_KEY_PASSED_I, K, PF_KEY_##A)
#define PF_KEY_MEMBER(X, K, A)      PF_APPLY(PF_KEY_MEMBER_I, K, PF_KEY_##A)
#define PF_KEY_ENTRY(X, K, A)       PF_APPLY(PF_KEY_ENTRY_I, X, PF_KEY_##A)
#define PF_REAL_ARGUMENT(X, K, A)   PF_APPLY(PF_REAL_ARGUMENT_I, K, PF_SLOT_##A)
#define PF_IN_NUMBER(X, K, A)       PF_APPLY(PF_NUMBER_I, X##_in_, K, PF_SLOT_##A)
#define PF_OUT_NUMBER(X, K, A)      PF_APPLY(PF_NUMBER_I, X##_out_, K, PF_SLOT_##A)
#define PF_PLUS_ONE(X, K, A)        +1
#define PF_BLOCK_ARGUMENT(X, K, A)  PF_APPLY(PF_BLOCK_ARGUMENT_I, PF_PART_##A)
#define PF_BLOCK_PASSED(X, K, A)    PF_APPLY(PF_BLOCK_PASSED_I, X, PF_PART_##A)
#define PF_PART_BLOCK(O, I)         PF_HEAD(PF_SLOT_##O), PF_HEAD(PF_SLOT_##I)
#define PF_HEAD(...)                PF_HEAD_I(__VA_ARGS__)
#define PF_HEAD_I(SHAPE, NAME, ...) SHAPE, NAME
#define PF_APPLY(M, ...)            M(__VA_ARGS__)

#define PF_IN_ARGUMENT_I(K, SHAPE, NAME, ...)        , PF_UNUSED PF_ROWS_##SHAPE(const NUM, NAME)
#define PF_OUT_ARGUMENT_I(K, SHAPE, NAME, ...)       , PF_UNUSED PF_ROWS_##SHAPE(NUM, NAME)
#define PF_REAL_ARGUMENT_I(K, SHAPE, NAME, ...)      , PF_UNUSED PF_ROWS_##SHAPE(const double, NAME)
#define PF_NUMBER_I(PREFIX, K, SHAPE, NAME, ...)     PREFIX##NAME = K,
#define PF_BLOCK_ARGUMENT_I(SHAPE_O, O, SHAPE_I, I)  , PF_BLOCK_##SHAPE_O(SHAPE_I, d##O##_d##I)
#define PF_BLOCK_PASSED_I(X, SHAPE_O, O, SHAPE_I, I) , (void *)jac[X##_out_##O * X##_n_in + X##_in_##I]
#define PF_SLOT_ENTRY_I(K, SHAPE, NAME, FIELD, EVAL, ...)                                                          \
    {.name = #NAME, .field = FIELD, .eval = EVAL, .shape = PF_##SHAPE, __VA_ARGS__},
#define PF_KEY_ARGUMENT_I(K, MEMBER, NAME, LENGTH, PASSED, ...) , PF_UNUSED PASSED NAME
#define PF_KEY_PASSED_I(K, MEMBER, NAME, ...)                   , pf_keys->NAME
#define PF_KEY_MEMBER_I(K, MEMBER, NAME, LENGTH, ...)           MEMBER NAME LENGTH;
#define PF_KEY_ENTRY_I(TERM_NAME, MEMBER, NAME, LENGTH, PASSED, TYPE, UNIT, DOC, ...)                              \
    {.name = #NAME,                                                                                                \
     .unit = UNIT,                                                                                                 \
     .doc = DOC,                                                                                                   \
     .type = TYPE,                                                                                                 \
     .offset = offsetof(struct TERM_NAME##_params, NAME),                                                          \
     __VA_ARGS__},

/* M(X, K, A) for each A of a list of up to 32, which may be empty; K = 0, 1, ... */
#define PF_EACH(M, X, ...) PF_EACH_OF(PF_LENGTH(__VA_ARGS__))(M, X, 0, __VA_ARGS__)
#define PF_EACH_OF(N)      PF_EACH_OF_I(N)
#define PF_EACH_OF_I(N)    PF_EACH_##N
#define PF_LENGTH(...)                                                                                             \
    PF_LENGTH_I(_, ##__VA_ARGS__, 32, 31, 30, 29, 28, 27, 26, 25, 24, 23, 22, 21, 20, 19, 18, 17, 16, 15, 14, 13,  \
                12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0, _)
#define PF_LENGTH_I(_, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z, A, B, C, D,   \
                    E, F, N, ...)                                                                                  \
    N
#define PF_EACH_0(M, X, K, A)
#define PF_EACH_1(M, X, K, A)       M(X, K, A)
#define PF_EACH_2(M, X, K, A, ...)  M(X, K, A) PF_EACH_1(M, X, K + 1, __VA_ARGS__)
#define PF_EACH_3(M, X, K, A, ...)  M(X, K, A) PF_EACH_2(M, X, K + 1, __VA_ARGS__)
#define PF_EACH_4(M, X, K, A, ...)  M(X, K, A) PF_EACH_3(M, X, K + 1, __VA_ARGS__)
#define PF_EACH_5(M, X, K, A, ...)  M(X, K, A) PF_EACH_4(M, X, K + 1, __VA_ARGS__)
#define PF_EACH_6(M, X, K, A, ...)  M(X, K, A) PF_EACH_5(M, X, K + 1, __VA_ARGS__)
#define PF_EACH_7(M, X, K, A, ...)  M(X, K, A) PF_EACH_6(M, X, K + 1, __VA_ARGS__)
#define PF_EACH_8(M, X, K, A, ...)  M(X, K, A) PF_EACH_7(M, X, K + 1, __VA_ARGS__)
#define PF_EACH_9(M, X, K, A, ...)  M(X, K, A) PF_EACH_8(M, X, K + 1, __VA_ARGS__)
#define PF_EACH_10(M, X, K, A, ...) M(X, K, A) PF_EACH_9(M, X, K + 1, __VA_ARGS__)
#define PF_EACH_11(M, X, K, A, ...) M(X, K, A) PF_EACH_10(M, X, K + 1, __VA_ARGS__)
#define PF_EACH_12(M, X, K, A, ...) M(X, K, A) PF_EACH_11(M, X, K + 1, __VA_ARGS__)
#define PF_EACH_13(M, X, K, A, ...) M(X, K, A) PF_EACH_12(M, X, K + 1, __VA_ARGS__)
#define PF_EACH_14(M, X, K, A, ...) M(X, K, A) PF_EACH_13(M, X, K + 1, __VA_ARGS__)
#define PF_EACH_15(M, X, K, A, ...) M(X, K, A) PF_EACH_14(M, X, K + 1, __VA_ARGS__)
#define PF_EACH_16(M, X, K, A, ...) M(X, K, A) PF_EACH_15(M, X, K + 1, __VA_ARGS__)
#define PF_EACH_17(M, X, K, A, ...) M(X, K, A) PF_EACH_16(M, X, K + 1, __VA_ARGS__)
#define PF_EACH_18(M, X, K, A, ...) M(X, K, A) PF_EACH_17(M, X, K + 1, __VA_ARGS__)
#define PF_EACH_19(M, X, K, A, ...) M(X, K, A) PF_EACH_18(M, X, K + 1, __VA_ARGS__)
#define PF_EACH_20(M, X, K, A, ...) M(X, K, A) PF_EACH_19(M, X, K + 1, __VA_ARGS__)
#define PF_EACH_21(M, X, K, A, ...) M(X, K, A) PF_EACH_20(M, X, K + 1, __VA_ARGS__)
#define PF_EACH_22(M, X, K, A, ...) M(X, K, A) PF_EACH_21(M, X, K + 1, __VA_ARGS__)
#define PF_EACH_23(M, X, K, A, ...) M(X, K, A) PF_EACH_22(M, X, K + 1, __VA_ARGS__)
#define PF_EACH_24(M, X, K, A, ...) M(X, K, A) PF_EACH_23(M, X, K + 1, __VA_ARGS__)
#define PF_EACH_25(M, X, K, A, ...) M(X, K, A) PF_EACH_24(M, X, K + 1, __VA_ARGS__)
#define PF_EACH_26(M, X, K, A, ...) M(X, K, A) PF_EACH_25(M, X, K + 1, __VA_ARGS__)
#define PF_EACH_27(M, X, K, A, ...) M(X, K, A) PF_EACH_26(M, X, K + 1, __VA_ARGS__)
#define PF_EACH_28(M, X, K, A, ...) M(X, K, A) PF_EACH_27(M, X, K + 1, __VA_ARGS__)
#define PF_EACH_29(M, X, K, A, ...) M(X, K, A) PF_EACH_28(M, X, K + 1, __VA_ARGS__)
#define PF_EACH_30(M, X, K, A, ...) M(X, K, A) PF_EACH_29(M, X, K + 1, __VA_ARGS__)
#define PF_EACH_31(M, X, K, A, ...) M(X, K, A) PF_EACH_30(M, X, K + 1, __VA_ARGS__)
#define PF_EACH_32(M, X, K, A, ...) M(X, K, A) PF_EACH_31(M, X, K + 1, __VA_ARGS__)

/* What is said of parameters and of pairs before there is any point. */
#define CHECK(NAME, KEYS)                                                                                          \
    PF_CHECK_ONCE(NAME, KEYS)                                                                                      \
    PF_CHECK_KEYS(NAME, PF_OPEN_##KEYS)
#define PF_CHECK_ONCE(NAME, KEYS)                                                                                  \
    PF_CHECK_KEYS(NAME, PF_OPEN_##KEYS);                                                                           \
    int NAME##_check(const void *params, char *err, size_t n)                                                      \
    {                                                                                                              \
        const struct NAME##_params *pf_keys = params;                                                              \
        int pf_status = 0;                                                                                         \
                                                                                                                   \
        (void)pf_keys;                                                                                             \
        F(NAME##_check_keys)(&pf_status, err, n PF_EACH(PF_KEY_PASSED, NAME, PF_OPEN_##KEYS));                     \
        return pf_status;                                                                                          \
    }
#define PF_CHECK_KEYS(NAME, KEYS)                                                                                  \
    PF_UNUSED static void F(NAME##_check_keys)(PF_UNUSED int *pf_status, PF_UNUSED char *pf_err,                   \
                                               PF_UNUSED size_t pf_room PF_EACH(PF_KEY_ARGUMENT, NAME, KEYS))
#define REFUSE_UNLESS(SO, ...)                                                                                     \
    do {                                                                                                           \
        if (SO)                                                                                                    \
            break;                                                                                                 \
        snprintf(pf_err, pf_room, __VA_ARGS__);                                                                    \
        *pf_status = 1;                                                                                            \
        return;                                                                                                    \
    } while (0)

#define REACH(NAME, KEYS)                                                                                          \
    PF_REACH_ONCE(NAME, KEYS)                                                                                      \
    PF_REACH_KEYS(NAME, PF_OPEN_##KEYS)
#define PF_REACH_ONCE(NAME, KEYS)                                                                                  \
    PF_REACH_KEYS(NAME, PF_OPEN_##KEYS);                                                                           \
    double NAME##_reach(const void *params, double size, double h)                                                 \
    {                                                                                                              \
        const struct NAME##_params *pf_keys = params;                                                              \
                                                                                                                   \
        (void)pf_keys;                                                                                             \
        return F(NAME##_reach_keys)(size, h PF_EACH(PF_KEY_PASSED, NAME, PF_OPEN_##KEYS));                         \
    }
#define PF_REACH_KEYS(NAME, KEYS)                                                                                  \
    PF_UNUSED static double F(NAME##_reach_keys)(PF_UNUSED double size,                                            \
                                                 PF_UNUSED double h PF_EACH(PF_KEY_ARGUMENT, NAME, KEYS))

/* --- The plugin: PLUGIN(heat, "what it is for", FIELDS(u, T), TERMS(storage, diffusion), .author = "me").  Fields
 * are standard ones, u, p, T, c, phi, U, omega, lambda, or new ones: FIELD(tau, "Pa", "stress", .order = 1), whose
 * shape is PF_SHAPE_tau; then members of pf_plugin. --- */
#define PLUGIN(NAME, DOC, UNKNOWNS, TERMS_, ...)                                                                   \
    PF_PLUGIN_ONCE(NAME, DOC, PF_OPEN_##UNKNOWNS, PF_OPEN_##TERMS_, __VA_ARGS__)
#define PF_PLUGIN_ONCE(NAME, DOC, UNKNOWNS, TERM_LIST, ...)                                                        \
    static const pf_plugin pf_plugin_##NAME = {                                                                    \
        PF_PLUGIN,                                                                                                 \
        .min_minor = PF_ABI_MINOR,                                                                                 \
        .name = #NAME,                                                                                             \
        .version = "1.0",                                                                                          \
        .author = "",                                                                                              \
        .license = "not stated",                                                                                   \
        .doc = DOC,                                                                                                \
        .field = (const pf_field[]){PF_EACH(PF_FIELD_ENTRY, NAME, UNKNOWNS){0}},                                   \
        .n_field = sizeof((const pf_field[]){PF_EACH(PF_FIELD_ENTRY, NAME, UNKNOWNS){0}}) / sizeof(pf_field) - 1,  \
        .term = (const pf_term *const[]){PF_EACH(PF_TERM_ENTRY, NAME, TERM_LIST) NULL},                            \
        .n_term =                                                                                                  \
            sizeof((const pf_term *const[]){PF_EACH(PF_TERM_ENTRY, NAME, TERM_LIST) NULL}) / sizeof(void *) - 1,   \
        __VA_ARGS__};                                                                                              \
    PF_ENTRY(pf_plugin_##NAME)

#define PF_OPEN_FIELDS(...)     __VA_ARGS__
#define PF_OPEN_TERMS(...)      __VA_ARGS__
#define PF_TERM_ENTRY(X, K, A)  &A,
#define PF_FIELD_ENTRY(X, K, A) {PF_FIELD_##A},
#define PF_FIELD_FIELD(NAME, UNIT, DOC, ...)                                                                       \
    .name = #NAME, .unit = UNIT, .doc = DOC, .shape = PF_SHAPE_NUMBER(PF_SHAPE_##NAME), __VA_ARGS__
#define PF_SHAPE_NUMBER(S)   PF_SHAPE_NUMBER_I(S)
#define PF_SHAPE_NUMBER_I(S) PF_##S

#define PF_FIELD_u PF_FIELD_FIELD(u, "m/s", "velocity", .order = 2, .reaction = "force", .reaction_unit = "N")
#define PF_FIELD_p PF_FIELD_FIELD(p, "Pa", "pressure", .order = 1)
#define PF_FIELD_T PF_FIELD_FIELD(T, "K", "temperature", .order = 2, .reaction = "heat", .reaction_unit = "W")
#define PF_FIELD_c                                                                                                 \
    PF_FIELD_FIELD(c, "mol/m^3", "concentration", .order = 2, .reaction = "rate", .reaction_unit = "mol/s")
#define PF_FIELD_phi    PF_FIELD_FIELD(phi, "1", "share of the second fluid", .order = 2)
#define PF_FIELD_U      PF_FIELD_FIELD(U, "m/s", "velocity of a particle", .support = PF_ON_PARTICLE)
#define PF_FIELD_omega  PF_FIELD_FIELD(omega, "rad/s", "angular velocity of a particle", .support = PF_ON_PARTICLE)
#define PF_FIELD_lambda PF_FIELD_FIELD(lambda, "m/s", "multiplier of the rigid motion", .order = 2)

/* --- Functions of real and of complex numbers.  The imaginary part carries a derivative and is 1e-100 in size, so
 * that f(x + ih) = f(x) + ih f'(x) exactly. --- */
static inline pf_complex pf_complex_of(double re, double im)
{
    pf_complex z;

    __real__ z = re;
    __imag__ z = im;
    return z;
}

#define PF_CHAIN(NAME, DERIVATIVE)                                                                                 \
    static inline pf_complex pf_complex_##NAME(pf_complex z)                                                       \
    {                                                                                                              \
        const double x = creal(z), y = NAME(x), h = cimag(z), slope = h != 0 ? DERIVATIVE : 0;                     \
                                                                                                                   \
        (void)y;                                                                                                   \
        return pf_complex_of(NAME(x), h * slope);                                                                  \
    }
PF_CHAIN(sqrt, 0.5 / y)
PF_CHAIN(exp, y)
PF_CHAIN(log, 1 / x)
PF_CHAIN(sin, cos(x))
PF_CHAIN(cos, -sin(x))
PF_CHAIN(tan, 1 + y * y)
PF_CHAIN(tanh, 1 - y * y)
PF_CHAIN(atan, 1 / (1 + x * x))
PF_CHAIN(fabs, (x < 0 ? -1 : 1))

static inline pf_complex pf_complex_pow(pf_complex z, pf_complex w)
{
    const double x = creal(z), e = creal(w), y = pow(x, e);

    return pf_complex_of(y, (cimag(z) != 0 ? cimag(z) * (x > 0 ? e * y / x : e * pow(x, e - 1)) : 0) +
                                (cimag(w) != 0 ? cimag(w) * y * log(x) : 0));
}

static inline pf_complex pf_complex_max(pf_complex z, pf_complex w)
{
    return creal(z) < creal(w) ? w : z;
}

static inline pf_complex pf_complex_min(pf_complex z, pf_complex w)
{
    return creal(w) < creal(z) ? w : z;
}

static inline double pf_real_max(double x, double y)
{
    return x < y ? y : x;
}

static inline double pf_real_min(double x, double y)
{
    return y < x ? y : x;
}

#define PF_FUNCTION(NAME, x) _Generic((x), pf_complex : pf_complex_##NAME, default : NAME)(x)
#define sqrt(x)              PF_FUNCTION(sqrt, x)
#define exp(x)               PF_FUNCTION(exp, x)
#define log(x)               PF_FUNCTION(log, x)
#define sin(x)               PF_FUNCTION(sin, x)
#define cos(x)               PF_FUNCTION(cos, x)
#define tan(x)               PF_FUNCTION(tan, x)
#define tanh(x)              PF_FUNCTION(tanh, x)
#define atan(x)              PF_FUNCTION(atan, x)
#define fabs(x)              PF_FUNCTION(fabs, x)
#define pow(x, y)            _Generic((x) + (y), pf_complex : pf_complex_pow, default : pow)(x, y)
#define max(x, y)            _Generic((x) + (y), pf_complex : pf_complex_max, default : pf_real_max)(x, y)
#define min(x, y)            _Generic((x) + (y), pf_complex : pf_complex_min, default : pf_real_min)(x, y)

#elif PF_ONCE /* the second time: the same functions for complex numbers, and nothing else of the file */
#include <plugflow/twin_complex.h>

#undef PF_ONCE
#undef PF_TWIN
#undef PF_TERM_ONCE
#undef PF_PLUGIN_ONCE
#undef PF_JACOBIAN_ONCE
#undef PF_CHECK_ONCE
#undef PF_REACH_ONCE
#define PF_ONCE 0
#define PF_TWIN "plugflow/twin_complex.h" /* no third time */
#define PF_TERM_ONCE(...)
#define PF_PLUGIN_ONCE(...)
#define PF_JACOBIAN_ONCE(...)
#define PF_CHECK_ONCE(...)
#define PF_REACH_ONCE(...)
#endif
