/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * term.h -- plugins as the kernel sees them: found, checked, copied into structs of this
 * version's layout, and their point functions with derivatives. */
#ifndef TERM_TERM_H
#define TERM_TERM_H

#include "base/arena.h"
#include "base/error.h"
#include "base/value.h"

#include <plugflow/mesh.h>
#include <plugflow/plugin.h>
#include <plugflow/solver.h>

enum { TERM_MAX_PARAMS = 32, TERM_MAX_SLOTS = 12, TERM_MAX_DIRS = 16, TERM_MAX_FILES = 64, TERM_MAX_FIELDS = 16 };

/* A plugin after its checks.  All strides are those of this version's structs. */
typedef struct term_plugin {
    const char *path;
    pf_plugin d;
    pf_term *term; /* [d.n_term] */
} term_plugin;

/* A shared object that was looked at. */
typedef struct term_file {
    char *path;
    const char *kind;   /* "equation", "solver", "mesh" or NULL */
    term_plugin plugin; /* kind "equation"                      */
    const pf_solver *solver;
    const pf_mesh_reader *mesh_reader;
    char *refused; /* why it cannot be used, or NULL */
} term_file;

typedef struct registry {
    int n_dir, n_file;
    char *dir[TERM_MAX_DIRS];
    term_file file[TERM_MAX_FILES];
    arena memory;
} registry;

/* Looks in PLUGFLOW_PLUGIN_PATH, the build tree beside the program, the installed folder;
 * loads the explicitly given files at once. */
int registry_create(registry *r, const char *const *file, int n_file, error *err);
int registry_load(registry *r, const char *path, term_file **out, error *err);
int registry_equation(registry *r, const char *name, const term_plugin **out, error *err);
/* 1 if there is a plugin file or a loaded plugin of this name, else 0 and the name that comes nearest (or NULL). */
int registry_knows(registry *r, const char *name, const char **near);
int registry_solver(registry *r, const char *name, const pf_solver **out, error *err);
int registry_mesh_reader(registry *r, const char *name, const pf_mesh_reader **out, error *err);
/* Loads whatever lies in the folders; failures stay in file[].refused. */
int registry_scan(registry *r, error *err);
void registry_destroy(registry *r);

/* Checks a description as it came from a file and copies it (check.c). */
int term_adopt(const pf_plugin *d, const char *path, arena *memory, term_plugin *out, error *err);

int term_components(uint32_t shape, int dim);
/* What tells component k of a field from the others: "", "x", "xy"; and a shape in words, "symmetric tensor". */
const char *term_component(uint32_t shape, int n_comp, int k);
const char *term_shape_name(uint32_t shape);
int term_is_tensor(uint32_t shape);
/* 1 if a mirror with this axis as its normal turns the sign of component k of a field: u_x, or T_xy, in the mirror
 * x = 0.  On a plane of symmetry it is zero. */
int term_turns_sign(uint32_t shape, int n_comp, int k, int axis);
/* 1 if the slot holds a field of unknowns, of this instant or an earlier one. */
int term_slot_field(const pf_slot *s);
/* 1 if the slot is an unknown, so that a Jacobian block belongs to it; the same of a property too, by which a term
 * is derived. */
int term_is_unknown(const pf_slot *s);
int term_is_derived(const pf_slot *s);
/* What a term's outputs are. */
enum term_kind { TERM_EQUATION, TERM_PUBLISHES, TERM_SHOWS };
enum term_kind term_kind(const pf_term *t);
/* 1 if d/dt of a field meets the field's own test function (field NULL: of any): it stores.  A residual that
 * stabilises has rates, too, but meets slopes of the test function. */
int term_stores(const pf_term *t, const char *field);
/* 1 if slopes of a field meet slopes of its test function: it is a flux that spreads the field.  With its Laplacian
 * among the inputs it is a residual that stabilises. */
int term_diffuses(const pf_term *t, const char *field);
/* Shape that the slot must have for a field of this shape, or 0. */
uint32_t term_slot_shape(uint32_t eval, uint32_t field_shape);
const char *term_where_name(uint32_t where);
const char *term_eval_name(uint32_t eval);
/* The field that the plugin declares under this name, or NULL. */
const pf_field *term_field(const term_plugin *p, const char *name);

/* What two parameters of one name differ in, "unit", "type" or "default", or NULL.  Ranges may: each term has its
 * own. */
