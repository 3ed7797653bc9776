/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Names of boundaries against those that the mesh has, and boundaries without a condition.  Those of a box are
 * known before there is a mesh, so that a wrong one is reported with all other mistakes of the case. */
#include "describe/describe.h"

#include <math.h>
#include <string.h>

/* Position of a name in the list, or -1 with a message. */
static int find_name(const description *d, const case_block *b, const char *key, const char *name,
                     const char *const *list, int n)
{
    text t = {0};

    for (int i = 0; i < n; i++)
        if (strcmp(list[i], name) == 0)
            return i;
    for (int i = 0; i < n; i++)
        text_add(&t, "%s%s", i ? ", " : "", list[i]);
    case_wrong(d->c, b, key, "%s: no boundary is called \"%s\"%s; the mesh has: %s%s",
               !key                    ? "boundary"
               : strcmp(key, "forces") ? "output: integrals"
                                       : "output: forces",
               name, text_hint(text_nearest(name, list, (size_t)n)).s,
               t.s ? t.s : "no named boundary (in Gmsh a physical group names one)",
               key && d->n_body && strcmp(key, "forces") == 0
                   ? " (forces on bodies are in particles.csv without being asked for)"
                   : "");
    text_free(&t);
    return -1;
}

/* Bits of the boundaries (by position in the list) that a line names. */
static uint64_t bits_of(const description *d, const boundary_line *l, const char *const *list, int n, int report)
{
    const char *const *name = l->periodic[0] ? l->periodic : &l->name;
    uint64_t bits = 0;

    for (int s = 0; s < (l->periodic[0] ? 2 : 1); s++)
        for (int i = 0; name[s] && strcmp(name[s], "*") && i < n; i++)
            bits |= strcmp(list[i], name[s]) == 0 ? (uint64_t)1 << i : 0;
    for (int s = 0; report && s < (l->periodic[0] ? 2 : 1); s++)
        if (name[s] && strcmp(name[s], "*"))
            find_name(d, l->block, NULL, name[s], list, n);
    return bits;
}

static int has_star(const description *d)
{
    for (int i = 0; i < d->n_line; i++)
        if (d->line[i].name && strcmp(d->line[i].name, "*") == 0)
            return 1;
    return 0;
}

static void say_bare(const description *d, int64_t facets, uint64_t names, const char *const *list, int n,
                     const char *where)
{
    text t = {0};

    for (int k = 0; k < n; k++)
        if (names >> k & 1)
            text_add(&t, "%s\"%s\"", t.n ? ", " : "", list[k]);
    case_wrong(d->c, NULL, NULL,
               "%lld boundary facets have no condition: %s%s; give them one, or say boundary \"...\" { natural = "
               "true } if "
               "nothing is prescribed there; boundary \"*\" {} means all others",
               (long long)facets, t.s ? t.s : "without a name", where);
    text_free(&t);
}

/* A boundary of a periodic pair stands in another line, too. */
static void say_periodic(const description *d, const boundary_line *pair, const boundary_line *other,
                         uint64_t common, const char *const *list, int n)
{
    int first = 0;

    while (first < n - 1 && !(common >> first & 1))
        first++;
    case_wrong(
        d->c, other->block, NULL,
        "boundary: \"%s\" is periodic by line %d, so nothing is prescribed there; leave one of the two lines out",
        list[first], pair->block->line);
}

/* All that hangs on names alone. */
static void check_names(const description *d, const char *const *list, int n)
{
    uint64_t bit[DESCRIBE_MAX_LINES];

    for (int i = 0; i < d->n_line; i++) {
        const boundary_line *l = &d->line[i];

        bit[i] = bits_of(d, l, list, n, 1);
        if (l->periodic[0] && l->periodic[1] && strcmp(l->periodic[0], l->periodic[1]) == 0)
            case_wrong(d->c, l->block, "periodic", "boundary: \"%s\" cannot be periodic with itself",
                       l->periodic[0]);
    }
    for (int i = 0; i < d->n_line; i++)
        for (int k = 0; k < d->n_line; k++)
            if (i != k && d->line[i].periodic[0] && (bit[i] & bit[k]) && (!d->line[k].periodic[0] || k > i))
                say_periodic(d, &d->line[i], &d->line[k], bit[i] & bit[k], list, n);
    for (int i = 0; i < d->output.n_integral; i++)
        find_name(d, d->output.block, "integrals", d->output.integral[i], list, n);
    for (int f = 0; f < d->output.n_force; f++) {
        int b = find_name(d, d->output.block, "forces", d->output.force[f], list, n);

        for (int i = 0; b >= 0 && i < d->n_line; i++)
            if (d->line[i].periodic[0] && (bit[i] >> b & 1))
                case_wrong(d->c, d->output.block, "forces",
                           "output: forces: \"%s\" is periodic; no force acts on it", d->output.force[f]);
    }
}

/* Facets of the sides of the box that are not named. */
static int64_t bare_of_box(const description *d, uint64_t named)
{
    const mesh_box *box = &d->mesh.box;
    int64_t n = 0;

    for (int side = 0; side < 2 * d->dim; side++) {
        int64_t facets = box->simplex && d->dim == 3 ? 2 : 1;

        for (int k = 0; k < d->dim; k++)
            facets *= k == side / 2 ? 1 : box->n[k];
        n += named >> side & 1 ? 0 : facets;
    }
    return n;
}

