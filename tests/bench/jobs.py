# SPDX-License-Identifier: GPL-3.0-or-later
"""What is measured: the assembly, whole cases, limits of the machine, other packages on the same problem.

A job has the names that its entries begin with; run(context) returns entries (name, value, unit)."""
import dataclasses
import math

import measure

# name: parameters of flow.lua, cells in each direction: usually, quick, under valgrind
SPACES = {
    "2d.q2q1": ({"dim": 2, "shape": "quads"}, 48, 16, 6),
    "2d.p2p1": ({"dim": 2, "shape": "triangles"}, 48, 16, 6),
    "3d.q2q1": ({"dim": 3, "shape": "hexes"}, 12, 8, 4),
    "3d.p2p1": ({"dim": 3, "shape": "tets"}, 8, 5, 2),
}
BODIES = {"2d": (50, 32, 32, 16), "3d": (1, 12, 8, 4)}
FEW_DISKS = 10  # under valgrind, which is slow
POINTS = {"2d.q2q1": (2, 9, 9, 4), "2d.p2p1": (2, 7, 6, 3), "3d.q2q1": (3, 27, 27, 8), "3d.p2p1": (3, 14, 10, 4)}
SECONDS, QUICK_SECONDS = 1.0, 0.2


@dataclasses.dataclass
class Job:
    names: list
    run: object
    quick: bool = False
    is_case: bool = False
    long: bool = False  # runs only if its own name is given


def dense_operations(space):
    """Of the matrix of a cell, additions and multiplications, if D is full where trial and test are both velocities:
    B_i^T (D B_j) at all points, B = (value, gradient); pressure meets the divergence."""
    dim, points, n2, n1 = POINTS[space]
    first = 2 * points * n2 * (dim * (1 + dim)) ** 2
    second = 2 * points * n2 ** 2 * dim ** 2 * (1 + dim)
    return first + second + 2 * (2 * points * n2 * n1 * dim)


def least(a, b):
    """Of each value the smaller one."""
    return {name: min(value, b[name]) for name, value in a.items()} if b else a


# --- assembly ---

def variants():
    """(name, parameters, sizes, whether it is part of a quick run)."""
    for space, (sets, *sizes) in SPACES.items():
        yield space, sets, sizes, True
    for space, (sets, *_) in SPACES.items():
        count, *sizes = BODIES[space[:2]]
        yield space + ".bodies", {**sets, "bodies": count}, sizes, space.endswith("q2q1")


def kinds(name):
    return ("jacobian", "residual", "history") if name.endswith(".bodies") else ("jacobian", "residual")


def best_times(context, sets, threads, *options):
    return context.assembly("tests/bench/flow.lua", sets, "--threads", threads, "--seconds",
                            QUICK_SECONDS if context.quick else SECONDS, *options)


def assembly_job(name, sets, sizes):
    def run(context):  # one thread before and after the others, which may have a quieter moment
        sets["n"] = sizes[1 if context.quick else 0]
        one = best_times(context, sets, 1)
        every = best_times(context, sets, context.threads) if context.threads > 1 else None
        busiest = best_times(context, sets, context.threads, "--busiest") if every else None
        one = least(best_times(context, sets, 1), one)
        cells = one["cells"]
        for kind in kinds(name):
            yield f"{kind}.{name}.cells_per_second", cells / one[kind], "cells/s"
            if every:
                yield f"{kind}.{name}.all_cores.cells_per_second", cells / every[kind], "cells/s"
                yield f"{kind}.{name}.speedup", one[kind] / every[kind], "1"
                yield f"{kind}.{name}.share_speedup", one[kind] / busiest[kind], "1"
        if name in POINTS:
            limit = context.limits(1)
            moved = 8 * one["matrix_entries"] + 24 * one["unknowns"]
            yield (f"jacobian.{name}.of_peak", dense_operations(name) * cells / one["jacobian"] / limit["flops_per_second"],
                   "1")
            yield f"jacobian.{name}.of_stream", moved / one["jacobian"] / limit["stream_bytes_per_second"], "1"

    return run


def instructions_job(name, sets, sizes):
    def run(context):
        sets["n"] = sizes[2]
        if "bodies" in sets:
            sets["bodies"] = min(sets["bodies"], FEW_DISKS)
        cells, counts = context.instructions("tests/bench/flow.lua", sets)
        for kind, count in counts.items():
            yield f"instructions.{kind}.{name}.per_cell", count / cells, "instructions/cell"

    return run


def limits_job(context):
    for threads, part in ((1, ""), (context.threads, "all_cores.")):
        if threads > 1 or not part:
            for name, value in context.limits(threads).items():
                yield f"limits.{part}{name}", value, "B/s" if "bytes" in name else "flop/s"


# --- whole cases ---

def case(name, path, quick=False, needs=None, all_cores=False, long=False, **sets):
    """needs: a linear solver without which the case is too large."""
    def run(context):
        if needs and needs not in context.solvers():
            raise measure.Skipped(f"needs {needs}, which is not among the plugins")
        yield from measure.case_entries(name, context.case(path, sets, context.threads if all_cores else 1))

    return Job([name], run, quick, is_case=True, long=long)


