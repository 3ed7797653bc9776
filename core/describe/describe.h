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
    DESCRIBE_MAX_ITERATIONS = 50
};

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

enum body_motion { BODY_FREE, BODY_FIXED, BODY_PRESCRIBED };

/* particle {}, or one of particles {}. */
typedef struct body_spec {
    const case_block *block;
    shape shape;
    double density; /* kg/m^3 */
    int motion;     /* enum body_motion */
    pose start;
    value velocity, spin; /* at the start, of the surface (fixed), or prescribed: functions of t */
    int held[6];          /* components of velocity (3) and spin (3; 2D: the last) held          */
} body_spec;

/* time {}. */
typedef struct time_spec {
    int unsteady;
    int order;               /* 1: BDF1, 2: BDF2                         */
    int geometry_iterations; /* how often bodies are placed anew in a step */
    double step, start, stop;
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
    double every; /* time between two files of fields */
    int n_field, field[TERM_MAX_FIELDS];
    int n_probe, n_line, n_force;
    probe_spec probe[DESCRIBE_MAX_PROBES];
    line_spec line[DESCRIBE_MAX_PROBES];
    const char *force[MESH_MAX_NAMES]; /* boundaries whose reactions are wanted */
    double about[3];                   /* point that torques refer to           */
} output_spec;

/* solve {}. */
typedef struct solve_spec {
    double tolerance; /* of Newton, per field */
    int max_iterations;
    double linear_tolerance; /* of GMRES with old factors; 0: factor every matrix */
    int n_continued;         /* parameters of terms that a steady case is continued in, */
    double *continued[DESCRIBE_MAX_CONTINUED], from[DESCRIBE_MAX_CONTINUED], to[DESCRIBE_MAX_CONTINUED];
} solve_spec;

typedef struct description {
    case_file *c; /* for messages, and for results{} */
    int dim;
    mesh_spec mesh;
    int incomplete; /* some term is unknown: what needs its fields and keys cannot be judged */
    int n_use;
    term_use use[DESCRIBE_MAX_TERMS]; /* terms that are on */
    field_list fields;                /* their unknowns    */
    int n_line;
    boundary_line *line;
    int n_body;
    body_spec *body;
    value initial[TERM_MAX_FIELDS], exact[TERM_MAX_FIELDS];
    value offset[TERM_MAX_FIELDS]; /* added to what is written, not to what is solved */
    int has_initial[TERM_MAX_FIELDS], has_exact[TERM_MAX_FIELDS], has_offset[TERM_MAX_FIELDS];
    time_spec time;
    output_spec output;
    solve_spec solve;
    warning_list warnings; /* of what was read; whoever makes a problem of it goes on with the list */
    arena memory;
} description;

/* Reads all of a case; every mistake is reported at once.  ERR_CASE or ERR_PLUGIN. */
int describe(description *d, case_file *c, registry *r, error *err);
/* What can be checked only with the mesh: names of boundaries in boundary{} and output{} (of a box: earlier),
 * facets without a condition.  ERR_CASE. */
int describe_check(const description *d, const mesh *m, error *err);
/* facet[n_facet]: 1 where the facet belongs to a boundary line. */
void describe_facets(const description *d, const mesh *m, int line, uint8_t *facet);
void describe_destroy(description *d);

/* Whether a term of the case acts on such points (enum pf_where). */
int describe_has(const description *d, int where);

/* --- between the files of this folder: one function a block --- */

void describe_mesh(description *d);
int describe_terms(description *d, registry *r, error *err);
int describe_boundaries(description *d, error *err);
int describe_bodies(description *d, error *err);
void describe_settings(description *d);
void describe_output(description *d);
void describe_check_box(const description *d);

#endif
