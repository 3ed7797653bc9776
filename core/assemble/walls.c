/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Distances from the walls at the points of terms with PF_WALL_DISTANCE: of cells and facets once, of what follows
 * the bodies whenever they are placed. */
#include "assemble/batch.h"
#include "mesh/wall.h"

#include <math.h>
#include <omp.h>

/* Looks in balls that grow, from the size of the cell on. */
static int distance(const wall *walls, const double *x, double h, double *d, error *err)
{
    wall_point p;
    int n = 0;

    for (double range = h; n == 0; range *= 2)
        TRY(wall_near(walls, x, range, 1, &p, &n, err));
    *d = fabs(p.distance);
    return 0;
}

static int take_batch(const assembly *a, const assembly_class *c, int64_t batch, workspace *w, error *err)
{
    const int dim = a->space->mesh->dim;

    geometry_points(a, c, batch, w);
    for (int q = 0; q < c->n_q; q++)
        for (int l = 0; l < 8; l++) {
            double x[3] = {0}, d = INFINITY;

            for (int k = 0; k < dim; k++)
                x[k] = w->x[k * c->n_q + q][l];
            if (a->walls)
                TRY(distance(a->walls, x, w->h[q][l], &d, err));
            c->wall[batch * c->n_q + q][l] = d;
        }
    return 0;
}

int walls_update(const assembly *a, assembly_class *c, error *err)
{
    int failed = 0;

    if (!c->any_wall || c->wall_ready)
        return 0;
    ARENA_NEW(c->follows ? &c->item_memory : &c->wall_memory, c->wall, c->n_batch * c->n_q + 1, err);
#pragma omp parallel for num_threads(a->n_thread) schedule(dynamic, 16)
    for (int64_t b = 0; b < c->n_batch; b++) {
        error why;

        if (take_batch(a, c, b, &a->work[omp_get_thread_num()], &why))
#pragma omp atomic write
            failed = 1;
    }
    if (failed)
        return error_memory(err, "distances from walls", 0);
    c->wall_ready = 1;
    return 0;
}
