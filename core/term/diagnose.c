/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What is wrong with a Jacobian block that is not the derivative. */
#include "term/block.h"

#include <math.h>
#include <stdio.h>

void block_diagnose(const double *given, const double *truth, int rows, int cols, size_t ld, char *text, size_t n)
{
    size_t m = (size_t)(rows * cols) * ld;
    double size = block_norm(truth, m), mine = block_norm(given, m), dot = 0;
    const double near = 1e-6;

    for (size_t i = 0; i < m; i++)
        dot += given[i] * truth[i];
    *text = 0;
    if (!isfinite(mine))
        snprintf(text, n, "the block is not finite");
    else if (mine == 0)
        snprintf(text, n, "missing: the block is zero, the derivative is not");
    else if (size == 0)
        snprintf(text, n, "superfluous: the derivative is zero, the block is not");
    else if (block_distance(given, truth, -1, m) < near * size)
        snprintf(text, n, "sign: the block is minus the derivative");
    else if (block_distance(given, truth, dot / (size * size), m) < near * mine)
        snprintf(text, n, "factor: the block is %.6g times the derivative", dot / (size * size));
    else if (rows == cols && block_transposed_distance(given, truth, rows, ld) < near * size)
        snprintf(text, n, "transpose: rows and columns are exchanged");
    else
        snprintf(text, n, "wrong by %.2g of its norm", block_distance(given, truth, 1, m) / size);
}
