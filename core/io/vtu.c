/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * VTK XML unstructured grids.  Cells are of second order (types 22, 28, 24, 29), data appended
 * raw with 64-bit headers; vectors have three components, symmetric tensors six (xx, yy, zz, xy, yz, xz), tensors
 * nine, as ParaView knows them. */
#include "io/vtu.h"

#include "base/arena.h"
#include "io/file.h"

#include <math.h>
#include <string.h>

typedef struct block {
    const void *data;
    uint64_t bytes;
} block;

/* Value of a field at node i of a cell: its own unknown, or, for a field of order 1, the interpolation between
 * those of the vertices; basis: of the field's order at that node. */
static void at_node(const space *s, int f, const double *x, const int32_t *cell, const double *basis, double *to)
{
    const field_spec *g = &s->field[f];
    const fe_cell *c = s->mesh->type;

    for (int k = 0; k < g->n_comp; k++) {
        double sum = 0;

        for (int j = 0; j < fe_n_basis(c, g->order); j++)
            if (basis[j] != 0)
                sum += basis[j] * x[s->first[f][cell[g->order == 2 ? j : c->vertex[j]]] + k];
        to[k] = sum;
    }
}

/* Components in a file, and which of the field's stands in each; -1: none, and 0. */
static int file_components(const field_spec *f, int dim, int *of)
{
    static const int two[] = {0, 2, -1, 1, -1, -1}, three[] = {0, 3, 5, 1, 4, 2};
    int n = f->n_comp == 1 ? 1 : f->shape == PF_SYMMETRIC ? 6 : f->shape == PF_TENSOR ? 9 : 3;

    for (int k = 0; k < n; k++) {
        of[k] = k < f->n_comp ? k : -1;
        if (n == 6)
            of[k] = dim == 2 ? two[k] : three[k];
        if (n == 9 && dim == 2)
            of[k] = k / 3 < 2 && k % 3 < 2 ? k / 3 * 2 + k % 3 : -1;
    }
    return n;
}

/* Values of a field at all nodes, v[n_node][components in the file]. */
static void nodal(const space *s, int f, const double *x, double *v)
{
    const mesh *m = s->mesh;
    const field_spec *g = &s->field[f];
    int of[VALUE_MAX], width = file_components(g, m->dim, of);
    double own[VALUE_MAX], basis[FE_MAX_NODES][FE_MAX_NODES], ignored[FE_MAX_NODES][3];

    for (int i = 0; i < m->type->n_node; i++)
        fe_basis(m->type, g->order, m->type->x[i], basis[i], ignored);
    for (int64_t e = 0; e < m->n_cell; e++)
        for (int i = 0; i < m->type->n_node; i++) {
            const int32_t *cell = m->cell + e * m->type->n_node;

            at_node(s, f, x, cell, basis[i], own);
            for (int k = 0; k < width; k++)
                v[(int64_t)cell[i] * width + k] = of[k] < 0 ? 0 : own[of[k]];
        }
}

/* No values at nodes inside of bodies, or outside of them. */
static void make_empty(const int32_t *body, int64_t n_node, int inside, int width, double *v)
{
    for (int64_t n = 0; n < n_node; n++)
        for (int k = 0; (body[n] >= 0) == inside && k < width; k++)
            v[n * width + k] = NAN;
}

/* A file as it is put together: its XML part and the blocks behind it. */
typedef struct grid_file {
    text head;
    int n;
    block b[4 * SPACE_MAX_FIELDS + 5];
    uint64_t offset; /* of the next block */
} grid_file;

static void name_components(grid_file *g, int width)
{
    static const char *const six[] = {"xx", "yy", "zz", "xy", "yz", "xz"};

    for (int k = 0; width > 3 && k < width; k++)
        text_add(&g->head, " ComponentName%d=\"%s\"", k, width == 6 ? six[k] : term_component(PF_TENSOR, 9, k));
}

static void add_array(grid_file *g, const char *type, const char *name, const char *unit, int width,
                      const void *data, int64_t bytes)
{
    text_add(&g->head, "<DataArray type=\"%s\" Name=\"%s\"", type, name);
    if (unit)
        text_add(&g->head, " unit=\"%s\"", unit);
    if (width > 1)
        text_add(&g->head, " NumberOfComponents=\"%d\"", width);
    name_components(g, width);
    text_add(&g->head, " format=\"appended\" offset=\"%llu\"/>\n", (unsigned long long)g->offset);
    g->b[g->n++] = (block){data, (uint64_t)bytes};
    g->offset += (uint64_t)bytes + 8;
}

static int add_mesh(grid_file *g, const mesh *m, arena *a, error *err)
{
    const fe_cell *c = m->type;
    double *points;
    int32_t *connectivity;
    int64_t *ends;
    uint8_t *types;

    ARENA_NEW(a, points, 3 * m->n_node, err);
    ARENA_NEW(a, connectivity, m->n_cell * c->n_node, err);
    ARENA_NEW(a, ends, m->n_cell, err);
    ARENA_NEW(a, types, m->n_cell, err);
    for (int64_t i = 0; i < m->n_node; i++)
        memcpy(points + 3 * i, m->x + i * m->dim, (size_t)m->dim * sizeof *points);
    for (int64_t e = 0; e < m->n_cell; e++) {
        ends[e] = (e + 1) * c->n_node;
        types[e] = (uint8_t)c->vtk_type;
        for (int i = 0; i < c->n_node; i++)
            connectivity[e * c->n_node + i] = m->cell[e * c->n_node + c->vtk[i]];
    }
    text_add(&g->head, "<Piece NumberOfPoints=\"%lld\" NumberOfCells=\"%lld\">\n<Points>\n", (long long)m->n_node,
             (long long)m->n_cell);
    add_array(g, "Float64", "Points", "m", 3, points, m->n_node * 24);
    text_add(&g->head, "</Points>\n<Cells>\n");
    add_array(g, "Int32", "connectivity", NULL, 1, connectivity, m->n_cell * c->n_node * 4);
    add_array(g, "Int64", "offsets", NULL, 1, ends, m->n_cell * 8);
    add_array(g, "UInt8", "types", NULL, 1, types, m->n_cell);
    text_add(&g->head, "</Cells>\n");
    return 0;
}

