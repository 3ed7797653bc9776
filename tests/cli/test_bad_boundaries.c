/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Mistakes in boundary "..." {}: each is refused with its line, what was expected and what to write. */
#include "support/bad_case.h"
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

/* A pressure on the boundary would take the place of the balance of mass there: the flow between p = 1 and p = 0
 * was -0.0006 where 0.625 is exact. */
static void a_field_whose_equation_is_another_balance_cannot_be_prescribed(void **state)
{
    static const bad_case list[] = {
        {"8 boundary \"right\" { p = 0 }",
         3,
         {"bad.lua:8: boundary \"right\": \"p\" cannot be prescribed", "(continuity.divergence)",
          "does not contain p", "would be lost there"}},
        {"8 boundary \"right\" { p = function(x, y) return y end }", 3, {"\"p\" cannot be prescribed"}},
        {"8 boundary \"right\" { p = \"0\" }", 3, {"bad.lua:8: ", "\"p\": expected a number or a function"}},
        {"9 initial { p = 1 }", 0, {"ok"}},
    };

    (void)state;
    assert_bad_cases(list);
}

static void names_of_other_codes_are_understood(void **state)
{
    static const bad_case list[] = {
        {"7 boundary \"left\" { velocity = {1, 0} }",
         3,
         {"unknown key \"velocity\"; did you mean \"u\"", "!no condition"}},
        {"7 boundary \"left\" { U = {1, 0} }", 3, {"did you mean \"u\""}},
        {"6 boundary \"*\" { no_slip = true }", 3, {"did you mean \"u\"", "a wall is u = {0, 0}"}},
        {"8 boundary \"right\" { outflow = true }", 3, {"did you mean \"natural\""}},
        {"8 boundary \"right\" { slip = true }", 3, {"did you mean \"symmetry\""}},
        {"7 boundary \"left\" { theta = 1 }", 3, {"unknown key \"theta\"", "natural", "symmetry", "traction, u"}},
        {"8 boundary \"rigth\" { natural = true }", 3, {"bad.lua:8: ", "did you mean \"right\"?"}},
        {"8 boundary \"front\" { natural = true }",
         3,
         {"no boundary is called \"front\"", "left, right, bottom, top"}},
    };

    (void)state;
    assert_bad_cases(list);
}

static void values_have_the_components_of_the_field(void **state)
{
    static const bad_case list[] = {
        {"7 boundary \"left\" { u = 1 }", 3, {"bad.lua:7: ", "expected 2 components"}},
        {"7 boundary \"left\" { u = {1} }", 3, {"expected 2 components"}},
        {"7 boundary \"left\" { u = \"fast\" }", 3, {"expected 2 components"}},
        {"7 boundary \"left\" { u = {0/0, 0} }", 3, {"bad.lua:7: ", "component 1 is not a finite number"}},
        {"7 boundary \"left\" { u = {free, free} }", 3, {"nothing of \"u\" is prescribed"}},
        {"7 boundary \"left\" { u = {1, free} }", 0, {"ok"}},
        {"7 boundary \"left\" { u = function(x, y) return 1 end }", 3, {"must return 2 numbers, result 2 is nil"}},
        {"8 boundary \"right\" { traction = 1 }", 3, {"\"traction\": expected 2 components"}},
        {"8 boundary \"right\" { traction = {free, 0} }", 3, {"free leaves a component open"}},
        {"8 boundary \"right\" { natural = 1 }", 3, {"expected true or false"}},
        {"7 boundary \"left\" { u = function(x, y, t) if t > 0.07 then return nil end return 1, 0 end }\n"
         "9 time { step = 0.05, stop = 0.1 }",
         3,
         {"t = 0.1: it must return 2 numbers"}},
    };

    (void)state;
    assert_bad_cases(list);
}

