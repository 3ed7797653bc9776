/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Reads back what vtp_write writes, and what earlier versions wrote: arrays as text, one kind of cells. */
#include "io/file.h"
#include "io/vtp.h"
#include "io/vtu_xml.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What the file tells, as numbers. */
typedef struct numbers {
    size_t n;
    double *v;
} numbers;

enum { POINTS, CONNECTIVITY, OFFSETS, ID, N_ARRAY };

static const char *const array_name[N_ARRAY] = {
    [POINTS] = "Points", [CONNECTIVITY] = "connectivity", [OFFSETS] = "offsets", [ID] = "id"};

static int is_space(char c)
{
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/* The numbers between a tag and the next one; the text ends with a zero. */
static int read_numbers(const char *path, const char *name, const char *from, numbers *to, arena *a, error *err)
{
    size_t n = 0;

    for (const char *p = from; *p && *p != '<'; p++)
        n += !is_space(*p) && (p == from || is_space(p[-1]));
    ARENA_NEW(a, to->v, n + 1, err);
    to->n = n;
    for (size_t i = 0; i < n; i++) {
        char *end;

        to->v[i] = strtod(from, &end);
        if (end == from || !(fabs(to->v[i]) < 1e100) || !(is_space(*end) || *end == '<' || !*end))
            return error_set(err, ERR_IO, "%s: entry %zu of '%s' is no number", path, i, name);
        from = end;
    }
    return 0;
}

/* The end shows that the file is complete. */
static int check_end(const char *path, const char *s, size_t n, error *err)
{
    static const char last[] = "</VTKFile>";

    while (n && is_space(s[n - 1]))
        n--;
    if (n < sizeof last - 1 || memcmp(s + n - (sizeof last - 1), last, sizeof last - 1))
        return error_set(err, ERR_IO, "%s: does not end with %s: cut short? Run the case again", path, last);
    return 0;
}

/* Collects the arrays of the file's one piece. */
static int read_arrays(const char *path, const char *s, size_t n, vtp_file *v, numbers *array, arena *a, error *err)
{
    uint64_t points = 0, lines = 0, polygons = 0;
    int pieces = 0;
    vtu_tag t;

    for (const char *p = s; vtu_tag_next(p, s + n, &t); p = t.after) {
        char name[64];

        if (t.closes)
            continue;
        if (vtu_tag_is(&t, "Piece"))
            pieces +=
                vtu_tag_count(&t, "NumberOfPoints", &points) &&
                vtu_tag_count(&t, "NumberOfLines", &lines) + vtu_tag_count(&t, "NumberOfPolys", &polygons) == 1;
        if (!vtu_tag_is(&t, "DataArray") || !vtu_tag_text(&t, "Name", name, sizeof name))
            continue;
        for (int k = 0; k < N_ARRAY; k++)
            if (!array[k].v && !strcmp(name, array_name[k]))
                TRY(read_numbers(path, name, t.after, &array[k], a, err));
    }
    if (pieces != 1 || points > n || lines > n || polygons > n)
        return error_set(
            err, ERR_IO,
            "%s: %d pieces with numbers of points and of lines or polygons (%llu, %llu, %llu in %zu bytes), "
            "expected one; run the case again",
            path, pieces, (unsigned long long)points, (unsigned long long)lines, (unsigned long long)polygons, n);
    v->n_point = (size_t)points;
    v->n_cell = (size_t)(lines + polygons);
    v->polygons = polygons > 0;
    return 0;
}

static int check_count(const char *path, int which, size_t n, size_t want, error *err)
{
    if (n == want)
        return 0;
    return error_set(err, ERR_IO, "%s: '%s' has %zu entries, expected %zu; run the case again", path,
                     array_name[which], n, want);
}

/* The points of each cell. */
static int take_cells(const char *path, const numbers *array, vtp_file *v, arena *a, error *err)
{
    const numbers *corner = &array[CONNECTIVITY];

    TRY(check_count(path, OFFSETS, array[OFFSETS].n, v->n_cell, err));
    ARENA_NEW(a, v->first, v->n_cell + 1, err);
    ARENA_NEW(a, v->corner, corner->n + 1, err);
    for (size_t c = 0; c < v->n_cell; c++) {
        double end = array[OFFSETS].v[c];

        if (!(end >= (double)v->first[c] && end <= (double)corner->n))
            return error_set(err, ERR_IO, "%s: cell %zu ends at point %g of %zu", path, c, end, corner->n);
        v->first[c + 1] = (size_t)end;
    }
    TRY(check_count(path, CONNECTIVITY, corner->n, v->first[v->n_cell], err));
    for (size_t i = 0; i < corner->n; i++) {
        if (!(corner->v[i] >= 0 && corner->v[i] < (double)v->n_point))
            return error_set(err, ERR_IO, "%s: a cell has point %g of %zu", path, corner->v[i], v->n_point);
        v->corner[i] = (size_t)corner->v[i];
    }
    return 0;
}

int vtp_read(const char *path, vtp_file *v, arena *a, error *err)
{
    numbers array[N_ARRAY] = {0};
    unsigned char *bytes = NULL;
    size_t n = 0;

    memset(v, 0, sizeof *v);
    TRY(file_read(path, a, &bytes, &n, err));
    TRY(check_end(path, (const char *)bytes, n, err));
    TRY(read_arrays(path, (const char *)bytes, n, v, array, a, err));
    TRY(check_count(path, POINTS, array[POINTS].n, 3 * v->n_point, err));
    ARENA_NEW(a, v->point, v->n_point, err);
    if (v->n_point)
        memcpy(v->point, array[POINTS].v, v->n_point * sizeof *v->point);
    TRY(take_cells(path, array, v, a, err));
    TRY(check_count(path, ID, array[ID].n, v->n_cell, err));
    ARENA_NEW(a, v->id, v->n_cell, err);
    for (size_t c = 0; c < v->n_cell; c++)
        v->id[c] = (int32_t)fmax(INT32_MIN, fmin(INT32_MAX, array[ID].v[c]));
    return 0;
}