def cases():
    cavity2d, cavity3d, sphere = "cases/cavity2d.lua", "cases/cavity3d.lua", "cases/settling_sphere.lua"
    beltrami, tank, wall = "cases/beltrami.lua", "tests/bench/whole_tank.lua", "tests/bench/sphere_near_wall.lua"
    disk, disks, vortices = "cases/falling_disk.lua", "cases/fifty_disks.lua", "cases/taylor_green.lua"
    block = "solver_block"
    return [
        case("cavity2d.32", cavity2d, True, n=32), case("cavity2d.64", cavity2d, n=64), case("cavity2d.96", cavity2d, n=96),
        case("cavity2d.128", cavity2d, n=128),
        case("cavity3d.6", cavity3d, True, n=6), case("cavity3d.8", cavity3d, n=8), case("cavity3d.12", cavity3d, n=12),
        case("cavity3d.16", cavity3d, n=16),
        case("falling_disk.short", disk, True, stop=0.05), case("falling_disk", disk, stop=0.6),
        case("falling_disk.20ms", disk, stop=0.6, dt=0.02), case("falling_disk.32", disk, n=32, dt=0.0025, stop=0.02),
        case("fifty_disks.short", disks, True, steps=3), case("fifty_disks.12", disks, n=12, steps=20),
        case("fifty_disks.16", disks, n=16, steps=20), case("fifty_disks.24", disks, n=24, steps=20),
        case("settling_sphere.2", sphere, True, n=2, stop=0.075), case("settling_sphere.3", sphere, n=3, stop=0.125),
        case("settling_sphere.4", sphere, n=4, stop=0.1),
        case("settling_sphere.4.all_cores", sphere, n=4, stop=0.1, all_cores=True),
        case("settling_sphere.4.long.all_cores", sphere, n=4, stop=0.9, all_cores=True, long=True),
        case("fifty_disks.16.long", disks, n=16, steps=500, long=True),
        case("whole_tank.4.long.all_cores", tank, n=4, steps=36, needs=block, all_cores=True, long=True),
        case("whole_tank.2", tank, n=2, steps=4),
        case("whole_tank.4.all_cores", tank, n=4, steps=4, needs=block, all_cores=True),
        case("sphere_in_box.34.all_cores", "tests/bench/flow.lua", needs=block, all_cores=True, dim=3, shape="hexes", bodies=1,
             n=34, steps=3),
        case("beltrami.4", beltrami, True), case("beltrami.8", beltrami, n=8), case("beltrami.16", beltrami, n=16, stop=0.03),
        case("beltrami.32", beltrami, n=32, stop=0.03, needs=block),
        case("taylor_green.16", vortices, True, n=16), case("taylor_green.32", vortices, n=32),
        case("taylor_green.48", vortices, n=48), case("taylor_green.64", vortices, n=64),
        case("sphere_near_wall.8", wall, n=8), case("sphere_near_wall.12", wall, n=12),
        case("sphere_near_wall.19", wall, n=19),
    ]


# --- beside others ---

ROUNDS = 2  # in turn, the best of each counts; the first of DOLFINx compiles its forms


def beside(context, peer, path, n):
    """Least processor seconds of the whole program, least values of the other one."""
    ours, theirs = math.inf, None
    for _ in range(ROUNDS):
        ours = min(ours, context.case(path, {"n": n}, 1)["cpu_seconds"])
        theirs = least(context.peer(peer), theirs)
    return ours, theirs


def dolfinx_job(dim, n):
    def run(context):
        name, space, path = f"cavity{dim}d.{n}", f"{dim}d.q2q1", f"cases/cavity{dim}d.lua"
        context.need("dolfinx")
        ours, theirs = beside(context, ["dolfinx", dim, n, 100], path, n)
        yield f"{name}.dolfinx_mumps_seconds", theirs["total"], "s"
        yield f"{name}.vs_dolfinx_mumps", ours / theirs["total"], "1"
        assembly = context.assembly(path, {"n": n}, "--threads", 1, "--seconds", SECONDS)
        rate = n ** dim * theirs["iterations"] / theirs["jacobian"]
        yield f"jacobian.{space}.dolfinx_cells_per_second", rate, "cells/s"
        yield f"jacobian.{space}.vs_dolfinx", assembly["cells"] / assembly["jacobian"] / rate, "1"

    return Job([f"cavity{dim}d.{n}.vs_dolfinx_mumps", f"jacobian.{dim}d.q2q1.vs_dolfinx"], run)


def freefem_job(context):
    context.need("freefem")
    ours, theirs = beside(context, ["freefem", 128, 100], "cases/cavity2d.lua", 128)
    yield "cavity2d.128.freefem_seconds", theirs["total"], "s"
    yield "cavity2d.128.vs_freefem", ours / theirs["total"], "1"


def all_jobs():
    jobs = [Job(["limits"], limits_job, True)]
    for name, sets, sizes, quick in variants():
        names = [f"{kind}.{name}" for kind in kinds(name)]
        jobs.append(Job(names, assembly_job(name, dict(sets), sizes), quick))
    for name, sets, sizes, quick in variants():
        names = [f"instructions.{kind}.{name}" for kind in kinds(name)]
        jobs.append(Job(names, instructions_job(name, dict(sets), sizes), quick and name in POINTS))
    jobs += cases()
    return jobs + [dolfinx_job(2, 128), dolfinx_job(3, 12), Job(["cavity2d.128.vs_freefem"], freefem_job)]
