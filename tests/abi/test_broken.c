/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What plugflow test says about plugins with one error each: exit code and message.  The
 * plugins come from broken.c, from altered copies of the momentum plugin, and from frozen/.
 *
 *     PLUGFLOW_PROGRAM      the program
 *     PLUGFLOW_BROKEN_DIR   folder of the plugins, NAME.so                                 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <cmocka.h>

enum { EXIT_OK = 0, EXIT_PLUGIN = 5, MAX_TEXTS = 4 };

/* One call of the program: `before` FILE `after`, its exit code, and what its output contains. */
struct expected {
    const char *before, *file, *after;
    int code;
    const char *text[MAX_TEXTS]; /* NULL-terminated */
};

static const char *setting(const char *name)
{
    const char *value = getenv(name);

    if (!value || !*value)
        fail_msg("the environment variable %s is not set", name);
    return value;
}

static void answers_as_expected(void **state)
{
    const struct expected *e = *state;
    static char output[1 << 16];
    char command[4096];
    size_t n;
    int status;
    FILE *p;

    snprintf(command, sizeof command, "'%s' %s '%s/%s' %s 2>&1", setting("PLUGFLOW_PROGRAM"), e->before,
             setting("PLUGFLOW_BROKEN_DIR"), e->file, e->after);
    p = popen(command, "r");
    assert_non_null(p);
    n = fread(output, 1, sizeof output - 1, p);
    output[n] = 0;
    status = pclose(p);
    if (!WIFEXITED(status) || WEXITSTATUS(status) != e->code)
        fail_msg("%s\nended with %s %d, expected exit code %d; it says\n%s", command,
                 WIFEXITED(status) ? "exit code" : "signal",
                 WIFEXITED(status) ? WEXITSTATUS(status) : WTERMSIG(status), e->code, output);
    for (int i = 0; i < MAX_TEXTS && e->text[i]; i++)
        if (!strstr(output, e->text[i]))
            fail_msg("%s\ndoes not say\n  %s\nbut\n%s", command, e->text[i], output);
}

static void copy_passes(void **state)
{
    const char *const *names = *state;
    struct expected e = {"test", "", "", EXIT_OK, {" 0 failed"}};
    char command[4096], file[200];

    snprintf(command, sizeof command, "mkdir -p '%s/as' && cp '%s/%s' '%s/as/%s.so'",
             setting("PLUGFLOW_BROKEN_DIR"), setting("PLUGFLOW_BROKEN_DIR"), names[0],
             setting("PLUGFLOW_BROKEN_DIR"), names[1]);
    assert_int_equal(system(command), 0);
    snprintf(file, sizeof file, "as/%s.so", names[1]);
    e.file = file;
    *state = &e;
    answers_as_expected(state);
}

#define CALL(FACT, BEFORE, FILE, AFTER, CODE, ...)                                                                 \
    {                                                                                                              \
        FACT, answers_as_expected, NULL, NULL, &(struct expected)                                                  \
        {                                                                                                          \
            BEFORE, FILE, AFTER, CODE,                                                                             \
            {                                                                                                      \
                __VA_ARGS__                                                                                        \
            }                                                                                                      \
        }                                                                                                          \
    }
