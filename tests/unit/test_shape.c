/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Shapes: moments, reach, and what becomes of a distance function that fails. */
#include "base/text.h"
#include "particle/particle.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* --- distance functions; ctx: half widths --- */

static int of_ellipsoid(const void *ctx, const double *x, double t, double *out, error *err)
{
    const double *h = ctx;
    double v = 0;

    (void)t, (void)err;
    for (int k = 0; k < 3; k++)
        v += h[k] > 0 ? x[k] * x[k] / (h[k] * h[k]) : 0;
    out[0] = h[0] * (sqrt(v) - 1);
    return 0;
}

/* Turned by 0.4 about z, so that its faces are not those of cells. */
static int of_box(const void *ctx, const double *x, double t, double *out, error *err)
{
    const double *h = ctx, c = cos(0.4), s = sin(0.4), own[3] = {c * x[0] + s * x[1], c * x[1] - s * x[0], x[2]};

    (void)t, (void)err;
    out[0] = -INFINITY;
    for (int k = 0; k < 3; k++)
        out[0] = h[k] > 0 ? fmax(out[0], fabs(own[k]) - h[k]) : out[0];
    return 0;
}

/* A ball of half the width, moved by a quarter of it along x. */
static int of_shifted_ball(const void *ctx, const double *x, double t, double *out, error *err)
{
    const double *h = ctx;

    (void)t, (void)err;
    out[0] = sqrt((x[0] - h[0] / 4) * (x[0] - h[0] / 4) + x[1] * x[1] + x[2] * x[2]) - h[0] / 2;
    return 0;
}

static int of_nothing(const void *ctx, const double *x, double t, double *out, error *err)
{
    (void)ctx, (void)x, (void)t, (void)err;
    out[0] = 1;
    return 0;
}

/* Fails right of x = h_0 / 2. */
static int that_fails(const void *ctx, const double *x, double t, double *out, error *err)
{
    const double *h = ctx;

    if (x[0] > h[0] / 2)
        return error_set(err, ERR_CASE, "f.lua:7: no way at %s", text_point(x, 2).s);
    return of_ellipsoid(ctx, x, t, out, err);
}

/* Not a number in the middle. */
static int that_is_not_finite(const void *ctx, const double *x, double t, double *out, error *err)
{
    const double *h = ctx;

    of_ellipsoid(ctx, x, t, out, err);
    if (fabs(x[0]) < h[0] / 2)
        out[0] = NAN;
    return 0;
}

/* Fails once *ctx is set. */
typedef struct trap {
    double half[3];
    int set;
} trap;

static int that_fails_later(const void *ctx, const double *x, double t, double *out, error *err)
{
    const trap *trap = ctx;

    return trap->set ? error_set(err, ERR_CASE, "g.lua:3: later") : of_ellipsoid(trap->half, x, t, out, err);
}

typedef int distance_fn(const void *, const double *, double, double *, error *);

static shape general(int dim, distance_fn *f, const double *half, const void *ctx)
{
    shape s = {.kind = SHAPE_DISTANCE, .dim = dim, .distance = {.n = 1, .f = f, .ctx = ctx}};

    memcpy(s.half, half, (size_t)dim * sizeof *half);
    return s;
}

static shape superellipsoid(int dim, double e, double f)
{
    return (shape){.kind = SHAPE_SUPERELLIPSOID, .dim = dim, .half = {0.7, 0.4, 0.5}, .exponent = {e, f}};
}

static void measure(shape *s, arena *memory)
{
    error err;

    if (shape_measure(s, memory, &err))
        fail_msg("%s", err.text);
}

/* --- moments --- */

