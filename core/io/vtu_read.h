/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * vtu_read.h -- reads back the .vtu files that a run writes: one piece of cells of second
 * order, data appended raw.  Every offset, size and node number is checked against the file,
 * so that whoever holds a vtu_file may index it without further tests. */
#ifndef IO_VTU_READ_H
#define IO_VTU_READ_H

#include "base/arena.h"
#include "base/error.h"
#include "fe/fe.h"

#include <stddef.h>
#include <stdint.h>

enum vtu_kind { VTU_FLOAT32, VTU_FLOAT64, VTU_INT32, VTU_INT64, VTU_UINT8 };

typedef struct vtu_array {
    char name[128];
    char unit[64];           /* empty: not told                                  */
    int kind;                /* enum vtu_kind                                    */
    int components;          /* of an entry                                      */
    size_t n;                /* entries * components                             */
    const unsigned char *at; /* n values of the kind, not aligned                */
} vtu_array;

enum { VTU_MAX_FIELDS = 64 };

typedef struct vtu_file {
    arena memory;
    const unsigned char *bytes; /* the file, size n_byte                         */
    size_t n_byte;
    size_t n_point, n_cell;
    int dim;                                          /* of the cells: 2 or 3    */
    vtu_array point, connectivity, offset, cell_type; /* point: 3 components     */
    vtu_array field[VTU_MAX_FIELDS];                  /* PointData of 1, 3, 6 or 9 components */
    int n_field;
    vtu_array body; /* of each point the number of the rigid body that holds it, -1: fluid; at NULL: not told */
    int has_time;
    double time;
    char time_unit[64];
} vtu_file;

/* Reads the file at path.  ERR_IO if it cannot be read, is cut short or is not such a file;
 * v is then empty, and vtu_close need not but may be called. */
int vtu_open(vtu_file *v, const char *path, error *err);
void vtu_close(vtu_file *v);

/* Value i of the array. */
double vtu_number(const vtu_array *a, size_t i);
int64_t vtu_integer(const vtu_array *a, size_t i);

/* Type of cell c and its points: point[i] belongs to node i in the order of fe_cell. */
const fe_cell *vtu_cell(const vtu_file *v, size_t c, size_t point[FE_MAX_NODES]);

#endif
