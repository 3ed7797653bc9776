/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A second species beside the first: the same equations with a field and keys of its own.  (Copy this file for a
 * third one.) */
#define SPECIES         c_2
#define PLUGIN_NAME     species_2
#define PF_SHAPE_c_2    SCALAR
#define diffusivity     diffusivity_2
#define first_order     first_order_2
#define second_order    second_order_2
#define max_rate        max_rate_2
#define half_saturation half_saturation_2
#define c_source        c_2_source
#define c_flux          c_2_flux
#define c_uptake        c_2_uptake

#include "../species/species.c"