/* int x^p0 y^p1 z^p2 over the body, by the tanh-sinh rule, which does not mind infinite slopes at the ends. */
static double power_integral(const shape *s, const int p[3])
{
    enum { N = 60 };
    double sum = 0, e = s->exponent[0], f = s->exponent[1];

    for (int i = -N; i <= N; i++)
        for (int j = s->dim == 3 ? -N : 0; j <= (s->dim == 3 ? N : 0); j++) {
            double a = M_PI / 2 * sinh(i * 3.2 / N), c = M_PI / 2 * sinh(j * 3.2 / N);
            double x = 1 / (1 + exp(-2 * a)), z = 1 / (1 + exp(-2 * c)); /* and 1 - x without cancellation: */
            double x1 = 1 / (1 + exp(2 * a)), z1 = 1 / (1 + exp(2 * c));
            double dx = 3.2 / N * M_PI * cosh(i * 3.2 / N) * x * x1,
                   dz = 3.2 / N * M_PI * cosh(j * 3.2 / N) * z * z1;
            double y = pow(-expm1(e * log1p(-x1)), 1 / e), scale = pow(-expm1(f * log1p(-z1)), 1 / f);

            if (s->dim == 2)
                scale = z = dz = 1;
            sum += pow(scale * x, p[0]) * pow(scale * y, p[1] + 1) / (p[1] + 1) * scale * dx * pow(z, p[2]) * dz;
        }
    for (int k = 0; k < s->dim; k++)
        sum *= 2 * pow(s->half[k], p[k] + 1);
    return sum;
}

/* Volume and second moments, against quadrature; of a sphere and of what is all but a box, too. */
static void moments_of_superellipsoids_follow_from_gamma_functions(void **state)
{
    static const double e[][2] = {{2, 2}, {4, 4}, {3, 6}, {1.5, 2.5}, {1, 1}};
    arena memory = {0};

    (void)state;
    for (int dim = 2; dim <= 3; dim++)
        for (int i = 0; i < 5; i++) {
            shape s = superellipsoid(dim, e[i][0], e[i][1]);

            measure(&s, &memory);
            for (int k = -1; k < dim; k++) {
                int p[3] = {0};
                double v = k < 0 ? s.volume : s.moment[k][k], q;

                if (k >= 0)
                    p[k] = 2;
                q = power_integral(&s, p);
                if (fabs(v / q - 1) > 1e-9)
                    fail_msg("%dD, exponents %g and %g, moment %d: %.12g, by quadrature %.12g", dim, e[i][0],
                             e[i][1], k, v, q);
            }
            assert_true(s.moment[0][1] == 0);
        }
    for (int dim = 2; dim <= 3; dim++) {
        shape s = superellipsoid(dim, 2, 2), box = superellipsoid(dim, 1e9, 1e9);
        shape round = {.kind = SHAPE_ELLIPSOID, .dim = dim, .half = {0.7, 0.4, 0.5}};

        measure(&s, &memory);
        measure(&box, &memory);
        measure(&round, &memory);
        assert_true(fabs(s.volume / round.volume - 1) < 1e-14);
        assert_true(fabs(box.volume / (dim == 2 ? 4 * 0.28 : 8 * 0.14) - 1) < 1e-8);
        for (int k = 0; k < dim; k++) {
            assert_true(fabs(s.moment[k][k] / round.moment[k][k] - 1) < 1e-14);
            assert_true(fabs(box.moment[k][k] / (box.volume * box.half[k] * box.half[k] / 3) - 1) < 1e-8);
        }
    }
    arena_free(&memory);
}

static void an_exponent_below_one_is_refused(void **state)
{
    arena memory = {0};
    shape s = superellipsoid(3, 4, 0.5), t = superellipsoid(2, 0.9, 4), u = superellipsoid(2, 4, 0);
    error err;

    (void)state;
    assert_int_equal(shape_measure(&s, &memory, &err), ERR_CASE);
    assert_non_null(strstr(err.text, "exponent_z is 0.5"));
    assert_int_equal(shape_measure(&t, &memory, &err), ERR_CASE);
    assert_int_equal(shape_measure(&u, &memory, &err), 0); /* of no meaning in 2D */
    arena_free(&memory);
}

