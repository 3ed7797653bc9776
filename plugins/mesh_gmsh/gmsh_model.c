/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Opening and meshing with libgmsh, and the choice of one type of cells of second order. */
#include "gmsh_model.h"

#include <plugflow/mesh.h>

#include <gmshc.h>

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

int model_fail(build *b, int status, const char *fmt, ...)
{
    int n = snprintf(b->w->text, TEXT, "%s: ", b->path);
    va_list ap;

    va_start(ap, fmt);
    if (n >= 0 && n < TEXT)
        vsnprintf(b->w->text + n, (size_t)(TEXT - n), fmt, ap);
    va_end(ap);
    return b->w->status = status;
}

void *model_array(int64_t n, size_t size)
{
    return n < 0 || (uint64_t)n > PTRDIFF_MAX / size ? NULL : calloc(n > 0 ? (size_t)n : 1, size);
}

int model_has_suffix(const char *path, const char *suffix)
{
    size_t n = strlen(path), m = strlen(suffix);

    return n >= m && strcmp(path + n - m, suffix) == 0;
}

/* Gmsh's first error since the logger was started, which later ones follow from; "" if none. */
static void first_error(char *text, size_t n)
{
    char **log = NULL, *last = NULL;
    size_t n_log = 0;
    int err = 0;

    gmshLoggerGetLastError(&last, &err);
    snprintf(text, n, "%s", !err && last ? last : "");
    gmshFree(last);
    gmshLoggerGet(&log, &n_log, &err);
    for (size_t i = n_log; !err && i-- > 0;) {
        if (strncmp(log[i], "Error: ", 7) == 0)
            snprintf(text, n, "%s", log[i] + 7);
        gmshFree(log[i]);
    }
    gmshFree(log);
}

int model_gmsh_failed(build *b, const char *what, const char *advice)
{
    char said[300];

    first_error(said, sizeof said);
    return model_fail(b, PF_MESH_BAD, "%s%s%s; %s", what, *said ? ": Gmsh says: " : "", said, advice);
}

static int gmsh_has_error(void)
{
    char said[8];

    first_error(said, sizeof said);
    return *said != 0;
}

/* Gmsh takes a cut .msh file for a smaller mesh, and other text for a .geo script. */
static int check_msh(build *b)
{
    char tail[257] = "", head[16] = "", *last;
    FILE *f = fopen(b->path, "rb");
    long size = -1;
    size_t n;

    if (!f)
        return model_fail(b, PF_MESH_NO_FILE, "cannot be opened: %s", strerror(errno));
    n = fread(head, 1, sizeof head - 1, f);
    if (fseek(f, 0, SEEK_END) == 0)
        size = ftell(f);
    if (size > 0 && fseek(f, size > 256 ? size - 256 : 0, SEEK_SET) == 0) {
        size_t m = fread(tail, 1, 256, f);

        while (m > 0 && strchr(" \t\r\n", tail[m - 1]))
            m--;
        tail[m] = 0;
        for (size_t i = 0; i < m; i++)
            tail[i] = tail[i] ? tail[i] : ' ';
    }
    fclose(f);
    if (size == 0)
        return model_fail(b, PF_MESH_BAD, "the file is empty; write it again (gmsh -2 or -3, -order 2)");
    if (n < 1 || head[strspn(head, " \t\r\n")] != '$')
        return model_fail(b, PF_MESH_BAD, "is not a Gmsh mesh: it does not begin with $MeshFormat");
    last = strrchr(tail, '\n');
    if (strncasecmp(last ? last + 1 : tail, "$End", 4) != 0)
        return model_fail(b, PF_MESH_BAD,
                          "the file is cut off or damaged: it does not end with a closed section ($End...); "
                          "write or copy it again");
    return 0;
}

static int number_option(const char *name, double value)
{
    int err = 0;

    gmshOptionSetNumber(name, value, &err);
    return err;
}

/* What the result depends on is set before and after the file's own settings. */
static void set_options(void)
{
    number_option("General.Terminal", 0);
    number_option("General.AbortOnError", 0);
    number_option("General.NumThreads", 1);
    number_option("Mesh.SecondOrderIncomplete", 0);
}

