/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * run.h -- a problem solved, step by step, with its files. */
#ifndef RUN_RUN_H
#define RUN_RUN_H

#include "io/file.h"
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
    void (*progress)(void *ctx, const run_progress *p);
    void *ctx;
} run_talk;

typedef struct run_result {
    const char *status; /* "ok", "interrupted", "not converged", ... */
    long steps;
    int newton_iterations, last_newton, gmres_iterations, factorisations, halved;
    double newton_order, newton_ratio;
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

typedef struct run {
    problem *p;
    const char *dir;
    const run_talk *talk;
    run_result *result;
    table forces, probes, particles;
    newton_time last; /* of the state that is written */
    double *contact;  /* [n_dof] rows of some terms only */
    double *body_row; /* room for a row of particles.csv, and a count a body */
    int n_body_file;
    char **body_file;
    struct located *probe_at, **line_at;
    int log_fd, warned, warned_singular, warned_order;
    int n_file, room;
    char **file;
    double *file_time;
    double start;
    double *residual; /* of the last solve */
    double *offset;   /* [n_dof] added to the solution in files */
    double *shown;    /* [n_dof] solution + offset             */
    text results;     /* JSON of the case's derived results */
} run;

int output_open(run *r, error *err);
int output_series(run *r, double t, error *err); /* forces and probes, every step */
int output_fields(run *r, double t, error *err); /* a .vtu and the .pvd           */
int output_lines(run *r, double t, error *err);
int output_event(run *r, const char *event, const char *fields_json, error *err);
int particles_open(run *r, error *err);
double particles_energy(const run *r); /* kinetic, J */
/* |force on the fluid + force on the bodies| by the terms that couple them, over the sum of forces on bodies. */
int particles_balance(run *r, double *balance, error *err);
int particles_write(run *r, double t, error *err); /* particles.csv, every step          */
int particles_outline(run *r, error *err);         /* a .vtp for the file of fields just written */
int output_summary(run *r, error *err);
void output_close(run *r);

/* |u_h - u|, |grad(u_h - u)|, |u| in L2 for a field whose exact solution the case gives. */
int norms_of_error(const problem *p, int field, double t, double *l2, double *h1, double *exact, error *err);
/* Mean of each component over the domain: of a field of the fluid only over the fluid, and bodies that move it
 * count with their motion. */
int norms_mean(const problem *p, int f, double *mean, error *err);

/* Calls the case's results(function) and leaves JSON in r->results. */
int results_evaluate(run *r, error *err);

#endif
