/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Case files that users got wrong, as they wrote them (bad_cases/): each says with file and line what is wrong and
 * what to write instead, and those that are right run. */
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct trial {
    const char *file;
    const char *command; /* "check", or "run" if it shows only then */
    int code;
    const char *says[5];
} trial;

static const trial trials[] = {
    {"01_key_typo", "check", 3, {"01_key_typo.lua:3: ", "\"viscocity\"", "did you mean \"viscosity\""}},
    {"02_fn_typo", "check", 3, {"02_fn_typo.lua:2: ", "\"msh\"", "did you mean \"mesh\""}},
    {"04_term_typo", "check", 3, {"04_term_typo.lua:5: ", "\"momentun\"", "did you mean \"momentum\""}},
    {"05_zero_visc", "check", 3, {"05_zero_visc.lua:3: ", "\"viscosity\"", "is 0; it must be positive"}},
    {"07_neg_density", "check", 3, {"07_neg_density.lua:3: ", "\"density\"", "is -1; it must not be negative"}},
    {"08_string_visc", "check", 3, {"08_string_visc.lua:3: ", "\"viscosity\"", "expected a number", "\"water\""}},
    {"10_no_fluid", "check", 3, {"needs \"density\"", "needs \"viscosity\"", "fluid { viscosity = ... }"}},
    {"11_no_terms", "check", 3, {"11_no_terms.lua: ", "no term", "term \"momentum\" {}"}},
    {"13_no_bc", "check", 3, {"no condition: \"left\", \"right\", \"bottom\", \"top\"", "natural = true"}},
    {"14_bc_missing", "check", 3, {"no condition: \"bottom\", \"top\"", "natural = true"}},
    {"16_inflow_no_outflow_t", "run", 3, {"net outflow is -0.666", "\"left\"", "natural = true"}},
    {"17_nan_fn", "check", 3, {"17_nan_fn.lua:7: ", "\"u\" at (0, 0), t = 0", "not finite"}},
    {"19_err_fn", "check", 3, {"19_err_fn.lua:7: ", "\"z\" is not defined"}},
    {"20_inf_loop", "check", 3, {"20_inf_loop.lua:2: ", "endless loop"}},
    {"22_cells_zero", "check", 3, {"22_cells_zero.lua:2: ", "\"cells\"", "entry 1 is 0", "whole number"}},
    {"23_cells_neg", "check", 3, {"23_cells_neg.lua:2: ", "\"cells\"", "entry 2 is -8"}},
    {"25_box_inverted", "check", 3, {"25_box_inverted.lua:2: ", "\"box\"", "beyond the first", "0 is not > 2"}},
    {"26_box_flat", "check", 3, {"26_box_flat.lua:2: ", "\"box\"", "beyond the first"}},
    {"28_dim_mix2", "check", 3, {"28_dim_mix2.lua:6: ", "\"u\"", "expected 2 components"}},
    {"29_dt_neg", "check", 3, {"29_dt_neg.lua:9: ", "\"step\"", "is -0.05; it must be positive"}},
    {"31_stop_neg", "check", 3, {"31_stop_neg.lua:9: ", "stop = -1 is not after start = 0"}},
    {"32_no_stop", "check", 3, {"32_no_stop.lua:9: ", "\"stop\" is missing"}},
    {"34_scheme", "check", 3, {"34_scheme.lua:9: ", "\"rk4\"", "\"bdf1\", \"bdf2\""}},
    {"35_outside", "check", 3, {"35_outside.lua:10: ", "(5, 0.5) lies outside of the mesh", "(0, 0) to (2, 1)"}},
    {"37_bigger",
     "check",
     3,
     {"37_bigger.lua:10: ", "\"bottom\" by 0.2 and \"top\" by 0.2", "larger than the domain"}},
    {"38_in_wall", "check", 3, {"38_in_wall.lua:10: ", "reaches through \"bottom\" by 0.1"}},
    {"40_radius_neg", "check", 3, {"40_radius_neg.lua:10: ", "-0.2", "positive"}},
    {"41_density_zero", "check", 3, {"41_density_zero.lua:10: ", "\"density\"", "is 0; it must be positive"}},
    {"43_shape_str", "check", 3, {"43_shape_str.lua:10: ", "\"shape\"", "shape = disk { radius = 0.1 }"}},
    {"44_diameter", "check", 3, {"44_diameter.lua:10: "}},
    {"46_particulate_first", "check", 3, {"46_particulate_first.lua:2: ", "fluid{} must stand before it"}},
    {"47_formulation", "check", 3, {"47_formulation.lua:9: ", "sharpp", "\"sharp\", \"conservative\""}},
    {"49_angle_deg", "check", 3, {"49_angle_deg.lua:10: ", "\"angle\"", "rad", "expected a number", "\"45deg\""}},
    {"50_motion", "check", 3, {"50_motion.lua:10: ", "\"frozen\"", "\"free\", \"fixed\", \"prescribed\""}},
    {"52_gravity_scalar", "check", 3, {"52_gravity_scalar.lua:3: ", "\"gravity\"", "expected 2 numbers in braces"}},
    {"53_gravity_vec3", "check", 3, {"53_gravity_vec3.lua:3: ", "\"gravity\"", "expected 2 numbers, got 3"}},
    {"55_periodic_and_bc", "check", 3, {"55_periodic_and_bc.lua:7: ", "\"left\" is periodic by line 6"}},
    {"56_geo_missing", "check", 4, {"56_geo_missing.lua:2: ", "nope.geo", "is not there"}},
    {"58_msh_garbage", "check", 4, {"58_msh_garbage.lua:2: ", "garbage.msh"}},
    {"59_stl", "check", 4, {"59_stl.lua:2: ", "garbage.stl"}},
    {"61_probe_outside", "check", 3, {"61_probe_outside.lua:9: ", "probe \"a\" at (9, 9)", "outside the mesh"}},
    {"62_probe_3d", "check", 3, {"62_probe_3d.lua:9: ", "probe \"a\" needs 2 coordinates"}},
    {"64_forces_bad", "check", 3, {"64_forces_bad.lua:9: ", "\"cylinder\"", "left, right, bottom, top"}},
    {"65_results_nil", "run", 3, {"65_results_nil.lua:9: ", "\"nothing.fx\""}},
    {"67_lua_syntax", "check", 3, {"67_lua_syntax.lua:10: ", "'}' expected (to close '{' at line 9)"}},
    {"68_io", "check", 3, {"68_io.lua:9: ", "\"io\" is not defined"}},
    {"70_print", "run", 0, {"hello", "summary.json"}},
    {"71_every_neg", "check", 3, {"71_every_neg.lua:10: ", "\"every\"", "is -1; it must be positive"}},
    {"73_tol_neg", "check", 3, {"73_tol_neg.lua:9: ", "\"tolerance\"", "is -1; it must lie between"}},
    {"74_twice_mesh", "check", 3, {"74_twice_mesh.lua:3: ", "a second block", "line 2"}},
    {"76_twice_term", "check", 3, {"76_twice_term.lua:6: ", "momentum.inertia is on already, by line 5"}},
    {"77_only_momentum", "check", 3, {"77_only_momentum.lua:4: ", "\"p\"", "term \"continuity\" {} does"}},
    {"79_bc_velocity", "check", 3, {"79_bc_velocity.lua:6: ", "\"velocity\"", "did you mean \"u\""}},
    {"80_highRe", "check", 0, {"warning: the Reynolds number of the smallest cells is 1.2e+05"}},
    {"82_fast_no_contact", "run", 6, {"particle 0"}},
    {"83_case_missing", "check", 0, {"83_case_missing.lua: ok"}},
    {"85_map_nan", "check", 3, {"85_map_nan.lua:2: ", "\"map\" at (0, 0)", "not finite"}},
    {"86_initial_bad", "run", 0, {"summary.json"}},
    {"88_natural_all", "check", 3, {"nothing determines \"u\" (velocity)", "prescribe it", "time {}"}},
    {"89_param_unused", "check", 0, {"--set n=8"}},
    {"big", "check", 0, {"big.lua: ok"}},
    {"bigdt", "check", 0, {"bigdt.lua: ok"}},
    {"nophys", "check", 3, {"nophys.lua:7: ", "no boundary is called \"left\"", "physical group"}},
    {"pd",
     "check",
     3,
     {"pd.lua:8: ", "\"left\": \"p\" cannot be prescribed", "continuity.divergence", "would be lost"}},
    {"prob", "check", 0, {"prob.lua: ok"}},
    {"sweep", "run", 3, {"sweep.lua:11", "r has no part called \"flow\""}},
    {"ts", "run", 0, {"summary.json"}},
    {"ts3", "check", 3, {"ts3.lua:8: ", "\"u\" at (0, 0), t = 0.5", "not finite"}},
    {"warn", "run", 0, {"warning: particle 0 (line 7) is 0.2 wide, 1.6 cells; below 4 cells across"}},
};

