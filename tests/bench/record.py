# SPDX-License-Identifier: GPL-3.0-or-later
"""The file of all benchmark runs, a JSON list, and what a new run is compared with."""
import datetime
import json
import os
import re
import subprocess
import sys
import tempfile

LOSS_OF_INSTRUCTIONS = 1.02  # more than this is marked: their number hardly depends on what else a machine does


def machine():
    """Model of the processor, cores that may be used, bytes of memory."""
    cpu = "unknown"
    try:
        with open("/proc/cpuinfo") as f:
            cpu = re.search(r"model name\s*:\s*(.*)", f.read()).group(1)
    except (OSError, AttributeError):
        pass
    return {"cpu": cpu, "cores": len(os.sched_getaffinity(0)),
            "memory_bytes": os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")}


def commit():
    """What git calls this source, or None."""
    try:
        return subprocess.run(["git", "describe", "--always", "--dirty"], capture_output=True, text=True,
                              check=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return None


def is_run(run):
    return (isinstance(run, dict) and isinstance(run.get("entries"), list)
            and all(isinstance(e, dict) and isinstance(e.get("name"), str) and isinstance(e.get("value"), (int, float))
                    for e in run["entries"]))


def load(path):
    """The runs of a file.  A file that is none of ours is put aside, not lost."""
    try:
        with open(path) as f:
            runs = json.load(f)
        if isinstance(runs, list) and all(is_run(run) for run in runs):
            return runs
        why = "it is not a list of runs"
    except FileNotFoundError:
        return []
    except ValueError as e:
        why = str(e)
    aside, k = path + ".broken", 1
    while os.path.exists(aside):
        k += 1
        aside = f"{path}.broken{k}"
    os.rename(path, aside)
    print(f"{path} cannot be read ({why}); it is now {aside}, and a new one begins", file=sys.stderr)
    return []


def append(path, run):
    """The file is the old one or the new one at every moment."""
    runs = load(path) + [run]
    fd, name = tempfile.mkstemp(prefix=os.path.basename(path) + ".", dir=os.path.dirname(path) or ".")
    try:
        with os.fdopen(fd, "w") as f:
            json.dump(runs, f, indent=1)
            f.write("\n")
            f.flush()
            os.fsync(f.fileno())
        os.chmod(name, 0o644)
        os.replace(name, path)
    except BaseException:
        os.unlink(name)
        raise


def new_run(threads, quick):
    now = datetime.datetime.now(datetime.timezone.utc)
    return {"machine": machine(), "date": now.strftime("%Y-%m-%dT%H:%M:%SZ"), "commit": commit(), "threads": threads,
            "quick": quick, "load": os.getloadavg()[0],
            "environment": {k: v for k, v in os.environ.items() if k.startswith(("OPENBLAS_", "OMP_"))},
            "entries": [], "failed": []}


def comparable(a, b):
    return (all(a["machine"].get(k) == b.get("machine", {}).get(k) for k in ("cpu", "cores"))
            and a["threads"] == b.get("threads") and a["quick"] == b.get("quick"))


def last_values(runs, run):
    """Of each entry the value of the last run of its kind on this machine."""
    return {e["name"]: e["value"] for old in runs if comparable(run, old) for e in old["entries"]}


def ratio(entry, before):
    """New over old, None if there is no old one."""
    old = before.get(entry["name"])
    return entry["value"] / old if old else None


def is_loss(entry, before):
    r = ratio(entry, before)
    return entry["unit"].startswith("instructions") and r is not None and r > LOSS_OF_INSTRUCTIONS
