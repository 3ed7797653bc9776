/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The texts of plugflow new: a case, a README, terms on bodies. */
#include "cli/new.h"

#include <string.h>

static int uses(const new_plugin *n, const char *field)
{
    for (int i = 0; i < n->weak.n_used; i++)
        if (strcmp(n->weak.used[i].name, field) == 0)
            return 1;
    return 0;
}

static int is_of_flow(const char *field)
{
    return strcmp(field, "u") == 0 || strcmp(field, "p") == 0 || strcmp(field, "U") == 0;
}

/* A line of boundary{}: the velocity, if there is a flow, and `value` of the other fields on the mesh. */
static void boundary(const new_plugin *n, const char *name, const char *velocity, const char *value, text *t)
{
    const int in_3d = n->weak.only_3d;
    const char *between = "";

    text_add(t, "boundary \"%s\" { ", name);
    if (velocity) {
        text_add(t, "u = {%s%s}", velocity, in_3d ? ", 0" : "");
        between = ", ";
    }
    for (int i = 0; i < n->weak.n_used && value; i++) {
        const struct weak_used *u = &n->weak.used[i];

        if (is_of_flow(u->name) || (!u->has_test && strcmp(u->name, "T") != 0))
            continue;
        text_add(t, u->rank ? "%s%s = {%s, 0%s}" : "%s%s = %s", between, u->name, value, in_3d ? ", 0" : "");
        between = ", ";
    }
    text_add(t, " }\n");
}

static void boundaries(const new_plugin *n, int flow, text *t)
{
    const int open = strcmp(n->where, "PF_FACET") == 0;
    int other = 0;

    for (int i = 0; i < n->weak.n_used; i++)
        other |= !is_of_flow(n->weak.used[i].name);
    if (other) {
        boundary(n, "left", flow ? (open ? "1, 0" : "0, 0") : NULL, "0", t);
        boundary(n, "right", flow && !open ? "0, 0" : NULL, "1", t);
    } else if (open) {
        boundary(n, "left", "1, 0", NULL, t);
        text_add(t, "boundary \"right\" { natural = true } -- the fluid goes out\n");
    }
    if (flow && !open && !n->bodies)
        boundary(n, "top", "1, 0", NULL, t);
    if (flow && open) {
        boundary(n, "bottom", "0, 0", NULL, t);
        boundary(n, "top", "0, 0", NULL, t);
        if (n->weak.only_3d) {
            boundary(n, "front", "0, 0", NULL, t);
            boundary(n, "back", "0, 0", NULL, t);
        }
    } else if (flow) {
        boundary(n, "*", "0, 0", NULL, t);
    } else {
        text_add(t, "boundary \"*\" { natural = true } -- nothing passes\n");
    }
}

/* The field has its equation elsewhere: the term only reads it, or acts on it on a boundary. */
static int needs_equation(const new_plugin *n, const struct weak_used *u)
{
    const int on_boundary = strcmp(n->where, "PF_FACET") == 0 || strcmp(n->where, "PF_SURFACE") == 0;

    return !is_of_flow(u->name) && (on_boundary || !u->has_test);
}

static int needs_heat(const new_plugin *n)
{
    for (int i = 0; i < n->weak.n_used; i++)
        if (strcmp(n->weak.used[i].name, "T") == 0 && needs_equation(n, &n->weak.used[i]))
            return 1;
    return 0;
}

void new_case(const new_plugin *n, text *t)
{
    const int in_3d = n->weak.only_3d,
              flow = n->bodies || needs_heat(n) || uses(n, "u") || uses(n, "p") || uses(n, "U");
    const char *shape = in_3d ? "sphere" : "disk", *deep = in_3d ? ", 0.5" : "";

    text_add(t, "-- The smallest case in which %s acts.\ncase \"%s\"\n\n", n->name, n->name);
    if (in_3d)
        text_add(t, "mesh  { box = {{0, 0, 0}, {1, 1, 1}}, cells = {4, 4, 4} }\n");
    else
        text_add(t, "mesh  { box = {{0, 0}, {1, 1}}, cells = {%d, %d} }\n", n->bodies ? 20 : 8, n->bodies ? 20 : 8);
    if (flow)
        text_add(t, "fluid { density = 1, viscosity = 1, gravity = {0, %d%s} }\n\n", n->bodies ? -10 : 0,
                 in_3d ? ", 0" : "");
    else
        text_add(t, n->weak.fluid.n ? "fluid { %s }\n\n" : "\n", n->weak.fluid.s);
    if (flow)
        text_add(t, "term \"continuity\" {}\nterm \"momentum\" {}\n");
    if (needs_heat(n))
        text_add(t, "term \"heat\" { conductivity = 1, heat_capacity = 1 }\n");
    for (int i = 0; i < n->weak.n_used; i++)
        if (strcmp(n->weak.used[i].name, "T") != 0 && needs_equation(n, &n->weak.used[i]))
            text_add(t, "-- add the term that is an equation of %s\n", n->weak.used[i].name);
    if (n->bodies)
        text_add(t, "particulate(\"sharp\")\n");
    text_add(t, "term \"%s\" { %s }\n\n", n->name, n->weak.keys.n ? n->weak.keys.s : "");
    boundaries(n, flow, t);
    for (int i = 0; i < n->bodies; i++)
        text_add(t, "%sparticle { shape = %s { radius = 0.12 }, density = 2, at = {0.5, %s%s} }\n", i ? "" : "\n",
                 shape, i ? "0.35" : "0.62", deep);
    if (n->bodies || n->weak.unsteady)
        text_add(t, "\ntime { scheme = \"bdf2\", step = 0.01, stop = 0.05 }\n");
}

