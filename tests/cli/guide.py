#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Follows docs/plugin-guide.md literally, in an empty folder: writes its files, types its commands, finds in what they print
what it says.  --log FILE writes down what happened.  Prints TAP."""
import math
import os
import re
import subprocess
import sys
import tempfile

SOURCE = os.environ.get("PLUGFLOW_SOURCE", ".")
PROGRAM = os.path.abspath(os.environ.get("PLUGFLOW_PROGRAM", "build/plugflow"))
BLOCK = re.compile(r"^```(\w+)([^\n]*)\n(.*?)^```", re.M | re.S)


def follow(guide, folder, log):
    """Lines that say what did not go as the guide says."""
    wrong, said = [], ""
    env = dict(os.environ, PATH=os.path.dirname(PROGRAM) + ":" + os.environ["PATH"], LC_ALL="C")
    for kind, words, body in BLOCK.findall(guide):
        words = words.split()
        if kind == "sh":
            run = subprocess.run(["sh", "-ec", body], cwd=folder, env=env, capture_output=True, text=True, timeout=300)
            said = run.stdout + run.stderr
            commands = "".join(f"$ {line}\n" for line in body.splitlines())
            shown = re.sub(r"-I\S+", "-I/usr/local/include", said.replace(os.path.realpath(folder), "/home/you"))
            log.append(f"```text\n{commands}{shown.rstrip()}\n```\n")
            if (run.returncode != 0) != bool(words):
                wrong.append(f"exit code {run.returncode} of: {body.strip()}\n{said}")
        elif kind == "text":
            wrong += [f"not said: {line}" for line in body.splitlines() if line.strip() and line not in said]
        elif words[:2] == ["part", "of"]:
            with open(os.path.join(folder, words[2])) as f:
                if body not in f.read():
                    wrong.append(f"{words[2]} does not have\n{body}")
        else:
            log.append(f"(writes `{words[0]}` as in the guide)\n")
            with open(os.path.join(folder, words[0]), "w") as f:
                f.write(body)
    return wrong


def orders(folder):
    """Of the errors of T at 8, 16 and 32 cells."""
    error = []
    for n in (8, 16, 32):
        with open(os.path.join(folder, f"out/{n}/summary.json")) as f:
            error.append(float(re.search(r'"errors":\s*\{\s*"T":\s*\{[^}]*"l2":\s*([-+.0-9e]+)', f.read()).group(1)))
    return [math.log2(a / b) for a, b in zip(error, error[1:])], error


def main():
    log = []
    with open(os.path.join(SOURCE, "docs/plugin-guide.md")) as f:
        guide = f.read()
    with tempfile.TemporaryDirectory() as folder:
        wrong = follow(guide, folder, log)
        order, error = orders(folder)
    shown = ", ".join(f"{e:.3g}" for e in error) + "; orders " + ", ".join(f"{p:.2f}" for p in order)
    if min(order) < 2.5:
        wrong.append(f"errors of T {shown}, expected orders near 3")
    log.append(f"Errors of T in L2 with 8, 16, 32 cells: {shown}.\n")
    print("1..1")
    print(f"{'not ok' if wrong else 'ok'} 1 - the_guide_is_right_as_it_stands")
    print(f"# errors of T {shown}")
    for line in "\n".join(wrong).splitlines():
        print(f"# {line}")
    if len(sys.argv) > 2:
        with open(sys.argv[2], "w") as f:
            f.write("# plugin-guide.md, followed\n\nWhat `tests/cli/guide.py --log` did in an empty folder, from the first line "
                    "of the guide to the last.\n\n" + "\n".join(log))
    return bool(wrong)


sys.exit(main())
