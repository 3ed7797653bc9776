/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Images of a body in a periodic mesh. */
#include "body/body.h"

#include <string.h>

int bodies_images(const mesh *m, double (*shift)[3])
{
    int images = 1;

    memset(shift, 0, sizeof *shift);
    for (int k = 0; k < m->n_period && k < 3; k++) {
        int n = images;

        for (int sign = -1; sign <= 1; sign += 2)
            for (int i = 0; i < n; i++, images++)
                for (int c = 0; c < 3; c++)
                    shift[images][c] = shift[i][c] + sign * m->period_vector[k][c];
    }
    return images;
}
