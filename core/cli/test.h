/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * test.h -- what the files of plugflow test share. */
#ifndef CLI_TEST_H
#define CLI_TEST_H

#include "cli/cli.h"
#include "term/selftest.h"

/* Tests the terms of the case o->case_path, or those that the operand names. */
int cli_test_case(const cli *o, selftest *s, error *err);

#endif
