/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The envelope: cells within a margin of a body are attached to it.  Their nodes couple with its velocity, and the
 * matrix has room for restricted unknowns (multipliers) at them.  While each body stays within the margin only
 * weights and flags change; beyond, cells are attached anew, and the pattern of the matrix is another one. */
#include "body/body.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Margin of the attached cells, in sizes of a cell. */
#define MARGIN 1.07 /* no round number: bodies often lie along the lines of the mesh */

int envelope_holds(const bodies *b, const pose *at)
{
    if (!b->envelope.stamp)
        return 0;
    for (int k = 0; k < b->n; k++) {
        double d = 0;

        for (int i = 0; i < b->space->mesh->dim; i++)
            d += pow(at[k].x[i] - b->envelope.centre[k][i], 2);
        if (sqrt(d) > 0.95 * MARGIN * b->h_mean)
            return 0;
    }
    return 1;
}

/* Lists the pairs of cell and body, by body and image; the shift of each to e->shift.  Without lists: counts them.
 */
static int64_t list_pairs(bodies *b, const pose *at, int32_t *cell, int32_t *body)
{
    int64_t n = 0;

    for (int k = 0; k < b->n; k++)
        for (int j = 0; j < b->n_image; j++) {
            double x[3] = {at[k].x[0] + b->image[j][0], at[k].x[1] + b->image[j][1], at[k].x[2] + b->image[j][2]};
            int64_t here = cell_grid_ball(b->grid, x, b->spec[k].shape.radius + MARGIN * b->h_mean, b->near_cell);

            for (int64_t i = 0; cell && i < here; i++) {
                cell[n + i] = b->near_cell[i];
                body[n + i] = k;
                memcpy(b->envelope.shift[n + i], b->image[j], sizeof b->image[j]);
            }
            n += here;
        }
    return n;
}

int envelope_attach(bodies *b, const pose *at, error *err)
{
    envelope *e = &b->envelope;
    arena scratch = {0};
    int32_t *cell, *body;
    int64_t n = list_pairs(b, at, NULL, NULL);
    int status;

    arena_free(&e->memory);
    ARENA_NEW(&e->memory, e->centre, b->n, err);
    ARENA_NEW(&e->memory, e->shift, n + 1, err);
    for (int k = 0; k < b->n; k++)
        memcpy(e->centre[k], at[k].x, sizeof e->centre[k]);
    for (int64_t i = 0; i < b->space->mesh->n_cell; i++)
        e->first_tie[i] = -1;
    ARENA_NEW(&scratch, cell, n + 1, err);
    body = arena_alloc(&scratch, (size_t)n + 1, sizeof *body);
    if (body)
        list_pairs(b, at, cell, body);
    status =
        body ? space_attach(b->space, cell, body, n, err) : error_memory(err, "attached cells", 4.0 * (double)n);
    arena_free(&scratch);
    TRY(status);
    TRY(pairs_link(b, at, 2 * MARGIN * b->h_mean, err));
    e->stamp++;
    e->made++;
    return 0;
}
