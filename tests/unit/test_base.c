/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Strings, arenas, random numbers, breadcrumbs, diagnoses of Jacobian blocks. */
#include "base/arena.h"
#include "base/process.h"
#include "base/random.h"
#include "base/text.h"
#include "term/block.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void nearest_name_is_found_for_slips_only(void **state)
{
    const char *const names[] = {"density", "gravity", "viscosity"};

    (void)state;
    assert_string_equal(text_nearest("viscosty", names, 3), "viscosity");
    assert_string_equal(text_nearest("desnity", names, 3), "density");
    assert_null(text_nearest("temperature", names, 3));
    assert_null(text_nearest("w", (const char *const[]){"p", "u"}, 2)); /* nothing of it would be left */
    assert_int_equal(text_distance("ab", "ba"), 1);
}

static void a_name_is_never_taken_for_a_slip_for_itself(void **state)
{
    const char *const names[] = {"theta", "Theta", "beta"};

    (void)state;
    assert_string_equal(text_nearest("theta", names, 3), "Theta");
    assert_null(text_nearest("theta", names, 1));
}

/* Names beyond what text_distance compares are near nothing. */
static void a_name_of_300_letters_is_near_nothing(void **state)
{
    const char *const names[] = {"density"};
    char name[301];

    (void)state;
    memset(name, 'x', 300);
    name[300] = 0;
    assert_null(text_nearest(name, names, 1));
}

static void a_hint_is_empty_or_ends_a_message(void **state)
{
    char name[400];

    (void)state;
    assert_string_equal(text_hint("density").s, "; did you mean \"density\"?");
    assert_string_equal(text_hint(NULL).s, "");
    memset(name, 'x', sizeof name - 1);
    name[sizeof name - 1] = 0;
    assert_non_null(strstr(text_hint(name).s, "xxx\"?"));
}

static void assert_json(const char *bytes, size_t n, const char *json)
{
    text t = {0};

    text_json_bytes(&t, bytes, n);
    assert_string_equal(t.s, json);
    text_free(&t);
}

static void strings_of_json_are_utf8_whatever_the_bytes(void **state)
{
    (void)state;
    assert_json("a\"\\\n", 4, "\"a\\\"\\\\\\u000a\"");
    assert_json("a\0b", 3, "\"a\\u0000b\"");
    assert_json("\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80", 9, "\"\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80\"");
    assert_json("\xe9t", 2, "\"\xef\xbf\xbdt\"");                               /* Latin-1 */
    assert_json("\xe2\x82", 2, "\"\xef\xbf\xbd\xef\xbf\xbd\"");                 /* cut off */
    assert_json("\xc0\x80", 2, "\"\xef\xbf\xbd\xef\xbf\xbd\"");                 /* longer than need be */
    assert_json("\xed\xa0\x80", 3, "\"\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd\""); /* half of a pair of UTF-16 */
    assert_json("\xf4\x90\x80\x80", 4, "\"\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd\"");
}

static void numbers_read_back_as_the_same_bits(void **state)
{
    const double v[] = {0.1, 1.0 / 3, 1e-300, -7.25, 123456789.123456789};

    (void)state;
    for (size_t i = 0; i < sizeof v / sizeof *v; i++) {
        text t = {0};

        text_number(&t, v[i]);
        assert_true(strtod(t.s, NULL) == v[i]);
        text_free(&t);
    }
}

static void what_is_not_finite_becomes_null(void **state)
{
    text t = {0};

    (void)state;
    text_number(&t, NAN);
    assert_string_equal(t.s, "null");
    text_free(&t);
}

static void arena_memory_is_zeroed_aligned_and_refuses_overflow(void **state)
{
    arena a = {0};
    double *p = arena_alloc(&a, 3, sizeof *p);

    (void)state;
    assert_int_equal((uintptr_t)p % 64, 0);
    assert_true(p[0] == 0 && p[2] == 0);
    assert_null(arena_alloc(&a, SIZE_MAX / 4, 8));
    arena_free(&a);
}

/* The reference numbers come from integer arithmetic elsewhere. */
static void random_numbers_are_those_of_xorshift64star(void **state)
{
    const unsigned long long expected[2][3] = {{0x1cd4f43d462f79, 0x14e854f4361af9, 0x13ddb1690cc4c1},
                                               {0x0e2011809ec061, 0x024d8e1e4b8ccc, 0x12faf834f20188}};

    (void)state;
    assert_true(random_start(0) == RANDOM_SEED);
    for (int s = 0; s < 2; s++) {
        unsigned long long random = random_start(s ? 7 : 0);

        for (int i = 0; i < 3; i++)
            assert_true(random_next(&random) == (double)expected[s][i] * 0x1p-53);
    }
}

static void every_thread_has_a_breadcrumb_of_its_own(void **state)
{
    int wrong = 0;

    (void)state;
#pragma omp parallel num_threads(4) reduction(+ : wrong)
    {
        const int me = omp_get_thread_num();

        process_enter("plugin", "term", "residual", me);
#pragma omp barrier
        wrong += process_now().cell != me || process.thread[me].now.cell != me;
        process_leave();
        wrong += process_now().plugin != NULL;
    }
    assert_int_equal(wrong, 0);
    assert_int_equal((uintptr_t)&process.thread[1] % 64, 0);
}

static void diagnosis_names_sign_factor_transpose_and_missing(void **state)
{
    const double truth[4] = {1, 2, 3, 4}, minus[4] = {-1, -2, -3, -4}, twice[4] = {2, 4, 6, 8},
                 turned[4] = {1, 3, 2, 4};
    const double none[4] = {0}, wrong[4] = {1, 2, 3, 9};
    char text[200];

    (void)state;
    block_diagnose(minus, truth, 2, 2, 1, text, sizeof text);
    assert_non_null(strstr(text, "sign"));
    block_diagnose(twice, truth, 2, 2, 1, text, sizeof text);
    assert_non_null(strstr(text, "factor"));
    block_diagnose(turned, truth, 2, 2, 1, text, sizeof text);
    assert_non_null(strstr(text, "transpose"));
    block_diagnose(none, truth, 2, 2, 1, text, sizeof text);
    assert_non_null(strstr(text, "missing"));
    block_diagnose(wrong, truth, 2, 2, 1, text, sizeof text);
    assert_non_null(strstr(text, "wrong by"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nearest_name_is_found_for_slips_only),
        cmocka_unit_test(a_name_is_never_taken_for_a_slip_for_itself),
        cmocka_unit_test(a_name_of_300_letters_is_near_nothing),
        cmocka_unit_test(a_hint_is_empty_or_ends_a_message),
        cmocka_unit_test(strings_of_json_are_utf8_whatever_the_bytes),
        cmocka_unit_test(numbers_read_back_as_the_same_bits),
        cmocka_unit_test(what_is_not_finite_becomes_null),
        cmocka_unit_test(arena_memory_is_zeroed_aligned_and_refuses_overflow),
        cmocka_unit_test(random_numbers_are_those_of_xorshift64star),
        cmocka_unit_test(every_thread_has_a_breadcrumb_of_its_own),
        cmocka_unit_test(diagnosis_names_sign_factor_transpose_and_missing),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