/* An ellipsoid by a distance function has the moments of the ellipsoid, as well as is said. */
static void moments_of_distance_functions_are_as_exact_as_they_say(void **state)
{
    static const double half[3] = {0.7, 0.4, 0.5};
    static const double goal[2] = {1e-8, 1e-5};
    arena memory = {0};

    (void)state;
    for (int dim = 2; dim <= 3; dim++) {
        const double h[3] = {half[0], half[1], dim == 3 ? half[2] : 0};
        shape s = general(dim, of_ellipsoid, h, h);
        shape round = {.kind = SHAPE_ELLIPSOID, .dim = dim, .half = {h[0], h[1], h[2]}};
        double worst = 0;

        measure(&s, &memory);
        measure(&round, &memory);
        worst = fabs(s.volume / round.volume - 1);
        for (int i = 0; i < dim; i++) {
            worst = fmax(worst, fabs(s.centre[i]) / s.radius);
            for (int j = 0; j < dim; j++)
                worst = fmax(worst, fabs(s.moment[i][j] - round.moment[i][j]) / (s.volume * s.radius * s.radius));
        }
        print_message("# %dD: error %.1e, said to be %.1e\n", dim, worst, s.accuracy);
        assert_true(worst < goal[dim - 2]);
        assert_true(worst < 2 * s.accuracy + 1e-12);
    }
    arena_free(&memory);
}

/* Edges are cut off: the error is larger, and said to be. */
static void moments_of_bodies_with_edges_say_their_error(void **state)
{
    static const double half[3] = {0.7, 0.4, 0.5};
    const double c = cos(0.4), d = sin(0.4);
    arena memory = {0};

    (void)state;
    for (int dim = 2; dim <= 3; dim++) {
        const double h[3] = {half[0], half[1], dim == 3 ? half[2] : 0};
        const double hull[3] = {h[0] * c + h[1] * d, h[0] * d + h[1] * c, h[2]};
        shape s = general(dim, of_box, hull, h);
        shape box = {.kind = SHAPE_BOX, .dim = dim, .half = {h[0], h[1], h[2]}};
        double worst;

        measure(&s, &memory);
        measure(&box, &memory);
        worst = fabs(s.volume / box.volume - 1);
        for (int k = 0; k < 2; k++) {
            double turned = (k ? d * d : c * c) * box.moment[0][0] + (k ? c * c : d * d) * box.moment[1][1];

            worst = fmax(worst, fabs(s.moment[k][k] - turned) / (s.volume * s.radius * s.radius));
        }
        print_message("# %dD: error %.1e, said to be %.1e\n", dim, worst, s.accuracy);
        assert_true(worst < (dim == 2 ? 1e-4 : 3e-3));
        assert_true(worst < 3 * s.accuracy);
    }
    arena_free(&memory);
}

static void the_centroid_becomes_the_origin(void **state)
{
    arena memory = {0};

    (void)state;
    for (int dim = 2; dim <= 3; dim++) {
        const double h[3] = {0.8, 0.8, 0.8}, r = 0.4;
        double volume = dim == 2 ? M_PI * r * r : 4 * M_PI / 3 * r * r * r, at[3] = {0};
        shape s = general(dim, of_shifted_ball, h, h);

        measure(&s, &memory);
        assert_true(fabs(s.centre[0] - 0.2) < 1e-6 && fabs(s.centre[1]) < 1e-6);
        assert_true(fabs(s.volume / volume - 1) < 1e-5);
        assert_true(fabs(s.moment[0][0] / (volume * r * r / (dim + 2)) - 1) < 1e-4);
        for (int side = -1; side <= 1; side += 2) {
            at[0] = side * (r - 1e-5);
            assert_true(shape_level(&s, at) < 0);
            at[0] = side * (r + 1e-5);
            assert_true(shape_level(&s, at) > 0);
        }
        for (int k = 0; k < dim; k++)
            assert_true(shape_support(&s, (double[3]){k == 0, k == 1, k == 2}) < s.radius);
    }
    arena_free(&memory);
}

