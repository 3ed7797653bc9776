#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The lid-driven cavity with DOLFINx 0.5 (Debian 12) and MUMPS, as the cases cavity2d and cavity3d have it: Q2/Q1,
Newton from rest to |r| < 1e-10, quadrature of degree 5.  Prints lines "name value unit";
seconds are of the processor.

    OMP_NUM_THREADS=1 /usr/bin/python3 cavity_dolfinx.py DIM CELLS REYNOLDS [SOLVER]
"""
import sys
import time

import numpy as np
import ufl
from dolfinx import fem, mesh
from dolfinx.fem import petsc
from mpi4py import MPI
from petsc4py import PETSc

MOST_ITERATIONS = 15


def make_space(dim, n):
    if dim == 2:
        box = mesh.create_unit_square(MPI.COMM_WORLD, n, n, mesh.CellType.quadrilateral)
    else:
        box = mesh.create_unit_cube(MPI.COMM_WORLD, n, n, n, mesh.CellType.hexahedron)
    cell = box.ufl_cell()
    return fem.FunctionSpace(box, ufl.MixedElement([ufl.VectorElement("Lagrange", cell, 2),
                                                    ufl.FiniteElement("Lagrange", cell, 1)]))


def make_forms(space, reynolds):
    w = fem.Function(space)
    u, p = ufl.split(w)
    v, q = ufl.TestFunctions(space)
    residual = (ufl.inner(ufl.grad(u) * u, v) + 2 / reynolds * ufl.inner(ufl.sym(ufl.grad(u)), ufl.grad(v))
                - p * ufl.div(v) + q * ufl.div(u)) * ufl.dx(metadata={"quadrature_degree": 5})
    return w, fem.form(residual), fem.form(ufl.derivative(residual, w))


def make_conditions(space, dim):
    """The lid moves, all else rests; the pressure is held at the origin."""
    velocities, _ = space.sub(0).collapse()
    pressures, _ = space.sub(1).collapse()
    wall, zero = fem.Function(velocities), fem.Function(pressures)

    def lid(x):
        v = np.zeros((dim, x.shape[1]))
        v[0] = np.isclose(x[1], 1)
        return v

    wall.interpolate(lid)
    facets = mesh.locate_entities_boundary(space.mesh, dim - 1, lambda x: np.full(x.shape[1], True))
    on_wall = fem.locate_dofs_topological((space.sub(0), velocities), dim - 1, facets)
    at_origin = fem.locate_dofs_geometrical((space.sub(1), pressures), lambda x: np.isclose(abs(x).sum(axis=0), 0))
    return [fem.dirichletbc(wall, on_wall, space.sub(0)), fem.dirichletbc(zero, at_origin, space.sub(1))]


def newton(w, residual, jacobian, conditions, solver):
    """Seconds of residuals, Jacobians and solves, and the number of the latter."""
    matrix, vector = petsc.create_matrix(jacobian), petsc.create_vector(residual)
    step = matrix.createVecRight()
    ksp = PETSc.KSP().create(MPI.COMM_WORLD)
    ksp.setType("preonly")
    ksp.getPC().setType("lu")
    ksp.getPC().setFactorSolverType(solver)
    ksp.setOperators(matrix)
    seconds = dict.fromkeys(("residual", "jacobian", "solve"), 0.0)
    held = np.concatenate([c.dof_indices()[0] for c in conditions])

    def timed(name, work):
        start = time.process_time()
        work()
        seconds[name] += time.process_time() - start

    def form_residual():
        with vector.localForm() as local:
            local.set(0)
        petsc.assemble_vector(vector, residual)
        vector.array[held] = 0  # w satisfies the conditions already

    def form_jacobian():
        matrix.zeroEntries()
        petsc.assemble_matrix(matrix, jacobian, conditions)
        matrix.assemble()

    for iteration in range(MOST_ITERATIONS):
        timed("residual", form_residual)
        if vector.norm() < 1e-10:
            return seconds, iteration
        timed("jacobian", form_jacobian)
        timed("solve", lambda: ksp.solve(vector, step))
        w.vector.axpy(-1, step)
    sys.exit("no convergence")


def main():
    dim, n, reynolds = int(sys.argv[1]), int(sys.argv[2]), float(sys.argv[3])
    space = make_space(dim, n)
    w, residual, jacobian = make_forms(space, reynolds)
    conditions = make_conditions(space, dim)
    petsc.set_bc(w.vector, conditions)
    start = time.process_time()
    seconds, iterations = newton(w, residual, jacobian, conditions, sys.argv[4] if len(sys.argv) > 4 else "mumps")
    print(f"total {time.process_time() - start} s")
    for name, value in seconds.items():
        print(f"{name} {value} s")
    print(f"iterations {iterations} 1")
    print(f"jacobian_cells_per_second {n ** dim * iterations / seconds['jacobian']} cells/s")


main()
