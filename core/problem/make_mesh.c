/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The mesh of a case: a box, or a file by the plugin that reads it; moved by the case's map. */
#include "problem/problem.h"

#include <string.h>
#include <unistd.h>

/* Bytes that a cell costs before anything is solved (pattern, matrix, offsets), by dimension; measured. */
static const double bytes_per_cell[4] = {0, 0, 6e3, 250e3};

static int read_file(const description *d, registry *r, mesh *m, error *err)
{
    const pf_mesh_reader *reader_plugin;
    pf_mesh_data data = {.size = sizeof data};
    char why[1500] = "";
    int status;

    if (access(d->mesh.path, R_OK) != 0)
        return error_set(err, ERR_MESH, "mesh file %s is not there or cannot be read", d->mesh.path);
    status = registry_mesh_reader(r, "mesh_gmsh", &reader_plugin, err);
    if (status) {
        error_prefix(err,
                     "mesh file %s needs the plugin that reads Gmsh files (Debian package libgmsh-dev, then ./pf "
                     "build): ",
                     d->mesh.path);
        return status;
    }
    status = reader_plugin->read(d->mesh.path, d->dim, &data, why, sizeof why);
    if (status)
        return error_set(err, status == PF_MESH_MEMORY ? ERR_MEMORY : ERR_MESH, "mesh file %s: %s", d->mesh.path,
                         why);
    if ((int)data.dim != d->dim)
        status = error_set(err, ERR_MESH, "mesh file %s is %uD; say dim = %u in mesh{}", d->mesh.path, data.dim,
                           data.dim);
    else
        status = mesh_create_from_data(&data, d->mesh.path, m, err);
    reader_plugin->release(&data);
    return status;
}

/* Refuses meshes that cannot fit before any of them is allocated. */
static int check_size(const description *d, error *err)
{
    double cells = d->mesh.box.simplex ? (d->dim == 2 ? 2 : 6) : 1, bytes;
    double memory = (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE);

    for (int k = 0; k < d->dim; k++)
        cells *= d->mesh.box.n[k];
    bytes = cells * bytes_per_cell[d->dim] * (d->mesh.box.simplex ? 0.3 : 1);
    if (bytes <= memory)
        return 0;
    return error_set(
        err, ERR_MEMORY,
        "mesh: %.4g cells need about %.3g GB before anything is solved, this machine has %.3g GB; take fewer "
        "cells (about %.3g fit)",
        cells, bytes / 1e9, memory / 1e9, cells * memory / bytes);
}

static int make_mesh(const description *d, registry *r, mesh *m, error *err)
{
    if (d->mesh.path) {
        TRY(read_file(d, r, m, err));
    } else {
        TRY(check_size(d, err));
        TRY(mesh_create_box(&d->mesh.box, m, err));
    }
    for (int64_t i = 0; d->mesh.has_map && i < m->n_node; i++) {
        double x[3] = {0}, y[3];

        memcpy(x, m->x + i * d->dim, (size_t)d->dim * sizeof *x);
        TRY(value_at(&d->mesh.map, x, 0, y, err));
        memcpy(m->x + i * d->dim, y, (size_t)d->dim * sizeof *x);
    }
    return mesh_measure(m, err);
}

int problem_make_mesh(const description *d, registry *r, mesh *m, error *err)
{
    int status = make_mesh(d, r, m, err);

    if (status == ERR_MESH || status == ERR_MEMORY) /* others name the line themselves */
        error_prefix(err, "%s:%d: ", d->mesh.block->file, d->mesh.block->line);
    return status;
}

int problem_halve(mesh_box *box, arena *memory, error *err)
{
    for (int k = 0; k < box->dim; k++) {
        const int n = box->n[k], half = (n + 1) / 2;
        const double *fine = box->ticks[k];
        double *ticks;

        box->n[k] = half;
        if (!fine)
            continue;
        ARENA_NEW(memory, ticks, half + 1, err);
        for (int i = 0; i <= half; i++) { /* of an odd number not all ticks are among the fine ones */
            const double at = (double)i * n / half;
            const int below = at < n ? (int)at : n - 1;

            ticks[i] = fine[below] + (at - below) * (fine[below + 1] - fine[below]);
        }
        box->ticks[k] = ticks;
    }
    return 0;
}
