/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Terms that plugflow new --weak writes, beside those written by hand: the same values and derivatives to round-off
 * at random points.  Their times are printed. */
#include "support/program.h"

#include <plugflow/plugin.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <complex.h>
#include <dlfcn.h>
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

enum { POINTS = 64, MOST_SLOTS = 8, MOST_COMPONENTS = 9, ROUNDS = 60, CALLS = 400 };

/* A form and the term that says the same: of a plugin of the build, the name of the term in it. */
static const struct pair {
    const char *name, *form, *by_hand, *term;
} pairs[] = {
    {"w_divergence", "div(u)*q", "plugins/continuity/continuity.so", "divergence"},
    {"w_inertia", "rho*dot(dt(u), v)", "plugins/momentum/momentum.so", "inertia"},
    {"w_convection", "rho*dot(dot(grad(u), u), v)", "plugins/momentum/momentum.so", "convection"},
    {"w_viscous", "mu*inner(grad(u) + transpose(grad(u)), grad(v))", "plugins/momentum/momentum.so", "viscous"},
    {"w_pressure", "-p*div(v)", "plugins/momentum/momentum.so", "pressure_gradient"},
    {"w_diffusion", "k = property(conductivity); k*dot(grad(T), grad(s))", "plugins/heat/heat.so", "diffusion"},
    {"w_buoyancy", "rho*expansion*(T - reference_temperature)*dot(g, v)", "plugins/heat/heat.so", "buoyancy"},
    {"w_power_law",
     "D = sym(grad(u)); rate2 = eps^2 + 2*inner(D, D); mu_n = consistency*rate2^(0.5*(n - 1)); "
     "inner(2*mu_n*D - p*I, grad(v))",
     "tests/abi/kit/gnf.so", "stress"},
    {"w_forchheimer",
     "(viscosity/permeability + density*forchheimer/sqrt(permeability)*sqrt(dot(u, u) + 1e-300))*dot(u, v)",
     "tests/abi/kit/drag.so", "drag"},
};

static int no_failure(const pf_batch *b, uint32_t lane, int status, const char *fmt, ...)
{
    (void)b, (void)lane, (void)fmt;
    return status;
}

static const pf_term *load(const char *path, const char *name)
{
    static const pf_host host = {sizeof host, PF_ABI_MAJOR, PF_ABI_MINOR, PF_SIZES, "test", no_failure};
    void *library = dlopen(path, RTLD_NOW | RTLD_LOCAL),
         *symbol = library ? dlsym(library, "pf_plugin_entry") : NULL;
    pf_entry_fn *entry;
    const pf_plugin *p;
    char why[200] = "";

    if (!symbol)
        fail_msg("%s", dlerror());
    memcpy(&entry, &symbol, sizeof entry);
    p = entry(&host, why, sizeof why);
    for (uint32_t i = 0; p && i < p->n_term; i++)
        if (strcmp(p->term[i]->name, name) == 0)
            return p->term[i];
    return NULL;
}

static int components(uint32_t shape, int dim)
{
    return shape == PF_SCALAR ? 1 : shape == PF_VECTOR ? dim : dim * dim;
}

/* A number in (0.5, 1.5) that belongs to a name and a place. */
static double number_of(const char *name, int i)
{
    uint64_t h = 1469598103934665603u + (uint64_t)i * 0x9e3779b97f4a7c15u;

    for (; *name; name++)
        h = (h ^ (uint64_t)*name) * 1099511628211u;
    h ^= h >> 29;
    h *= 0xbf58476d1ce4e5b9u;
    return 0.5 + (double)(h >> 11) / 9007199254740992.0;
}

/* A term at its points; values of slots and parameters follow from their names. */
typedef struct side {
    const pf_term *t;
    int dim;
    _Alignas(16) char params[256];
    double *in[MOST_SLOTS], *out[MOST_SLOTS], *jac[MOST_SLOTS * MOST_SLOTS];
    pf_batch b;
} side;

static double *rows(int n)
{
    double *r = aligned_alloc(64, (size_t)n * POINTS * sizeof *r);

    assert_non_null(r);
    memset(r, 0, (size_t)n * POINTS * sizeof *r);
    return r;
}

