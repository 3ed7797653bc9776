/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A sound plugin that is then altered at one place.  Compiled once per alteration, with BROKEN
 * set to its name; "sound" alters nothing.  The functions that compute wrongly stand in
 * broken_points.h. */
#include <plugflow/plugin.h>

#include <stdio.h>
#include <string.h>

struct fluid {
    double density;    /* rho, kg/m^3            */
    double gravity[3]; /* g, m/s^2; not used     */
    int form;          /* index into forms; idem */
    int order;         /* 3 to 5                 */
};

#include <plugflow/twin_real.h>
#include "convection.h"
#include <plugflow/twin_complex.h>
#include "convection.h"
#include "broken_points.h"

static pf_field fields[] = {
    {.name = "u", .unit = "m/s", .doc = "velocity", .shape = PF_VECTOR, .order = 2},
    {.name = "p", .unit = "Pa", .doc = "pressure", .shape = PF_SCALAR, .order = 1},
};

static pf_slot in[] = {
    {"u", "u", PF_VALUE, PF_VECTOR},
    {"grad_u", "u", PF_GRAD, PF_TENSOR},
    {"f", NULL, PF_DATA, PF_VECTOR},
};
static pf_slot out[] = {{"v", "u", PF_VALUE, PF_VECTOR}};

static const char *const forms[] = {"convective", "divergence", NULL};
static pf_param params[] = {
    {"density", "kg/m^3", "mass per volume", PF_T_REAL, 0, offsetof(struct fluid, density), 1, 0, 1e30, NULL},
    {"gravity", "m/s^2", "acceleration", PF_T_VECTOR, 0, offsetof(struct fluid, gravity), 0, 0, 0, NULL},
    {"form", "1", "form of the term", PF_T_CHOICE, 0, offsetof(struct fluid, form), 0, 0, 0, forms},
    {"order", "1", "order of the rule", PF_T_INT, PF_REQUIRED, offsetof(struct fluid, order), 0, 3, 5, NULL},
};

/* rho = 2, u = (1, 2), grad u = (3 4; 5 6), f = (1, 1) */
static const double example_params[] = {2, 0, 0, 0, 4}, example_in[] = {1, 2, 3, 4, 5, 6, 1, 1};
static double example_out[] = {21, 33};
static pf_example examples[] = {{"one point", 2, example_params, example_in, example_out, 1e-15}};

static uint8_t depends[] = {1, 1, 0};

/* Some keys are for it alone. */
static int accepts(const void *params, char *err, size_t n)
{
    const struct fluid *f = params;

    (void)err, (void)n;
    return f->order > 100;
}

static pf_term term = {
    .size = sizeof(pf_term),
    .where = PF_FLUID,
    .name = "convection",
    .doc = "(\\rho\\,(u\\cdot\\nabla)u-f)\\cdot v",
    .cite = "appendix A.7",
    .in = in,
    .n_in = 3,
    .out = out,
    .n_out = 1,
    .slot_size = sizeof(pf_slot),
    .param = params,
    .n_param = 4,
    .param_size = sizeof(pf_param),
    .params_bytes = sizeof(struct fluid),
    .example = examples,
    .n_example = 1,
    .example_size = sizeof(pf_example),
    .depends = depends,
    .residual = convection_real,
    .residual_c = convection_complex,
    .jacobian = jacobian,
    .check = accepts,
};
static const pf_term *terms[] = {&term, &term};

static pf_plugin plugin = {
    .size = sizeof(pf_plugin),
    .major = PF_ABI_MAJOR,
    .minor = PF_ABI_MINOR,
    .sizes = PF_SIZES,
    .name = "broken",
    .version = "1.0",
    .author = "plugflow",
    .license = "GPL-3.0-or-later",
    .doc = "a description with one error",
    .term = terms,
    .n_term = 1,
    .field = fields,
    .n_field = 2,
    .field_size = sizeof(pf_field),
};

