#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""./pf bench: measures, prints, and appends one run to build/bench.json (docs/performance.md).

    ./pf bench [--quick] [--compare] [--threads N] [--list] [NAME ...]

NAME: entries, or what their names begin with (falling_disk, jacobian.3d).  All seconds are of one thread unless the name says
all_cores.  Exit code 1: something failed, the rest is there."""
import argparse
import os
import sys

import jobs
import measure
import record

COLUMNS = ("seconds", "cpu_seconds", "setup_seconds", "geometry_seconds", "assemble_seconds", "factor_seconds", "solve_seconds",
           "output_seconds", "other_seconds", "seconds_per_step", "newton_iterations", "unknowns", "peak_memory_bytes")
HEADS = ("total", "cpu", "setup", "geom.", "assemble", "factor", "solve", "output", "other", "s/step", "newton", "unknowns", "MB")

BUSY = 0.5
WHOLE = ("newton_iterations", "unknowns", "peak_memory_bytes")


def starts(name, prefix):
    return name == prefix or name.startswith(prefix + ".")


def select(all_jobs, names, quick):
    """Jobs that may have entries of these names: those whose names begin so, else the one with the longest name that the
    wanted entry begins with."""
    if not names:
        return [job for job in all_jobs if (job.quick or not quick) and not job.long]
    chosen = []
    for wanted in names:
        found = [job for job in all_jobs
                 if any(starts(name, wanted) and (not job.long or name == wanted) for name in job.names)]
        if not found:
            longest = max((len(name) for job in all_jobs for name in job.names if starts(wanted, name)), default=0)
            found = [job for job in all_jobs
                     if any(starts(wanted, name) and len(name) == longest for name in job.names)]
        if not found:
            sys.exit(f"{wanted}: no entry begins so; ./pf bench --list shows what there is")
        chosen += found
    return [job for job in all_jobs if job in chosen]


def short(value):
    """A number with four digits, and its thousands as a letter."""
    for size, letter in ((1e12, "T"), (1e9, "G"), (1e6, "M"), (1e3, "k")):
        if abs(value) >= size:
            return f"{value / size:.4g} {letter}"
    return f"{value:.4g} "


class Table:
    """Lines as they come: of a case one, of everything else one an entry."""

    def __init__(self, before):
        self.before, self.in_cases = before, False

    def note(self, name, text):
        print(f"{name:<46} {text}", flush=True)

    def change(self, entry):
        r = record.ratio(entry, self.before)
        return "" if r is None else f"{r:9.3f}" + ("  LOSS" if record.is_loss(entry, self.before) else "")

    def entry(self, e):
        unit = "" if e["unit"] == "1" else e["unit"]
        print(f"{e['name']:<46} {short(e['value']) + unit:>24} {self.change(e)}", flush=True)

    def case(self, name, entries):
        value = {e["name"][len(name) + 1:]: e["value"] for e in entries}
        value["peak_memory_bytes"] = value["peak_memory_bytes"] / 1e6
        cells = [f"{value[c]:{'9.0f' if c in WHOLE else '9.3g'}}" if c in value else f"{'–':>9}" for c in COLUMNS]
        print(f"{name:<28}" + "".join(cells) + self.change(entries[0]), flush=True)

    def job(self, job, entries):
        if job.is_case and not self.in_cases:
            print(f"\n{'seconds':<28}" + "".join(f"{head:>9}" for head in HEADS)
                  + ("   to last" if self.before else ""))
        elif self.in_cases and not job.is_case:
            print()
        self.in_cases = job.is_case
        if job.is_case:
            self.case(job.names[0], entries)
        else:
            for e in entries:
                self.entry(e)


def measure_all(chosen, context, run, table):
    for job in chosen:
        try:
            entries = [{"name": name, "value": value, "unit": unit} for name, value, unit in job.run(context)]
            run["entries"] += entries
            table.job(job, entries)
        except measure.Skipped as e:
            table.note(job.names[0], f"not measured: {e}")
        except (measure.Failed, KeyError, OSError, ValueError) as e:
            run["failed"].append(job.names[0])
            table.note(job.names[0], f"failed: {e if isinstance(e, measure.Failed) else repr(e)}")


def compare(run, before):
    print(f"\n{'entry':<52} {'now':>14} {'before':>14} {'ratio':>9}")
    for e in run["entries"]:
        r = record.ratio(e, before)
        if r is not None:
            mark = "  LOSS" if record.is_loss(e, before) else ""
            print(f"{e['name']:<52} {e['value']:14.5g} {before[e['name']]:14.5g} {r:9.3f}{mark}")


def options():
    p = argparse.ArgumentParser(prog="./pf bench", description="measures, prints, and appends a run to build/bench.json")
    p.add_argument("names", nargs="*", metavar="NAME", help="entries, or what their names begin with")
    p.add_argument("--quick", action="store_true", help="small sizes, two minutes")
    p.add_argument("--compare", action="store_true", help="every entry beside its last value on this machine")
    p.add_argument("--list", action="store_true", help="the names, without measuring")
    p.add_argument("--threads", type=int, default=len(os.sched_getaffinity(0)), help="of all_cores (default: all there are)")
    p.add_argument("--build", default=os.environ.get("PLUGFLOW_BUILD", "build"), help=argparse.SUPPRESS)
    p.add_argument("--file", help="instead of build/bench.json")
    o = p.parse_args()
    if o.threads < 1:
        p.error(f"--threads {o.threads}: expected at least 1")
    return o


def main():
    o = options()
    chosen = select(jobs.all_jobs(), o.names, o.quick)
    if o.list:
        print("\n".join(name for job in chosen for name in job.names))
        return 0
    path = o.file or os.path.join(o.build, "bench.json")
    run = record.new_run(o.threads, o.quick)
    before = record.last_values(record.load(path), run)
    print(f"{run['machine']['cpu']}, {run['machine']['cores']} cores, {run['machine']['memory_bytes'] / 1e9:.3g} GB; "
          f"all_cores: {o.threads} threads")
    if run["load"] > BUSY:
        print(f"others use {run['load']:.2g} cores: trust instructions and ratios, not seconds, and all_cores least")
    stopped = False
    try:
        measure_all(chosen, measure.Context(o.build, o.threads, o.quick), run, Table(before))
    except KeyboardInterrupt:
        stopped = True
    if run["entries"]:
        record.append(path, run)
        print(f"\n{path}: {len(run['entries'])} entries", flush=True)
    if o.compare:
        compare(run, before)
    lost = [e["name"] for e in run["entries"] if record.is_loss(e, before)]
    if lost:
        print("more instructions than before: " + ", ".join(lost))
    if run["failed"]:
        print("failed: " + ", ".join(run["failed"]))
    return 130 if stopped else 1 if run["failed"] else 0


if __name__ == "__main__":
    sys.exit(main())