static void conditions_do_not_contradict_each_other(void **state)
{
    static const bad_case list[] = {
        {"8 boundary \"right\" {}", 3, {"bad.lua:8: boundary \"right\" gives no condition"}},
        {"8 boundary \"right\" { natural = false }", 3, {"gives no condition"}},
        {"8 boundary \"right\" { symmetry = false }", 3, {"gives no condition"}},
        {"8 boundary \"right\" { natural = true, u = {0, 0} }", 3, {"nothing is prescribed, but something is"}},
        {"8 boundary \"right\" { symmetry = true, u = {0, 0} }", 3, {"\"u\" is given beside symmetry = true"}},
        {"8 boundary \"right\" { symmetry = true, traction = {1, 0} }",
         3,
         {"\"traction\" is given beside symmetry"}},
        {"8 boundary \"right\" { u = {0, 0}, traction = {1, 0} }", 3, {"traction has no effect"}},
        {"8 boundary \"right\" { natural = true }\n9 boundary \"left\" { u = {1, 0} }",
         3,
         {"bad.lua:9: ", "prescribed already by line 7"}},
        {"9 boundary \"right\" { u = {1, 0} }",
         3,
         {"line 8 says natural = true", "line 9 is about the same boundary"}},
        {"6 ", 3, {"no condition: \"bottom\", \"top\"", "natural = true"}},
        {"5 term \"momentum\" { without = {\"traction\"} }\n8 boundary \"right\" { traction = {1, 0} }",
         3,
         {"bad.lua:8: ", "\"traction\" belongs to momentum.traction, which is off", "term \"momentum.traction\" {}",
          "!unknown"}},
    };

    (void)state;
    assert_bad_cases(list);
}

static void periodic_boundaries_are_pairs(void **state)
{
    static const bad_case list[] = {
        {"7 boundary { periodic = {\"left\", \"right\"} }\n8 ", 0, {"ok"}},
        {"7 boundary { periodic = {\"left\"} }\n8 ",
         3,
         {"bad.lua:7: ", "periodic = {\"left\", \"right\"}", "!no condition"}},
        {"7 boundary { periodic = {\"left\", \"right\", \"top\"} }\n8 ",
         3,
         {"bad.lua:7: ", "periodic = {\"left\", \"right\"}"}},
        {"7 boundary { periodic = \"left\" }\n8 ", 3, {"expected names in braces", "!no condition"}},
        {"7 boundary { periodic = {\"left\", \"rigth\"} }\n8 ", 3, {"did you mean \"right\"?"}},
        {"7 boundary { periodic = {\"left\", \"left\"} }\n8 ", 3, {"cannot be periodic with itself"}},
        {"7 boundary \"left\" { periodic = \"right\" }\n8 ", 3, {"without a name"}},
        {"7 boundary { periodic = {\"left\", \"right\"} }\n8 boundary { periodic = {\"right\", \"left\"} }",
         3,
         {"bad.lua:8: boundary: \"left\" is periodic by line 7"}},
        {"9 boundary { periodic = {\"left\", \"right\"} }",
         3,
         {"bad.lua:7: boundary: \"left\" is periodic by line 9"}},
        {"7 boundary { periodic = {\"left\", \"bottom\"} }", 4, {"bad.lua:7: ", "their nodes do not match"}},
        {"8 boundary { natural = true }", 3, {"bad.lua:8: boundary: expected a name", "!unknown key"}},
    };

    (void)state;
    assert_bad_cases(list);
}

static void backflow_is_for_outflows_and_not_negative(void **state)
{
    static const bad_case list[] = {
        {"8 boundary \"right\" { backflow = 1 }", 0, {"ok"}},
        {"8 boundary \"right\" { pressure = 2, backflow = 1 }", 0, {"ok"}},
        {"8 boundary \"right\" { backflow = -1 }",
         5,
         {"momentum.backflow", "backflow is -1; it must not be negative"}},
        {"6 boundary \"*\" { u = {0, 0}, backflow = 1 }", 3, {"\"u\" and \"backflow\" are both given"}},
        {"8 boundary \"right\" { natural = true, backflow = 1 }",
         3,
         {"natural = true says that nothing is prescribed"}},
    };

    (void)state;
    assert_bad_cases(list);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_field_whose_equation_is_another_balance_cannot_be_prescribed),
        cmocka_unit_test(names_of_other_codes_are_understood),
        cmocka_unit_test(values_have_the_components_of_the_field),
        cmocka_unit_test(conditions_do_not_contradict_each_other),
        cmocka_unit_test(periodic_boundaries_are_pairs),
        cmocka_unit_test(backflow_is_for_outflows_and_not_negative),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
