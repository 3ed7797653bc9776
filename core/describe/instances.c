/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Terms beside each other: one that takes the place of another, one that is there twice in different parts of the
 * domain; and what they do before a run and after it. */
#include "describe/describe.h"

#include <stdio.h>
#include <string.h>

/* --- a term on several lines --- */

/* A line that has the term on, too, other than the one of u; NULL: there is none.  *parted: both act in a part of
 * the domain of their own. */
static const case_block *other_line(const description *d, const term_use *u, const case_block *line, int *parted)
{
    for (int k = 0; k < 3; k++) {
        const term_list *l = k == 1 ? &d->law : &d->shown;
        const term_use *use = k ? l->use : d->use;
        const case_block *const *block = k ? l->block : d->use_block;

        for (int i = 0; i < (k ? l->n : d->n_use); i++)
            if (use[i].term == u->term && block[i] != line) {
                *parted = use[i].inside && u->inside;
                if (!*parted)
                    return block[i];
            }
    }
    return NULL;
}

int describe_check_twice(description *d, const reader *own, const term_use *u)
{
    int parted = 0;
    const case_block *other = other_line(d, u, own->b, &parted);

    if (!other)
        return 1;
    case_wrong(
        d->c, own->b, NULL,
        "%s: %s.%s is on already, by line %d; two lines of one term need a part of the domain each: inside = "
        "function(x, y%s) ... end",
        own->what, u->plugin->d.name, u->term->name, other->line, d->dim == 3 ? ", z" : "");
    return 0;
}

enum { LABEL_MOST = 24 };

