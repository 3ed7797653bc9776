/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The files of fields and of bodies, written and read back. */
#include "io/file.h"
#include "io/vtp.h"
#include "io/vtu_read.h"
#include "support/made.h"
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void the_file_of_fields_has_the_bodies_and_nothing_where_a_field_is_empty(void **state)
{
    (void)state;
    for (int dim = 2; dim <= 3; dim++) {
        error err;
        made k;
        vtu_file v;
        int inside = 0;

        made_create(&k, dim, 0, 5);
        made_add(&k, SHAPE_ELLIPSOID, 0.3, 0.3, 0.3, (const double[]){0.5, 0.5, 0.5}, 1);
        made_fill(&k, 7, 0);
        assert_int_equal(vtu_open(&v, made_write(&k, scratch(), 1), &err), 0);
        assert_int_equal(v.n_field, 2);
        assert_int_equal(v.n_point, k.m.n_node);
        for (size_t i = 0; i < v.n_point; i++) {
            double p = vtu_number(&v.field[1], i), u = vtu_number(&v.field[0], 3 * i);

            assert_int_equal(vtu_integer(&v.body, i), k.body[i]);
            assert_int_equal(isnan(p), k.body[i] >= 0);
            assert_true(u == k.x[k.s.first[0][i]]);
            inside += k.body[i] >= 0;
        }
        assert_true(inside > 5);
        vtu_close(&v);
        made_destroy(&k);
    }
}

/* Wherever the file ends, also where its last line was kept. */
static void a_truncated_file_of_bodies_is_an_error(void **state)
{
    static const char last[] = "</VTKFile>\n";
    unsigned char *bytes, *part;
    char path[500];
    arena a = {0};
    vtp_file v;
    error err;
    size_t n;
    made k;

    (void)state;
    made_create(&k, 2, 0, 2);
    made_add(&k, SHAPE_ELLIPSOID, 0.2, 0.2, 0, (const double[]){0.25, 0.25}, 1);
    made_fill(&k, 0, 0);
    made_write(&k, scratch(), 1);
    snprintf(path, sizeof path, "%s/particles_00000.vtp", scratch());
    assert_int_equal(file_read(path, &a, &bytes, &n, &err), 0);
    assert_int_equal(vtp_read(path, &v, &a, &err), 0);
    assert_int_equal(v.n_cell, 1);
    part = malloc(n + sizeof last);
    assert_non_null(part);
    for (size_t cut = 0; cut + 2 < n; cut += 7) {
        const char *data = strstr((const char *)bytes, "<CellData>");

        memcpy(part, bytes, cut);
        memcpy(part + cut, last, sizeof last - 1);
        assert_int_equal(file_write(path, part, cut, &err), 0);
        assert_int_equal(vtp_read(path, &v, &a, &err), ERR_IO);
        assert_int_equal(file_write(path, part, cut + sizeof last - 1, &err), 0);
        if ((const char *)bytes + cut < data)
            assert_int_equal(vtp_read(path, &v, &a, &err), ERR_IO);
    }
    free(part);
    arena_free(&a);
    made_destroy(&k);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_file_of_fields_has_the_bodies_and_nothing_where_a_field_is_empty),
        cmocka_unit_test(a_truncated_file_of_bodies_is_an_error),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
