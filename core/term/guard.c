/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The zones hold numbers that are none (NaN), so that what is read there shows, too; of each array its own, as what
 * is computed from a NaN has its bits. */
#include "term/guard.h"

#include <stdint.h>
#include <stdio.h>
#include <string.h>

enum { ZONE = 1024 }; /* bytes before, and behind after what aligns */

static const uint64_t marks = 0x7ff8a5c3e1d20f4bULL; /* a NaN; what is added leaves it one */

/* The zone behind begins right after the last byte. */
static unsigned char mark_at(uint64_t mark, const unsigned char *at)
{
    return (unsigned char)(mark >> 8 * ((uintptr_t)at % 8));
}

static void paint(uint64_t mark, unsigned char *from, const unsigned char *to)
{
    for (; from < to; from++)
        *from = mark_at(mark, from);
}

void *guard_new(guard *g, const char *kind, const char *name, size_t count, size_t unit, size_t row, int fixed)
{
    const size_t bytes = count * unit;
    unsigned char *block = g->n < GUARD_MAX ? arena_alloc(g->memory, 2 * ZONE + bytes, 1) : NULL;
    guard_array *a = &g->array[g->n];

    if (!block)
        return NULL;
    *a = (guard_array){kind, name, block + ZONE, NULL, marks + ((uint64_t)g->n << 20), count, unit, row};
    if (fixed && !(a->kept = arena_alloc(g->memory, bytes + 1, 1)))
        return NULL;
    g->n++;
    paint(a->mark, block, a->at);
    paint(a->mark, a->at + bytes, a->at + bytes + ZONE);
    return a->at;
}

void guard_keep(guard *g)
{
    for (int i = 0; i < g->n; i++)
        if (g->array[i].kept)
            memcpy(g->array[i].kept, g->array[i].at, g->array[i].count * g->array[i].unit);
}

/* Bytes of the zone from the array on that were written, counted to the last one; `step` is the direction. */
static size_t reach(uint64_t mark, const unsigned char *from, int step)
{
    size_t far = 0;

    for (size_t i = 0; i < ZONE; i++) {
        const unsigned char *at = step > 0 ? from + i : from - 1 - i;

        if (*at != mark_at(mark, at))
            far = i + 1;
    }
    return far;
}

/* "output \"v\"" */
static const char *title(const guard_array *a, char *text, size_t n)
{
    snprintf(text, n, a->name && *a->name ? "%s \"%s\"" : "%s", a->kind, a->name);
    return text;
}

/* First number of what must not change that did, or -1. */
static long altered(const guard_array *a)
{
    for (size_t i = 0; a->kept && i < a->count; i++)
        if (memcmp(a->at + i * a->unit, a->kept + i * a->unit, a->unit) != 0)
            return (long)i;
    return -1;
}

static int array_broken(const guard_array *a, char *text, size_t n)
{
    const size_t behind = reach(a->mark, a->at + a->count * a->unit, 1), before = reach(a->mark, a->at, -1);
    char name[160];
    long changed;

    title(a, name, sizeof name);
    if (behind || before) {
        const size_t far = behind ? behind : before, numbers = (far + a->unit - 1) / a->unit;

        snprintf(text, n, "writes outside of %s: up to %zu %s%s %s", name, a->row ? numbers : far,
                 a->row ? "lane" : "byte", (a->row ? numbers : far) > 1 ? "s" : "",
                 behind ? "past its end" : "before its start");
        return 1;
    }
    if ((changed = altered(a)) >= 0) {
        if (a->row)
            snprintf(text, n, "changes %s, which is not its to write (component %zu, lane %zu)", name,
                     (size_t)changed / a->row, (size_t)changed % a->row);
        else
            snprintf(text, n, "changes %s, which are not its to write (byte %ld)", name, changed);
        return 1;
    }
    return 0;
}

int guard_broken(guard *g, char *text, size_t n)
{
    int broken = 0;

    for (int i = 0; i < g->n; i++) {
        guard_array *a = &g->array[i];
        char why[300];

        if (!array_broken(a, why, sizeof why))
            continue;
        if (!broken)
            snprintf(text, n, "%s", why);
        broken = 1;
        paint(a->mark, a->at - ZONE, a->at);
        paint(a->mark, a->at + a->count * a->unit, a->at + a->count * a->unit + ZONE);
        if (a->kept)
            memcpy(a->at, a->kept, a->count * a->unit);
    }
    return broken;
}

const char *guard_read(const guard *g, double v, char *text, size_t n)
{
    const uint64_t sign = 1ULL << 63;
    uint64_t bits;

    memcpy(&bits, &v, sizeof bits);
    for (int i = 0; i < g->n; i++)
        if ((bits & ~sign) == g->array[i].mark)
            return title(&g->array[i], text, n);
    return NULL;
}
