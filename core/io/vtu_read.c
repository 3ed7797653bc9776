/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The file is read whole.  Its XML part tells, for every array, the offset of a block behind
 * the '_' of <AppendedData>: a UInt64 byte count and as many bytes, little endian.  The arrays
 * stay where they are; vtu_number copies single values out, for they need not be aligned. */
#include "io/vtu_read.h"
#include "io/file.h"
#include "io/vtu_xml.h"

#include <plugflow/mesh.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

_Static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "values are copied out as they lie in the file");

static const struct {
    const char *name;
    size_t size;
} kind_of[] = {[VTU_FLOAT32] = {"Float32", 4},
               [VTU_FLOAT64] = {"Float64", 8},
               [VTU_INT32] = {"Int32", 4},
               [VTU_INT64] = {"Int64", 8},
               [VTU_UINT8] = {"UInt8", 1}};
enum { N_KIND = sizeof kind_of / sizeof kind_of[0] };

double vtu_number(const vtu_array *a, size_t i)
{
    float f;
    double d;

    switch (a->kind) {
    case VTU_FLOAT32:
        memcpy(&f, a->at + 4 * i, 4);
        return (double)f;
    case VTU_FLOAT64:
        memcpy(&d, a->at + 8 * i, 8);
        return d;
    default:
        return (double)vtu_integer(a, i);
    }
}

int64_t vtu_integer(const vtu_array *a, size_t i)
{
    int32_t small;
    int64_t large;

    switch (a->kind) {
    case VTU_UINT8:
        return a->at[i];
    case VTU_INT32:
        memcpy(&small, a->at + 4 * i, 4);
        return small;
    case VTU_INT64:
        memcpy(&large, a->at + 8 * i, 8);
        return large;
    default:
        return -1;
    }
}

static const fe_cell *cell_of_vtk(int64_t vtk_type)
{
    for (int type = PF_TRI6; type <= PF_HEX27; type++)
        if (fe_cell_of(type)->vtk_type == vtk_type)
            return fe_cell_of(type);
    return NULL;
}

const fe_cell *vtu_cell(const vtu_file *v, size_t c, size_t point[FE_MAX_NODES])
{
    const fe_cell *cell = cell_of_vtk(vtu_integer(&v->cell_type, c));
    size_t first = c ? (size_t)vtu_integer(&v->offset, c - 1) : 0;

    for (int i = 0; i < cell->n_node; i++)
        point[cell->vtk[i]] = (size_t)vtu_integer(&v->connectivity, first + (size_t)i);
    return cell;
}

/* What the XML part tells while it is walked through. */
typedef struct walk {
    const char *path;
    const char *end;            /* of the XML part: start of <AppendedData            */
    const unsigned char *block; /* first byte behind '_'                              */
    char section[32];           /* Points, Cells, PointData, ... or empty             */
    int pieces;
} walk;

/* Finds the appended data and the end of the file, which shows that the file is complete. */
static int find_blocks(const vtu_file *v, walk *w, error *err)
{
    static const char last[] = "</VTKFile>";
    const char *start = (const char *)v->bytes, *end = start + v->n_byte, *p = start;
    size_t n = v->n_byte;
    vtu_tag t;

    while (n && (start[n - 1] == '\n' || start[n - 1] == '\r' || start[n - 1] == ' '))
        n--;
    if (n < sizeof last - 1 || memcmp(start + n - (sizeof last - 1), last, sizeof last - 1))
        return error_set(err, ERR_IO, "%s: does not end with %s: not a .vtu file or cut short (%zu bytes)", w->path,
                         last, v->n_byte);
    for (;; p = t.after) {
        if (!vtu_tag_next(p, end, &t))
            return error_set(err, ERR_IO, "%s: has no <AppendedData>", w->path);
        if (vtu_tag_is(&t, "AppendedData") && !t.closes)
            break;
    }
    w->end = t.name - 1;
    for (p = t.after; p < end && *p != '_'; p++)
        if (*p != ' ' && *p != '\n' && *p != '\r' && *p != '\t')
            return error_set(err, ERR_IO, "%s: no '_' at the start of <AppendedData>", w->path);
    if (p == end)
        return error_set(err, ERR_IO, "%s: no '_' at the start of <AppendedData>", w->path);
    w->block = (const unsigned char *)p + 1;
    return 0;
}

static int check_form(const walk *w, const vtu_tag *t, error *err)
{
    static const char *const want[][2] = {
        {"type", "UnstructuredGrid"}, {"byte_order", "LittleEndian"}, {"header_type", "UInt64"}};
    char s[64];

    for (size_t i = 0; i < sizeof want / sizeof want[0]; i++)
        if (!vtu_tag_text(t, want[i][0], s, sizeof s) || strcmp(s, want[i][1]))
            return error_set(err, ERR_IO, "%s: %s is \"%s\", expected \"%s\"", w->path, want[i][0], s, want[i][1]);
    if (vtu_tag_text(t, "compressor", s, sizeof s))
        return error_set(err, ERR_IO, "%s: compressed (%s); only raw data can be read", w->path, s);
    return 0;
}