static void a_body_larger_than_its_box_is_refused(void **state)
{
    static const double half[3] = {0.7, 0.4, 0.5}, box[3] = {0.7, 0.38, 0.5};
    arena memory = {0};
    error err;

    (void)state;
    for (int dim = 2; dim <= 3; dim++) {
        const double h[3] = {half[0], half[1], dim == 3 ? half[2] : 0};
        shape s = general(dim, of_ellipsoid, box, h), none = general(dim, of_nothing, box, h);

        assert_int_equal(shape_measure(&s, &memory, &err), ERR_CASE);
        assert_non_null(strstr(err.text, "larger half widths"));
        assert_int_equal(shape_measure(&none, &memory, &err), ERR_CASE);
        assert_non_null(strstr(err.text, "nowhere negative"));
    }
    arena_free(&memory);
}

/* --- reach --- */

/* Largest extent of the superellipsoid in direction n, from points of its surface in many directions. */
static double reach(const shape *s, const double *n)
{
    enum { N = 400 };
    double most = 0;

    for (int i = 0; i < N; i++)
        for (int j = 0; j < (s->dim == 3 ? N / 2 : 1); j++) {
            double a = 2 * M_PI * i / N, c = s->dim == 3 ? M_PI * (j + 0.5) / (N / 2.0) : M_PI / 2, low = 0,
                   high = 2;
            double d[3] = {sin(c) * cos(a), sin(c) * sin(a), s->dim == 3 ? cos(c) : 0};
            double along = d[0] * n[0] + d[1] * n[1] + d[2] * n[2];

            if (s->radius * along < most) /* cannot be further out */
                continue;
            for (int k = 0; k < 40; k++) {
                double mid = 0.5 * (low + high), x[3] = {mid * d[0], mid * d[1], mid * d[2]};

                if (shape_level(s, x) < 0)
                    low = mid;
                else
                    high = mid;
            }
            most = fmax(most, low * along);
        }
    return most;
}

static void directions(int dim, int i, double *n)
{
    double a = 0.3 + 1.1 * i, c = dim == 3 ? 0.2 + 0.7 * i : M_PI / 2;

    n[0] = sin(c) * cos(a);
    n[1] = sin(c) * sin(a);
    n[2] = dim == 3 ? cos(c) : 0;
}

/* A body that is leant on a wall touches it: the support is the dual norm, not the radius of a ball. */
static void superellipsoids_reach_as_far_as_their_surface(void **state)
{
    static const double e[][2] = {{2, 2}, {4, 4}, {3, 6}, {1.5, 2.5}, {1, 1}};
    arena memory = {0};

    (void)state;
    for (int dim = 2; dim <= 3; dim++)
        for (int i = 0; i < 5; i++) {
            shape s = superellipsoid(dim, e[i][0], e[i][1]);

            measure(&s, &memory);
            for (int k = 0; k < dim; k++)
                assert_true(fabs(shape_support(&s, (double[3]){k == 0, k == 1, k == 2}) - s.half[k]) < 1e-14);
            for (int k = 0; k < 4; k++) {
                double n[3], h, r;

                directions(dim, k, n);
                h = shape_support(&s, n);
                r = reach(&s, n);
                if (!(r < h + 1e-9 && r > h - 2e-2 * h))
                    fail_msg("%dD, exponents %g and %g: support %.9g, surface reaches to %.9g", dim, e[i][0],
                             e[i][1], h, r);
            }
        }
    arena_free(&memory);
}

/* Of distance functions from points of the surface: never too large, too small by less than is said. */
static void distance_functions_reach_as_far_as_their_surface(void **state)
{
    static const double half[3] = {0.7, 0.4, 0.5};
    const double c = cos(0.4), d = sin(0.4);
    arena memory = {0};

    (void)state;
    for (int dim = 2; dim <= 3; dim++)
        for (int edges = 0; edges < 2; edges++) {
            const double h[3] = {half[0], half[1], dim == 3 ? half[2] : 0};
            const double hull[3] = {h[0] * c + h[1] * d, h[0] * d + h[1] * c, h[2]};
            shape s = general(dim, edges ? of_box : of_ellipsoid, edges ? hull : h, h);
            shape exact = {.kind = edges ? SHAPE_BOX : SHAPE_ELLIPSOID, .dim = dim, .half = {h[0], h[1], h[2]}};
            double worst = 0;

            measure(&s, &memory);
            measure(&exact, &memory);
            for (int k = 0; k < 200; k++) {
                double n[3], lack;

                directions(dim, k, n);
                lack = (shape_support(&exact,
                                      edges ? (double[3]){c * n[0] + d * n[1], c * n[1] - d * n[0], n[2]} : n) -
                        shape_support(&s, n)) /
                       exact.radius;
                assert_true(lack > -1e-4); /* the centroid may be off by a little */
                worst = fmax(worst, lack);
            }
            print_message("# %dD, %s: support too small by %.1e radii, %lld points\n", dim,
                          edges ? "box" : "ellipsoid", worst, (long long)s.n_support);
            assert_true(worst < (dim == 2 ? 1e-4 : edges ? 2e-3 : 1e-3));
        }
    arena_free(&memory);
}

