/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Whether the keys that a plugin's terms ask for are keys of a case: none that every line has already, and one
 * line, which serves all terms of the plugin, can mean only one thing by a key.  (Optional terms have lines of
 * their own.) */
#include "term/check.h"

#include <string.h>

/* Keys of every line term "..." {}; and of fluid{}, where shared parameters come from. */
static const char *taken_by(const char *key, int shared)
{
    static const char *const general[] = {"name", "inside", "over", "without", "only", "jacobian"};

    for (size_t i = 0; i < sizeof general / sizeof *general; i++)
        if (strcmp(general[i], key) == 0)
            return "every term line";
    return shared && strcmp(key, "region") == 0 ? "fluid{}" : NULL;
}

static int check_general(const pf_term *t, const check_subject *s, error *err)
{
    for (uint32_t i = 0; i < t->n_param; i++) {
        const char *of = taken_by(t->param[i].name, (t->param[i].flags & PF_SHARED) != 0);

        if (of)
            return check_wrong(err, s, "parameter \"%s\" is a key of %s; give it another name", t->param[i].name,
                               of);
    }
    for (uint32_t k = 0; k < t->n_in && !(t->flags & PF_BY_BOUNDARY); k++) {
        const char *of = t->in[k].eval == PF_DATA ? taken_by(t->in[k].name, 0) : NULL;

        if (of)
            return check_wrong(err, s, "PF_DATA slot \"%s\" is a key of %s; give it another name", t->in[k].name,
                               of);
    }
    return 0;
}

const char *term_key_differs(const pf_param *a, const pf_param *b)
{
    if (a->type != b->type)
        return "type";
    if (strcmp(a->unit, b->unit) != 0)
        return "unit";
    return !((a->flags | b->flags) & PF_REQUIRED) && a->dflt != b->dflt ? "default" : NULL;
}

static int check_pair(const pf_term *a, const pf_term *b, const check_subject *s, error *err)
{
    for (uint32_t i = 0; i < a->n_param; i++)
        for (uint32_t k = 0; k < b->n_param; k++) {
            const pf_param *p = &a->param[i], *q = &b->param[k];
            const char *what = strcmp(p->name, q->name) == 0 ? term_key_differs(p, q) : NULL;

            if (what)
                return check_wrong(err, s,
                                   "parameter \"%s\" has another %s than in term %s (%s, default %g; there %s, "
                                   "default %g): one line of a case serves both; call one of them otherwise",
                                   q->name, what, a->name, q->unit, q->dflt, p->unit, p->dflt);
        }
    return 0;
}

int check_keys(const term_plugin *p, const char *path, error *err)
{
    for (uint32_t i = 0; i < p->d.n_term; i++) {
        const check_subject s = {path, p->term[i].name};

        TRY(check_general(&p->term[i], &s, err));
        for (uint32_t k = 0; k < i; k++)
            if (!((p->term[k].flags | p->term[i].flags) & PF_OPTIONAL))
                TRY(check_pair(&p->term[k], &p->term[i], &s, err));
    }
    return 0;
}
