/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Points at which a term is tested: random places, normals, bodies, all different, the same in every run; with what
 * points of their kind have, as pf_batch says. */
#include "term/bench.h"

#include <math.h>
#include <string.h>

void bench_repeat(double *row)
{
    memcpy(row + BENCH_N, row, (BENCH_LD - BENCH_N) * sizeof *row);
}

/* Room for what the batch has of each point; NULL: no memory. */
static double *numbers(bench *k, const char *name, int rows)
{
    double *p = guard_new(&k->guard, "the points'", name, (size_t)rows * BENCH_LD, sizeof *p, BENCH_LD, 1);

    if (k->n_point == BENCH_POINT_ARRAYS || !p)
        return NULL;
    k->rows[k->n_point] = rows;
    return k->point[k->n_point++] = p;
}

static const double *uniform(bench *k, const char *name, int rows, double low, double high)
{
    double *p = numbers(k, name, rows);

    for (int i = 0; p && i < rows * BENCH_LD; i++)
        p[i] = bench_number(k, low, high);
    return p;
}

static const double *unit_vectors(bench *k, const char *name)
{
    double *p = numbers(k, name, k->dim);

    for (int l = 0; p && l < BENCH_LD; l++) {
        double sum = 0;

        for (int c = 0; c < k->dim; c++) {
            p[c * BENCH_LD + l] = bench_number(k, 0.2, 1) * (bench_number(k, -1, 1) > 0 ? 1 : -1);
            sum += p[c * BENCH_LD + l] * p[c * BENCH_LD + l];
        }
        for (int c = 0; c < k->dim; c++)
            p[c * BENCH_LD + l] /= sqrt(sum);
    }
    return p;
}

/* A rotation, [row][column]: in 3D about z, then about x. */
static void rotation(double alpha, double beta, int dim, double r[3][3])
{
    const double c = cos(alpha), s = sin(alpha), d = cos(beta), e = sin(beta);
    const double in_space[3][3] = {{c, -s, 0}, {d * s, d * c, -e}, {e * s, e * c, d}};
    const double in_plane[3][3] = {{c, -s, 0}, {s, c, 0}, {0, 0, 1}};

    memcpy(r, dim == 3 ? in_space : in_plane, sizeof in_space);
}

static const double *rotations(bench *k, const char *name)
{
    double *p = numbers(k, name, k->dim * k->dim), r[3][3];

    for (int l = 0; p && l < BENCH_LD; l++) {
        rotation(bench_number(k, -3, 3), bench_number(k, -3, 3), k->dim, r);
        for (int i = 0; i < k->dim * k->dim; i++)
            p[i * BENCH_LD + l] = r[i / k->dim][i % k->dim];
    }
    return p;
}

/* Symmetric positive definite matrices: A^T A + 1, A in [-size, size]. */
static const double *positive_matrices(bench *k, const char *name, int d, double size)
{
    double *p = numbers(k, name, d * d), a[3][3];

    for (int l = 0; p && l < BENCH_LD; l++) {
        for (int i = 0; i < d * d; i++)
            a[i / d][i % d] = bench_number(k, -size, size);
        for (int i = 0; i < d * d; i++) {
            double *g = &p[i * BENCH_LD + l];

            *g = i / d == i % d;
            for (int r = 0; r < d; r++)
                *g += a[r][i / d] * a[r][i % d];
        }
    }
    return p;
}

/* to = a + sign b, where all are there. */
static void sum(const double *a, double sign, const double *b, int rows, double *to)
{
    for (int i = 0; a && b && to && i < rows * BENCH_LD; i++)
        to[i] = a[i] + sign * b[i];
}

/* What is there of a body: all of it on points that have one. */
static void place_body(bench *k, pf_batch *b)
{
    const int spin = k->dim == 2 ? 1 : 3;
    double *mass;

    b->arm = uniform(k, "arm", k->dim, -1, 1);
    b->density = uniform(k, "density", 1, 1.5, 4);
    b->centre = uniform(k, "centre", k->dim, -1, 1);
    b->axes = rotations(k, "axes");
    b->volume = uniform(k, "volume", 1, 0.1, 0.6);
    b->mass = mass = numbers(k, "mass", 1);
    for (int l = 0; mass && b->density && b->volume && l < BENCH_LD; l++)
        mass[l] = b->density[l] * b->volume[l];
    b->inertia = positive_matrices(k, "inertia", spin == 1 ? 1 : 3, 1);
    b->id = k->id;
    sum(b->centre, 1, b->arm, k->dim, k->point[0]); /* x */
}

static void place_pair(bench *k, pf_batch *b)
{
    double *centre;

    b->gap = uniform(k, "gap", 1, 0.05, 0.35);
    b->size_of = uniform(k, "size_of", 1, 0.5, 1.5);
    b->other_size = uniform(k, "other_size", 1, 0.5, 1.5);
    b->other_density = uniform(k, "other_density", 1, 1.5, 4);
    b->other_axes = rotations(k, "other_axes");
    b->other_arm = uniform(k, "other_arm", k->dim, -1, 1);
    b->other_centre = centre = numbers(k, "other_centre", k->dim);
    sum(b->x, -1, b->other_arm, k->dim, centre);
    b->other_id = k->other_id;
}

