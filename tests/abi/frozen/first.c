/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A plugin built against plugin_1_0.h, the header as it was in version 1.0 of the interface.
 * Neither file is ever changed: whatever loads here must load in every later version 1.x.
 * It uses everything that 1.0 has. */
#include "plugin_1_0.h"

#include <stdio.h>

struct absorption {
    double rate, centre[3];
    int power, on, law;
};

static const pf_host *host;

static int check(const void *params, char *err, size_t nerr)
{
    const struct absorption *m = params;

    if (m->power <= 3)
        return 0;
    snprintf(err, nerr, "power %d is not possible", m->power);
    return -1;
}

/* (dc/dt - c_old / dt + rate c^2 - s) q + grad c . grad q */
#define ABSORPTION(NAME, T)                                                                                        \
    static int NAME(const pf_batch *b, const T *const *in, T *const *out)                                          \
    {                                                                                                              \
        const struct absorption *m = b->params;                                                                    \
                                                                                                                   \
        if (b->size < sizeof *b || b->n > b->ld || b->ld % PF_LANES)                                               \
            return host->fail(b, 0, PF_FAIL, "batch of %u bytes, %u points in %u lanes", b->size, b->n, b->ld);    \
        for (uint32_t i = 0; i < b->ld; i++)                                                                       \
            out[0][i] = in[1][i] - in[3][i] / b->dt + m->rate * in[0][i] * in[0][i] - in[4][i];                    \
        for (uint32_t i = 0; i < b->dim * b->ld; i++)                                                              \
            out[1][i] = in[2][i];                                                                                  \
        return PF_OK;                                                                                              \
    }
ABSORPTION(absorption_real, double)
ABSORPTION(absorption_complex, pf_complex)

static int absorption_jacobian(const pf_batch *b, const double *const *in, double *const *jac)
{
    const struct absorption *m = b->params;

    for (uint32_t i = 0; i < b->ld; i++) {
        jac[0][i] = 2 * m->rate * in[0][i];
        jac[1][i] = 1;
        for (uint32_t a = 0; a < b->dim; a++)
            jac[7][(a * b->dim + a) * b->ld + i] = 1;
    }
    return jac[3] || jac[4] ? PF_FAIL : PF_OK;
}

/* On a facet: rate (u . n) q, without twin and Jacobian. */
static int outflow_residual(const pf_batch *b, const double *const *in, double *const *out)
{
    const struct absorption *m = b->params;

    for (uint32_t i = 0; i < b->ld; i++)
        out[0][i] = 0;
    for (uint32_t a = 0; a < b->dim; a++)
        for (uint32_t i = 0; i < b->ld; i++)
            out[0][i] += m->rate * in[0][a * b->ld + i] * b->normal[a * b->ld + i];
    return PF_OK;
}

static const pf_field fields[] = {
    {"c", "mol/m^3", "concentration", PF_SCALAR, 2, PF_ON_MESH, "flow", "mol/s"},
    {"u", "m/s", "velocity", PF_VECTOR, 2, PF_ON_MESH, "force", "N"},
};

static const char *const laws[] = {"constant", "linear", NULL};
static const pf_param params[] = {
    {"rate", "1/s", "absorption", PF_T_REAL, 0, offsetof(struct absorption, rate), 2, 0, 10, NULL},
    {"centre", "m", "a point", PF_T_VECTOR, 0, offsetof(struct absorption, centre), 0, 0, 0, NULL},
    {"power", "1", "an exponent", PF_T_INT, 0, offsetof(struct absorption, power), 2, 1, 9, NULL},
    {"on", "1", "a switch", PF_T_BOOL, 0, offsetof(struct absorption, on), 1, 0, 0, NULL},
    {"law", "1", "a law", PF_T_CHOICE, 0, offsetof(struct absorption, law), 1, 0, 0, laws},
};

static const pf_slot in[] = {
    {"c", "c", PF_VALUE, PF_SCALAR},   {"c_t", "c", PF_DOT, PF_SCALAR}, {"grad_c", "c", PF_GRAD, PF_VECTOR},
    {"c_old", "c", PF_OLD, PF_SCALAR}, {"s", NULL, PF_DATA, PF_SCALAR},
};
static const pf_slot out[] = {{"q", "c", PF_VALUE, PF_SCALAR}, {"grad_q", "c", PF_GRAD, PF_VECTOR}};
static const pf_slot velocity[] = {{"u", "u", PF_VALUE, PF_VECTOR}};
static const uint8_t depends[] = {1, 1, 0, 1, 1, 0, 0, 1, 0, 0};

/* rate = 3; c = 2, dc/dt = 5, grad c = (7, 8), c_old = 0, s = 1 */
static const double example_params[] = {3, 0, 0, 2, 1, 1}, example_in[] = {2, 5, 7, 8, 0, 1},
                    example_out[] = {16, 7, 8};
static const pf_example examples[] = {{"one point", 2, example_params, example_in, example_out, 1e-15}};

static const pf_term absorption = {
    sizeof(pf_term),
    0,
    PF_CELL,
    5,
    2,
    5,
    1,
    sizeof(pf_slot),
    sizeof(pf_param),
    sizeof(pf_example),
    sizeof(struct absorption),
    64,
    "absorption",
    "(\\dot c+kc^2-s)q+\\nabla c\\cdot\\nabla q",
    "none",
    in,
    out,
    params,
    examples,
    depends,
    check,
    absorption_real,
    absorption_complex,
    absorption_jacobian,
};
static const pf_term outflow = {
    .size = sizeof(pf_term),
    .flags = PF_LINEAR | PF_OPTIONAL,
    .where = PF_FACET,
    .n_in = 1,
    .n_out = 1,
    .n_param = 5,
    .slot_size = sizeof(pf_slot),
    .param_size = sizeof(pf_param),
    .params_bytes = sizeof(struct absorption),
    .name = "outflow",
    .doc = "k(u\\cdot n)q",
    .cite = "none",
    .in = velocity,
    .out = out,
    .param = params,
    .residual = outflow_residual,
};
static const pf_term *const terms[] = {&absorption, &outflow};

static const pf_plugin first = {
    sizeof(pf_plugin),
    PF_ABI_MAJOR,
    PF_ABI_MINOR,
    0,
    PF_SIZES,
    2,
    2,
    sizeof(pf_field),
    "first",
    "1.0",
    "plugflow",
    "GPL-3.0-or-later",
    "all that version 1.0 of the interface can say",
    terms,
    fields,
};

PF_EXPORT const pf_plugin *pf_plugin_entry(const pf_host *h, char *err, size_t nerr)
{
    if (h->size < sizeof *h || h->major != 1 || h->sizes != PF_SIZES || !h->version) {
        snprintf(err, nerr, "a host of %u bytes, interface %u.%u", h->size, h->major, h->minor);
        return NULL;
    }
    host = h;
    return &first;
}
