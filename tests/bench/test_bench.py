#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The benchmark itself: a small run gives a well-formed file with positive values; what fails is said and the rest goes on;
a broken file is put aside; names select; a loss of instructions is marked.  Prints TAP."""
import contextlib
import io
import json
import os
import subprocess
import sys
import tempfile

import bench
import jobs
import measure
import record

BUILD = os.environ.get("PLUGFLOW_BUILD", "build")


def run_bench(folder, *names):
    script = os.path.join(os.path.dirname(os.path.abspath(__file__)), "bench.py")
    return subprocess.run([sys.executable, script, "--quick", "--threads", "1", "--build", BUILD,
                           "--file", f"{folder}/bench.json", *names], capture_output=True, text=True)


def a_run(**values):
    run = record.new_run(1, True)
    run["entries"] = [{"name": name, "value": value, "unit": "instructions/cell"} for name, value in values.items()]
    return run


def small_run_is_well_formed(folder):
    for count in (1, 2):
        done = run_bench(folder, "jacobian.2d.q2q1.cells_per_second", "taylor_green.16")
        assert done.returncode == 0, done.stdout + done.stderr
        with open(f"{folder}/bench.json") as f:
            runs = json.load(f)
        assert len(runs) == count
    run = runs[-1]
    assert run["machine"]["cores"] >= 1 and run["machine"]["memory_bytes"] > 0 and run["date"].endswith("Z")
    value = {e["name"]: e["value"] for e in run["entries"]}
    for name in ("jacobian.2d.q2q1.cells_per_second", "residual.2d.q2q1.cells_per_second", "jacobian.2d.q2q1.of_peak",
                 "taylor_green.16.seconds", "taylor_green.16.cpu_seconds", "taylor_green.16.assemble_seconds",
                 "taylor_green.16.peak_memory_bytes"):
        assert value[name] > 0, name
    assert all(v >= 0 for v in value.values()), value
    assert value["taylor_green.16.unknowns"] == 2304
    assert value["taylor_green.16.assemble_seconds"] < value["taylor_green.16.seconds"]
    assert value["residual.2d.q2q1.cells_per_second"] > value["jacobian.2d.q2q1.cells_per_second"]
    assert not [f for f in os.listdir(folder) if f != "bench.json"]


def what_fails_is_said_and_the_rest_goes_on(folder):
    few = [jobs.case("none", "cases/there_is_none.lua"), jobs.case("large", "cases/cavity2d.lua", needs="solver_none"),
           jobs.case("couette", "cases/couette.lua")]
    run, said = a_run(), io.StringIO()
    with contextlib.redirect_stdout(said):
        bench.measure_all(few, measure.Context(BUILD, 1, True), run, bench.Table({}))
    assert run["failed"] == ["none"], run
    assert any(e["name"] == "couette.seconds" and e["value"] > 0 for e in run["entries"])
    assert "there_is_none.lua" in said.getvalue() and "needs solver_none" in said.getvalue(), said.getvalue()


def broken_file_is_put_aside(folder):
    path = f"{folder}/bench.json"
    for text in ('[{"entries": [', '{"entries": []}'):
        with open(path, "w") as f:
            f.write(text)
        with contextlib.redirect_stderr(io.StringIO()) as said:
            record.append(path, a_run(a=1))
        assert "is now" in said.getvalue()
        assert len(record.load(path)) == 1
    for name, text in ((".broken", '[{"entries": ['), (".broken2", '{"entries": []}')):
        with open(path + name) as f:
            assert f.read() == text


def loss_of_instructions_is_marked(folder):
    before = record.last_values([a_run(a=1, b=9), a_run(a=100, c=100, d=100)], a_run())
    assert before == {"a": 100, "b": 9, "c": 100, "d": 100}
    a, b, c, new = a_run(a=101.9, c=102.1, d=50, e=1)["entries"]
    assert [record.is_loss(e, before) for e in (a, b, c, new)] == [False, True, False, False]
    assert record.ratio(c, before) == 0.5 and record.ratio(new, before) is None
    other = a_run(a=7)
    other["machine"]["cores"] += 1
    assert record.last_values([other], a_run()) == {}


def names_select(folder):
    every = jobs.all_jobs()

    def first(*names):
        return [job.names[0] for job in bench.select(every, names, False)]

    assert first("falling_disk.20ms.seconds") == ["falling_disk.20ms"]
    assert first("falling_disk.seconds") == ["falling_disk"]
    assert set(first("falling_disk")) == {"falling_disk", "falling_disk.20ms", "falling_disk.32", "falling_disk.short"}
    assert first("settling_sphere.4") == ["settling_sphere.4", "settling_sphere.4.all_cores"]
    assert first("settling_sphere.4.long.all_cores.seconds") == ["settling_sphere.4.long.all_cores"]
    assert not any(".long" in name for name in first())
    assert first("cavity2d.128.vs_dolfinx_mumps") == ["cavity2d.128.vs_dolfinx_mumps"]
    assert first("residual.3d.p2p1.cells_per_second") == ["jacobian.3d.p2p1"]
    assert len({name for job in every for name in job.names}) == sum(len(job.names) for job in every)
    done = run_bench(folder, "falling_dusk")
    assert done.returncode == 1 and "falling_dusk" in done.stderr and not os.path.exists(f"{folder}/bench.json")


def main():
    tests = [small_run_is_well_formed, what_fails_is_said_and_the_rest_goes_on, broken_file_is_put_aside,
             loss_of_instructions_is_marked, names_select]
    failed = 0
    print(f"1..{len(tests)}")
    for i, test in enumerate(tests, 1):
        why = None
        with tempfile.TemporaryDirectory() as folder:
            try:
                test(folder)
            except Exception as e:
                why = repr(e)
        failed += why is not None
        print(f"{'ok' if why is None else 'not ok'} {i} - {test.__name__}")
        if why:
            print("# " + why.replace("\n", "\n# ").replace("\\n", "\n# "))
    return failed > 0


sys.exit(main())
