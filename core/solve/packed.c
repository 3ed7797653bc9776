/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "solve/packed.h"

int packed_structure(packed *p, const space *s, const pf_csr *a, error *err)
{
    int64_t *row, *col, n = 0;
    double *value;

    arena_free(&p->memory);
    p->claims = s->claims;
    p->a = *a;
    for (int64_t k = 0; s->unused && k < a->row[a->n]; k++)
        n += !s->unused[k];
    n = s->unused ? n : a->row[a->n];
    ARENA_NEW(&p->memory, col, n, err);
    p->a.col = col;
    p->a.shared_col = NULL;
    p->a.shared_shift = NULL;
    for (int64_t i = 0, at = 0; i < a->n; i++)
        for (int64_t k = a->row[i]; k < a->row[i + 1]; k++)
            if (!s->unused || !s->unused[k])
                col[at++] = pf_column(a, i, k);
    if (!s->unused)
        return 0;
    ARENA_NEW(&p->memory, row, a->n + 1, err);
    ARENA_NEW(&p->memory, value, n, err);
    for (int64_t i = 0; i < a->n; i++) {
        row[i + 1] = row[i];
        for (int64_t k = a->row[i]; k < a->row[i + 1]; k++)
            row[i + 1] += !s->unused[k];
    }
    p->a.row = row;
    p->a.value = value;
    return 0;
}

int packed_holds(const packed *p, const space *s)
{
    return p->claims == s->claims;
}

void packed_values(packed *p, const space *s, const pf_csr *a)
{
    double *value = (double *)p->a.value;
    int64_t n = 0;

    for (int64_t k = 0; s->unused && k < a->row[a->n]; k++)
        if (!s->unused[k])
            value[n++] = a->value[k];
}

void packed_destroy(packed *p)
{
    arena_free(&p->memory);
}
