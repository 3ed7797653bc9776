/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * VTK XML unstructured grids.  Cells are of second order (types 22, 28, 24, 29), data appended
 * raw with 64-bit headers; vectors have three components. */
#include "io/vtu.h"

#include "io/file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct block {
    const void *data;
    uint64_t bytes;
} block;

/* Values of a field at all nodes, [n_node][1 or 3]. */
static double *nodal(const space *s, int f, const double *x)
{
    const mesh *m = s->mesh;
    const field_spec *g = &s->field[f];
    int width = g->n_comp == 1 ? 1 : 3, n = fe_n_basis(m->type, g->order);
    double *v = calloc((size_t)(m->n_node * width), sizeof *v);
    double basis[FE_MAX_NODES][FE_MAX_NODES], ignored[FE_MAX_NODES][3];

    for (int i = 0; i < m->type->n_node; i++)
        fe_basis(m->type, g->order, m->type->x[i], basis[i], ignored);
    for (int64_t e = 0; v && e < m->n_cell; e++)
        for (int i = 0; i < m->type->n_node; i++) {
            double *to = v + (int64_t)m->cell[e * m->type->n_node + i] * width;

            for (int k = 0; k < g->n_comp; k++) {
                double sum = 0;

                for (int j = 0; j < n; j++) {
                    int local = g->order == 2 ? j : m->type->vertex[j];

                    if (basis[i][j] != 0)
                        sum += basis[i][j] * x[s->first[f][m->cell[e * m->type->n_node + local]] + k];
                }
                to[k] = sum;
            }
        }
    return v;
}

static void add_array(text *head, block *b, const char *type, const char *name, const char *unit, int width,
                      const void *data, uint64_t bytes, uint64_t *offset)
{
    text_add(head, "<DataArray type=\"%s\" Name=\"%s\"", type, name);
    if (unit)
        text_add(head, " unit=\"%s\"", unit);
    if (width > 1)
        text_add(head, " NumberOfComponents=\"%d\"", width);
    text_add(head, " format=\"appended\" offset=\"%llu\"/>\n", (unsigned long long)*offset);
    *b = (block){data, bytes};
    *offset += bytes + 8;
}

static int put_together(const char *path, text *head, const block *b, int n, error *err)
{
    static const char tail[] = "\n</AppendedData>\n</VTKFile>\n";
    size_t size = head->n + sizeof tail - 1, at;
    char *all;
    int status;

    for (int i = 0; i < n; i++)
        size += b[i].bytes + 8;
    all = head->failed ? NULL : malloc(size);
    if (!all)
        return error_memory(err, path, (double)size);
    memcpy(all, head->s, head->n);
    at = head->n;
    for (int i = 0; i < n; i++) {
        memcpy(all + at, &b[i].bytes, 8);
        memcpy(all + at + 8, b[i].data, b[i].bytes);
        at += b[i].bytes + 8;
    }
    memcpy(all + at, tail, sizeof tail - 1);
    status = file_write(path, all, size, err);
    free(all);
    return status;
}

int vtu_write(const char *path, const space *s, const int *fields, int n_field, const double *x, double t,
              error *err)
{
    const mesh *m = s->mesh;
    const fe_cell *c = m->type;
    double *points = calloc((size_t)m->n_node * 3, sizeof *points), *values[SPACE_MAX_FIELDS] = {0};
    int32_t *connectivity = malloc((size_t)(m->n_cell * c->n_node) * sizeof *connectivity);
    int64_t *ends = malloc((size_t)m->n_cell * sizeof *ends);
    uint8_t *types = malloc((size_t)m->n_cell);
    block b[SPACE_MAX_FIELDS + 4];
    uint64_t offset = 0;
    text head = {0};
    int status = 0, ok = points && connectivity && ends && types, nb = 0;

    for (int i = 0; i < n_field && ok; i++)
        ok = (values[i] = nodal(s, fields[i], x)) != NULL;
    for (int64_t i = 0; ok && i < m->n_node; i++)
        memcpy(points + 3 * i, m->x + i * m->dim, (size_t)m->dim * sizeof *points);
    for (int64_t e = 0; ok && e < m->n_cell; e++) {
        ends[e] = (e + 1) * c->n_node;
        types[e] = (uint8_t)c->vtk_type;
        for (int i = 0; i < c->n_node; i++)
            connectivity[e * c->n_node + i] = m->cell[e * c->n_node + c->vtk[i]];
    }
    text_add(&head, "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
                    "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<UnstructuredGrid>\n");
    if (isfinite(t)) {
        text_add(
            &head,
            "<FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">");
        text_number(&head, t);
        text_add(&head, "</DataArray>\n</FieldData>\n");
    }
    text_add(&head, "<Piece NumberOfPoints=\"%lld\" NumberOfCells=\"%lld\">\n<Points>\n", (long long)m->n_node,
             (long long)m->n_cell);
    add_array(&head, &b[nb++], "Float64", "Points", "m", 3, points, (uint64_t)m->n_node * 24, &offset);
    text_add(&head, "</Points>\n<Cells>\n");
    add_array(&head, &b[nb++], "Int32", "connectivity", NULL, 1, connectivity,
              (uint64_t)(m->n_cell * c->n_node) * 4, &offset);
    add_array(&head, &b[nb++], "Int64", "offsets", NULL, 1, ends, (uint64_t)m->n_cell * 8, &offset);
    add_array(&head, &b[nb++], "UInt8", "types", NULL, 1, types, (uint64_t)m->n_cell, &offset);
    text_add(&head, "</Cells>\n<PointData>\n");
    for (int i = 0; i < n_field; i++) {
        const field_spec *f = &s->field[fields[i]];
        int width = f->n_comp == 1 ? 1 : 3;

        add_array(&head, &b[nb++], "Float64", f->name, f->unit, width, values[i], (uint64_t)(m->n_node * width) * 8,
                  &offset);
    }
    text_add(&head, "</PointData>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_");
    status = ok ? put_together(path, &head, b, nb, err) : error_memory(err, path, 60.0 * (double)m->n_node);
    for (int i = 0; i < n_field; i++)
        free(values[i]);
    free(points);
    free(connectivity);
    free(ends);
    free(types);
    text_free(&head);
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
