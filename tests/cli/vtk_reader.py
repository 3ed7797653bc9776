# SPDX-License-Identifier: GPL-3.0-or-later
"""ParaView's reader loads what a run wrote and returns an exact quadratic field at random points.

Runs a case whose initial velocity is a quadratic (written at t = 0) on every kind of cell and
evaluates the file with VTK's reader and shape functions.  Then cases with bodies: which nodes lie in
them, what stands there, and their outlines and surfaces."""
import math
import os
import random
import shutil
import subprocess
import sys
import tempfile

try:
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLUnstructuredGridReader
    from vtkmodules.vtkCommonCore import reference
    from vtkmodules.vtkFiltersCore import vtkFeatureEdges, vtkMassProperties
except ImportError:
    # Another python3 may come first in PATH; Debian's own has the package.
    if sys.executable != "/usr/bin/python3" and os.path.exists("/usr/bin/python3"):
        os.execv("/usr/bin/python3", ["/usr/bin/python3"] + sys.argv)
    print("1..0 # skip python3-vtk9 is not installed")
    sys.exit(0)

CASE = """
mesh {{ box = {box}, cells = {cells}, shape = "{shape}" {map} }}
fluid {{ density = 1, viscosity = 1 }}
term "continuity" {{}}
term "momentum" {{}}
boundary "*" {{ natural = true }}
initial {{ u = function({args}) return {u} end, p = function({args}) return 1 + 2 * x - 3 * y end }}
time {{ step = 1e-3, stop = 1e-3 }}
"""


def velocity(dim, x):
    u = [x[0] ** 2 - x[0] * x[1] + 1, 2 * x[1] ** 2 + x[0] - 0.5]
    return u + ([x[2] ** 2 + x[0] * x[2] - x[1]] if dim == 3 else [0.0])


def place(grid):
    """A random point of a random cell and VTK's own shape functions there."""
    cell = grid.GetCell(random.randrange(grid.GetNumberOfCells()))
    where = [random.random() for _ in range(3)]
    if sum(where) > 1 and cell.GetNumberOfPoints() in (6, 10):
        where = [w / (2 * sum(where)) for w in where]
    x, weights = [0.0] * 3, [0.0] * cell.GetNumberOfPoints()
    cell.EvaluateLocation(reference(0), where, x, weights)
    return cell, x, weights


def solve(text):
    """The folder with the results of a case."""
    tmp = tempfile.mkdtemp()
    with open(tmp + "/case.lua", "w") as f:
        f.write(text)
    subprocess.run([os.environ["PLUGFLOW_PROGRAM"], "run", tmp + "/case.lua", "--quiet", "--out", tmp + "/o"], check=True,
                   stdout=subprocess.DEVNULL)
    return tmp


def read(reader, path):
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def quadratic(shape, dim, curved):
    """Largest error of an exact quadratic."""
    lua = {2: "x * x - x * y + 1, 2 * y * y + x - 0.5",
           3: "x * x - x * y + 1, 2 * y * y + x - 0.5, z * z + x * z - y"}[dim]
    tmp = solve(CASE.format(box="{{0,0},{1,2}}" if dim == 2 else "{{0,0,0},{1,2,1}}", cells="{3,4}" if dim == 2 else "{2,3,2}",
                            shape=shape, args="x, y" if dim == 2 else "x, y, z", u=lua,
                            map=", map = function(x, y) return x + 0.1 * y, y - 0.2 * x end" if curved else ""))
    try:
        grid = read(vtkXMLUnstructuredGridReader(), tmp + "/o/fields_00000.vtu")
        random.seed(1)
        u, p, worst = grid.GetPointData().GetArray("u"), grid.GetPointData().GetArray("p"), 0.0
        for _ in range(40):
            cell, x, weights = place(grid)
            exact = velocity(dim, x) + [1 + 2 * x[0] - 3 * x[1]]
            for k in range(4):
                value = sum(w * (u.GetTuple(cell.GetPointId(i))[k] if k < 3 else p.GetTuple(cell.GetPointId(i))[0])
                            for i, w in enumerate(weights))
                worst = max(worst, abs(value - exact[k]))
        return grid.GetNumberOfCells() > 0 and worst < 1e-12, "largest error %.1e" % worst
    finally:
        shutil.rmtree(tmp)


BODIES = """
mesh {{ box = {{{box}}}, cells = {{{cells}}} }}
fluid {{ density = 1, viscosity = 1 }}
term "continuity" {{}}
term "momentum" {{ without = {{"convection"}} }}
particulate("sharp")
boundary "*" {{ u = {{{zero}}} }}
{bodies}
{time}
"""


def wrong_nodes(grid, inside, motion):
    """Nodes whose body, velocity or pressure is not what it must be; how many lie in bodies."""
    u, p, body = (grid.GetPointData().GetArray(name) for name in ("u", "p", "body"))
    bad = covered = 0
    for i in range(grid.GetNumberOfPoints()):
        k = inside(grid.GetPoint(i))
        empty, value = math.isnan(p.GetTuple(i)[0]), u.GetTuple(i)
        covered += k >= 0
        bad += body.GetTuple(i)[0] != k or empty != (k >= 0)
        bad += k >= 0 and max(abs(a - b) for a, b in zip(value, motion(k, grid.GetPoint(i)))) > 1e-9
    return bad, covered


