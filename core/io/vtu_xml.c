/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * As much of XML as a .vtu header has: tags with quoted attributes, the five entities,
 * comments.  Nothing here reads at or behind end. */
#include "io/vtu_xml.h"

#include <string.h>

static int is_space(char c)
{
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/* The '>' that ends a tag: one outside of quotes; NULL if the text ends before. */
static const char *tag_end(const char *p, const char *end)
{
    char quote = 0;

    for (; p < end; p++) {
        if (quote)
            quote = *p == quote ? 0 : quote;
        else if (*p == '"' || *p == '\'')
            quote = *p;
        else if (*p == '>')
            return p;
    }
    return NULL;
}

static const char *comment_end(const char *p, const char *end)
{
    for (; end - p >= 3; p++)
        if (!memcmp(p, "-->", 3))
            return p + 2;
    return NULL;
}

int vtu_tag_next(const char *at, const char *end, vtu_tag *t)
{
    for (;;) {
        const char *p = memchr(at, '<', (size_t)(end - at)), *close;
        int comment;

        if (!p)
            return 0;
        p++;
        comment = end - p >= 3 && !memcmp(p, "!--", 3);
        close = comment ? comment_end(p + 3, end) : tag_end(p, end);
        if (!close)
            return 0;
        at = close + 1;
        if (*p == '!' || *p == '?')
            continue;
        t->closes = *p == '/';
        t->name = p + t->closes;
        for (p = t->name; p < close && !is_space(*p) && *p != '/';)
            p++;
        t->n_name = (size_t)(p - t->name);
        t->attributes = p;
        t->attributes_end = close;
        t->after = at;
        return 1;
    }
}

int vtu_tag_is(const vtu_tag *t, const char *name)
{
    return t->n_name == strlen(name) && !memcmp(t->name, name, t->n_name);
}

/* The value of the attribute between its quotes. */
static const char *attribute_find(const vtu_tag *t, const char *attribute, const char **value_end)
{
    const char *p = t->attributes, *end = t->attributes_end;
    size_t n = strlen(attribute);

    while (p < end) {
        const char *name, *name_end, *value;

        while (p < end && (is_space(*p) || *p == '/'))
            p++;
        for (name = p; p < end && *p != '=' && !is_space(*p);)
            p++;
        name_end = p;
        while (p < end && is_space(*p))
            p++;
        if (p == end || *p++ != '=')
            return NULL;
        while (p < end && is_space(*p))
            p++;
        if (p == end || (*p != '"' && *p != '\''))
            return NULL;
        value = p + 1;
        p = memchr(value, *p, (size_t)(end - value));
        if (!p)
            return NULL;
        *value_end = p++;
        if ((size_t)(name_end - name) == n && !memcmp(name, attribute, n))
            return value;
    }
    return NULL;
}

/* One character, an entity being one; the length it takes in the text. */
static size_t character(const char *p, const char *end, char *c)
{
    static const struct {
        const char *text;
        char c;
    } entity[] = {{"&lt;", '<'}, {"&gt;", '>'}, {"&amp;", '&'}, {"&quot;", '"'}, {"&apos;", '\''}};

    for (size_t i = 0; *p == '&' && i < sizeof entity / sizeof entity[0]; i++) {
        size_t n = strlen(entity[i].text);

        if ((size_t)(end - p) >= n && !memcmp(p, entity[i].text, n)) {
            *c = entity[i].c;
            return n;
        }
    }
    *c = *p;
    return 1;
}

int vtu_tag_text(const vtu_tag *t, const char *attribute, char *value, size_t size)
{
    const char *end = NULL, *p = attribute_find(t, attribute, &end);
    size_t n = 0;

    value[0] = 0;
    if (!p)
        return 0;
    while (p < end && n + 1 < size)
        p += character(p, end, &value[n++]);
    value[p == end ? n : 0] = 0;
    return p == end;
}

int vtu_tag_count(const vtu_tag *t, const char *attribute, uint64_t *value)
{
    char s[32];
    uint64_t v = 0;

    if (!vtu_tag_text(t, attribute, s, sizeof s) || !s[0])
        return 0;
    for (const char *p = s; *p; p++)
        if (*p < '0' || *p > '9' || __builtin_mul_overflow(v, 10u, &v) ||
            __builtin_add_overflow(v, (uint64_t)(*p - '0'), &v))
            return 0;
    *value = v;
    return 1;
}