/* plugflow test NAME.so ends with exit code 5 and says the texts. */
#define TOLD(NAME, ...) CALL(#NAME "_is_told", "test", #NAME ".so", "", EXIT_PLUGIN, __VA_ARGS__)
/* plugflow run planted.lua --plugin NAME.so ends with this exit code and says the texts. */
#define RUN(FACT, NAME, CODE, ...)                                                                                 \
    CALL(FACT, "run \"$PLUGFLOW_SOURCE/tests/abi/planted.lua\" --out \"$PLUGFLOW_BROKEN_DIR/out\" --plugin",       \
         #NAME ".so", "", CODE, __VA_ARGS__)
/* A copy of the file, called like the plugin in it, passes all checks. */
#define LOADS(FACT, FILE, NAME)                                                                                    \
    {                                                                                                              \
        FACT, copy_passes, NULL, NULL, (const char *[])                                                            \
        {                                                                                                          \
            FILE, NAME                                                                                             \
        }                                                                                                          \
    }

/* plugflow jacobian supg.lua OPTIONS --plugin supg.so finds nothing wrong. */
#define SUPG(FACT, OPTIONS)                                                                                        \
    CALL(FACT, "jacobian \"$PLUGFLOW_SOURCE/tests/abi/supg.lua\" --plugin", "supg.so", OPTIONS, EXIT_OK,           \
         "ok     d R_T / d T  differences agree", "ok     d R_T / d u  differences agree")

static const struct CMUnitTest tests[] = {
    TOLD(sound, "the file sound.so holds a plugin \"broken\": they must have the same name", " 1 failed"),
    LOADS("sound_plugin_passes", "sound.so", "broken"),
    LOADS("plugin_of_a_later_minor_version_with_longer_structs_passes", "later_minor.so", "broken"),
    LOADS("keys_of_one_name_may_have_two_ranges", "two_ranges.so", "broken"),
    LOADS("required_whole_number_is_tested_inside_its_range", "needs_order.so", "broken"),
    LOADS("frozen_header_1_0_loads", "frozen_1_0.so", "first"),
    LOADS("frozen_header_1_1_loads", "frozen_1_1.so", "second"),
    LOADS("frozen_header_1_2_loads", "frozen_1_2.so", "third"),
    LOADS("frozen_header_1_3_loads_with_laplacian_and_metric", "frozen_1_3.so", "fourth"),
    LOADS("laplacian_and_metric_of_1_3_pass", "supg.so", "supg"),
    CALL("they_are_described", "describe", "supg.so", "", EXIT_OK, "Laplacian of T, scalar",
         "; reads the metric of the element"),
    SUPG("term_with_both_has_its_jacobian_on_curved_quads", ""),
    SUPG("term_with_both_has_its_jacobian_on_curved_triangles", "--set simplex=true"),
    SUPG("term_with_both_has_its_jacobian_in_cut_quads", "--set body=true"),
    SUPG("term_with_both_has_its_jacobian_in_cut_triangles", "--set body=true --set simplex=true"),

    /* files */
    TOLD(nowhere, "nowhere.so does not exist"),
    TOLD(not_elf, "not_elf.so cannot be loaded", "invalid ELF header"),
    TOLD(no_entry, "is no plugin: it exports none of pf_plugin_entry", "PF_EXPORT"),
    TOLD(undefined_symbol, "undefined_symbol.so cannot be loaded", "undefined symbol: a_function_that_nobody_has"),

    /* the description of the plugin */
    TOLD(wrong_abi_major, "built for plugin interface 2.4, this plugflow has 1.4", "rebuild"),
    TOLD(needs_newer_minor, "needs plugin interface 1.5 or later, this plugflow has 1.4", "update plugflow"),
    TOLD(plugin_too_small, "its pf_plugin has 40 bytes, at least", "set .size = sizeof(pf_plugin)"),
    TOLD(other_type_sizes, "built with other type sizes (0x40404, here 0x80808)"),
    TOLD(bad_plugin_name, "has no proper name"),
    TOLD(no_license, "lacks a version or a license"),
    TOLD(no_terms, "describes no term"),
    TOLD(wrong_field_size, "field_size = 8; set .field_size = sizeof(pf_field)"),
    TOLD(declines, "declines.so declines to start: needs a licence server"),
    TOLD(declines_silently, "declines to start: it gives no reason"),
    TOLD(crash_in_entry, "crashed (bad memory access)", "crash_in_entry.so", "while it is loaded"),

    /* fields and terms */
    TOLD(bad_field_order, "field \"u\": order 3", "order 1 or 2"),
    TOLD(duplicate_field, "two fields are called \"u\""),
    TOLD(term_too_small, "term 0 has 64 bytes, at least", "set .size = sizeof(pf_term)"),
    TOLD(wrong_slot_size, "term convection: slot_size = 8; set .slot_size = sizeof(pf_slot)"),
    TOLD(wrong_param_size, "term convection: param_size = 8; set .param_size = sizeof(pf_param)"),
    TOLD(wrong_example_size, "term convection: example_size = 8; set .example_size = sizeof(pf_example)"),
    TOLD(bad_term_name, "a term has no proper name"),
    TOLD(duplicate_term, "term convection: two terms have this name"),
    TOLD(no_citation, "lacks doc (its weak form) or cite"),
    TOLD(no_residual, "term convection: has no residual function"),
    TOLD(no_output, "term convection: has no output"),
    TOLD(unknown_place, "acts on unknown points, where = 17"),
    TOLD(on_particles, "slot \"u\": at PF_PARTICLE points fields of particles and of the problem are there"),
    TOLD(by_boundary_in_cells, "has PF_BY_BOUNDARY, so it must act on PF_FACET"),

    /* slots */
    TOLD(duplicate_slot, "two input slots are called \"u\""),
    TOLD(duplicate_data_slot, "two input slots are called \"u\""),
    TOLD(undeclared_field, "input slot \"u\" uses field \"temperature\", an undeclared dependency"),
    TOLD(wrong_slot_shape, "input slot \"grad_u\": the gradient of field \"u\" has another shape"),
    TOLD(output_of_old_value, "output slot \"v\": eval 5 is not possible there"),
    TOLD(defect_slot, "slot \"u\" asks for PF_DEFECT, which only PF_CUT and PF_PAIR points have"),
    TOLD(laplacian_of_a_test_function,
         "output slot \"v\": PF_LAPLACE is for input slots; of a test function there are "),
    TOLD(laplacian_on_pairs,
         "slot \"u\": on PF_PAIR points fields on particles are there, as PF_DEFECT, PF_VALUE or PF_OTHER"),
    TOLD(laplacian_in_cut_cells, "slot \"u\": on PF_CUT points fields on the mesh are there, as PF_DEFECT only"),
    TOLD(laplacian_off_the_mesh, "slot \"lap_p\": field \"p\" does not live on the mesh and has no Laplacian"),
    TOLD(laplacian_of_a_body, "slot \"lap_p\": field \"p\" does not live on the mesh and has no Laplacian"),
    TOLD(laplacian_of_wrong_shape, "input slot \"grad_u\": the Laplacian of field \"u\" has another shape"),
    TOLD(laplacian_without_minor, "uses PF_LAPLACE of plugin interface 1.3", "set .min_minor = 3 in its pf_plugin"),
    TOLD(metric_without_minor, "uses PF_METRIC of plugin interface 1.3", "set .min_minor = 3 in its pf_plugin"),
    TOLD(metric_in_cut_cells, "has PF_METRIC, but PF_CUT points lie in no single element and have no metric"),
    TOLD(too_many_slots, "268435456 input slots and 1 output slots, at most 12 of each are possible"),

    /* parameters */
    TOLD(default_out_of_range, "parameter \"density\": default -1 lies outside its own range [0, 1e+30]"),
    TOLD(param_outside_struct, "parameter \"density\" at offset 40 lies outside the 40 bytes of params"),
    TOLD(param_offset_wraps, "parameter \"density\" at offset 4294967292 lies outside the 40 bytes of params"),
    TOLD(choice_out_of_range, "parameter \"form\": default 2 is none of its 2 choices"),
    TOLD(duplicate_param, "two parameters are called \"density\""),
    TOLD(param_without_unit, "parameter \"density\" lacks a unit"),
    TOLD(key_of_every_line, "parameter \"over\" is a key of every term line; give it another name"),
    TOLD(data_of_every_line, "PF_DATA slot \"name\" is a key of every term line; give it another name"),
    TOLD(required_unknown, "input slot \"u\" has PF_REQUIRED, which is for PF_DATA"),
    TOLD(required_without_minor, "uses PF_REQUIRED of data of plugin interface 1.4", "set .min_minor = 4"),
    TOLD(two_units,
         "term other: parameter \"density\" has another unit than in term convection (g/cm^3, default 1; "
         "there kg/m^3, default 1)"),
    TOLD(two_defaults, "term other: parameter \"density\" has another default than in term convection"),

    /* worked examples */
    TOLD(wrong_example, "WRONG  convection  example \"one point\": v[1] is 33, expected 34"),
    TOLD(example_of_no_dimension, "example \"one point\" has dimension 0; 2 or 3 is possible"),
    TOLD(example_without_output, "example \"one point\" lacks its values"),
    TOLD(nan_in_example, "example \"one point\": v[0] is ", "nan, expected 21"),

    CALL("the_terms_of_a_case_are_tested_in_its_conditions",
         "test --case \"$PLUGFLOW_SOURCE/tests/abi/planted.lua\" --plugin", "sound.so", "", EXIT_OK,
         "ok     broken.convection  ", " batches of the case", " 0 failed"),
    CALL("a_fault_is_found_in_the_conditions_of_a_case",
         "test --case \"$PLUGFLOW_SOURCE/tests/abi/planted.lua\" --plugin", "transpose.so", "", EXIT_PLUGIN,
         "WRONG  convection  d v / d u in 2D: ", "d v[0] / d u[1] is "),
    CALL("a_report_in_json", "test --json", "transpose.so", "", EXIT_PLUGIN,
         "{\"ok\": false, \"text\": \"convection  d v / d u in 2D: transpose", "\"failed\": 3, \"exit\": 5"),

    /* residuals */
    TOLD(unwritten, "output \"v\"[0] in 2D is not written; the residual must assign every output"),
    TOLD(added, "output \"v\"[0] in 2D is added to; the residual must assign, not add"),
    TOLD(nan_output, "output \"v\"[0] in 2D is not a finite number on random values"),
    TOLD(unrepeatable, "output \"v\"[0] in 2D differs between two calls with the same values"),
    TOLD(neighbour, "output \"v\": a point's value depends on the other points of its batch"),
    TOLD(batch_maximum, "output \"v\": a point's value depends on the other points of its batch"),
    TOLD(fails, "convection  residual on random values returned -1: term broken.convection at x = (",
         ": density -4.5 is not possible"),
    TOLD(host_of_batch, "convection  residual on random values returned -1: term broken.convection at x = (",
         ": the host came with the batch"),
    TOLD(fails_silently, "convection  residual on random values returned 1: without saying why"),
    TOLD(crash, "crashed (bad memory access) inside term broken.convection, residual on random values",
         "crash.so: the test ended by signal 11"),

    /* Jacobians */
    TOLD(sign, "d v / d u in 2D: sign: the block is minus the derivative",
         "d v / d grad_u in 2D: analytic = complex step"),
    TOLD(factor, "d v / d u in 2D: factor: the block is 2 times the derivative"),
    TOLD(transpose, "d v / d u in 2D: transpose: rows and columns are exchanged"),
    TOLD(missing, "d v / d u in 2D: missing: the block is zero, the derivative is not"),
    TOLD(exchanged, "d v / d grad_u in 2D: transpose: the two indices of grad_u are exchanged",
         "d v / d grad_u in 3D: transpose: the two indices of grad_u are exchanged"),
    TOLD(incomplete, "d v / d grad_u in 2D: wrong by "),
    TOLD(nan_jacobian, "d v / d u in 2D: the block is not finite"),
    TOLD(failing, "Jacobian returned -1: term broken.convection at x = (", "no derivative at 1"),
    TOLD(crashing, "crashed (bad memory access) inside term broken.convection, Jacobian"),
    TOLD(denied_coupling, "\"v\" depends on \"u\", but depends[0][0] says it does not: undeclared dependency"),
    TOLD(not_linear, "is flagged PF_LINEAR, but d v / d u changes with the state"),

    /* complex twins */
    TOLD(different, "residual_c differs from residual by ", "they must be one source"),
    TOLD(nan_twin, "residual_c differs from residual by "),
    TOLD(failing_twin, "residual_c returned -1"),
    TOLD(crashing_twin, "crashed (bad memory access) inside term broken.convection, complex twin"),
    TOLD(not_analytic, "d v / d u in 2D: residual_c does not carry the derivative"),

#ifdef HAVE_MOMENTUM
    /* the momentum plugin with one error in its source */
    TOLD(planted_sign, "WRONG  convection  d v / d u in 2D: sign: the block is minus the derivative"),
    TOLD(planted_factor, "WRONG  viscous  d grad_v / d grad_u in 2D: factor: the block is 2 times the derivative"),
    TOLD(planted_transpose, "WRONG  convection  d v / d grad_u in 2D: transpose: the two indices of grad_u"),
    TOLD(planted_missing, "WRONG  pressure_gradient  d div_v / d p in 2D: missing: the block is zero"),
    TOLD(planted_half, "WRONG  viscous  d grad_v / d grad_u in 2D: transpose: ", "is missing"),
    TOLD(planted_residual, "WRONG  viscous  example \"grad u = (1 2; 4 -1)", "grad_v[0][1] is 12, expected 18"),

    /* in a run */
    RUN("a_sound_plugin_runs", sound, EXIT_OK, "observed order 2."),
    RUN("a_run_tells_a_jacobian_with_a_wrong_factor", factor, EXIT_OK,
        "warning: Newton converges with order 1.0 only: some Jacobian block is wrong or missing; plugflow "
        "jacobian ",
        "planted.lua compares them one by one"),
    RUN("a_run_tells_a_jacobian_with_a_block_missing", missing, EXIT_OK, "order 1.0 only"),
    RUN("a_run_tells_a_transposed_jacobian", transpose, EXIT_OK, "only: some Jacobian block is wrong or missing"),
    RUN("a_run_names_the_term_with_a_nan", nan_output, EXIT_PLUGIN, "term broken.convection: output \"v\" is ",
        "nan at x = ("),
    RUN("a_run_names_the_jacobian_with_a_nan", nan_jacobian, EXIT_PLUGIN,
        "term broken.convection: derivative of \"v\" by \"u\" is ", "nan at x = ("),

    /* names */
    LOADS("copy_of_momentum_passes_on_its_own", "momentum_copy.so", "momentum"),
    CALL("two_plugins_of_one_name_are_told_with_both_files", "describe momentum --plugin", "momentum_copy.so", "",
         EXIT_PLUGIN, "two plugins are called \"momentum\": ", "/momentum_copy.so and ", "/momentum.so; remove"),
    CALL("two_plugins_of_one_name_are_listed_with_both_files", "plugins --plugin", "momentum_copy.so", "", EXIT_OK,
         "two plugins are called \"momentum\": ", "/momentum_copy.so and ", "/momentum.so; remove"),
#endif
};

int main(void)
{
    struct rlimit none = {0, 0};

    setrlimit(RLIMIT_CORE, &none);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