const char *term_key_differs(const pf_param *a, const pf_param *b);

/* Fills the parameters of a term with their defaults. */
void term_defaults(const pf_term *t, void *params);

enum term_derivative { TERM_AUTO, TERM_ANALYTIC, TERM_COMPLEX, TERM_FD };

/* pf_term.init and done (host.c).  init: not 0 with why. */
int term_start(const term_plugin *p, const pf_term *t, void *params, int dim, int n_body, int unsteady, char *why,
               size_t n);
void term_end(const term_plugin *p, const pf_term *t, void *params);

/* Room that term_jacobian needs for ld lanes, in bytes. */
size_t term_jacobian_room(const pf_term *t, int dim, uint32_t ld);
/* 1 if the term has what this derivative comes from: a Jacobian by hand, a complex twin.  Differences and TERM_AUTO
 * are always possible; and a term without unknowns has nothing to derive. */
int term_has_derivative(const pf_term *t, enum term_derivative how);
/* 1 if it is the Jacobian by hand that term_jacobian calls. */
int term_derives_by_hand(const pf_term *t, enum term_derivative how);
/* d out / d in at every point, by hand, complex step or central differences (TERM_AUTO: the
 * first that the term has).  jac as in pf_jacobian_fn: where the blocks of an
 * input are NULL (in those of the first output) there is no derivative by it; room from term_jacobian_room, 64-byte
 * aligned. Returns an enum pf_status; PF_FAIL, with the reason in the report, also if the term does not have it. */
int term_jacobian(const pf_term *t, enum term_derivative how, const pf_batch *b, const double *const *in,
                  double *const *jac, void *room);

/* A term that a case switched on. */
typedef struct term_use {
    const term_plugin *plugin;
    const pf_term *term;
    int where; /* enum pf_where: the term's own, or PF_FLUID where the case narrows it */
    void *params;
    enum term_derivative how;
    const value *data[TERM_MAX_SLOTS]; /* for PF_DATA slots */
    const value *inside;               /* acts where this is above 0; NULL: on all its points                 */
    const char *label;                 /* `name` of the line, for messages and reports; NULL: it has none     */
    int replaced;                      /* another term takes its place, or there is no use for it               */
    const double *key[TERM_MAX_SLOTS]; /* for PF_BODY_KEY and PF_OTHER_KEY slots: [n_body][components] */
    const struct term_use
        *law[TERM_MAX_SLOTS]; /* for PF_PROPERTY inputs: who publishes it; NULL: see term_number */
    uint32_t given, missing;  /* bit k: parameter k stands in the case; it had to, and does not */
    uint32_t no_data;         /* bit k: the data of input k stand nowhere in the case and are 0 */
} term_use;

/* The term's own parameter of the name and shape of a PF_PROPERTY input, which is its value where nobody publishes
 * it; NULL: it has none. */
const double *term_number(const term_use *u, const pf_slot *s);
/* Whether a term takes this property. */
int term_takes(const pf_term *t, const char *property);
/* The output of a publisher that is this property; -1: it does not publish it. */
int term_publishes(const pf_term *t, const char *property);

/* --- fields: the unknowns that plugins declare (fields.c) --- */

typedef struct field_spec {
    const char *name, *unit, *doc, *reaction, *reaction_unit;
    const char *declared_by; /* plugin that declared it first */
    const char *constrains;  /* restricted fields: the field they hold, or NULL */
    int shape;
    int n_comp;
    int order;   /* 0 (off the mesh), 1 or 2      */
    int support; /* enum pf_support               */
} field_spec;

typedef struct field_list {
    int n;
    field_spec f[TERM_MAX_FIELDS];
} field_list;

/* Adds a field, or checks that it agrees with the one of this name. */
int fields_add(field_list *l, int dim, const pf_field *f, const char *plugin, error *err);
int fields_find(const field_list *l, const char *name); /* index or -1 */
/* Whether the field is the velocity of bodies, a vector in m/s or one that says which field moves with it; or their
 * spin, in rad/s.  There may be other vectors and spins of bodies. */
int fields_moves_bodies(const field_spec *f);

/* What this plugflow offers its plugins: pf_batch.host, and at their entry. */
extern const pf_host term_host;
/* Where term_host.fail leaves its text; pf_batch.kernel points here. */
typedef struct term_report {
    const char *plugin, *term;
    int status;
    char text[1000];
} term_report;

#endif