static void open_side(side *s, const pf_term *t, int dim)
{
    *s = (side){.t = t, .dim = dim};
    s->b = (pf_batch){sizeof s->b, (uint32_t)dim, POINTS, POINTS, 0, 0.1, 20, .params = s->params};
    assert_true(t->params_bytes <= sizeof s->params);
    for (uint32_t k = 0; k < t->n_param; k++)
        for (int c = 0; c < (t->param[k].type == PF_T_REAL ? 1 : t->param[k].type == PF_T_VECTOR ? 3 : 0); c++) {
            const double v = number_of(t->param[k].name, c);

            memcpy(s->params + t->param[k].offset + (size_t)c * sizeof v, &v, sizeof v);
        }
    for (uint32_t k = 0; k < t->n_in; k++) {
        s->in[k] = rows(MOST_COMPONENTS);
        for (int i = 0; i < components(t->in[k].shape, dim) * POINTS; i++)
            s->in[k][i] = number_of(t->in[k].eval == PF_PROPERTY ? t->in[k].field : t->in[k].name, i);
    }
    for (uint32_t o = 0; o < t->n_out; o++) {
        s->out[o] = rows(MOST_COMPONENTS);
        for (uint32_t k = 0; k < t->n_in; k++)
            s->jac[o * t->n_in + k] = rows(MOST_COMPONENTS * MOST_COMPONENTS);
    }
}

static void close_side(side *s)
{
    for (int i = 0; i < MOST_SLOTS; i++) {
        free(s->in[i]);
        free(s->out[i]);
    }
    for (int i = 0; i < MOST_SLOTS * MOST_SLOTS; i++)
        free(s->jac[i]);
}

static int residual(side *s)
{
    return s->t->residual(&s->b, (const double *const *)s->in, s->out);
}

/* The Jacobian: the term's own, or by complex step as the kernel does it. */
static void jacobian(side *s, int by_complex_step)
{
    pf_complex *in[MOST_SLOTS], *out[MOST_SLOTS];

    if (!by_complex_step) {
        assert_int_equal(s->t->jacobian(&s->b, (const double *const *)s->in, s->jac), 0);
        return;
    }
    for (int k = 0; k < MOST_SLOTS; k++) {
        in[k] = (pf_complex *)rows(2 * MOST_COMPONENTS);
        out[k] = (pf_complex *)rows(2 * MOST_COMPONENTS);
    }
    for (uint32_t k = 0; k < s->t->n_in; k++)
        for (int c = 0; c < components(s->t->in[k].shape, s->dim); c++) {
            const int n_c = components(s->t->in[k].shape, s->dim);

            for (uint32_t j = 0; j < s->t->n_in; j++)
                for (int i = 0; i < MOST_COMPONENTS * POINTS; i++)
                    in[j][i] = s->in[j][i] + (j == k && i / POINTS == c ? 1e-100 * _Complex_I : 0);
            assert_int_equal(s->t->residual_c(&s->b, (const pf_complex *const *)in, out), 0);
            for (uint32_t o = 0; o < s->t->n_out; o++)
                for (int a = 0; a < components(s->t->out[o].shape, s->dim); a++)
                    for (int i = 0; i < POINTS; i++)
                        s->jac[o * s->t->n_in + k][(a * n_c + c) * POINTS + i] =
                            cimag(out[o][a * POINTS + i]) * 1e100;
        }
    for (int k = 0; k < MOST_SLOTS; k++) {
        free(in[k]);
        free(out[k]);
    }
}

/* The slot that is called like `like`, or holds the same property. */
static uint32_t slot_of(const pf_slot *slot, uint32_t n, const pf_slot *like)
{
    uint32_t k = 0;

    while (k < n && strcmp(slot[k].name, like->name) != 0 &&
           !(like->eval == PF_PROPERTY && slot[k].eval == PF_PROPERTY && strcmp(slot[k].field, like->field) == 0))
        k++;
    if (k == n)
        fail_msg("the generated term has no slot %s", like->name);
    return k;
}

