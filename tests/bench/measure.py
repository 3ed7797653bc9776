# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs programs and reads what they measured."""
import glob
import json
import os
import re
import resource
import shutil
import subprocess
import tempfile

CASE_SECONDS = 3600  # of one program at most
PHASES = ("setup", "geometry", "assemble", "factor", "solve", "output")
PEERS = {"dolfinx": (["/usr/bin/python3", "-c", "import dolfinx, petsc4py"], "python3-dolfinx python3-petsc4py"),
         "freefem": (["FreeFem++", "-h"], "freefem++")}


class Failed(Exception):
    """A measurement came to nothing."""


class Skipped(Exception):
    """What it needs is not here."""


def command(words, env=None):
    """Standard output of a program; Failed with the end of what it said if it fails."""
    words = [str(w) for w in words]
    try:
        done = subprocess.run(words, capture_output=True, text=True, errors="replace", timeout=CASE_SECONDS,
                              env={**os.environ, **(env or {})})
    except OSError as e:
        raise Failed(str(e))
    except subprocess.TimeoutExpired:
        raise Failed(f"took more than {CASE_SECONDS} s")
    if done.returncode:
        said = (done.stderr.strip() or done.stdout.strip() or "without a word").splitlines()[-1]
        raise Failed(f"exit code {done.returncode}: {said}")
    return done.stdout