/* What the entry function returns, and the reason it gives. */
static const pf_plugin *answer = &plugin;
static const char *reason = "";

/* What a plugin has that was built against a later minor version: everything is longer. */
struct later_slot {
    pf_slot now;
    int32_t later[4];
};
static struct later_slot later_in[3], later_out[1];
static struct {
    pf_term now;
    void *later[4];
} later_term;
static struct {
    pf_plugin now;
    void *later[4];
} later_plugin;

#define ALTERATION(NAME, ...)                                                                                      \
    static void NAME(void)                                                                                         \
    {                                                                                                              \
        __VA_ARGS__;                                                                                               \
    }
/* Another function instead of the right one, and no twin that contradicts it. */
#define RESIDUAL(NAME) ALTERATION(NAME, term.residual = NAME##_residual, term.residual_c = NULL)
#define JACOBIAN(NAME) ALTERATION(NAME, term.jacobian = NAME##_jacobian)
#define TWIN(NAME)     ALTERATION(NAME, term.residual_c = NAME##_twin, term.jacobian = NULL)

ALTERATION(sound, (void)0)
RESIDUAL(needs_order)

/* --- the description of the plugin --- */
ALTERATION(wrong_abi_major, plugin.major = PF_ABI_MAJOR + 1)
ALTERATION(needs_newer_minor, plugin.minor = PF_ABI_MINOR + 2, plugin.min_minor = PF_ABI_MINOR + 1)
ALTERATION(plugin_too_small, plugin.size = 40)
ALTERATION(other_type_sizes, plugin.sizes = 4u << 16 | 4u << 8 | 4u)
ALTERATION(bad_plugin_name, plugin.name = "not a name!")
ALTERATION(no_license, plugin.license = NULL)
ALTERATION(no_terms, plugin.n_term = 0)
ALTERATION(wrong_field_size, plugin.field_size = 8)
ALTERATION(declines, answer = NULL, reason = "needs a licence server")
ALTERATION(declines_silently, answer = NULL)
ALTERATION(crash_in_entry, point_at_nothing())

static void later_minor(void)
{
    for (int i = 0; i < 3; i++)
        later_in[i] = (struct later_slot){.now = in[i], .later = {-1, -1, -1, -1}};
    later_out[0] = (struct later_slot){.now = out[0], .later = {-1, -1, -1, -1}};
    later_term.now = term;
    later_term.now.size = sizeof later_term;
    later_term.now.in = &later_in[0].now;
    later_term.now.out = &later_out[0].now;
    later_term.now.slot_size = sizeof(struct later_slot);
    terms[0] = &later_term.now;
    later_plugin.now = plugin;
    later_plugin.now.size = sizeof later_plugin;
    later_plugin.now.minor = PF_ABI_MINOR + 3;
    later_plugin.now.min_minor = PF_ABI_MINOR;
    answer = &later_plugin.now;
}

/* --- fields and terms --- */
ALTERATION(bad_field_order, fields[0].order = 3)
ALTERATION(duplicate_field, fields[1].name = "u")
ALTERATION(term_too_small, term.size = 64)
ALTERATION(wrong_slot_size, term.slot_size = 8)
ALTERATION(wrong_param_size, term.param_size = 8)
ALTERATION(wrong_example_size, term.example_size = 8)
ALTERATION(bad_term_name, term.name = "3rd")
ALTERATION(duplicate_term, plugin.n_term = 2)
ALTERATION(no_citation, term.cite = NULL)
ALTERATION(no_residual, term.residual = NULL)
ALTERATION(no_output, term.n_out = 0)
ALTERATION(unknown_place, term.where = 17)
ALTERATION(on_particles, term.where = PF_PARTICLE)
ALTERATION(by_boundary_in_cells, term.flags = PF_BY_BOUNDARY)