static int open_file(build *b)
{
    int err = 0, geo = model_has_suffix(b->path, ".geo");

    if (!geo && check_msh(b))
        return b->w->status;
    gmshInitialize(0, NULL, 0, &err);
    if (err)
        return model_gmsh_failed(b, "Gmsh cannot be initialised", "check its installation");
    gmshLoggerStart(&err);
    set_options();
    gmshOpen(b->path, &err);
    if (err || gmsh_has_error())
        return model_gmsh_failed(b, geo ? "the script is wrong" : "the mesh file is damaged",
                                 geo ? "look at it with: gmsh FILE" : "write or copy it again");
    set_options();
    return 0;
}

static int find_dim(build *b, int dim)
{
    int err = 0;

    if (dim != 0 && dim != 2 && dim != 3)
        return model_fail(b, PF_MESH_BAD, "meshes of dimension %d are not possible, only 2 and 3", dim);
    if (dim == 0)
        dim = gmshModelGetDimension(&err);
    if (err || dim < 2)
        return model_gmsh_failed(b, "it has no surfaces or volumes", "a mesh needs cells of dimension 2 or 3");
    b->w->dim = (uint32_t)dim;
    return 0;
}

static int generate(build *b)
{
    int err = 0;

    if (!model_has_suffix(b->path, ".geo"))
        return 0;
    number_option("Mesh.ElementOrder", 2);
    gmshModelMeshGenerate((int)b->w->dim, &err);
    return err ? model_gmsh_failed(b, "meshing failed", "look at it with: gmsh FILE") : 0;
}

int model_properties(int type, kind *k, double *local)
{
    char *name = NULL;
    double *x = NULL;
    size_t nx = 0;
    int err = 0, dim = 0;

    memset(k, 0, sizeof *k);
    k->type = type;
    gmshModelMeshGetElementProperties(type, &name, &dim, &k->order, &k->n_node, &x, &nx, &k->n_primary, &err);
    snprintf(k->name, sizeof k->name, "%s", !err && name ? name : "unknown");
    for (size_t i = 0; local && !err && i < nx && i < MAX_NODES * 3; i++)
        local[i] = x[i];
    gmshFree(name);
    gmshFree(x);
    return err;
}

static void free_lists(size_t **list, size_t *n, size_t nn)
{
    for (size_t i = 0; i < nn; i++)
        gmshFree(list[i]);
    gmshFree(list);
    gmshFree(n);
}

int model_each_type(build *b, int dim, int entity, element_fn *f, void *arg)
{
    size_t n_type = 0, **tag = NULL, *n_tag = NULL, nn_tag = 0, **at = NULL, *n_at = NULL, nn_at = 0;
    int *type = NULL, err = 0, status = 0;

    gmshModelMeshGetElements(&type, &n_type, &tag, &n_tag, &nn_tag, &at, &n_at, &nn_at, dim, entity, &err);
    if (err)
        return model_gmsh_failed(b, "its elements cannot be read", "write the file again");
    for (size_t i = 0; i < n_type && !status; i++)
        status = n_at[i] > 0 ? f(b, type[i], at[i], n_at[i], arg) : 0;
    gmshFree(type);
    free_lists(tag, n_tag, nn_tag);
    free_lists(at, n_at, nn_at);
    return status;
}

int model_each_cell_entity(build *b, element_fn *f, void *arg)
{
    int *entity = NULL, *group = NULL, err = 0, status = 0, dim = (int)b->w->dim;
    size_t n = 0, n_group = 0, n_in;

    gmshModelGetPhysicalGroups(&group, &n_group, dim, &err);
    gmshFree(group);
    gmshModelGetEntities(&entity, &n, dim, &err);
    for (size_t i = 0; i + 1 < n && !status; i += 2) {
        n_in = 1;
        if (n_group > 0) {
            gmshModelGetPhysicalGroupsForEntity(dim, entity[i + 1], &group, &n_in, &err);
            gmshFree(group);
        }
        status = n_in > 0 ? model_each_type(b, dim, entity[i + 1], f, arg) : 0;
    }
    gmshFree(entity);
    return status;
}

typedef struct census {
    int n;
    kind kind[MAX_TYPES];
} census;

