/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * vtu_xml.h -- the tags of the XML part of a .vtu file, one after another. */
#ifndef IO_VTU_XML_H
#define IO_VTU_XML_H

#include <stddef.h>
#include <stdint.h>

/* A tag <name attributes> of the text [at, end): the strings are not terminated. */
typedef struct vtu_tag {
    const char *name;
    size_t n_name;
    const char *attributes, *attributes_end;
    const char *after; /* first byte behind '>'                                  */
    int closes;        /* </name>                                                */
} vtu_tag;

/* The next tag at or behind at, comments and <?...?> passed over; 0 if there is none. */
int vtu_tag_next(const char *at, const char *end, vtu_tag *t);
int vtu_tag_is(const vtu_tag *t, const char *name);

/* Copies the attribute's value, entities resolved, into value[size].  0: there is no such
 * attribute (value is then empty) or it does not fit. */
int vtu_tag_text(const vtu_tag *t, const char *attribute, char *value, size_t size);
/* The attribute as a number without sign; 0: it is none. */
int vtu_tag_count(const vtu_tag *t, const char *attribute, uint64_t *value);

#endif