static void compare(const char *what, const double *x, const double *y, int n)
{
    double worst = 0, size = 0;

    for (int i = 0; i < n; i++) {
        worst = fmax(worst, fabs(x[i] - y[i]));
        size = fmax(size, fabs(y[i]));
        if (!isfinite(x[i]))
            fail_msg("%s: number %d is %g", what, i, x[i]);
    }
    /* a few operations in another order */
    if (worst > 32 * DBL_EPSILON * size)
        fail_msg("%s: differs by %g of %g", what, worst, size);
}

static void compare_all(const struct pair *p, side *made, side *hand)
{
    assert_int_equal(residual(made), 0);
    assert_int_equal(residual(hand), 0);
    jacobian(made, 0);
    jacobian(hand, 1);
    assert_int_equal(made->t->n_in, hand->t->n_in);
    for (uint32_t o = 0; o < hand->t->n_out; o++) {
        const uint32_t oo = slot_of(made->t->out, made->t->n_out, &hand->t->out[o]);
        const int n_o = components(hand->t->out[o].shape, hand->dim);
        char what[200];

        snprintf(what, sizeof what, "%s %dD, output %s", p->name, hand->dim, hand->t->out[o].name);
        compare(what, made->out[oo], hand->out[o], n_o * POINTS);
        for (uint32_t k = 0; k < hand->t->n_in; k++) {
            const uint32_t kk = slot_of(made->t->in, made->t->n_in, &hand->t->in[k]);

            snprintf(what, sizeof what, "%s %dD, d %s / d %s", p->name, hand->dim, hand->t->out[o].name,
                     hand->t->in[k].name);
            compare(what, made->jac[oo * made->t->n_in + kk], hand->jac[o * hand->t->n_in + k],
                    n_o * components(hand->t->in[k].shape, hand->dim) * POINTS);
        }
    }
}

static double seconds(void)
{
    struct timespec t;

    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double time_of(side *s, int with_jacobian)
{
    double t = seconds();

    for (int i = 0; i < CALLS; i++) {
        residual(s);
        if (with_jacobian)
            s->t->jacobian(&s->b, (const double *const *)s->in, s->jac);
    }
    return seconds() - t;
}

/* The best times of many short rounds, one after the other, so that what else the machine does falls on both. */
static void print_times(const struct pair *p, side *made, side *hand)
{
    const int with_jacobian = hand->t->jacobian != NULL;
    double a = INFINITY, b = INFINITY;

    for (int i = 0; i < ROUNDS; i++) {
        a = fmin(a, time_of(made, with_jacobian));
        b = fmin(b, time_of(hand, with_jacobian));
    }
    print_message("# %-13s %dD  %s %6.1f ns, by hand %6.1f ns: %.2f\n", p->name, hand->dim,
                  with_jacobian ? "residual and Jacobian" : "residual             ", a / CALLS * 1e9,
                  b / CALLS * 1e9, a / b);
}

static void compare_in(const struct pair *p, const pf_term *made, const pf_term *by_hand, int dim)
{
    side a, b;

    open_side(&a, made, dim);
    open_side(&b, by_hand, dim);
    compare_all(p, &a, &b);
    print_times(p, &a, &b);
    close_side(&a);
    close_side(&b);
}

static void generated_terms_equal_those_by_hand(void **state)
{
    int n = 0;

    (void)state;
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        const struct pair *p = &pairs[i];
        const pf_term *by_hand, *made;
        char path[600];

        snprintf(path, sizeof path, "%s/%s", getenv("PLUGFLOW_BUILD"), p->by_hand);
        if (access(path, R_OK) != 0 || !(by_hand = load(path, p->term)))
            continue; /* a plugin that is not built, a term that is no more */
        assert_ran(
            shell(
                "cd '%s' && \"$PLUGFLOW_PROGRAM\" new %s --on cells --weak '%s' && \"$PLUGFLOW_PROGRAM\" build %s",
                scratch(), p->name, p->form, p->name),
            0, p->name);
        snprintf(path, sizeof path, "%s/%s/%s.so", scratch(), p->name, p->name);
        made = load(path, p->name);
        for (int dim = 2; dim <= 3; dim++)
            compare_in(p, made, by_hand, dim);
        n++;
    }
    assert_true(n >= 6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(generated_terms_equal_those_by_hand)};

    return cmocka_run_group_tests(tests, NULL, NULL);
}
