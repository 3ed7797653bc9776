/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A disk that is full, a folder that cannot be written, memory that ends. */
#include "support/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdlib.h>

/* Files may grow to 8 KiB only: what the kernel of the system does when the disk is full. */
static void a_full_disk_is_code_7_and_leaves_no_half_file(void **state)
{
    (void)state;
    assert_ran(shell("ulimit -f 8; %s run cases/cavity2d.lua --set n=16 --out %s/full", getenv("PLUGFLOW_PROGRAM"),
                     scratch()),
               7, "cannot write", "fields_00000.vtu");
    assert_true(shell("ls %s/full/fields_00000.vtu %s/full/*.tmp", scratch(), scratch()).code != 0);
    assert_ran(shell("cat %s/full/summary.json", scratch()), 0, "\"status\": \"input/output error\"");
}

static void a_table_on_a_full_disk_holds_whole_lines(void **state)
{
    (void)state;
    assert_ran(shell("ulimit -f 30; %s run %s --quiet --out %s/lines", getenv("PLUGFLOW_PROGRAM"),
                     put_file("t.lua",
                              "mesh { box = {{0,0},{1,1}}, cells = {3,3} }\nfluid { density = 1, viscosity = 1 }\n"
                              "term \"continuity\" {}\nterm \"momentum\" {}\nboundary \"*\" { u = {0,0} }\n"
                              "boundary \"top\" { u = function(x, y, t) return math.sin(t), 0 end }\n"
                              "time { step = 0.01, stop = 20 }\n"
                              "output { every = 100, forces = {\"top\"} }\n"),
                     scratch()),
               7, "cannot write");
    /* every line has the same number of commas */
    assert_ran(shell("awk -F, 'NR == 1 { n = NF } NF != n { exit 1 } END { exit NR < 10 }' %s/lines/forces.csv && "
                     "tail -c 1 %s/lines/forces.csv | od -An -c",
                     scratch(), scratch()),
               0, "\\n");
}

static void a_folder_that_cannot_be_written_is_code_7(void **state)
{
    (void)state;
    put_file("file", "not a folder");
    assert_ran(plugflow("run cases/cavity2d.lua --set n=4 --out %s/file", scratch()), 7, "is no folder", "--out");
    assert_ran(plugflow("run cases/cavity2d.lua --set n=4 --out %s/file/below", scratch()), 7, "file/below");
    assert_ran(plugflow("run cases/cavity2d.lua --set n=4 --out /proc/plugflow"), 7, "/proc/plugflow");
}

static void memory_that_ends_is_code_8(void **state)
{
    (void)state;
#ifdef __SANITIZE_ADDRESS__
    return; /* the sanitizer's own address space is larger than any limit */
#endif
    assert_ran(shell("ulimit -v 400000; %s run cases/cavity2d.lua --threads 1 --set n=200 --out %s/mem",
                     getenv("PLUGFLOW_PROGRAM"), scratch()),
               8, "memory");
}

static void a_truncated_result_is_no_crash_of_the_picture(void **state)
{
    (void)state;
    assert_ran(plugflow("run cases/cavity2d.lua --quiet --set n=4 --out %s/o", scratch()), 0, NULL);
    for (int bytes = 100; bytes < 5500; bytes += 900)
        assert_ran(shell("head -c %d %s/o/fields_00000.vtu >%s/cut.vtu; %s picture %s/cut.vtu --out %s/cut.png",
                         bytes, scratch(), scratch(), getenv("PLUGFLOW_PROGRAM"), scratch(), scratch()),
                   7, "cut.vtu");
    assert_true(shell("ls %s/cut.png", scratch()).code != 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_full_disk_is_code_7_and_leaves_no_half_file),
        cmocka_unit_test(a_table_on_a_full_disk_holds_whole_lines),
        cmocka_unit_test(a_folder_that_cannot_be_written_is_code_7),
        cmocka_unit_test(memory_that_ends_is_code_8),
        cmocka_unit_test(a_truncated_result_is_no_crash_of_the_picture),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
