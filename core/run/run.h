/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * run.h -- a problem solved, step by step, with its files. */
#ifndef RUN_RUN_H
#define RUN_RUN_H

#include "base/text.h"
#include "io/file.h"
#include "io/vtu.h"
#include "problem/problem.h"

#include <signal.h>

/* What a run has to say while it runs; all optional. */
typedef struct run_progress {
    long step, steps;
    double t, dt;
    int newton;
    double residual;
} run_progress;

typedef struct run_talk {
    void (*say)(void *ctx, const char *line);
    void (*warn)(void *ctx, const char *line); /* of what is doubtful */
    void (*progress)(void *ctx, const run_progress *p);
    void *ctx;
} run_talk;

typedef struct run_result {
    const char *status; /* "ok", "interrupted", "not converged", ... */
    long steps;
    int newton_iterations, last_newton, gmres_iterations, factorisations;
    double newton_order, newton_ratio;
    int steady;    /* the run ended because the flow was */
    double change; /* relative, see is_steady (march.c)  */
    double seconds_total, seconds_assemble, seconds_factor, seconds_solve, seconds_output, peak_bytes;
    int n_error;
    struct {
        char name[40];
        double l2, h1, l2_exact;
    } error_norm[SPACE_MAX_FIELDS];
} run_result;

/* Runs the problem; writes into dir (made if need be).  *stop != 0 (a signal) ends it after the step. */
int run_problem(problem *p, const char *dir, const run_talk *talk, const volatile sig_atomic_t *stop,
                run_result *result, error *err);

/* --- between the files of this folder --- */

/* A body as it stands, or its image by a period of the mesh. */
typedef struct body_place {
    int body;
    solid solid;
} body_place;

typedef struct run {
    problem *p;
    stepper *stepper; /* the reactions of the last step */
    const char *dir;
    const run_talk *talk;
    run_result *result;
    double largest[SPACE_MAX_FIELDS];        /* size of each field so far, for is_steady */
    int before_steps;                        /* rows are of the start: there are no reactions yet */
    double *x;                               /* [n_dof] the solution, free fields with zero mean */
    double taken;                            /* its time: of the last step of the run, s */
    table forces, probes, particles, values; /* values: problem.csv */
    table integrals;
    struct showing *showing; /* NULL: no term shows anything (showing.h) */
    double *body_row;        /* room for a row of particles.csv, and a count a body */
    float *node_share;       /* [n_node] */
    int n_body_file;
    char **body_file;
    int64_t n_time, time_room;
    double *time;         /* [n_time] of the rows of tables, s */
    uint8_t *facet_count; /* [3 n_node] room for reactions of a boundary */
    struct located *probe_at, **line_at;
    int log_fd, warned, warned_singular, warned_order, warned_doubt;
    int told; /* warnings said so far */
    int n_file, room;
    char **file;
    double *file_time;
    double start;
    double *offset;  /* [n_dof] added to the solution in files */
    double *shown;   /* [n_dof] solution + offset */
    double *in_file; /* [n_dof] the same with the bodies' motion at nodes inside of them; NULL: no bodies */
    int n_place;
    body_place *place;      /* where bodies are                                        */
    int32_t *body_of_node;  /* [n_node] body that holds the node, or -1; NULL: none       */
    uint32_t empty;         /* bit f: field f has no value inside of bodies                */
    uint32_t empty_outside; /* ... has none outside of them                              */
    text results;           /* JSON of the case's derived results */
    struct flow_energy *energy;
    arena memory;
} run;

/* The one solution of a steady run (steady.c). */
int run_steady(run *r, const volatile sig_atomic_t *stop, error *err);
/* The steps of an unsteady run (march.c). */
int march(run *r, const volatile sig_atomic_t *stop, error *err);
/* What both kinds of runs do after a solution (report.c): a line for the user; a line of the log; warnings; r->x,
 * the solution as it is shown. */
void run_say(const run *r, const char *fmt, ...) __attribute__((format(printf, 2, 3)));
int run_log_solve(run *r, double t, double dt, const newton_report *report, error *err);
int run_log_failures(run *r, error *err); /* the tries at the last step that failed */
void run_warn_defect(run *r);
void run_warn_singular(run *r, const newton_report *report);
void run_warn_order(run *r, const newton_report *report);
int run_tell_warnings(run *r, error *err);
void run_take_solution(run *r);