static void place_all(bench *k, pf_batch *b)
{
    const uint32_t where = k->t->where, flags = k->t->flags;
    const int on_pair = where == PF_PAIR, on_surface = where == PF_SURFACE, on_body = where == PF_PARTICLE;

    b->x = uniform(k, "x", k->dim, -1, 1);
    b->h = uniform(k, "h", 1, 0.05, 0.35);
    if (where == PF_FACET || on_surface || on_pair)
        b->normal = unit_vectors(k, "normal");
    if (where == PF_SOLID || on_surface || on_pair || on_body)
        place_body(k, b);
    if (on_pair)
        place_pair(k, b);
    if (on_surface)
        b->curvature = uniform(k, "curvature", 1, 0.5, 3);
    if (on_body) {
        b->fluid_force = uniform(k, "fluid_force", k->dim, -1, 1);
        b->fluid_torque = uniform(k, "fluid_torque", k->dim == 2 ? 1 : 3, -1, 1);
    }
    if (flags & PF_METRIC)
        b->metric = positive_matrices(k, "metric", k->dim, 3);
    if (flags & PF_WALL_DISTANCE)
        b->wall_distance = uniform(k, "wall_distance", 1, 0.1, 1);
}

int bench_points(bench *k, error *err)
{
    pf_batch *b = &k->b;

    k->id = guard_new(&k->guard, "the points'", "id", BENCH_LD, sizeof *k->id, BENCH_LD, 1);
    k->other_id = guard_new(&k->guard, "the points'", "other_id", BENCH_LD, sizeof *k->id, BENCH_LD, 1);
    if (!k->id || !k->other_id)
        return error_memory(err, "test of a term", 0);
    for (int l = 0; l < BENCH_LD; l++)
        k->id[l] = l % BENCH_N % 5, k->other_id[l] = 5 + l % BENCH_N % 4;
    *b = (pf_batch){
        .size = sizeof(pf_batch),
        .dim = (uint32_t)k->dim,
        .n = BENCH_N,
        .ld = BENCH_LD,
        .t = 0.7,
        .dt = 0.1,
        .shift = 15,
        .params = k->params,
        .scratch = k->scratch,
        .kernel = &k->report,
        .host = &term_host,
    };
    place_all(k, b);
    for (int i = 0; i < k->n_point; i++)
        for (int r = 0; r < k->rows[i]; r++)
            bench_repeat(k->point[i] + r * BENCH_LD);
    return k->n_point > 0 && k->point[k->n_point - 1] ? 0 : error_memory(err, "test of a term", 0);
}

static void put_all(bench *k, const double *array, double v)
{
    for (int i = 0; array && i < k->n_point; i++)
        for (int l = 0; k->point[i] == array && l < BENCH_LD; l++)
            k->point[i][l] = v;
}

void bench_example_points(bench *k)
{
    static const double g[3][3] = {{4, 1, 0}, {1, 2, 0}, {0, 0, 1}};
    const double normal[3] = {0.6, k->dim == 2 ? -0.8 : 0.48, 0.64};

    for (int i = 0; i < k->n_point; i++)
        for (int r = 0; r < k->rows[i]; r++)
            for (int l = 0; l < BENCH_LD; l++) {
                double *v = &k->point[i][r * BENCH_LD + l];

                *v = k->point[i] == k->b.normal   ? normal[r]
                     : k->point[i] == k->b.metric ? g[r / k->dim][r % k->dim]
                                                  : *v;
            }
    put_all(k, k->b.h, 0.1);
    put_all(k, k->b.gap, 0.1);
    put_all(k, k->b.density, 2);
    put_all(k, k->b.size_of, 2);
    put_all(k, k->b.other_size, 2);
    put_all(k, k->b.other_density, 2);
}

static void reverse(double *row)
{
    for (int l = 0; l < BENCH_N / 2; l++) {
        double swap = row[l];

        row[l] = row[BENCH_N - 1 - l], row[BENCH_N - 1 - l] = swap;
    }
    bench_repeat(row);
}

static void reverse_whole(int32_t *row)
{
    for (int l = 0; l < BENCH_N / 2; l++) {
        int32_t swap = row[l];

        row[l] = row[BENCH_N - 1 - l], row[BENCH_N - 1 - l] = swap;
    }
    for (int l = BENCH_N; l < BENCH_LD; l++)
        row[l] = row[l - BENCH_N];
}

void bench_reverse(bench *k)
{
    for (uint32_t i = 0; i < k->t->n_in; i++)
        for (int c = 0; c < bench_components(k, &k->t->in[i]); c++)
            reverse(k->in[i] + c * BENCH_LD);
    for (int i = 0; i < k->n_point; i++)
        for (int r = 0; r < k->rows[i]; r++)
            reverse(k->point[i] + r * BENCH_LD);
    reverse_whole(k->id);
    reverse_whole(k->other_id);
}
