/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "space/evaluate.h"

#include "base/dense.h"

#include <math.h>
#include <string.h>

/* First unknown of the field at local node i of the cell, or NULL. */
static const double *nodal(const space *s, int field, const double *x, int64_t cell, int i)
{
    const mesh *m = s->mesh;
    int order = s->field[field].order, local = order == 2 ? i : m->type->vertex[i];
    int64_t carrier = space_of_cells(&s->field[field]) ? space_cell_carrier(s, cell)
                      : order == 0                     ? m->n_node
                                                       : m->cell[cell * m->type->n_node + local];

    return s->first[field][carrier] < 0 ? NULL : x + s->first[field][carrier];
}

void space_evaluate(const space *s, int field, const double *x, int64_t cell, const double *xi,
                    const point_values *want)
{
    const mesh *m = s->mesh;
    int dim = m->dim, order = s->field[field].order, n_comp = s->field[field].n_comp;
    double n[FE_MAX_NODES], dn[FE_MAX_NODES][3], place[3], j[3][3], inverse[3][3], det;

    if (want->gradient || want->place || want->det) {
        det = mesh_place(m, cell, xi, place, j);
        if (want->place)
            memcpy(want->place, place, sizeof place);
        if (want->det)
            *want->det = det;
    }
    if (want->gradient) {
        dense_inverse3((const double(*)[3])j, inverse);
        memset(want->gradient, 0, (size_t)(n_comp * dim) * sizeof *want->gradient);
    }
    if (want->value)
        memset(want->value, 0, (size_t)n_comp * sizeof *want->value);
    fe_basis(m->type, order, xi, n, dn);
    for (int i = 0; i < fe_n_basis(m->type, order); i++) {
        const double *u = nodal(s, field, x, cell, i);

        for (int a = 0; want->value && a < n_comp; a++)
            want->value[a] += u ? n[i] * u[a] : NAN;
        for (int k = 0; want->gradient && u && k < dim; k++) {
            double g = 0;

            for (int b = 0; b < dim; b++)
                g += dn[i][b] * inverse[b][k];
            for (int a = 0; a < n_comp; a++)
                want->gradient[a * dim + k] += u[a] * g;
        }
    }
}

void space_integrate_basis(const space *s, int field, int64_t cell, const fe_rule *rule, double factor,
                           double *integral)
{
    const fe_cell *c = s->mesh->type;
    int order = s->field[field].order;

    for (int q = 0; q < rule->n; q++) {
        double n[FE_MAX_NODES], dn[FE_MAX_NODES][3], place[3], j[3][3];
        double volume = factor * rule->w[q] * mesh_place(s->mesh, cell, rule->x[q], place, j);

        fe_basis(c, order, rule->x[q], n, dn);
        for (int i = 0; i < fe_n_basis(c, order); i++) {
            const double *at = nodal(s, field, integral, cell, i);

            for (int k = 0; at && k < s->field[field].n_comp; k++)
                integral[at - integral + k] += volume * n[i];
        }
    }
}

int space_integrals(const space *s, int field, int degree, double *integral, error *err)
{
    fe_rule rule;

    TRY(fe_rule_cell(s->mesh->type, degree, &rule, err));
    for (int64_t e = 0; e < s->mesh->n_cell; e++)
        space_integrate_basis(s, field, e, &rule, 1, integral);
    return 0;
}