/* Places the array on its block of the appended data; n values are expected there. */
static int place(const vtu_file *v, const walk *w, const vtu_tag *t, vtu_array *a, error *err)
{
    uint64_t offset, room = (uint64_t)(v->bytes + v->n_byte - w->block), bytes, want;

    if (!vtu_tag_count(t, "offset", &offset))
        return error_set(err, ERR_IO, "%s: array '%s' has no offset", w->path, a->name);
    if (room < 8 || offset > room - 8)
        return error_set(err, ERR_IO, "%s: array '%s' starts at byte %llu of %llu", w->path, a->name,
                         (unsigned long long)offset, (unsigned long long)room);
    memcpy(&bytes, w->block + offset, 8);
    if (bytes > room - 8 - offset)
        return error_set(err, ERR_IO, "%s: array '%s' has %llu bytes, the file only %llu more", w->path, a->name,
                         (unsigned long long)bytes, (unsigned long long)(room - 8 - offset));
    if (a->n == SIZE_MAX) /* as many as there are */
        a->n = (size_t)bytes / kind_of[a->kind].size;
    if (__builtin_mul_overflow((uint64_t)a->n, kind_of[a->kind].size, &want) || bytes != want)
        return error_set(err, ERR_IO, "%s: array '%s' has %llu bytes, expected %llu", w->path, a->name,
                         (unsigned long long)bytes, (unsigned long long)want);
    a->at = w->block + offset + 8;
    return 0;
}

/* Time: the one value of an array, appended or written out. */
static int read_time(vtu_file *v, const walk *w, const vtu_tag *t, vtu_array *a, error *err)
{
    char s[64] = "", *rest;
    size_t room = (size_t)(w->end - t->after);

    a->n = 1;
    if (vtu_tag_text(t, "format", s, sizeof s) && !strcmp(s, "ascii")) {
        memcpy(s, t->after, room < sizeof s - 1 ? room : sizeof s - 1);
        s[sizeof s - 1] = 0;
        v->time = strtod(s, &rest);
        if (rest == s)
            return error_set(err, ERR_IO, "%s: TimeValue is not a number", w->path);
    } else {
        TRY(place(v, w, t, a, err));
        v->time = vtu_number(a, 0);
    }
    v->has_time = 1;
    memcpy(v->time_unit, a->unit, sizeof v->time_unit);
    return 0;
}

/* The array's place in v, and how many values it must have; NULL: of no interest. */
static vtu_array *array_target(vtu_file *v, const walk *w, const vtu_array *a, size_t *n)
{
    int points = !strcmp(w->section, "Points"), cells = !strcmp(w->section, "Cells");

    *n = cells ? v->n_cell : v->n_point * (size_t)a->components;
    if (points)
        return &v->point;
    if (cells && !strcmp(a->name, "connectivity")) {
        *n = SIZE_MAX;
        return &v->connectivity;
    }
    if (cells && !strcmp(a->name, "offsets"))
        return &v->offset;
    if (cells && !strcmp(a->name, "types"))
        return &v->cell_type;
    if (!strcmp(w->section, "PointData") && !strcmp(a->name, "body") && a->components == 1 && a->kind == VTU_INT32)
        return &v->body;
    if (!strcmp(w->section, "PointData") && (a->components == 1 || a->components % 3 == 0))
        return &v->field[v->n_field];
    return NULL;
}

static int read_array(vtu_file *v, const walk *w, const vtu_tag *t, error *err)
{
    vtu_array a = {.kind = N_KIND, .components = 1}, *target;
    char s[32];
    uint64_t components = 1;

    vtu_tag_text(t, "Name", a.name, sizeof a.name);
    vtu_tag_text(t, "unit", a.unit, sizeof a.unit);
    vtu_tag_text(t, "type", s, sizeof s);
    for (int k = 0; k < N_KIND; k++)
        if (!strcmp(s, kind_of[k].name))
            a.kind = k;
    if (vtu_tag_count(t, "NumberOfComponents", &components) && components > 9)
        return error_set(err, ERR_IO, "%s: array '%s' has %llu components", w->path, a.name,
                         (unsigned long long)components);
    a.components = (int)components;
    if (!strcmp(w->section, "FieldData") && !strcmp(a.name, "TimeValue") && a.kind < N_KIND)
        return read_time(v, w, t, &a, err);
    target = w->pieces ? array_target(v, w, &a, &a.n) : NULL; /* the piece tells the sizes */
    if (!target)
        return 0;
    if (a.kind == N_KIND)
        return error_set(err, ERR_IO, "%s: array '%s' has the unknown type '%s'", w->path, a.name, s);
    if (!vtu_tag_text(t, "format", s, sizeof s) || strcmp(s, "appended"))
        return error_set(err, ERR_IO, "%s: array '%s' has the format '%s', expected 'appended'", w->path, a.name,
                         s);
    if (target == v->field + v->n_field && ++v->n_field == VTU_MAX_FIELDS)
        return error_set(err, ERR_IO, "%s: has more than %d fields", w->path, VTU_MAX_FIELDS - 1);
    TRY(place(v, w, t, &a, err));
    *target = a;
    return 0;
}

