/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * small_system.h -- systems of scalar fields a, b and a vector field w, of first order on 3 x 3 cells of the unit
 * square, with terms made here, for tests of what solves them. */
#ifndef SUPPORT_SMALL_SYSTEM_H
#define SUPPORT_SMALL_SYSTEM_H

#include "solve/solve.h"
#include "term/term.h"

enum { SMALL_MAX_USES = 4, SMALL_MAX_DOFS = 100 };

/* Parameters of every term; both are 1 at first. */
typedef struct small_numbers {
    double c;     /* a coefficient                       */
    double wrong; /* what the Jacobian is multiplied with */
} small_numbers;

typedef struct small_system {
    mesh m;
    field_list fields;
    space s;
    registry r;
    newton_system sys;
    term_plugin plugin;
    pf_term term[SMALL_MAX_USES];
    term_use use[SMALL_MAX_USES];
    small_numbers number[SMALL_MAX_USES];
    double x[SMALL_MAX_DOFS]; /* where a solve starts, and what it finds */
    newton_report report;
    error err;
} small_system;

/* Fields by their letters; terms up to NULL, all with these flags; solver NULL: UMFPACK. */
void small_make(small_system *f, const pf_solver *solver, uint32_t flags, const char *fields,
                const pf_term *const *terms);
#define SMALL_MAKE(F, SOLVER, FLAGS, FIELDS, ...)                                                                  \
    small_make(F, SOLVER, FLAGS, FIELDS, (const pf_term *const[]){__VA_ARGS__, NULL})
void small_destroy(small_system *f);

int small_solve(small_system *f, const newton_options *o); /* newton_solve of a steady problem from x */
void small_set(small_system *f, double v);                 /* all unknowns                            */

void assert_near(double v, double expected, double tolerance);
void assert_said(const char *text, const char *part);
/* All unknowns of a field, to 1e-9. */
void assert_field(const small_system *f, const char *name, double expected);

extern const pf_term small_cubic;      /* a^3 + a - 2 = 0, so a = 1; its Jacobian is multiplied with `wrong` */
extern const pf_term small_arctangent; /* atan a = 0 */
extern const pf_term small_plain;      /* c a - 1 = 0 */
extern const pf_term small_follower;   /* b - c |a| = 0, smooth in 1e-10: where a = 0 its derivative says nothing */
extern const pf_term small_sum_a;      /* a + b - 1 = 0, as an equation for a */
extern const pf_term small_sum_b;      /* the same for b */
extern const pf_term small_a_for_b;    /* a = 0 in the place of an equation for b */
extern const pf_term small_nan_a;      /* a - 1, NaN where x > 0.5 */
extern const pf_term small_zero_b;     /* b = 0 */
extern const pf_term small_nan_b;      /* b - 1, the same */
extern const pf_term small_zero;       /* a = 0 */
extern const pf_term small_nan_jacobian; /* b = 0 with a Jacobian of NaN where x > 0.5 */
extern const pf_term small_root;         /* sqrt(a) + 1 with a Jacobian much too small: every step leads to a < 0 */
extern const pf_term small_enclosed;     /* grad a . grad s + (c a - x) s */
extern const pf_term small_released;     /* grad a . grad s + (a - tanh a - 1000 x) s */
extern const pf_term small_floating;     /* grad w : grad v - v_1 */

#endif