void new_readme(const new_plugin *n, text *t)
{
    const char *s = n->name;

    text_add(t, "# %s\n\n", s);
    if (n->form)
        text_add(t, "The term of plugflow that stands for\n\n    %s\n\n", n->form);
    text_add(
        t,
        "    plugflow build %s\n    plugflow test ./%s/%s.so\n    plugflow run %s/%s.lua --plugin ./%s/%s.so\n\n",
        s, s, s, s, s, s, s);
    text_add(
        t,
        "1. `%s.c`: say what each key is and its unit, and where the equation is from (`.cite`).\n"
        "2. Work out one point by hand and add it: `PF_EXAMPLES({\"what\", 2, (double[]){keys}, (double[]){in}, "
        "(double[]){out}, 1e-14})`.\n"
        "3. `%s.lua`: make it a case with a known solution, and say it: `exact { ... }`. Halve the cells and see "
        "the "
        "error fall.\n\n`<plugflow/term.h>` begins with all that a term may say; docs/plugin-guide.md goes through "
        "it.\n",
        s, s);
}

static const char on_pair[] =
    "/* What two near bodies, or a body and a wall, do to each other: a force that grows as they come near. */\n"
    "#include <plugflow/term.h>\n"
    "\n"
    "#define KEYS \\\n"
    "    REAL(force, \"N\", \"force at contact\", .dflt = 1, PF_NOT_NEGATIVE), \\\n"
    "    REAL(range, \"m\", \"gap at which it begins\", .dflt = 0.1, .min = 1e-9, .max = 1e30)\n"
    "\n"
    "/* -F0 (1 - gap/range)^2 n . V,  n from the other body to the first */\n"
    "TERM(@, PF_PAIR, IN(), OUT(SLOT(V, U, DEFECT, VECTOR)),\n"
    "     PARAMS(KEYS),\n"
    "     .flags = PF_LINEAR, .reach = @_reach, .doc = \"-F_0(1-gap/range)^2\\\\,n\\\\cdot V\", .cite = \"say from "
    "where\")\n"
    "{\n"
    "    LANES (i) {\n"
    "        const double s = max(1 - b->gap[i] / range, 0);\n"
    "\n"
    "        EACH (a)\n"
    "            V[a][i] = -force * s * s * AT(b->normal, a);\n"
    "    }\n"
    "}\n"
    "\n"
    "/* The gap beyond which it does nothing. */\n"
    "REACH(@, PARAMS(KEYS))\n"
    "{\n"
    "    return range;\n"
    "}\n"
    "\n"
    "PLUGIN(@, \"@\", FIELDS(U), TERMS(@), .author = \"\")\n"
    "#include PF_TWIN\n";

static const char on_body[] =
    "/* What happens to a body as a whole: here a spring pulls its centre to a place. */\n"
    "#include <plugflow/term.h>\n"
    "\n"
    "/* k (x - x0) . V, once a body, at its centre */\n"
    "TERM(@, PF_PARTICLE, IN(), OUT(V),\n"
    "     PARAMS(REAL(stiffness, \"N/m\", \"of the spring\", .dflt = 1, PF_NOT_NEGATIVE),\n"
    "            VECTOR(at, \"m\", \"where it is fixed\")),\n"
    "     .flags = PF_LINEAR, .doc = \"k(x-x_0)\\\\cdot V\", .cite = \"say from where\")\n"
    "{\n"
    "    EACH (a)\n"
    "        LANES (i)\n"
    "            V[a][i] = stiffness * (AT(b->x, a) - at[a]);\n"
    "}\n"
    "\n"
    "PLUGIN(@, \"@\", FIELDS(U), TERMS(@), .author = \"\")\n"
    "#include PF_TWIN\n";

void new_body_source(const new_plugin *n, text *t)
{
    const char *s = strcmp(n->where, "PF_PAIR") == 0 ? on_pair : on_body;

    for (; *s; s++)
        if (*s == '@')
            text_add(t, "%s", n->name);
        else
            text_add(t, "%c", *s);
}
