/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What other codes call the keys of a case, so that a message can name the right one. */
#include "case/case.h"

#include <string.h>
#include <strings.h>

typedef struct alias {
    const char *other, *key;
    const char *note; /* what differs beside the name, or NULL */
} alias;

#define DYNAMIC "dynamic viscosity = density * kinematic viscosity"
#define RADIUS  "shapes have their measures, as in shape = disk { radius = ... }"

/* Of those whose key is valid where the other name stands the first counts. */
static const alias aliases[] = {
    /* time */
    {"dt", "step", NULL},
    {"dt", "every", NULL},
    {"delta_t", "step", NULL},
    {"deltat", "step", NULL},
    {"timestep", "step", NULL},
    {"time_step", "step", NULL},
    {"step_size", "step", NULL},
    {"stepsize", "step", NULL},
    {"h", "step", NULL},
    {"steps", "stop", "the run ends at stop = start + steps * step"},
    {"n_steps", "stop", "the run ends at stop = start + steps * step"},
    {"nsteps", "stop", "the run ends at stop = start + steps * step"},
    {"n", "stop", "the run ends at stop = start + steps * step"},
    {"t_end", "stop", NULL},
    {"tend", "stop", NULL},
    {"end_time", "stop", NULL},
    {"endtime", "stop", NULL},
    {"t_stop", "stop", NULL},
    {"stop_time", "stop", NULL},
    {"t_max", "stop", NULL},
    {"tmax", "stop", NULL},
    {"t_final", "stop", NULL},
    {"tfinal", "stop", NULL},
    {"final_time", "stop", NULL},
    {"duration", "stop", "the run ends at stop = start + duration"},
    {"T", "stop", NULL},
    {"end", "stop", NULL},
    {"final", "stop", NULL},
    {"until", "stop", NULL},
    {"t0", "start", NULL},
    {"t_start", "start", NULL},
    {"tstart", "start", NULL},
    {"start_time", "start", NULL},
    {"starttime", "start", NULL},
    {"begin", "start", NULL},
    {"method", "scheme", NULL},
    {"integrator", "scheme", NULL},
    {"order", "scheme", "\"bdf1\" or \"bdf2\""},
    /* fluid */
    {"nu", "viscosity", DYNAMIC},
    {"kinematic_viscosity", "viscosity", DYNAMIC},
    {"dynamic_viscosity", "viscosity", NULL},
    {"mu", "viscosity", NULL},
    {"eta", "viscosity", NULL},
    {"re", "viscosity", "a Reynolds number is density * speed * length / viscosity"},
    {"reynolds", "viscosity", "a Reynolds number is density * speed * length / viscosity"},
    {"rho", "density", NULL},
    {"mass", "density", "density = mass / volume"},
    {"g", "gravity", "a vector, as in {0, -9.81}"},
    /* fields: boundary, initial, exact */
    {"velocity", "u", NULL},
    {"vel", "u", NULL},
    {"U", "u", NULL},
    {"v", "u", "all components together: u = {u, v}"},
    {"w", "u", "all components together: u = {u, v, w}"},
    {"ux", "u", "all components together: u = {u, v}"},
    {"uy", "u", "all components together: u = {u, v}"},
    {"no_slip", "u", "a wall is u = {0, 0}"},
    {"noslip", "u", "a wall is u = {0, 0}"},
    {"wall", "u", "a wall is u = {0, 0}"},
    {"inlet", "u", NULL},
    {"inflow", "u", NULL},
    {"pressure", "p", NULL},
    {"pressure", "traction", "a pressure p acts as the traction -p n"},
    {"p", "pressure", NULL},
    {"outlet", "natural", NULL},
    {"outflow", "natural", NULL},
    {"open", "natural", NULL},
    {"do_nothing", "natural", NULL},
    {"neumann", "natural", NULL},
    {"slip", "symmetry", NULL},
    {"free_slip", "symmetry", NULL},
    {"stress", "traction", NULL},
    {"temperature", "theta", NULL},
    /* mesh */
    {"resolution", "cells", NULL},
    {"n", "cells", NULL},
    {"nx", "cells", "all directions together: cells = {nx, ny}"},
    {"ny", "cells", "all directions together: cells = {nx, ny}"},
    {"nz", "cells", "all directions together: cells = {nx, ny, nz}"},
    {"elements", "cells", NULL},
    {"divisions", "cells", NULL},
    {"size", "box", "two corners, as in {{0, 0}, {2, 1}}"},
    {"domain", "box", NULL},
    {"corners", "box", NULL},
    {"xmin", "box", "two corners, as in {{xmin, ymin}, {xmax, ymax}}"},
    {"xmax", "box", "two corners, as in {{xmin, ymin}, {xmax, ymax}}"},
    {"ymin", "box", "two corners, as in {{xmin, ymin}, {xmax, ymax}}"},
    {"ymax", "box", "two corners, as in {{xmin, ymin}, {xmax, ymax}}"},
    {"path", "file", NULL},
    {"filename", "file", NULL},
    /* particle, particles */
    {"position", "at", NULL},
    {"pos", "at", NULL},
    {"x", "at", NULL},
    {"centre", "at", NULL},
    {"center", "at", NULL},
    {"u", "velocity", NULL},
    {"v", "velocity", NULL},
    {"omega", "spin", NULL},
    {"angular_velocity", "spin", NULL},
    {"rotation", "angle", "in radians"},
    {"rotation", "orientation", "a quaternion {w, x, y, z}"},
    {"angle", "orientation", "a quaternion {w, x, y, z}: {cos(a/2), 0, 0, sin(a/2)} turns by a about z"},
    {"orientation", "angle", "in radians"},
    {"theta", "angle", "in radians"},
    {"fixed", "motion", "motion = \"fixed\""},
    {"free", "motion", "motion = \"free\""},
    {"radius", "shape", RADIUS},
    {"r", "shape", RADIUS},
    {"diameter", "shape", RADIUS},
    {"d", "shape", RADIUS},
    {"a", "shape", RADIUS},
    {"count", "n", NULL},
    {"number", "n", NULL},
    {"box", "inside", NULL},
    {"region", "inside", NULL},
    {"distance", "gap", NULL},
    /* shapes */
    {"diameter", "radius", "half of it"},
    {"d", "radius", "half of the diameter"},
    {"r", "radius", NULL},
    /* output */
    {"interval", "every", NULL},
    {"write_interval", "every", NULL},
    {"writeinterval", "every", NULL},
    {"step", "every", NULL},
    {"frequency", "every", "a time, not a number of steps"},
    {"points", "probes", NULL},
    {"probe", "probes", NULL},
    {"variables", "fields", NULL},
    {"n", "points", NULL},
    {"start", "from", NULL},
    {"end", "to", NULL},
    {"drag", "forces", NULL},
    {"lift", "forces", NULL},
    {"origin", "about", NULL},
    /* solve */
    {"tol", "tolerance", NULL},
    {"rtol", "tolerance", NULL},
    {"atol", "tolerance", NULL},
    {"max_iter", "max_iterations", NULL},
    {"maxiter", "max_iterations", NULL},
    {"iterations", "max_iterations", NULL},
};

const char *case_alias(const char *other, const char *const *valid, int n, const char **note)
{
    for (size_t i = 0; i < sizeof aliases / sizeof *aliases; i++)
        for (int k = 0; k < n && strcasecmp(aliases[i].other, other) == 0; k++)
            if (strcmp(aliases[i].key, valid[k]) == 0) {
                *note = aliases[i].note;
                return valid[k];
            }
    return NULL;
}
