/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Fields of the mesh that properties depend on, in the middle of the gap of a pair: those of the last step, so that
 * bodies are coupled with each other alone; in steady flow the fields themselves, without derivatives. */
#include "assemble/batch.h"

#include "space/evaluate.h"

void properties_frozen(const assembly *a, const assembly_class *c, const assembly_state *s, int64_t batch,
                       const plan_input *in, v8 *out)
{
    const int dim = a->space->mesh->dim, n_comp = a->space->field[in->field].n_comp;

    for (int l = 0; l < 8; l++) {
        const near_pair *near = &c->pair[c->source[assemble_item(c, batch, l)]];
        double value[9], gradient[27] = {0};
        const point_values want = {.value = value, .gradient = gradient};

        for (int k = 0; k < in->n_comp; k++)
            out[k][l] = 0;
        if (near->cell < 0 || in->eval == PF_DOT) /* as in a fluid at rest */
            continue;
        space_evaluate(a->space, in->field, s->old, near->cell, near->ref, &want);
        for (int k = 0; k < n_comp && in->eval == PF_DIV; k++)
            out[0][l] += gradient[k * dim + k];
        for (int k = 0; k < in->n_comp && in->eval != PF_DIV; k++)
            out[k][l] = in->eval == PF_GRAD ? gradient[k] : value[k];
    }
}
