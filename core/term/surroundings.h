/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * surroundings.h -- what a plugin shares with the whole process and has to leave alone: how numbers are rounded,
 * the folder, the locale. */
#ifndef TERM_SURROUNDINGS_H
#define TERM_SURROUNDINGS_H

#include <stddef.h>
#include <sys/types.h>

typedef struct surroundings {
    int rounding; /* fegetround() */
    int flushes;  /* 1: numbers below the smallest normal one become zero */
    int folder;   /* a descriptor of the working directory, to go back to; -1: it cannot be had */
    dev_t device;
    ino_t inode;
    char locale[256];
} surroundings;

void surroundings_take(surroundings *s);
/* 1 and what is not as it was, which is put back; else 0. */
int surroundings_changed(const surroundings *s, char *text, size_t n);
void surroundings_release(surroundings *s);

#endif
