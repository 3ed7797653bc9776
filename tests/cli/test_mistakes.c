/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Mistakes that authors of terms make, in plugins of a few lines: what plugflow build and plugflow test say. */
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>

/* A plugin of one term, of this name: builds with this exit code, and what is said then. */
static void built(const char *name, const char *term, const char *end, int code, const char *text)
{
    char path[600];
    FILE *f;

    snprintf(path, sizeof path, "%s/%s.c", scratch(), name);
    f = fopen(path, "w");
    assert_non_null(f);
    fprintf(f, "#include <plugflow/term.h>\n%s\nPLUGIN(%s, \"x\", FIELDS(u, T), TERMS(t), .author = \"me\")\n%s\n",
            term, name, end);
    fclose(f);
    assert_ran(plugflow("build %s", path), code, text);
}

#define SAID      ".doc = \"d\", .cite = \"c\")\n"
#define WITH_TWIN "#include PF_TWIN"

static void a_line_of(const char *name, const char *term, int code, const char *text)
{
    built(name, term, WITH_TWIN, 0, "plugflow test ");
    assert_ran(plugflow("test %s/%s.so", scratch(), name), code, text);
}

static void messages_about_macros_are_explained(void **state)
{
    (void)state;
    built("m_slot", "TERM(t, PF_FLUID, IN(temp), OUT(s), PARAMS(), " SAID "{ LANES(i) s[i] = temp[i]; }", WITH_TWIN,
          5, "hint: a slot in IN or OUT is none that term.h knows");
    built("m_batch",
          "TERM(t, PF_FLUID, IN(T), OUT(s), PARAMS(REAL(b, \"1\", \"b\")), " SAID "{ LANES(i) s[i] = b * T[i]; }",
          WITH_TWIN, 5, "hint: a key or a slot is called as what every block has");
    built("m_many",
          "#define K(n) REAL(k##n, \"1\", \"k\")\n"
          "TERM(t, PF_FLUID, IN(T), OUT(s), PARAMS(K(1), K(2), K(3), K(4), K(5), K(6), K(7), K(8), K(9), K(10), "
          "K(11), "
          "K(12), K(13), K(14), K(15), K(16), "
          "K(17), K(18), K(19), K(20), K(21), K(22), K(23), K(24), K(25), K(26), K(27), K(28), K(29), K(30), "
          "K(31), K(32), K(33), K(34), K(35)), " SAID "{ LANES(i) s[i] = k1 * T[i]; }",
          WITH_TWIN, 5, "hint: a list is too long");
    built("m_twin", "TERM(t, PF_FLUID, IN(T), OUT(s), PARAMS(), " SAID "{ LANES(i) s[i] = T[i]; }", "", 5,
          "hint: the last line of the file is missing: #include PF_TWIN");
}

static void a_hidden_key_is_told(void **state)
{
    static const char term[] = "TERM(t, PF_FLUID, IN(T), OUT(s), PARAMS(REAL(a, \"1\", \"a\", .dflt = 1)), " SAID
                               "{ LANES(i) EACH(a) s[i] = a * T[i]; }";

    (void)state;
    built("m_hidden", term, WITH_TWIN, 0, "hint: two things have one name");
    a_line_of("m_hidden", term, 5, "WRONG  t  no output and no derivative depends on key a");
}

static void a_term_must_have_values_at_rest(void **state)
{
    static const char root[] = "TERM(t, PF_FLUID, IN(u), OUT(v), PARAMS(), " SAID
                               "{ LANES(i) { NUM m = %s; EACH(k) m += u[k][i] * u[k][i];\n"
                               "EACH(a) v[a][i] = sqrt(m) * u[a][i]; } }";
    char term[400];

    (void)state;
    snprintf(term, sizeof term, root, "0");
    a_line_of("m_rest", term, 5, "WRONG  t  d v / d u (complex step) is not a finite number in 2D at rest");
    snprintf(term, sizeof term, root, "1e-300");
    a_line_of("m_small", term, 5, "add a small number under the root");
    snprintf(term, sizeof term, root, "1e-150");
    a_line_of("m_sound", term, 0, " 0 failed");
}

static void a_scalar_may_be_below_zero_unless_its_range_says_otherwise(void **state)
{
    static const char root[] = "TERM(t, PF_FLUID, IN(SLOT(theta, T, VALUE, SCALAR%s)), OUT(s), PARAMS(), " SAID
                               "{ LANES(i) s[i] = sqrt(1e-20 + theta[i] * theta[i] * theta[i]); }";
    char term[400];

    (void)state;
    snprintf(term, sizeof term, root, ", .unit = \"K\"");
    a_line_of("m_below", term, 5, "s is not a finite number in 2D with scalars below 0");
    snprintf(term, sizeof term, root, ", .min = 0, .max = 1e4");
    a_line_of("m_ranged", term, 0, " 0 failed");
}