def cpu_seconds():
    """Of all programs that have ended: they do not grow much where others share the cores."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def values(text):
    """Of lines "name value unit"."""
    found = {}
    for line in text.splitlines():
        m = re.fullmatch(r"(\w+) ([-+.\deE]+) \S+", line)
        if m:
            found[m.group(1)] = float(m.group(2))
    return found


def set_options(sets):
    return [word for name, value in sets.items() for word in ("--set", f"{name}={value}")]


def seconds_per_step(out, steps):
    """From the files of fields: those of the first step, which makes three, and what comes before it do not count."""
    with open(f"{out}/fields.pvd") as f:
        times = [float(t) for t in re.findall(r'timestep="([^"]*)"', f.read())]
    files = sorted(glob.glob(f"{out}/fields_*.vtu"))
    if len(files) < 3 or len(files) != len(times):
        return None
    taken = os.stat(files[-1]).st_mtime - os.stat(files[1]).st_mtime
    return taken / (steps * (times[-1] - times[1]) / (times[-1] - times[0]))


def case_entries(name, summary):
    seconds = summary["seconds"]
    yield f"{name}.seconds", seconds["total"], "s"
    yield f"{name}.cpu_seconds", summary["cpu_seconds"], "s"
    for phase in PHASES:
        yield f"{name}.{phase}_seconds", seconds[phase], "s"
    yield f"{name}.other_seconds", seconds["total"] - sum(seconds[phase] for phase in PHASES), "s"
    if summary["seconds_per_step"]:
        yield f"{name}.seconds_per_step", summary["seconds_per_step"], "s"
    yield f"{name}.newton_iterations", summary["newton_iterations"], "1"
    yield f"{name}.unknowns", summary["unknowns"], "1"
    yield f"{name}.peak_memory_bytes", summary["peak_memory_bytes"], "B"
    yield f"{name}.bytes_per_unknown", summary["peak_memory_bytes"] / summary["unknowns"], "B"


class Context:
    """Where the programs are, and what is measured once only."""

    def __init__(self, build, threads, quick):
        self.build, self.threads, self.quick = build, threads, quick
        self.limit, self.found, self.slow_build = {}, None, None

    def program(self, name, build=None):
        return os.path.join(build or self.build, "tests", "bench", name)

    def plugins(self, build=None):
        return {"PLUGFLOW_PLUGIN_PATH": os.path.join(build or self.build, "plugins")}

    def solvers(self):
        """Everything that the program calls a plugin."""
        if self.found is None:
            self.found = set(re.findall(r"^(\w+) ", command([f"{self.build}/plugflow", "plugins"]), re.M))
        return self.found

    def limits(self, threads):
        if threads not in self.limit:
            self.limit[threads] = values(command([self.program("bench_limits"), threads]))
        return self.limit[threads]

    def assembly(self, path, sets, *options):
        passive = {"OMP_WAIT_POLICY": "passive"} if "--busiest" in options else {}
        return values(command([self.program("bench_assembly"), path, *set_options(sets), *options],
                              {**self.plugins(), **passive}))

    def case(self, path, sets, threads):
        """summary.json of a run, its cpu_seconds and seconds_per_step."""
        with tempfile.TemporaryDirectory() as out:
            start = cpu_seconds()
            command([f"{self.build}/plugflow", "run", path, *set_options(sets), "--quiet", "--threads", threads, "--out", out])
            cpu = cpu_seconds() - start
            with open(f"{out}/summary.json") as f:
                summary = json.load(f)
            if summary["status"] != "ok":
                raise Failed(summary["status"])
            summary["cpu_seconds"] = cpu
            summary["seconds_per_step"] = seconds_per_step(out, summary["steps"]) if summary["steps"] > 1 else None
        return summary

    # --- instructions ---

    def valgrind_build(self):
        """A build for processors that valgrind knows: 3.19 does not know AVX-512."""
        if self.slow_build is None:
            if not shutil.which("valgrind"):
                raise Skipped("needs valgrind: apt-get install --no-install-recommends valgrind")
            build = os.path.join(self.build, "bench-valgrind")
            with open("/proc/cpuinfo") as f:
                has_avx2 = {"avx2", "fma", "bmi2"} <= set(f.read().split())
            if not os.path.exists(f"{build}/build.ninja"):
                command(["meson", "setup", "--wrap-mode=nodownload", "-Dnative=false",
                         "-Dc_args=" + ("-march=x86-64-v3" if has_avx2 else ""), build])
            command(["ninja", "-C", build, "all", "tests/bench/bench_assembly"])
            self.slow_build = build
        return self.slow_build

    def instructions(self, path, sets):
        """Cells, and of each kind the instructions of one evaluation."""
        build = self.valgrind_build()
        kinds = ("jacobian", "residual", "history")
        switch = [f"--{what}=measured_{kind}" for kind in kinds for what in ("zero-before", "dump-after")]
        with tempfile.TemporaryDirectory() as out:
            said = command(["valgrind", "-q", "--tool=callgrind", f"--callgrind-out-file={out}/counts", *switch,
                            self.program("bench_assembly", build), path, *set_options(sets), "--times", 1],
                           {**self.plugins(build), "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"})
            counts = {}
            for file in glob.glob(f"{out}/counts*"):
                with open(file) as f:
                    text = f.read()
                kind = re.search(r"^desc: Trigger: --dump-after=measured_(\w+)", text, re.M)
                if kind:
                    counts[kind.group(1)] = int(re.search(r"^summary: (\d+)", text, re.M).group(1))
        if not counts:
            raise Failed("callgrind counted nothing")
        return values(said)["cells"], dict(sorted(counts.items()))

    # --- other packages ---

    def need(self, peer):
        probe, packages = PEERS[peer]
        try:
            subprocess.run(probe, capture_output=True, timeout=60, check=peer == "dolfinx")
        except (OSError, subprocess.SubprocessError):
            raise Skipped(f"for this ratio: apt-get install --no-install-recommends {packages}")

    def peer(self, words):
        """What a script of peers/ measured; words: which, and its arguments."""
        scripts = {"dolfinx": ["/usr/bin/python3", "tests/bench/peers/cavity_dolfinx.py"],
                   "freefem": ["FreeFem++", "-nw", "-v", "0", "tests/bench/peers/cavity_freefem.edp"]}
        return values(command([*scripts[words[0]], *words[1:]], {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}))
