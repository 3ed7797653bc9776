/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The order of unknowns in element vectors and matrices, and which unknowns these are on each item. */
#include "assemble/batch.h"

/* Carriers of an item. */
static int group_size(const assembly_class *c, const space *s)
{
    return c->where == PF_PAIR ? 2 : c->where == PF_CUT ? 2 * s->mesh->type->n_node : s->cell_carriers;
}

/* Fields that the class has rows or columns of. */
static uint32_t fields_of(const assembly_class *c)
{
    uint32_t found = 0;

    for (int t = 0; t < c->n_test; t++)
        found |= c->test[t].field < 0 ? 0 : 1u << c->test[t].field;
    for (int t = 0; t < c->n_trial; t++)
        found |= 1u << c->trial[t].field;
    for (int k = 0; k < c->n_input; k++)
        found |= c->input[k].field < 0 || c->input[k].frozen ? 0 : 1u << c->input[k].field;
    return found;
}

/* Numbers the entries; returns how many. */
static int number_entries(const assembly_class *c, const space *s, uint32_t fields, const element_layout *p)
{
    int n = 0;

    for (int k = 0; k < group_size(c, s); k++)
        for (int f = 0; f < s->n_field; f++)
            for (int i = 0; fields >> f & 1 && i < c->n_basis[s->field[f].order]; i++) {
                if (assemble_item_local(c, s, f, i) != k)
                    continue;
                p->at[f][i] = n;
                for (int b = 0; b < s->field[f].n_comp; b++, n++) {
                    p->field[n] = (uint8_t)f;
                    p->carrier[n] = (uint8_t)k;
                }
            }
    return n;
}

int layout_create(assembly *a, assembly_class *c, error *err)
{
    const space *s = a->space;
    element_layout *p = &c->layout;
    uint32_t fields = fields_of(c);
    int most = 1;

    for (int f = 0; f < s->n_field; f++)
        if (fields >> f & 1) {
            int n = c->n_basis[s->field[f].order];

            ARENA_NEW(&a->memory, p->at[f], n, err);
            most += n * s->field[f].n_comp;
        }
    if (most > ELEMENT_MOST_ENTRIES)
        return error_set(err, ERR_PLUGIN,
                         "the terms on the same points have fields with %d unknowns, at most %d are "
                         "possible",
                         most, ELEMENT_MOST_ENTRIES);
    ARENA_NEW(&a->memory, p->field, most, err);
    ARENA_NEW(&a->memory, p->carrier, most, err);
    p->n = number_entries(c, s, fields, p);
    p->width = (p->n + 7) / 8 * 8;
    for (int t = 0; t < c->n_test; t++)
        for (int r = 0; r < c->n_trial; r++)
            if (c->block[t][r] != SIZE_MAX)
                p->coupled[c->test[t].field] |= 1u << c->trial[r].field;
    return 0;
}

/* Points a direction if the points of a rule are products of those on a line, else 0. */
static int points_a_direction(const fe_rule *r, int dim, double *x)
{
    int n = 1, step = 1;

    while ((dim == 3 ? n * n * n : n * n) < r->n)
        n++;
    if (n > TENSOR_POINTS || (dim == 3 ? n * n * n : n * n) != r->n)
        return 0;
    for (int q = 0; q < n; q++)
        x[q] = r->x[q][0];
    for (int k = 0; k < dim; k++, step *= n)
        for (int q = 0; q < r->n; q++)
            if (r->x[q][k] != x[q / step % n])
                return 0;
    return n;
}

/* Where the matrix of two fields goes: see tensor_matrix. */
static int place_pairs(assembly *a, assembly_class *c, int row, int column, error *err)
{
    const space *s = a->space;
    const element_layout *p = &c->layout;
    int i, j, row_order = s->field[row].order, column_order = s->field[column].order;
    int n = tensor_pairs(s->mesh->dim, row_order, column_order, 0, &i, &j);

    ARENA_NEW(&a->memory, c->place[row][column], n, err);
    for (int k = 0; k < n; k++) {
        tensor_pairs(s->mesh->dim, row_order, column_order, k, &i, &j);
        c->place[row][column][k] = p->at[row][i] * p->width + p->at[column][j];
    }
    return 0;
}

int layout_tensor(assembly *a, assembly_class *c, error *err)
{
    const space *s = a->space;
    int on_cells = c->where == PF_CELL || c->where == PF_FLUID || c->where == PF_SOLID;
    double x[TENSOR_POINTS];
    int n = !on_cells || c->any_laplace || s->mesh->type->simplex
                ? 0
                : points_a_direction(&c->rule[0], s->mesh->dim, x);

    if (n == 0)
        return 0;
    ARENA_NEW(&a->memory, c->tensor, 1, err);
    tensor_create(c->tensor, s->mesh->dim, n, x);
    for (int f = 0; f < s->n_field; f++)
        for (int g = 0; g < s->n_field; g++)
            if (c->layout.coupled[f] >> g & 1)
                TRY(place_pairs(a, c, f, g, err));
    return 0;
}

int layout_items(const assembly *a, assembly_class *c, arena *memory, error *err)
{
    const space *s = a->space;
    const element_layout *p = &c->layout;

    ARENA_NEW(memory, c->dof, c->n_item * p->n + 1, err);
    for (int64_t item = 0; item < c->n_item; item++)
        for (int f = 0; f < s->n_field; f++)
            for (int i = 0; p->at[f] && i < c->n_basis[s->field[f].order]; i++) {
                int32_t *to = c->dof + item * p->n + p->at[f][i];
                int32_t carrier = space_carrier(s, c->group[item], p->carrier[p->at[f][i]]);

                for (int b = 0; b < s->field[f].n_comp; b++)
                    to[b] = carrier < 0 ? -1 : s->first[f][carrier] + b;
            }
    return 0;
}
