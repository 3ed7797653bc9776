/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * build.h -- what the files of plugflow build share. */
#ifndef CLI_BUILD_H
#define CLI_BUILD_H

/* Prints what is meant by messages of the compiler that are known; 1: what it made is of no use. */
int build_hints(const char *said);

#endif