/* side[k] = -1 or 1 if x lies below low or above high in direction k, else 0; 1 if it does in any. */
static int beyond(const description *d, const double *x, const double *low, const double *high, int *side)
{
    int any = 0;

    for (int k = 0; k < d->dim; k++) {
        double slack = 1e-8 * (high[k] - low[k]);

        side[k] = x[k] < low[k] - slack ? -1 : x[k] > high[k] + slack;
        any |= side[k];
    }
    return any != 0;
}

/* Probes and lines that lie wholly outside of the mesh, which reaches from low to high. */
static void check_points(const description *d, const double *low, const double *high)
{
    const output_spec *o = &d->output;
    int outside[3];

    for (int i = 0; i < o->n_probe; i++)
        if (beyond(d, o->probe[i].x, low, high, outside))
            case_wrong(d->c, o->block, o->probe[i].name,
                       "output: probe \"%s\" at %s lies outside the mesh, which reaches from %s to %s",
                       o->probe[i].name, text_point(o->probe[i].x, d->dim).s, text_point(low, d->dim).s,
                       text_point(high, d->dim).s);
    for (int i = 0; i < o->n_line; i++) {
        int other[3], all = 0;

        beyond(d, o->line[i].from, low, high, outside);
        beyond(d, o->line[i].to, low, high, other);
        for (int k = 0; k < d->dim; k++)
            all |= outside[k] && outside[k] == other[k];
        if (all)
            case_wrong(d->c, o->block, o->line[i].name,
                       "output: line \"%s\" from %s to %s lies outside the mesh, which reaches from %s to %s",
                       o->line[i].name, text_point(o->line[i].from, d->dim).s, text_point(o->line[i].to, d->dim).s,
                       text_point(low, d->dim).s, text_point(high, d->dim).s);
    }
}

void describe_check_box(const description *d)
{
    const char *list[6];
    uint64_t named = 0;

    if (d->mesh.path || !d->mesh.box.dim)
        return;
    if (describe_is_box(d))
        check_points(d, d->mesh.box.low, d->mesh.box.high);
    for (int i = 0; i < 2 * d->dim; i++)
        list[i] = mesh_box_side(i);
    check_names(d, list, 2 * d->dim);
    for (int i = 0; i < d->n_line; i++)
        named |= bits_of(d, &d->line[i], list, 2 * d->dim, 0);
    if (!has_star(d) && !d->incomplete && !d->boundary_unread && named != ((uint64_t)1 << 2 * d->dim) - 1)
        say_bare(d, bare_of_box(d, named), ~named, list, 2 * d->dim, "");
}

void describe_bounds(const mesh *m, double *low, double *high)
{
    for (int k = 0; k < 3; k++) {
        low[k] = k < m->dim ? INFINITY : 0;
        high[k] = k < m->dim ? -INFINITY : 0;
    }
    for (int64_t i = 0; i < m->n_node; i++)
        for (int k = 0; k < m->dim; k++) {
            low[k] = fmin(low[k], m->x[i * m->dim + k]);
            high[k] = fmax(high[k], m->x[i * m->dim + k]);
        }
}

int describe_check(description *d, const mesh *m, error *err)
{
    const char *const *list = (const char *const *)m->name;
    uint64_t named = 0, bare = 0;
    double low[3], high[3];
    int64_t first = -1, n_bare = 0;

    if (d->mesh.path)
        check_names(d, list, m->n_name);
    describe_bounds(m, low, high);
    if (!describe_is_box(d))
        check_points(d, low, high);
    for (int i = 0; i < d->n_line; i++)
        named |= bits_of(d, &d->line[i], list, m->n_name, 0);
    for (int64_t f = 0; f < m->n_facet && !has_star(d); f++)
        if (!(m->facet[f].names & named)) {
            bare |= m->facet[f].names;
            first = n_bare++ ? first : f;
        }
    if (first >= 0) {
        const int32_t *node = m->cell + (int64_t)m->facet[first].cell * m->type->n_node;
        const double *x = m->x + (int64_t)node[m->type->facet[m->facet[first].local][0]] * m->dim;
        text t = {0};

        text_add(&t, " (the first at %s)", text_point(x, m->dim).s);
        say_bare(d, n_bare, bare, list, m->n_name, t.s ? t.s : "");
        text_free(&t);
    }
    TRY(case_finish(d->c, err));
    return describe_start(d, err);
}

void describe_facets(const description *d, const mesh *m, int line, uint8_t *facet)
{
    const char *const *list = (const char *const *)m->name;
    const boundary_line *l = &d->line[line];
    uint64_t named = 0, mine = bits_of(d, l, list, m->n_name, 0);
    int star = l->name && strcmp(l->name, "*") == 0;

    for (int i = 0; i < d->n_line; i++)
        named |= bits_of(d, &d->line[i], list, m->n_name, 0);
    for (int64_t f = 0; f < m->n_facet; f++)
        facet[f] = star ? !(m->facet[f].names & named) : (m->facet[f].names & mine) != 0;
}
