/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * ghia.h -- the lid-driven cavity against the tables of Ghia, Ghia and Shin (1982) and of Erturk, Corke and
 * Goekcoel (2005). */
#ifndef VERIFY_GHIA_H
#define VERIFY_GHIA_H

#include "support/program.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct ghia_error {
    double largest, median;
} ghia_error;

static int ghia_ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;

    return (x > y) - (x < y);
}

enum { GHIA_ROWS = 64, GHIA_COLUMNS = 6 };

/* Rows of a reference table that do not start with #. */
static int ghia_table(const char *name, double (*row)[GHIA_COLUMNS])
{
    char path[400], line[300], *at, *end;
    int n = 0;
    FILE *f;

    snprintf(path, sizeof path, "%s/tests/verify/reference/%s", getenv("PLUGFLOW_SOURCE"), name);
    f = fopen(path, "r");
    while (f && n < GHIA_ROWS && fgets(line, sizeof line, f)) {
        int k = 0;

        for (at = line; *line != '#' && k < GHIA_COLUMNS; at = end + (*end == ',')) {
            row[n][k] = strtod(at, &end);
            if (end == at)
                break;
            k++;
        }
        n += k > 1;
    }
    if (f)
        fclose(f);
    return n;
}

static double ghia_interpolate(const double *x, const double *v, int n, double at)
{
    for (int i = 0; i + 1 < n; i++)
        if (x[i] <= at && at <= x[i + 1])
            return v[i] + (v[i + 1] - v[i]) * (at - x[i]) / (x[i + 1] - x[i]);
    return NAN;
}

/* Differences on the line lines/LINE.csv of a run from a column of a table; the coordinate `without` is left out.
 * Returns their number. */
static int ghia_differences(const char *dir, const char *line, const char *table, int column, double without,
                            double *e)
{
    int vertical = *line == 'v', n_e = 0, n, m;
    double row[GHIA_ROWS][GHIA_COLUMNS], *x, *v;
    char path[600];

    n = ghia_table(table, row);
    snprintf(path, sizeof path, "%s/%s/lines/%s.csv", scratch(), dir, line);
    m = csv_column(path, vertical ? "y" : "x", &x);
    csv_column(path, vertical ? "u" : "v", &v);
    for (int i = 0; i < n; i++)
        if (row[i][0] != without)
            e[n_e++] = fabs(ghia_interpolate(x, v, m, row[i][0]) - row[i][column]);
    free(x);
    free(v);
    return n_e;
}

static ghia_error ghia_sorted(double *e, int n)
{
    ghia_error r = {NAN, NAN};

    qsort(e, (size_t)n, sizeof *e, ghia_ascending);
    if (n >= 30)
        r = (ghia_error){e[n - 1], e[n / 2]};
    return r;
}

/* Column: 1, 2, 3 = Re 100, 400, 1000.  The printed v(0.9063) at Re = 400 is a misprint and left out. */
static ghia_error ghia_compare(const char *dir, int column)
{
    double e[2 * GHIA_ROWS];
    int n = ghia_differences(dir, "vertical", "ghia1982_u_vertical_centreline.csv", column, NAN, e);

    n += ghia_differences(dir, "horizontal", "ghia1982_v_horizontal_centreline.csv", column,
                          column == 2 ? 0.9063 : NAN, e + n);
    return ghia_sorted(e, n);
}

/* Column: 1 to 5 = Re 1000, 2500, 5000, 7500, 10000.  All places of the tables are among 201 equal ones. */
static inline ghia_error erturk_compare(const char *dir, int column)
{
    double e[2 * GHIA_ROWS];
    int n = ghia_differences(dir, "vertical", "erturk2005_u_vertical_centreline.csv", column, NAN, e);

    n += ghia_differences(dir, "horizontal", "erturk2005_v_horizontal_centreline.csv", column, NAN, e + n);
    return ghia_sorted(e, n);
}

#endif