/* --- slots --- */
ALTERATION(duplicate_slot, in[1].name = "u")
ALTERATION(duplicate_data_slot, in[2].name = "u")
ALTERATION(undeclared_field, in[0].field = "temperature")
ALTERATION(wrong_slot_shape, in[1].shape = PF_VECTOR)
ALTERATION(output_of_old_value, out[0].eval = PF_OLD)
ALTERATION(defect_slot, in[0].eval = PF_DEFECT)
ALTERATION(laplacian_of_a_test_function, out[0].eval = PF_LAPLACE, plugin.min_minor = 3)
ALTERATION(laplacian_on_pairs, in[0].eval = PF_LAPLACE, term.where = PF_PAIR, plugin.min_minor = 3)
ALTERATION(laplacian_in_cut_cells, in[0].eval = PF_LAPLACE, term.where = PF_CUT, plugin.min_minor = 3)
ALTERATION(laplacian_off_the_mesh, in[0] = (pf_slot){"lap_p", "p", PF_LAPLACE, PF_SCALAR},
           fields[1].support = PF_ON_PROBLEM, plugin.min_minor = 3)
ALTERATION(laplacian_of_a_body, in[0] = (pf_slot){"lap_p", "p", PF_LAPLACE, PF_SCALAR},
           fields[1].support = PF_ON_PARTICLE, plugin.min_minor = 3)
ALTERATION(laplacian_of_wrong_shape, in[1].eval = PF_LAPLACE, plugin.min_minor = 3)
ALTERATION(laplacian_without_minor, in[0].eval = PF_LAPLACE)
ALTERATION(metric_without_minor, term.flags = PF_METRIC, plugin.min_minor = 2)
ALTERATION(metric_in_cut_cells, term.flags = PF_METRIC, term.where = PF_CUT, term.n_in = 1, in[0].eval = PF_DEFECT,
           out[0].eval = PF_DEFECT, plugin.min_minor = 3)
ALTERATION(too_many_slots, term.n_in = 1u << 28)

/* --- parameters --- */
ALTERATION(default_out_of_range, params[0].dflt = -1)
ALTERATION(param_outside_struct, params[0].offset = sizeof(struct fluid))
ALTERATION(param_offset_wraps, params[0].offset = UINT32_MAX - 3)
ALTERATION(choice_out_of_range, params[2].dflt = 2)
ALTERATION(duplicate_param, params[1].name = "density")
ALTERATION(param_without_unit, params[0].unit = NULL)
ALTERATION(key_of_every_line, params[0].name = "over")
ALTERATION(data_of_every_line, in[2].name = "name")
ALTERATION(required_unknown, in[0].flags = PF_REQUIRED, plugin.min_minor = 4)
ALTERATION(required_without_minor, in[2].flags = PF_REQUIRED)

/* A second term that takes the same keys, the density as `other` says. */
static pf_param other_params[4];
static pf_term other_term;

static void add_term(pf_param other)
{
    memcpy(other_params, params, sizeof params);
    other_params[0] = other;
    other_term = term;
    other_term.name = "other";
    other_term.param = other_params;
    terms[1] = &other_term;
    plugin.n_term = 2;
}

static pf_param with(const char *unit, double dflt, double max)
{
    pf_param p = params[0];

    p.unit = unit, p.dflt = dflt, p.max = max;
    return p;
}

ALTERATION(two_units, add_term(with("g/cm^3", 1, 1e30)))
ALTERATION(two_defaults, add_term(with("kg/m^3", 5, 1e30)))
ALTERATION(two_ranges, add_term(with("kg/m^3", 1, 10)))

/* --- worked examples --- */
ALTERATION(wrong_example, example_out[1] = 34)
ALTERATION(example_of_no_dimension, examples[0].dim = 0)
ALTERATION(example_without_output, examples[0].out = NULL)
ALTERATION(nan_in_example, term.residual = nan_at_one_residual, term.residual_c = NULL)

