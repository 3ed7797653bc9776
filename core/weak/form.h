/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * form.h -- what is known of a form while it is translated.  A form is read into a tree (tree.c) whose parts are
 * scalars, vectors and tensors; components of the tree are expressions with indices (index.c), which are
 * differentiated (differentiate.c) and written as C (emit.c). */
#ifndef WEAK_FORM_H
#define WEAK_FORM_H

#include "weak/weak.h"

#include "base/arena.h"

#include <setjmp.h>
#include <stddef.h>

enum symbol_kind { SYM_SLOT, SYM_TEST, SYM_REAL, SYM_VECTOR, SYM_POINT, SYM_PART };

typedef struct tree tree;

/* What has a name in the generated C: "grad_u", "viscosity", "AT(b->normal, a)". */
typedef struct symbol {
    enum symbol_kind kind;
    const char *name;   /* in C                                          */
    const char *entry;  /* in IN, OUT, PARAMS: "grad_u", "GRAD(tau)"      */
    int rank;           /* 0 scalar, 1 vector, 2 tensor                   */
    int moves, is_rate; /* an unknown, or a property, which may depend on unknowns; d/dt of one */
    int is_property;
    const struct symbol *key; /* of a property: the number that the case gives where nobody publishes it */
    int column, is_used;      /* of SYM_PART: where it begins, and whether anything speaks of it         */
    const weak_field *field;  /* of slots                                       */
    const tree *part;         /* of SYM_PART: a name that the form gives        */
} symbol;

enum { FORM_MAX_SYMBOLS = 64 };

typedef struct form {
    const weak_request *request;
    weak_field field[WEAK_MAX_FIELDS];
    int n_field;
    symbol *symbol[FORM_MAX_SYMBOLS];
    int n_symbol, n_index, only_3d, nonlinear;
    arena memory;
    error *err;
    jmp_buf failed;
} form;

/* Ends the translation: the form with a mark at `column` (from 0; -1: none) and the reason. */
void form_fail(form *f, int column, const char *fmt, ...) __attribute__((format(printf, 3, 4), noreturn));
void *form_room(form *f, size_t count, size_t size);
const char *form_text(form *f, const char *fmt, ...) __attribute__((format(printf, 2, 3)));

/* The fields there are: standard ones, and those of the request. */
void form_fields(form *f);
const weak_field *form_field(const form *f, const char *name);
/* The symbol of that kind and name, made if it is new. */
symbol *form_symbol(form *f, enum symbol_kind kind, const char *name, int rank);
/* Refuses a name that C, term.h or the generated code has for something else. */
void form_check_name(form *f, const char *name, int column);
/* The one of this name, or NULL. */
symbol *form_named(const form *f, const char *name);

/* --- tree.c --- */
struct tree {
    const char *op; /* "number", "name", "+", "dot", ... */
    double number;
    symbol *symbol;
    tree *arg[2];
    int column, rank, degree; /* degree 1: linear in a test function */
};
tree *tree_new(form *f, const char *op, int column, tree *a, tree *b);
/* Reads the request's form: parts, and the form itself. */
tree *parse_form(form *f);
/* The meaning of a name, of a function with its arguments; ranks checked. */
tree *meaning_of_name(form *f, const char *name, int column);
tree *meaning_of_call(form *f, const char *name, int column, tree **arg, int n);
tree *meaning_of_operator(form *f, const char *op, int column, tree *a, tree *b);

/* --- index.c: an index is 3 id + shift; (a + 1) % 3 has shift 1 --- */
enum expr_kind { X_NUMBER, X_SYMBOL, X_DELTA, X_ADD, X_MUL, X_DIV, X_CALL, X_SELECT, X_SUM };
typedef struct expr expr;
struct expr {
    enum expr_kind kind;
    double number;
    const symbol *symbol; /* X_SYMBOL; X_CALL: the name that the form gives to it, or NULL */
    int index[2];         /* X_SYMBOL, X_DELTA, X_SUM */
    const char *call;     /* X_CALL; "" for a part    */
    int n;
    const expr **arg;
};
int index_new(form *f);
const expr *index_number(form *f, double v);
const expr *index_symbol(form *f, const symbol *s, int i, int j);
const expr *index_delta(form *f, int i, int j);
const expr *index_add(form *f, const expr *x, const expr *y);
const expr *index_mul(form *f, const expr *x, const expr *y);
const expr *index_div(form *f, const expr *x, const expr *y);
const expr *index_call(form *f, const char *name, const symbol *part, const expr *x, const expr *y);
/* x < y ? p : q */
const expr *index_select(form *f, const expr *x, const expr *y, const expr *p, const expr *q);
const expr *index_sum(form *f, int i, const expr *body);
const expr *index_replace(form *f, const expr *e, int id, int by);
/* The index that `index` becomes if id becomes `by`. */
int index_moved(int index, int id, int by);
int index_in(const expr *e, int id);
int index_has_delta(const expr *e, int id); /* id < 0: any */
int index_same(const expr *x, const expr *y);
int index_is_number(const expr *e, double v);
/* Products over sums multiplied out where the sums hold deltas, so that each addend has its own. */
const expr *index_spread(form *f, const expr *e);

/* --- lower.c, differentiate.c --- */
const expr *lower(form *f, const tree *t, int i, int j);
/* d e / d s[i][j] */
const expr *differentiate(form *f, const expr *e, const symbol *s, int i, int j);

/* --- print.c: the names that indices and expressions have at a place of the generated code --- */
enum { PRINT_MAX = 64 };
typedef struct names {
    const form *f;
    int index[PRINT_MAX], n_index;
    const expr *known[PRINT_MAX];
    const char *name[PRINT_MAX];
    int n_known;
} names;
/* "a", "k", ...: the name of the index with this id, given now if it has none. */
const char *print_index_name(names *n, int index);
void print_expr(names *n, const expr *e, text *t);

/* --- emit.c, emit_block.c --- */
/* Statements of `type` ("NUM", "double") that give names to what is computed once a point; and one that computes
 * target = e (or +=), target with the indices `at`, in lanes of its own if nothing has a name. */
void emit_once(form *f, names *n, const expr *e, const char *type, text *t);
void emit_assignment(form *f, names *n, const char *target, const int *at, int n_at, const char *op, const expr *e,
                     const char *type, text *t);
void emit_source(form *f, const tree *t, text *source);

#endif