static int read_piece(vtu_file *v, walk *w, const vtu_tag *t, error *err)
{
    uint64_t points, cells;

    if (w->pieces++)
        return error_set(err, ERR_IO, "%s: has several pieces; only one can be read", w->path);
    if (!vtu_tag_count(t, "NumberOfPoints", &points) || !vtu_tag_count(t, "NumberOfCells", &cells))
        return error_set(err, ERR_IO, "%s: <Piece> does not tell its numbers of points and cells", w->path);
    if (points > v->n_byte || cells > v->n_byte)
        return error_set(err, ERR_IO, "%s: %llu points and %llu cells do not fit into %zu bytes", w->path,
                         (unsigned long long)points, (unsigned long long)cells, v->n_byte);
    v->n_point = (size_t)points;
    v->n_cell = (size_t)cells;
    return 0;
}

static int read_header(vtu_file *v, walk *w, error *err)
{
    static const char *const section[] = {"FieldData", "PointData", "CellData", "Points", "Cells"};
    int form = 0;
    vtu_tag t;

    for (const char *p = (const char *)v->bytes; vtu_tag_next(p, w->end, &t); p = t.after) {
        if (vtu_tag_is(&t, "VTKFile") && !t.closes && !form++)
            TRY(check_form(w, &t, err));
        if (vtu_tag_is(&t, "Piece") && !t.closes)
            TRY(read_piece(v, w, &t, err));
        for (size_t i = 0; i < sizeof section / sizeof section[0]; i++)
            if (vtu_tag_is(&t, section[i]))
                snprintf(w->section, sizeof w->section, "%s", t.closes ? "" : section[i]);
        if (vtu_tag_is(&t, "DataArray") && !t.closes)
            TRY(read_array(v, w, &t, err));
    }
    if (!form || !w->pieces)
        return error_set(err, ERR_IO, "%s: not a .vtu file: <%s> is missing", w->path, form ? "Piece" : "VTKFile");
    return 0;
}

static int check_points(const vtu_file *v, const char *path, error *err)
{
    if (!v->point.at || v->point.components != 3 || v->point.kind > VTU_FLOAT64)
        return error_set(err, ERR_IO, "%s: has no points of 3 real components", path);
    for (size_t i = 0; i < v->point.n; i++)
        if (!(fabs(vtu_number(&v->point, i)) < 1e100))
            return error_set(err, ERR_IO, "%s: point %zu lies at %g", path, i / 3, vtu_number(&v->point, i));
    return 0;
}

static int check_cells(vtu_file *v, const char *path, error *err)
{
    int64_t before = 0;

    if (!v->connectivity.at || !v->offset.at || !v->cell_type.at || !v->n_cell)
        return error_set(err, ERR_IO, "%s: has no cells", path);
    for (size_t c = 0; c < v->n_cell; c++) {
        int64_t end = vtu_integer(&v->offset, c), type = vtu_integer(&v->cell_type, c);
        const fe_cell *cell = cell_of_vtk(type);

        if (!cell)
            return error_set(err, ERR_IO, "%s: cell %zu has the VTK type %lld, expected 22, 24, 28 or 29", path, c,
                             (long long)type);
        if (v->dim && v->dim != cell->dim)
            return error_set(err, ERR_IO, "%s: cell %zu has %d dimensions, those before %d", path, c, cell->dim,
                             v->dim);
        v->dim = cell->dim;
        if (end < before || end - before != cell->n_node || (uint64_t)end > v->connectivity.n)
            return error_set(err, ERR_IO, "%s: nodes %lld to %lld of %zu are no %s of %d nodes (cell %zu)", path,
                             (long long)before, (long long)end, v->connectivity.n, cell->name, cell->n_node, c);
        before = end;
    }
    if ((uint64_t)before != v->connectivity.n)
        return error_set(err, ERR_IO, "%s: the cells have %lld nodes of %zu", path, (long long)before,
                         v->connectivity.n);
    for (size_t i = 0; i < v->connectivity.n; i++) {
        int64_t p = vtu_integer(&v->connectivity, i);

        if (p < 0 || (uint64_t)p >= v->n_point)
            return error_set(err, ERR_IO, "%s: a cell has point %lld of %zu", path, (long long)p, v->n_point);
    }
    return 0;
}

static int read_all(vtu_file *v, const char *path, error *err)
{
    walk w = {.path = path};
    unsigned char *bytes = NULL;

    TRY(file_read(path, &v->memory, &bytes, &v->n_byte, err));
    v->bytes = bytes;
    TRY(find_blocks(v, &w, err));
    TRY(read_header(v, &w, err));
    TRY(check_points(v, path, err));
    return check_cells(v, path, err);
}

int vtu_open(vtu_file *v, const char *path, error *err)
{
    int status;

    memset(v, 0, sizeof *v);
    status = read_all(v, path, err);
    if (status)
        vtu_close(v);
    return status;
}

void vtu_close(vtu_file *v)
{
    arena_free(&v->memory);
    memset(v, 0, sizeof *v);
}
