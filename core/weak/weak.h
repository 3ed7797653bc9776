/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * weak.h -- from a line of weak form to the source of a term:
 *
 *     rho*dot(dt(u), v) + mu*inner(grad(u) + transpose(grad(u)), grad(v))
 *
 * A form is a sum of products with one test function each; more terms of one form follow after ";", and so do names
 * for parts: "D = sym(grad(u)); 2*mu*inner(D, grad(v))".  What comes out is a C file on plugflow/term.h, with
 * residual and Jacobian, the same numbers as one would write by hand. */
#ifndef WEAK_WEAK_H
#define WEAK_WEAK_H

#include "base/error.h"
#include "base/text.h"

/* A field that forms may speak of, and its test function. */
typedef struct weak_field {
    const char *name, *test;
    int rank;       /* 0 scalar, 1 vector                   */
    int order;      /* of a new one; 0: a standard field    */
    const char *on; /* "mesh", "particle"                   */
} weak_field;

enum { WEAK_MAX_FIELDS = 24 };

typedef struct weak_request {
    const char *name, *form; /* of the plugin and of its term        */
    const char *where;       /* "PF_FLUID", ...                      */
    const char *new_fields;  /* "name:vector:2,...", or NULL         */
} weak_request;

/* What came of it: the source, and what a case has to say. */
typedef struct weak_result {
    text fluid;            /* "density = 1": keys of fluid{} that it takes */
    text source, keys;     /* keys: "k = 1, b = {1, 0}", those that must be given and are not of fluid{} */
    int unsteady, only_3d; /* there is a dt(...); a cross product */
    int n_used;
    struct weak_used {
        char name[40];
        int rank, has_test; /* a test function: an equation of its own */
    } used[WEAK_MAX_FIELDS];
} weak_result;

/* Freed with weak_free whatever comes back. */
int weak_source(const weak_request *r, weak_result *out, error *err);
void weak_free(weak_result *out);

/* Of the last of "u,T" or "T,name:vector:2": its name, its rank, and its test function. */
int weak_last_field(const char *fields, char name[40], int *rank, char test[48], error *err);

#endif