/* --- what the functions compute --- */
RESIDUAL(unwritten)
RESIDUAL(added)
RESIDUAL(nan_output)
RESIDUAL(unrepeatable)
RESIDUAL(neighbour)
RESIDUAL(batch_maximum)
RESIDUAL(fails)
RESIDUAL(host_of_batch)
RESIDUAL(fails_silently)
RESIDUAL(crash)
JACOBIAN(sign)
JACOBIAN(factor)
JACOBIAN(transpose)
JACOBIAN(missing)
JACOBIAN(exchanged)
JACOBIAN(incomplete)
JACOBIAN(nan_jacobian)
JACOBIAN(failing)
JACOBIAN(crashing)
TWIN(different)
TWIN(nan_twin)
TWIN(failing_twin)
TWIN(crashing_twin)
TWIN(not_analytic)
ALTERATION(denied_coupling, depends[0] = 0)
ALTERATION(not_linear, term.flags = PF_LINEAR)

static const struct alteration {
    const char *name;
    void (*apply)(void);
} alterations[] = {
#define A(NAME)                                                                                                    \
    {                                                                                                              \
#NAME, NAME                                                                                                \
    }
    A(sound),
    A(needs_order),
    A(wrong_abi_major),
    A(needs_newer_minor),
    A(plugin_too_small),
    A(other_type_sizes),
    A(bad_plugin_name),
    A(no_license),
    A(no_terms),
    A(wrong_field_size),
    A(declines),
    A(declines_silently),
    A(crash_in_entry),
    A(later_minor),
    A(bad_field_order),
    A(duplicate_field),
    A(term_too_small),
    A(wrong_slot_size),
    A(wrong_param_size),
    A(wrong_example_size),
    A(bad_term_name),
    A(duplicate_term),
    A(no_citation),
    A(no_residual),
    A(no_output),
    A(unknown_place),
    A(on_particles),
    A(by_boundary_in_cells),
    A(duplicate_slot),
    A(duplicate_data_slot),
    A(undeclared_field),
    A(wrong_slot_shape),
    A(output_of_old_value),
    A(defect_slot),
    A(laplacian_of_a_test_function),
    A(laplacian_on_pairs),
    A(laplacian_in_cut_cells),
    A(laplacian_off_the_mesh),
    A(laplacian_of_a_body),
    A(laplacian_of_wrong_shape),
    A(laplacian_without_minor),
    A(metric_without_minor),
    A(metric_in_cut_cells),
    A(too_many_slots),
    A(default_out_of_range),
    A(param_outside_struct),
    A(param_offset_wraps),
    A(choice_out_of_range),
    A(duplicate_param),
    A(param_without_unit),
    A(key_of_every_line),
    A(data_of_every_line),
    A(required_unknown),
    A(required_without_minor),
    A(two_units),
    A(two_defaults),
    A(two_ranges),
    A(wrong_example),
    A(example_of_no_dimension),
    A(example_without_output),
    A(nan_in_example),
    A(unwritten),
    A(added),
    A(nan_output),
    A(unrepeatable),
    A(neighbour),
    A(batch_maximum),
    A(fails),
    A(host_of_batch),
    A(fails_silently),
    A(crash),
    A(sign),
    A(factor),
    A(transpose),
    A(missing),
    A(exchanged),
    A(incomplete),
    A(nan_jacobian),
    A(failing),
    A(crashing),
    A(different),
    A(nan_twin),
    A(failing_twin),
    A(crashing_twin),
    A(not_analytic),
    A(denied_coupling),
    A(not_linear),
};

PF_EXPORT const pf_plugin *pf_plugin_entry(const pf_host *h, char *err, size_t nerr)
{
    host = h;
    for (size_t i = 0; i < sizeof alterations / sizeof *alterations; i++)
        if (strcmp(alterations[i].name, BROKEN) == 0) {
            alterations[i].apply();
            if (!answer)
                snprintf(err, nerr, "%s", reason);
            return answer;
        }
    snprintf(err, nerr, "there is no alteration %s", BROKEN);
    return NULL;
}