/* --- failures --- */

static void an_error_of_the_distance_function_reaches_the_user(void **state)
{
    static const double half[3] = {0.7, 0.4, 0.5};
    arena memory = {0};
    error err;

    (void)state;
    for (int dim = 2; dim <= 3; dim++) {
        const double h[3] = {half[0], half[1], dim == 3 ? half[2] : 0};
        shape s = general(dim, that_fails, h, h), t = general(dim, that_is_not_finite, h, h);

        assert_int_equal(shape_measure(&s, &memory, &err), ERR_CASE);
        assert_non_null(strstr(err.text, "f.lua:7: no way at ("));
        assert_int_equal(shape_measure(&t, &memory, &err), ERR_CASE);
        assert_non_null(strstr(err.text, "not finite at ("));
    }
    arena_free(&memory);
}

/* One that comes up in the course of a run: whoever integrates over a cell hears of it, the first message stays. */
static void an_error_while_cells_are_cut_is_reported_by_the_cut(void **state)
{
    trap t = {.half = {0.3, 0.2, 0}};
    arena memory = {0};
    shape s = general(2, that_fails_later, t.half, &t), copy;
    mesh_box b = {.dim = 2, .low = {-1, -1}, .high = {1, 1}, .n = {5, 5}};
    double w[CUT_MAX_POINTS];
    enum cut_cover cover;
    cut_rule r;
    solid here;
    error err;
    mesh m;

    (void)state;
    measure(&s, &memory);
    copy = s;
    here = solid_at(&copy, &(pose){.q = {1}});
    assert_int_equal(mesh_create_box(&b, &m, &err), 0);
    assert_int_equal(mesh_measure(&m, &err), 0);
    assert_int_equal(cut_rule_create(&r, m.type, &err), 0);
    assert_int_equal(cut_cell(&r, &m, 12, &here, w, NULL, NULL, &cover, &err), 0);
    assert_int_equal(cover, CUT_PART);
    assert_int_equal(shape_check(&s, &err), 0);
    t.set = 1;
    assert_int_equal(cut_cell(&r, &m, 12, &here, w, NULL, NULL, &cover, &err), ERR_CASE);
    assert_string_equal(err.text, "g.lua:3: later");
    err.text[0] = 0;
    assert_int_equal(shape_check(&s, &err), ERR_CASE); /* of all copies */
    assert_string_equal(err.text, "g.lua:3: later");
    cut_rule_destroy(&r);
    mesh_destroy(&m);
    arena_free(&memory);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(moments_of_superellipsoids_follow_from_gamma_functions),
        cmocka_unit_test(an_exponent_below_one_is_refused),
        cmocka_unit_test(moments_of_distance_functions_are_as_exact_as_they_say),
        cmocka_unit_test(moments_of_bodies_with_edges_say_their_error),
        cmocka_unit_test(the_centroid_becomes_the_origin),
        cmocka_unit_test(a_body_larger_than_its_box_is_refused),
        cmocka_unit_test(superellipsoids_reach_as_far_as_their_surface),
        cmocka_unit_test(distance_functions_reach_as_far_as_their_surface),
        cmocka_unit_test(an_error_of_the_distance_function_reaches_the_user),
        cmocka_unit_test(an_error_while_cells_are_cut_is_reported_by_the_cut),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