static int add_fields(grid_file *g, const vtu_more *of, const int32_t *body, arena *a, error *err)
{
    const space *s = of->space;
    int64_t n = s ? s->mesh->n_node : 0;

    for (int i = 0; i < of->n_field; i++) {
        const field_spec *f = &s->field[of->field[i]];
        int at[VALUE_MAX], width = file_components(f, s->mesh->dim, at);
        double *values;

        if (space_of_cells(f)) /* see vtu_cells */
            continue;
        ARENA_NEW(a, values, n * width, err);
        nodal(s, of->field[i], of->x, values);
        if (body && of->empty >> of->field[i] & 1)
            make_empty(body, n, 1, width, values);
        if (body && of->empty_outside >> of->field[i] & 1)
            make_empty(body, n, 0, width, values);
        add_array(g, "Float64", f->name, f->unit, width, values, n * width * 8);
    }
    return 0;
}

static int add_cells(grid_file *g, const mesh *m, const vtu_cells *cells, arena *a, error *err)
{
    text_add(&g->head, "<CellData>\n");
    for (int i = 0; i < cells->n; i++) {
        const field_spec *f = cells->field[i];
        int of[VALUE_MAX], width = file_components(f, m->dim, of);
        double *values;

        ARENA_NEW(a, values, m->n_cell * width, err);
        for (int64_t e = 0; e < m->n_cell; e++)
            for (int k = 0; k < width; k++)
                values[e * width + k] = of[k] < 0 ? 0 : cells->value[i][e * f->n_comp + of[k]];
        add_array(g, "Float64", f->name, f->unit, width, values, m->n_cell * width * 8);
    }
    text_add(&g->head, "</CellData>\n");
    return 0;
}

static int put_together(const char *path, const grid_file *g, arena *a, error *err)
{
    static const char tail[] = "\n</AppendedData>\n</VTKFile>\n";
    size_t size = g->head.n + g->offset + sizeof tail - 1, at = g->head.n;
    char *all;

    if (g->head.failed)
        return error_memory(err, "the XML part", (double)size);
    ARENA_NEW(a, all, size, err);
    memcpy(all, g->head.s, at);
    for (int i = 0; i < g->n; i++) {
        memcpy(all + at, &g->b[i].bytes, 8);
        memcpy(all + at + 8, g->b[i].data, g->b[i].bytes);
        at += g->b[i].bytes + 8;
    }
    memcpy(all + at, tail, sizeof tail - 1);
    return file_write(path, all, size, err);
}

int vtu_write(const char *path, const space *s, const int *fields, int n_field, const double *x, double t,
              const vtu_bodies *bodies, error *err)
{
    return vtu_write_more(path, s, fields, n_field, x, t, bodies, &(vtu_more){0}, err);
}

int vtu_write_more(const char *path, const space *s, const int *fields, int n_field, const double *x, double t,
                   const vtu_bodies *bodies, const vtu_more *more, error *err)
{
    const vtu_more own = {s,   fields, n_field, x, bodies ? bodies->empty : 0, bodies ? bodies->empty_outside : 0,
                          NULL};
    const int32_t *body = bodies ? bodies->body : NULL;
    grid_file g = {0};
    arena a = {0};
    int status;

    text_add(&g.head, "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
                      "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<UnstructuredGrid>\n");
    if (isfinite(t)) {
        text_add(
            &g.head,
            "<FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">");
        text_number(&g.head, t);
        text_add(&g.head, "</DataArray>\n</FieldData>\n");
    }
    status = add_mesh(&g, s->mesh, &a, err);
    text_add(&g.head, "<PointData>\n");
    if (!status)
        status = add_fields(&g, &own, body, &a, err);
    if (!status)
        status = add_fields(&g, more, body, &a, err);
    if (body)
        add_array(&g, "Int32", "body", NULL, 1, body, s->mesh->n_node * 4);
    text_add(&g.head, "</PointData>\n");
    if (!status && more->cells && more->cells->n)
        status = add_cells(&g, s->mesh, more->cells, &a, err);
    text_add(&g.head, "</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_");
    if (!status)
        status = put_together(path, &g, &a, err);
    if (status == ERR_MEMORY)
        error_prefix(err, "%s: ", path);
    text_free(&g.head);
    arena_free(&a);
    return status;
}

int vtu_write_pvd(const char *path, const char *const *file, const double *t, int n, error *err)
{
    text s = {0};
    int status;

    text_add(&s, "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n");
    for (int i = 0; i < n; i++) {
        text_add(&s, "<DataSet timestep=\"");
        text_number(&s, t[i]);
        text_add(&s, "\" part=\"0\" file=\"%s\"/>\n", file[i]);
    }
    text_add(&s, "</Collection>\n</VTKFile>\n");
    status = s.failed ? error_memory(err, path, 0) : file_write(path, s.s, s.n, err);
    text_free(&s);
    return status;
}