int output_open(run *r, error *err);
/* The solution at time t as the files show it: r->shown, and where bodies are.  Before any of what follows. */
int output_take(run *r, double t, error *err);
int output_fields(run *r, double t, error *err); /* a .vtu and the .pvd           */
int output_event(run *r, const char *event, const char *fields_json, error *err);
int output_case(const run *r, error *err); /* case.json */

/* Columns of a field in tables: u, v, w for the velocity; name, or name_x, or name_xy, for others.  Their number.
 */
int output_components(const field_spec *f, const char *prefix, char (*name)[96]);
int output_has_columns(const field_spec *f);
int tables_locate(run *r, error *err);            /* ERR_CASE if a probe lies outside the mesh */
int tables_plan(run *r, text *units, error *err); /* columns and their units; no files yet */
int tables_add(run *r, double t, error *err);     /* a row of forces and probes */
/* Rows of probes and particles at the start: no step has been made, there are no forces. */
int tables_start(run *r, error *err);
int lines_locate(run *r, error *err);
int lines_write(run *r, double t, error *err);

/* --- inside of bodies (inside.c) --- */
int inside_open(run *r, error *err);
void inside_update(run *r);                                    /* after the bodies have moved              */
const body_place *inside_place(const run *r, const double *x); /* the body that holds x, or NULL */
/* Value of a field at x in the body (NULL: in the fluid): its motion, or NaN; else v stays. */
void inside_value(const run *r, const body_place *p, int field, const double *x, double *v);
/* r->body_of_node; the motion of bodies at the nodes that they hold into shown [n_dof]. */
void inside_nodes(run *r, double *shown);

/* --- fields off the mesh (off_mesh.c) --- */

enum { OFF_MESH_NAME = 96, OFF_MESH_MOST = 9 * SPACE_MAX_FIELDS };
/* Those with this support, bodies' velocity and spin left out: how many; their columns; values of a carrier,
 * returns what follows. */
int off_mesh_fields(const run *r, uint32_t support, int *list);
int off_mesh_columns(const run *r, uint32_t support, char (*name)[OFF_MESH_NAME]);
double *off_mesh_values(const run *r, uint32_t support, int32_t carrier, double *to);
int problem_table_plan(run *r, error *err);
int problem_table_add(run *r, double t, error *err); /* a row of problem.csv */

int particles_plan(run *r, error *err);
double particles_energy(const run *r); /* kinetic, J */
/* |force on the fluid + force on the bodies| by the terms that couple them, over the sum of forces on bodies. */
double particles_balance(const run *r);
int particles_write(run *r, double t, error *err); /* a row a body in particles.csv       */
int particles_outline(run *r, error *err);         /* a .vtp for the file of fields just written */
/* --- the balance of kinetic energy, and the cell Reynolds number (energy.c) --- */
int energy_open(run *r, error *err);        /* at the state at the start */
int energy_step(run *r, error *err);        /* after every step, and a steady solution */
void energy_log(const run *r, text *s);     /* members of the event of a step */
void energy_summary(const run *r, text *t); /* members of summary.json */
void energy_say(const run *r);              /* the same in words */
void energy_close(run *r);

int output_summary(run *r, error *err);
void output_close(run *r);

/* What is wrong with a function of exact{}, found at the start and not after the run. */
int norms_check(const problem *p, error *err);
/* |u_h - u|, |grad(u_h - u)|, |u| in L2 for a field whose exact solution the case gives. */
int norms_of_error(const run *r, int field, double t, double *l2, double *h1, double *exact, error *err);
/* Mean of each component over the domain: of a field of the fluid only over the fluid, and bodies that move it
 * count with their motion. */
int norms_mean(const run *r, int f, double *mean, error *err);

/* Before the run: the case's results(function) asks only for what there will be (results_check). */
int results_expect(run *r, error *err);
/* After it: calls it and leaves JSON in r->results (results_call). */
int results_evaluate(run *r, error *err);

/* Memory of terms (memory.c): by its mean over each cell; the columns of bodies' and their values, returns what
 * follows. */
int cell_fields(const run *r, vtu_cells *to, arena *memory, error *err);
int kept_columns(const run *r, char (*name)[OFF_MESH_NAME]);
double *kept_of_body(const run *r, int body, double *to);

#endif
