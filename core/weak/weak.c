/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A form from end to end: read, translated, and what a case has to say for it. */
#include "weak/form.h"

#include <stdio.h>
#include <string.h>

static void find_used(const form *f, weak_result *out)
{
    for (int i = 0; i < f->n_field; i++) {
        struct weak_used *u = &out->used[out->n_used];
        int used = 0;

        *u = (struct weak_used){.rank = f->field[i].rank};
        snprintf(u->name, sizeof u->name, "%s", f->field[i].name);
        for (int k = 0; k < f->n_symbol; k++)
            if (f->symbol[k]->field == &f->field[i]) {
                used = 1;
                u->has_test |= f->symbol[k]->kind == SYM_TEST;
            }
        out->n_used += used;
    }
}

static int begins(const char *s, const char *with)
{
    return strncmp(s, with, strlen(with)) == 0;
}

/* Which key of the case gives it: of the term's own line, of fluid{}, or none. */
static text *keys_of(const symbol *s, weak_result *out)
{
    if (s->field || s->is_property || !s->entry ||
        (s->kind != SYM_REAL && s->kind != SYM_VECTOR && s->kind != SYM_SLOT))
        return NULL;
    return s->kind == SYM_SLOT || begins(s->entry, "REAL(") || begins(s->entry, "VECTOR(") ? &out->keys
                                                                                           : &out->fluid;
}

static void find_keys(const form *f, weak_result *out)
{
    for (int i = 0; i < f->n_symbol; i++) {
        const symbol *s = f->symbol[i];
        text *keys = keys_of(s, out);

        out->unsteady |= s->kind == SYM_SLOT && s->is_rate;
        if (keys)
            text_add(keys, "%s%s = %s", keys->n ? ", " : "", s->name,
                     s->rank == 0 ? "1"
                     : f->only_3d ? "{1, 0, 0}"
                                  : "{1, 0}");
    }
    out->only_3d = f->only_3d;
}

int weak_source(const weak_request *r, weak_result *out, error *err)
{
    form f = {.request = r, .err = err};
    volatile int status = 0;

    memset(out, 0, sizeof *out);
    if (setjmp(f.failed) == 0) {
        form_fields(&f);
        emit_source(&f, parse_form(&f), &out->source);
        find_used(&f, out);
        find_keys(&f, out);
        if (out->source.failed || out->keys.failed)
            status = error_memory(err, "the source", (double)out->source.n);
    } else {
        status = err->code;
    }
    arena_free(&f.memory);
    return status;
}

void weak_free(weak_result *out)
{
    text_free(&out->source);
    text_free(&out->keys);
    text_free(&out->fluid);
}

int weak_last_field(const char *fields, char name[40], int *rank, char test[48], error *err)
{
    const weak_request r = {.new_fields = fields, .form = ""};
    const char *last = strrchr(fields, ',') ? strrchr(fields, ',') + 1 : fields;
    form f = {.request = &r, .err = err};
    volatile int status = 0;

    snprintf(name, 40, "%.*s", (int)strcspn(last, ":"), last);
    if (setjmp(f.failed) == 0) {
        const weak_field *found;

        form_fields(&f);
        found = form_field(&f, name);
        if (!found)
            form_fail(&f, -1, "--fields \"%s\" ends without a field", fields);
        *rank = found->rank;
        snprintf(test, 48, "%s", found->test);
    } else {
        status = err->code;
    }
    arena_free(&f.memory);
    return status;
}