enum { N_TRIAL = sizeof trials / sizeof *trials };

static int copy_trials(void **state)
{
    (void)state;
    if (shell("cp tests/cli/bad_cases/* %s/", scratch()).code)
        return -1;
    put_file("garbage.msh", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 4 1 4\n2 1");
    put_file("garbage.stl", "solid garbage\n  facet normal");
    put_file("nophys.lua", "case \"Bad\"\nmesh { file = \"nophys.geo\" }\nfluid { density = 1, viscosity = 0.1 }\n"
                           "term \"continuity\" {}\nterm \"momentum\" {}\nboundary \"*\" { u = {0,0} }\n"
                           "boundary \"left\" { u = {1,0} }\n");
    return 0;
}

static void each_mistake_is_named_with_its_line_and_the_remedy(void **state)
{
    int failed = 0;

    (void)state;
    for (int i = 0; i < N_TRIAL; i++) {
        const trial *t = &trials[i];
        const int runs = strcmp(t->command, "run") == 0;
        ran r = runs ? plugflow("run %s/%s.lua --out %s/out", scratch(), t->file, scratch())
                     : plugflow("check %s/%s.lua", scratch(), t->file);
        int ok = r.code == t->code;

        for (int k = 0; k < 5 && t->says[k]; k++)
            if (!strstr(r.err, t->says[k]) && !strstr(r.out, t->says[k])) {
                print_error("%s: not printed: \"%s\"\n", t->file, t->says[k]);
                ok = 0;
            }
        if (!ok)
            print_error("%s: %s ended with %d, expected %d\n--- stdout\n%s\n--- stderr\n%s\n", t->file, t->command,
                        r.code, t->code, r.out, r.err);
        failed |= !ok;
    }
    if (failed)
        fail();
}

static void every_file_of_the_folder_is_tried(void **state)
{
    DIR *folder = opendir("tests/cli/bad_cases");
    struct dirent *e;

    (void)state;
    assert_non_null(folder);
    while ((e = readdir(folder))) {
        const char *dot = strrchr(e->d_name, '.');
        int found = 0;

        for (int i = 0; dot && i < N_TRIAL; i++)
            found |= strlen(trials[i].file) == (size_t)(dot - e->d_name) &&
                     strncmp(trials[i].file, e->d_name, (size_t)(dot - e->d_name)) == 0;
        if (e->d_name[0] != '.' && !found)
            fail_msg("%s has no entry", e->d_name);
    }
    closedir(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(each_mistake_is_named_with_its_line_and_the_remedy, copy_trials),
        cmocka_unit_test(every_file_of_the_folder_is_tried),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
