/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "support/bad_case.h"

#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_LINES = 20, LINE_BYTES = 400 };

static const char *const plain[] = {
    "case \"Bad\"",
    "mesh { box = {{0,0},{2,1}}, cells = {16,8} }",
    "fluid { density = 1, viscosity = 0.1 }",
    "term \"continuity\" {}",
    "term \"momentum\" {}",
    "boundary \"*\" { u = {0,0} }",
    "boundary \"left\" { u = function(x,y) return 4*y*(1-y), 0 end }",
    "boundary \"right\" { natural = true }",
};

static void write_case(const char *edits, char *text, size_t size)
{
    char line[MOST_LINES][LINE_BYTES] = {{0}};
    size_t n = 0;

    for (size_t i = 0; i < sizeof plain / sizeof *plain; i++)
        snprintf(line[i], sizeof line[i], "%s", plain[i]);
    while (*edits) {
        char *rest;
        long k = strtol(edits, &rest, 10);
        size_t length = strcspn(rest, "\n");

        assert_in_range(k, 1, MOST_LINES);
        assert_true(length > 0 && length < LINE_BYTES);
        snprintf(line[k - 1], sizeof line[k - 1], "%.*s", (int)length - 1, rest + 1);
        edits = rest + length + (rest[length] == '\n');
    }
    for (int i = 0; i < MOST_LINES; i++)
        n += (size_t)snprintf(text + n, size - n, "%s\n", line[i]);
}

void check_bad_cases(const bad_case *list, size_t n, const char *file, int line)
{
    int failed = 0;

    for (size_t i = 0; i < n; i++) {
        const bad_case *b = &list[i];
        char text[MOST_LINES * LINE_BYTES];
        int ok;
        ran r;

        write_case(b->edits, text, sizeof text);
        r = plugflow("check %s", put_file("bad.lua", text));
        ok = r.code == b->code;
        for (int k = 0; k < 6 && b->says[k]; k++) {
            int unwanted = b->says[k][0] == '!';
            const char *what = b->says[k] + unwanted;

            if ((strstr(r.err, what) || strstr(r.out, what)) == unwanted) {
                print_error("%s:%d: %s: \"%s\"\n", file, line, unwanted ? "printed" : "not printed", what);
                ok = 0;
            }
        }
        if (!ok)
            print_error("%s:%d: case %zu: exit code %d, expected %d\n%s\n--- stdout\n%s\n--- stderr\n%s\n", file,
                        line, i, r.code, b->code, b->edits, r.out, r.err);
        failed |= !ok;
    }
    if (failed)
        fail();
}
