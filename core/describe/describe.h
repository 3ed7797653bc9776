/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * describe.h -- what a case says, read into plain data.
 *
 * A description is made once and never changed.  Nothing in it belongs to Lua but functions of place and time
 * behind one interface (base/value.h).  Only this folder reads the blocks of a case (case/case.h). */
#ifndef DESCRIBE_DESCRIBE_H
#define DESCRIBE_DESCRIBE_H

#include "base/warning.h"
#include "case/case.h"
#include "mesh/mesh.h"
#include "particle/particle.h"
#include "term/term.h"

enum {
    DESCRIBE_MAX_TERMS = 32,
    DESCRIBE_MAX_LINES = 64,
    DESCRIBE_MAX_PROBES = 64,
    DESCRIBE_MAX_CONTINUED = 16,
    DESCRIBE_MAX_ITERATIONS = 50,
    DESCRIBE_MAX_PLANES = 64,
    DESCRIBE_MAX_KEYS = 32
};

/* A symmetry plane: x_axis = at. */
typedef struct symmetry_plane {
    int axis;
    double at;
    const char *boundary; /* its name, or "*" */
} symmetry_plane;

/* mesh{}: a box or a file. */
typedef struct mesh_spec {
    const case_block *block;
    mesh_box box;     /* if path is NULL */
    const char *path; /* of the file, relative to the working folder */
    value map;        /* moves the nodes, if has_map */
    int has_map;
} mesh_spec;

/* boundary "name" {}. */
typedef struct boundary_line {
    const case_block *block;
    const char *name; /* "*": what no other line names */
    int symmetry, natural;
    const char *periodic[2]; /* boundary { periodic = {a, b} }: both names, and no name of its own */
    int has_value[TERM_MAX_FIELDS];
    value value[TERM_MAX_FIELDS]; /* prescribed, by field of the description               */
    int n_flux;                   /* PF_BY_BOUNDARY terms that this line switches on     */
    term_use *flux[DESCRIBE_MAX_TERMS];
    value flux_value[DESCRIBE_MAX_TERMS];
} boundary_line;

/* A key of particle{} that terms ask for (PF_BODY_KEY). */
typedef struct body_key {
    const char *name, *unit, *doc;
    const term_use *use; /* the first that has it */
    int n_comp, vector;
    double dflt, min, max;
    double *value; /* [n_body][n_comp] */
} body_key;

enum body_motion { BODY_FREE, BODY_FIXED, BODY_PRESCRIBED };

/* particle {}, or one of particles {}. */
typedef struct body_spec {
    const case_block *block;
    shape shape;
    double density; /* kg/m^3 */
    int motion;     /* enum body_motion */
    pose start;
    value velocity, spin; /* at the start, of the surface (fixed), or prescribed: functions of t */
    double *key;          /* [n_key][3] of the description's keys */
    uint32_t has_field;   /* bit f: the body says how its field f starts, */
    double *field;        /* [TERM_MAX_FIELDS][3] and this is it */
    int held[6];          /* components of velocity (3) and spin (3; 2D: the last) held          */
} body_spec;

/* time {}. */
typedef struct time_spec {
    int unsteady;
    int order;                /* 1: BDF1, 2: BDF2                         */
    int geometry_iterations;  /* how often bodies are placed anew in a step */
    double step, start, stop; /* with a tolerance step is the first one, 0: to be chosen */
    double tolerance;         /* of steps that choose their length; 0: all are of length step */
    double steady;            /* > 0: the run ends when the flow changes by less, see run/march.c */
} time_spec;

typedef struct probe_spec {
    const char *name;
    double x[3];
} probe_spec;

typedef struct line_spec {
    const char *name;
    double from[3], to[3];
    int n; /* points */
} line_spec;

/* output {}. */
typedef struct output_spec {
    const case_block *block;
    double every;        /* time between two files of fields */
    double tables_every; /* time between two rows of tables; 0: a row a step */
    int n_field, field[TERM_MAX_FIELDS];
    uint32_t kept; /* bit f: memory f is written, too */
    int n_probe, n_line, n_force;
    probe_spec probe[DESCRIBE_MAX_PROBES];
    line_spec line[DESCRIBE_MAX_PROBES];
    const char *force[MESH_MAX_NAMES]; /* boundaries whose reactions are wanted */
    double about[3];                   /* point that torques refer to           */
    double coefficient; /* of a force of 1 N: 2 / (density velocity^2 length or area); 0: none is wanted */
    int n_shown, shown[TERM_MAX_FIELDS]; /* fields of shown_fields to write      */
    int n_integral;                      /* boundaries whose integrals are wanted; -1: all that have a name */
    const char *integral[MESH_MAX_NAMES];
} output_spec;