static int is_label(const char *s)
{
    size_t n = strspn(s, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_");

    return n > 0 && n <= LABEL_MOST && !s[n];
}

int describe_instance(description *d, reader *own, const value **inside, const char **label, error *err)
{
    value *v;

    ARENA_NEW(&d->memory, v, 1, err);
    if (reader_string(own, "name", "of the line, for reports: where a term stands on several lines", label) > 0 &&
        !is_label(*label))
        case_wrong(d->c, own->b, "name",
                   "%s: \"name\" is a part of names of columns: expected at most %d letters, "
                   "digits and _",
                   own->what, LABEL_MOST);
    if (reader_condition(own, "inside", "where the term acts: true, or a number above 0, there", d->dim, v) > 0)
        *inside = v;
    return 0;
}

/* --- a term in the place of another --- */

static int is_called(const term_use *u, const char *name, size_t n)
{
    const size_t plugin = strlen(u->plugin->d.name), term = strlen(u->term->name);

    return plugin + term + 1 == n && strncmp(name, u->plugin->d.name, plugin) == 0 && name[plugin] == '.' &&
           strncmp(name + plugin + 1, u->term->name, term) == 0;
}

/* A name in `replaces` must be that of a term, if its plugin is there. */
static int check_replaced(description *d, registry *r, const term_use *u, const case_block *line, const char *name,
                          size_t n)
{
    const char *dot = memchr(name, '.', n), *near;
    char plugin[128];
    const term_plugin *p;
    error ignored;

    snprintf(plugin, sizeof plugin, "%.*s", (int)(dot ? dot - name : (long)n), name);
    if (dot && !registry_knows(r, plugin, &near)) {
        if (near)
            describe_warn(d, line, NULL, "%s.%s says that it replaces \"%.*s\", and there is no plugin \"%s\"%s",
                          u->plugin->d.name, u->term->name, (int)n, name, plugin, text_hint(near).s);
        return 1;
    }
    if (dot && registry_equation(r, plugin, &p, &ignored))
        return 1;
    for (uint32_t i = 0; dot && i < p->d.n_term; i++)
        if (strlen(p->term[i].name) == (size_t)(name + n - dot - 1) &&
            strncmp(p->term[i].name, dot + 1, (size_t)(name + n - dot - 1)) == 0)
            return 1;
    case_wrong(d->c, line, NULL, "term \"%s\": %s.%s says that it replaces \"%.*s\", %s", line->name,
               u->plugin->d.name, u->term->name, (int)n, name,
               dot ? "a term that its plugin does not have: the two plugins are of different versions"
                   : "which is no name of a term: \"plugin.term\"");
    return 0;
}

/* Who has replaced the term so far, or NULL. */
static const replacement *replacement_of(const description *d, const pf_term *t)
{
    for (int i = 0; i < d->n_replaced; i++)
        if (d->replaced[i].term == t)
            return &d->replaced[i];
    return NULL;
}

/* u, of a line, replaces the terms of this name that are on. */
static void replace(description *d, const term_use *u, const case_block *line, const char *name, size_t n)
{
    const case_block *ignored;
    term_use *v;

    for (int i = 0; (v = describe_use(d, i, &ignored)); i++) {
        const replacement *before = replacement_of(d, v->term);

        if (!is_called(v, name, n) || v->term == u->term)
            continue;
        v->replaced = 1;
        if (u->inside)
            case_wrong(d->c, line, "inside",
                       "term \"%s\": %s.%s replaces %.*s, which would be missing outside of \"inside\"; leave the "
                       "key out",
                       line->name, u->plugin->d.name, u->term->name, (int)n, name);
        else if (before && before->by != u->term)
            case_wrong(d->c, line, NULL,
                       "term \"%s\": %s.%s replaces %.*s, which %s.%s, by line %d, replaces, too: leave one of the "
                       "two out",
                       line->name, u->plugin->d.name, u->term->name, (int)n, name, before->by_plugin->d.name,
                       before->by->name, before->line);
        else if (!before && d->n_replaced < DESCRIBE_MAX_TERMS)
            d->replaced[d->n_replaced++] = (replacement){v->plugin, u->plugin, v->term, u->term, line->line};
    }
}

void describe_replace(description *d, registry *r)
{
    const case_block *line;
    term_use *u;

    for (int i = 0; (u = describe_use(d, i, &line)); i++)
        for (const char *at = u->term->replaces ? u->term->replaces : ""; *at;) {
            size_t n = strcspn(at, " ");

            if (n && check_replaced(d, r, u, line, at, n))
                replace(d, u, line, at, n);
            at += n + strspn(at + n, " ");
        }
}

static int without_replaced(term_use *use, const case_block **block, int n)
{
    int kept = 0;

    for (int i = 0; i < n; i++)
        if (!use[i].replaced) {
            use[kept] = use[i];
            block[kept++] = block[i];
        }
    return kept;
}

void describe_leave_out(description *d)
{
    d->n_use = without_replaced(d->use, d->use_block, d->n_use);
    d->law.n = without_replaced(d->law.use, d->law.block, d->law.n);
    d->shown.n = without_replaced(d->shown.use, d->shown.block, d->shown.n);
}

void describe_tell_replaced(const description *d, int i, char *to, size_t n)
{
    const replacement *p = &d->replaced[i];

    snprintf(to, n, "%s.%s is left out: %s.%s (line %d) replaces it", p->plugin->d.name, p->term->name,
             p->by_plugin->d.name, p->by->name, p->line);
}

/* --- before a run and after it --- */

int describe_start(description *d, error *err)
{
    const case_block *line;
    term_use *u;

    for (int i = 0; (u = describe_use(d, i, &line)); i++) {
        char why[400] = "";

        if (term_start(u->plugin, u->term, u->params, d->dim, d->n_body, d->time.unsteady, why, sizeof why))
            return error_set(err, ERR_CASE, "%s:%d: term \"%s\": %s.%s cannot start: %s", line->file, line->line,
                             line->name, u->plugin->d.name, u->term->name, *why ? why : "it does not say why");
        d->n_started = i + 1;
    }
    return 0;
}

void describe_end(description *d)
{
    const case_block *line;
    term_use *u;

    for (; d->n_started > 0; d->n_started--) {
        u = describe_use(d, d->n_started - 1, &line);
        term_end(u->plugin, u->term, u->params);
    }
}
