/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * vtu.h -- fields for ParaView: quadratic cells, appended raw, one file a time. */
#ifndef IO_VTU_H
#define IO_VTU_H

#include "space/space.h"

/* Writes fields[] (order 1 ones are interpolated to all nodes, exactly) at time t; NAN: a steady state. */
int vtu_write(const char *path, const space *s, const int *fields, int n_field, const double *x, double t,
              error *err);
/* The list of files with their times. */
int vtu_write_pvd(const char *path, const char *const *file, const double *t, int n, error *err);

#endif
