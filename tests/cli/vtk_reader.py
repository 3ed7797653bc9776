# SPDX-License-Identifier: GPL-3.0-or-later
"""ParaView's reader loads what a run wrote and returns an exact quadratic field at random points.

Runs a case whose initial velocity is a quadratic (written at t = 0) on every kind of cell and
evaluates the file with VTK's reader and shape functions."""
import os
import random
import shutil
import subprocess
import sys
import tempfile

try:
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
    from vtkmodules.vtkCommonCore import reference
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


def run(shape, dim, curved):
    tmp = tempfile.mkdtemp()
    lua = {2: "x * x - x * y + 1, 2 * y * y + x - 0.5",
           3: "x * x - x * y + 1, 2 * y * y + x - 0.5, z * z + x * z - y"}[dim]
    with open(tmp + "/case.lua", "w") as f:
        f.write(CASE.format(box="{{0,0},{1,2}}" if dim == 2 else "{{0,0,0},{1,2,1}}", cells="{3,4}" if dim == 2 else "{2,3,2}",
                            shape=shape, args="x, y" if dim == 2 else "x, y, z", u=lua,
                            map=", map = function(x, y) return x + 0.1 * y, y - 0.2 * x end" if curved else ""))
    try:
        subprocess.run([os.environ["PLUGFLOW_PROGRAM"], "run", tmp + "/case.lua", "--quiet", "--out", tmp + "/o"], check=True,
                       stdout=subprocess.DEVNULL)
        reader = vtkXMLUnstructuredGridReader()
        reader.SetFileName(tmp + "/o/fields_00000.vtu")
        reader.Update()
        grid = reader.GetOutput()
        random.seed(1)
        u, p, worst = grid.GetPointData().GetArray("u"), grid.GetPointData().GetArray("p"), 0.0
        for _ in range(40):
            cell, x, weights = place(grid)
            exact = velocity(dim, x) + [1 + 2 * x[0] - 3 * x[1]]
            for k in range(4):
                value = sum(w * (u.GetTuple(cell.GetPointId(i))[k] if k < 3 else p.GetTuple(cell.GetPointId(i))[0])
                            for i, w in enumerate(weights))
                worst = max(worst, abs(value - exact[k]))
        return grid.GetNumberOfCells(), worst
    finally:
        shutil.rmtree(tmp)


tests = [("quads", 2, False), ("triangles", 2, False), ("hexes", 3, False), ("tets", 3, False), ("quads", 2, True)]
print("1..%d" % len(tests))
bad = 0
for number, (shape, dim, curved) in enumerate(tests, 1):
    cells, worst = run(shape, dim, curved)
    ok = cells > 0 and worst < 1e-12
    bad += not ok
    print("%s %d - vtk_reads_%s%s_and_returns_the_quadratic (largest error %.1e)" % ("ok" if ok else "not ok", number,
          shape, "_sheared" if curved else "", worst))
sys.exit(1 if bad else 0)