/* solve {}. */
typedef struct solve_spec {
    double tolerance; /* of Newton, per field */
    int max_iterations;
    double linear_tolerance; /* what GMRES with old factors may leave at most; 0: factor every matrix */
    int coarse_start;        /* of a steady case on a box; -1: where it pays */
    double fall;             /* of a step in time, see newton_options */
    const char *solver;      /* plugin of the linear solver, without "solver_"; NULL: the kernel chooses */
    void *solver_params;     /* its own struct, filled; NULL: it has none */
    int n_continued;         /* parameters of terms that a steady case is continued in, */
    double *continued[DESCRIBE_MAX_CONTINUED], from[DESCRIBE_MAX_CONTINUED], to[DESCRIBE_MAX_CONTINUED];
} solve_spec;

/* Terms that are on, of one kind. */
typedef struct term_list {
    int n;
    term_use use[DESCRIBE_MAX_TERMS];
    const case_block *block[DESCRIBE_MAX_TERMS];
} term_list;

/* A term that is left out as another one takes its place. */
typedef struct replacement {
    const term_plugin *plugin, *by_plugin;
    const pf_term *term, *by;
    int line; /* of the other one */
} replacement;

typedef struct description {
    case_file *c;           /* for messages, and for results{} */
    warning_list *warnings; /* what is doubtful but no error   */
    int dim;
    mesh_spec mesh;
    int incomplete; /* some term is unknown: what needs its fields and keys cannot be judged */
    int n_use;
    term_use use[DESCRIBE_MAX_TERMS];                /* terms that are on and give equations */
    const case_block *use_block[DESCRIBE_MAX_TERMS]; /* lines that switch them on */
    term_list law, shown;                            /* those that publish properties; that give what is shown */
    field_list shown_fields;                         /* what those show as fields, called like their slots */
    int n_started; /* of all these: the first so many have been made ready (pf_term.init) */
    int n_replaced;
    replacement replaced[DESCRIBE_MAX_TERMS];
    field_list fields;           /* their unknowns    */
    int n_line, boundary_unread; /* some line is so wrong that its boundaries are unknown */
    boundary_line *line;
    int n_body;
    body_spec *body;
    field_list kept; /* memory of terms, and what it starts from */
    value kept_initial[TERM_MAX_FIELDS];
    int has_kept[TERM_MAX_FIELDS];
    int n_key;
    body_key key[DESCRIBE_MAX_KEYS];
    reader *reading; /* the block of a body that is being read */
    value initial[TERM_MAX_FIELDS], exact[TERM_MAX_FIELDS];
    value offset[TERM_MAX_FIELDS]; /* added to what is written, not to what is solved */
    int has_initial[TERM_MAX_FIELDS], has_exact[TERM_MAX_FIELDS], has_offset[TERM_MAX_FIELDS];
    time_spec time;
    output_spec output;
    solve_spec solve;
    arena memory;
} description;

/* Reads all of a case.  What is wrong with it is collected (case_finish); an error is of a plugin or of memory. */
int describe(description *d, case_file *c, registry *r, warning_list *w, error *err);
/* What can be checked only with the mesh: names of boundaries in boundary{} and output{} (of a box: earlier),
 * facets without a condition, probes and lines.  ERR_CASE.  If all is well, terms make ready for a run
 * (pf_term.init); that ends with describe_end or with the description. */
int describe_check(description *d, const mesh *m, error *err);
void describe_end(description *d);
/* "plugin.term is left out: ...", for i < n_replaced. */
void describe_tell_replaced(const description *d, int i, char *to, size_t n);
/* facet[n_facet]: 1 where the facet belongs to a boundary line. */
void describe_facets(const description *d, const mesh *m, int line, uint8_t *facet);
/* Planes of the boundaries with symmetry = true, each once. */
int describe_planes(const description *d, const mesh *m, symmetry_plane *plane, int *n, error *err);
/* Smallest and largest coordinates of the mesh. */
void describe_bounds(const mesh *m, double *low, double *high);
void describe_destroy(description *d);

/* Whether a term of the case acts on such points (enum pf_where). */
int describe_has(const description *d, int where);
/* Whether a term whose results are shown does. */
int describe_shows(const description *d, int where);
/* Whether the mesh is a box that nothing bends, so that its sides are known before it is made. */
int describe_is_box(const description *d);
/* The field that is the bodies' velocity, or angular velocity (spin = 1); -1: none. */
int describe_motion(const description *d, int spin);
/* Whether bodies move in time. */
int describe_moves(const description *d);

/* --- between the files of this folder: one function a block --- */