def sphere():
    """A sphere is a closed surface of the right volume, normals outwards; no fluid inside."""
    centre, radius = (0.47, 0.52, 0.51), 0.3
    tmp = solve(BODIES.format(box="{0,0,0},{1,1,1}", cells="5,5,5", zero="0,0,0", time="", bodies="particle { shape = sphere { "
                "radius = 0.3 }, density = 1, at = {0.47, 0.52, 0.51}, motion = \"fixed\", velocity = {1, 0, 0} }"))
    try:
        grid = read(vtkXMLUnstructuredGridReader(), tmp + "/o/fields_00000.vtu")
        wrong, covered = wrong_nodes(grid, lambda x: 0 if math.dist(x, centre) < radius else -1, lambda k, x: (1, 0, 0))
        body = read(vtkXMLPolyDataReader(), tmp + "/o/particles_00000.vtp")
        edges, mass = vtkFeatureEdges(), vtkMassProperties()
        edges.SetInputData(body)
        edges.FeatureEdgesOff()
        edges.ManifoldEdgesOff()
        edges.Update()
        mass.SetInputData(body)
        outward = 0.0
        for i in range(body.GetNumberOfCells()):
            a, b, c = (body.GetCell(i).GetPoints().GetPoint(k) for k in range(3))
            a, b, c = ([v - w for v, w in zip(q, centre)] for q in (a, b, c))
            outward += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                        a[2] * (b[0] * c[1] - b[1] * c[0])) / 6
        exact = 4 / 3 * math.pi * radius ** 3
        off = max(abs(math.dist(body.GetPoint(i), centre) - radius) for i in range(body.GetNumberOfPoints()))
        moves = body.GetCellData().GetArray("moves").GetRange()
        ok = (wrong == 0 and covered > 50 and edges.GetOutput().GetNumberOfCells() == 0 and off < 1e-8 and moves == (0, 0) and
              0.997 < mass.GetVolume() / exact < 1 and abs(outward - mass.GetVolume()) < 1e-6 * exact)
        return ok, "%d of %d nodes wrong, %d open edges, volume %.5f of the ball's, points off by %.1e" % (
            wrong, covered, edges.GetOutput().GetNumberOfCells(), outward / exact, off)
    finally:
        shutil.rmtree(tmp)


def disks():
    """Two disks, one turning: outlines, and the motion of each inside."""
    at, radius = ((0.3, 0.31), (0.7, 0.62)), 0.17
    one = "particle {{ shape = disk {{ radius = 0.17 }}, density = 1, at = {{{}, {}}}, motion = \"{}\", spin = {} }}\n"
    tmp = solve(BODIES.format(box="{0,0},{1,1}", cells="12,12", zero="0,0", time="time { step = 0.1, stop = 0.1 }",
                              bodies=one.format(*at[0], "fixed", 0) + one.format(*at[1], "prescribed", 2)))
    try:
        grid = read(vtkXMLUnstructuredGridReader(), tmp + "/o/fields_00001.vtu")
        wrong, covered = wrong_nodes(grid, lambda x: next((k for k in (0, 1) if math.dist(x[:2], at[k]) < radius), -1),
                                     lambda k, x: (-2 * (x[1] - at[k][1]) * k, 2 * (x[0] - at[k][0]) * k, 0))
        body = read(vtkXMLPolyDataReader(), tmp + "/o/particles_00001.vtp")
        data = [[int(body.GetCellData().GetArray(name).GetTuple(k)[0]) for k in (0, 1)] for name in ("id", "moves")]
        points = [body.GetCell(k).GetNumberOfPoints() for k in (0, 1)]
        ok = wrong == 0 and covered > 50 and data == [[0, 1], [0, 1]] and points == [97, 98]
        return ok, "%d of %d nodes wrong; id, moves %s; %s points" % (wrong, covered, data, points)
    finally:
        shutil.rmtree(tmp)


tests = [("vtk_reads_%s%s_and_returns_the_quadratic" % (shape, "_sheared" if curved else ""),
          lambda shape=shape, dim=dim, curved=curved: quadratic(shape, dim, curved))
         for shape, dim, curved in [("quads", 2, False), ("triangles", 2, False), ("hexes", 3, False), ("tets", 3, False),
                                    ("quads", 2, True)]]
tests += [("vtk_reads_a_sphere_as_a_closed_surface_with_no_fluid_inside", sphere),
          ("vtk_reads_disks_as_outlines_with_their_motion_inside", disks)]
print("1..%d" % len(tests))
bad = 0
for number, (name, test) in enumerate(tests, 1):
    ok, what = test()
    bad += not ok
    print("%s %d - %s (%s)" % ("ok" if ok else "not ok", number, name, what))
sys.exit(1 if bad else 0)
