/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * file.h -- files that are complete or absent, and tables that grow line by line. */
#ifndef IO_FILE_H
#define IO_FILE_H

#include "base/arena.h"
#include "base/error.h"
#include "base/text.h"

#include <stddef.h>

/* Writes beside it, flushes to disk, renames.  ERR_IO with what to do. */
int file_write(const char *path, const void *data, size_t n, error *err);
/* The bytes of a regular file, (*bytes)[*n] with a zero behind them, in the arena.  ERR_IO, ERR_MEMORY. */
int file_read(const char *path, arena *a, unsigned char **bytes, size_t *n, error *err);
/* The folder, with those above it; it must be writable. */
int file_make_dir(const char *path, error *err);
/* Removes what an earlier run left in the folder: fields_*.vtu, *.csv, *.pvd, *.json, *.jsonl, lines/ . */
int file_clean_run(const char *dir, error *err);

/* Rows of numbers, in memory and, a line at a time, in a file. */
typedef struct table {
    char *path;
    int fd;
    int n_column;
    char **column;
    long n_row, room;
    double *row; /* [n_row][n_column] */
} table;

/* A table of these columns, in memory; table_open() makes its file. */
int table_create(table *t, const char *path, const char *const *column, int n, error *err);
int table_open(table *t, error *err);
int table_add(table *t, const double *row, error *err);
void table_destroy(table *t);

/* Appends a line to a log that is open for appending. */
int file_append(int fd, const char *path, const char *line, size_t n, error *err);

#endif