static void a_read_past_a_slot_is_told(void **state)
{
    (void)state;
    a_line_of("m_past",
              "TERM(t, PF_FLUID, IN(grad_T), OUT(s), PARAMS(), " SAID "{ LANES(i) s[i] = grad_T[DIM][i]; }", 5,
              "comes from outside of input \"grad_T\": a slot is read past its end");
}

static void a_property_needs_a_key_or_a_publisher(void **state)
{
    (void)state;
    a_line_of("m_law",
              "TERM(t, PF_FLUID, IN(grad_T, mu), OUT(grad_s), PARAMS(), " SAID
              "{ LANES(i) EACH(a) grad_s[a][i] = mu[i] * grad_T[a][i]; }",
              5, "takes viscosity, which no term publishes and its PARAMS have no key for");
}

static void a_datum_may_multiply_an_unknown_of_a_linear_term(void **state)
{
    (void)state;
    a_line_of(
        "m_linear",
        "TERM(t, PF_FLUID, IN(grad_T, DATA(wind, VECTOR), OLD(T)), OUT(s), PARAMS(), .flags = PF_LINEAR, " SAID
        "{ LANES(i) { s[i] = 0; EACH(k) s[i] += old_T[i] * wind[k][i] * grad_T[k][i]; } }",
        0, "linear in 2D, as flagged");
    a_line_of("m_bent",
              "TERM(t, PF_FLUID, IN(T, grad_T), OUT(s), PARAMS(), .flags = PF_LINEAR, " SAID
              "{ LANES(i) s[i] = T[i] * grad_T[0][i]; }",
              5, "changes with the state");
}

static void an_init_may_want_another_problem(void **state)
{
    static const char term[] = "TERM(t, PF_FLUID, IN(T), OUT(s), PARAMS(), .init = t_init, " SAID
                               "{ LANES(i) s[i] = T[i]; }\n#if PF_ONCE\n"
                               "int t_init(void *params, const pf_setup *s, char *why, size_t n)\n"
                               "{ (void)params; snprintf(why, n, \"%s\"); return s->n_body %s; }\n#endif\n";
    char text[600];

    (void)state;
    snprintf(text, sizeof text, term, "three, please", "!= 3");
    a_line_of("m_three", text, 0, "init refuses 2 bodies, unsteady (three, please); tested with 3, unsteady");
    snprintf(text, sizeof text, term, "never", "< 100");
    a_line_of("m_never", text, 5, "never -- to each of 0 to 8 bodies");
}

static const char channel[] = "case \"c\"\nmesh { box = {{0, 0}, {1, 1}}, cells = {2, 2} }\n"
                              "fluid { density = 1%s }\nterm \"continuity\" {}\nterm \"momentum\" {}\n"
                              "term \"m_case\" {}\nboundary \"*\" { u = {0, 0} }\nsolve {}\n";

static void of_a_case_all_kinds_of_terms_are_tested(void **state)
{
    static const char *const terms[] = {
        "TERM(t, PF_FLUID, IN(grad_u), OUT(PROPERTY(viscosity, \"Pa s\", \"d\")), PARAMS(), " SAID
        "{ LANES(i) viscosity[i] = 1 + grad_u[0][0][i] * grad_u[0][0][i]; }",
        "TERM(t, PF_FLUID, IN(u), OUT(SHOW(speed, SCALAR, \"m/s\", \"d\")), PARAMS(), " SAID
        "{ LANES(i) speed[i] = u[0][i]; }",
    };
    char path[600];
    FILE *f;

    (void)state;
    snprintf(path, sizeof path, "%s/m_case.lua", scratch());
    for (size_t i = 0; i < sizeof terms / sizeof *terms; i++) {
        f = fopen(path, "w");
        assert_non_null(f);
        fprintf(f, channel, i ? ", viscosity = 1" : "");
        fclose(f);
        built("m_case", terms[i], WITH_TWIN, 0, "plugflow test ");
        assert_ran(plugflow("test --case %s --plugin %s/m_case.so m_case", path, scratch()), 0, "ok     m_case.t",
                   "1 passed, 0 failed");
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(messages_about_macros_are_explained),
        cmocka_unit_test(a_hidden_key_is_told),
        cmocka_unit_test(a_term_must_have_values_at_rest),
        cmocka_unit_test(a_scalar_may_be_below_zero_unless_its_range_says_otherwise),
        cmocka_unit_test(a_read_past_a_slot_is_told),
        cmocka_unit_test(a_property_needs_a_key_or_a_publisher),
        cmocka_unit_test(a_datum_may_multiply_an_unknown_of_a_linear_term),
        cmocka_unit_test(an_init_may_want_another_problem),
        cmocka_unit_test(of_a_case_all_kinds_of_terms_are_tested),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