static int count_type(build *b, int type, const size_t *tag, size_t n_tag, void *arg)
{
    census *c = arg;
    int i = 0;

    (void)tag;
    while (i < c->n && c->kind[i].type != type)
        i++;
    if (i == MAX_TYPES)
        return model_fail(b, PF_MESH_BAD, "has more than %d types of cells; only one is possible", MAX_TYPES);
    if (i == c->n) {
        if (model_properties(type, &c->kind[i], NULL) || c->kind[i].n_node < 1)
            return model_gmsh_failed(b, "has cells of an unknown type", "use triangles, quads, tets or hexes");
        c->n++;
    }
    c->kind[i].count += (int64_t)(n_tag / (size_t)c->kind[i].n_node);
    return 0;
}

static int take_census(build *b, census *c)
{
    memset(c, 0, sizeof *c);
    if (model_each_cell_entity(b, count_type, c))
        return b->w->status;
    if (c->n == 0)
        return model_gmsh_failed(
            b, b->w->dim == 2 ? "it has no cells of dimension 2" : "it has no cells of dimension 3",
            "mesh it in that dimension and keep these cells in the file (with physical groups, a "
            "group of that dimension is needed)");
    return 0;
}

static int mixed(build *b, const census *c)
{
    char list[400] = "";
    size_t used = 0;

    for (int i = 0; i < c->n && used < sizeof list; i++)
        used += (size_t)snprintf(list + used, sizeof list - used, "%s%lld of type %s", i ? ", " : "",
                                 (long long)c->kind[i].count, c->kind[i].name);
    return model_fail(b, PF_MESH_BAD, "cells of one type are needed, it has %s; for one type %s", list,
                      b->w->dim == 2
                          ? "leave out Recombine (all triangles) or set Mesh.SubdivisionAlgorithm = 1 (all quads)"
                          : "leave out Recombine (all tets) or make transfinite or extruded volumes with "
                            "Recombine (all hexes)");
}

static uint32_t cell_type(int gmsh_type)
{
    switch (gmsh_type) {
    case 9:
        return PF_TRI6;
    case 10:
        return PF_QUAD9;
    case 11:
        return PF_TET10;
    case 12:
        return PF_HEX27;
    default:
        return 0;
    }
}

/* One type of cells of second order, or an error with advice. */
static int choose_type(build *b)
{
    double local[MAX_NODES * 3] = {0};
    wire *w = b->w;
    census c;
    kind k;
    int err = 0, dim = (int)w->dim;

    if (take_census(b, &c))
        return w->status;
    if (c.n == 1 && c.kind[0].order == 1) {
        gmshModelMeshSetOrder(2, &err);
        if (err)
            return model_gmsh_failed(b, "its cells cannot be made second order",
                                     "write the mesh with: gmsh -order 2");
        if (take_census(b, &c))
            return w->status;
    }
    if (c.n > 1)
        return mixed(b, &c);
    if (model_properties(c.kind[0].type, &k, local))
        return model_gmsh_failed(b, "has cells of an unknown type", "use triangles, quads, tets or hexes");
    w->type = cell_type(k.type);
    if (!w->type)
        return model_fail(b, PF_MESH_BAD,
                          "its %lld cells of type %s are not usable, only second-order triangles, quads, "
                          "tets and hexes with all their nodes (Mesh.ElementOrder = 2, "
                          "Mesh.SecondOrderIncomplete = 0)",
                          (long long)c.kind[0].count, k.name);
    if (c.kind[0].count > MAX_COUNT)
        return model_fail(b, PF_MESH_BAD, "has %lld cells, too many", (long long)c.kind[0].count);
    b->gmsh_type = k.type;
    b->cell_room = c.kind[0].count;
    w->n_local = (uint32_t)k.n_node;
    w->facet_vertices = w->type == PF_HEX27 ? 4 : w->dim;
    for (int i = 0; i < k.n_node * dim; i++)
        w->reference[i] = local[i];
    return 0;
}

int model_open(build *b, int dim)
{
    if (open_file(b) || find_dim(b, dim) || generate(b))
        return b->w->status;
    return choose_type(b);
}
