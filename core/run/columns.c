/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What the columns of a field are called. */
#include "run/run.h"

#include <stdio.h>
#include <string.h>

static const char velocity_name[] = "uvw";

int output_has_columns(const field_spec *f)
{
    return f->support != PF_ON_PARTICLE; /* those are in particles.csv */
}

int output_components(const field_spec *f, const char *prefix, char (*name)[96])
{
    if (!output_has_columns(f))
        return 0;
    for (int k = 0; k < f->n_comp; k++)
        if (f->n_comp == 1)
            snprintf(name[k], 96, "%s%s", prefix, f->name);
        else if (strcmp(f->name, "u") == 0)
            snprintf(name[k], 96, "%s%c", prefix, velocity_name[k]);
        else
            snprintf(name[k], 96, "%s%s_%s", prefix, f->name, term_component((uint32_t)f->shape, f->n_comp, k));
    return f->n_comp;
}