int describe_mesh(description *d, error *err);
int describe_terms(description *d, registry *r, error *err);
/* Who publishes the properties that terms take. */
void describe_properties(description *d, registry *r);
int describe_boundaries(description *d, error *err);
int describe_bodies(description *d, error *err);
int describe_settings(description *d, registry *r, error *err);
/* The linear solver that solve {} names, and its keys (solver_keys.c). */
int describe_solver(description *d, registry *reg, reader *r, error *err);
/* "plugin.term" of a plugin that can be found which shows a field of this name, or NULL. */
const char *describe_who_shows(registry *r, const char *name);
/* What the shown terms show, before output{}. */
int describe_shown(description *d, error *err);
int describe_output(description *d, registry *r, error *err);
/* Numbers that terms need, and fields that nothing determines. */
void describe_check_terms(const description *d);
/* Bodies and the terms that move them and couple them with the flow. */
void describe_check_formulation(description *d);
void describe_check_box(const description *d);
/* Terms that go by a number which a replaced term would have shared with them (check_replaced.c). */
void describe_check_replaced(description *d);
/* Forces on bodies that are not counted, fields without a tie (check_exchange.c). */
void describe_check_exchange(description *d);

/* --- what they share --- */

/* The table on top of the Lua stack as a block of its own, in the line of b; pops it. */
int describe_inner(description *d, const case_block *b, const char *kind, const case_block **inner, error *err);
/* As reader_value, where `free` has no meaning. */
int describe_value(reader *r, const char *key, const char *doc, int n, int dim, value *v);
/* Finite numbers of the table on top of the stack: how many, or -1 if it is none of at most `most`. */
int describe_numbers(lua_State *l, double *v, int most);
/* Two corners of a box; as the readers return.  *dim: 2 or 3 if so many numbers stand there, else 0. */
int describe_corners(reader *r, const char *key, const char *doc, double *low, double *high, int *dim);
/* Adds a warning with file and line. */
void describe_warn(description *d, const case_block *b, const char *key, const char *fmt, ...)
    __attribute__((format(printf, 4, 5)));
/* Keys of a line about all its terms (instances.c). */
int describe_instance(description *d, reader *own, const value **inside, const char **label, error *err);
/* 0: another line has the term on, too, and says so. */
int describe_check_twice(description *d, const reader *own, const term_use *u);
/* Marks the terms that others replace; takes them out. */
void describe_replace(description *d, registry *r);
/* surfaces.c: marks terms at surfaces of bodies that the case has no use for. */
void describe_surfaces(description *d);
void describe_leave_out(description *d);
/* Terms that are on, by number: equations, then laws, then what is shown; NULL after the last.  *line: what
 * switches it on. */
term_use *describe_use(description *d, int i, const case_block **line);
/* Memory of the terms that are on (kept.c). */
int describe_kept(description *d, error *err);
void describe_initial_kept(description *d, reader *r);
void describe_check_kept(const description *d);
/* pf_term.init of all terms.  ERR_CASE. */
int describe_start(description *d, error *err);
/* Parameters and data of a term that is on, from its line and from fluid{}. */
int describe_read_param(reader *r, const pf_param *q, int dim, void *params, int *status, error *err);
int describe_term_keys(description *d, reader *own, reader *fluid, term_use *u, error *err);
/* Says that a parameter which a term on this line has to have is not there. */
void describe_missing(description *d, const case_block *own, const pf_param *q);
/* Keys on a line that belong to another term of its plugin, and in fluid{} that belong on a line. */
void describe_off_keys(description *d, reader *own, const term_plugin *plugin);
void describe_unshared_keys(description *d, reader *fluid);
/* Parameter of a term that is on, or NULL. */
const pf_param *describe_param(const term_use *u, const char *name);
/* 1 if a term on cells has the field among its unknowns and its test functions (off the diagonal a prescribed value
 * would take the place of another balance). */
int describe_field_is_balanced(const description *d, int f);
/* A key that no term has asked for in this block, but another term or block has it. */
void describe_misplaced(description *d, reader *r, const char *key, const char *fmt, ...)
    __attribute__((format(printf, 4, 5)));
/* Which keys bodies have by terms; those of a body, and how its fields start; then, with all bodies, to the terms.
 */
int describe_body_keys(description *d, error *err);
int describe_body_extras(description *d, reader *r, body_spec *q, error *err);
int describe_hand_out_keys(description *d, error *err);
/* Everything of a body but its place. */
int describe_body(description *d, reader *r, body_spec *q, error *err);
/* The shape that disk{}, sphere{} ... left on top of the Lua stack; pops it. */
int describe_shape(description *d, const case_block *b, shape *s, error *err);

#endif
