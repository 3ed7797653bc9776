#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Holds core/ to its architecture (docs/architecture.md): which folder may use which, no circles between the files of a
folder, sizes of files and functions, no mutable globals.  Reads the sources and the built library; prints TAP."""
import os
import re
import subprocess
import sys

SOURCE = os.environ.get("PLUGFLOW_SOURCE", ".")
BUILD = os.environ.get("PLUGFLOW_BUILD", "build")
MOST_LINES, MOST_IN_FUNCTION = 400, 60
# What must be global for a signal handler: one struct (core/base/process.h).
ALLOWED_GLOBALS = {"process"}

COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*", re.S)
STRING = re.compile(r'"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\'')
# A definition at column 0 that ends in "{" on a line of its own.
DEFINITION = re.compile(r"^([A-Za-z_][^\n;{}=#]*?)\b([A-Za-z_]\w*)\(([^;{}]*)\)\s*\n\{", re.M)


def blank(match):
    """The same number of lines, without content."""
    return "\n" * match.group(0).count("\n")


class File:
    def __init__(self, path):
        self.path = path
        self.folder = path.split("/")[1]
        with open(os.path.join(SOURCE, path)) as f:
            self.text = f.read()
        plain = COMMENT.sub(blank, self.text)
        self.includes = re.findall(r'^#include "([^"]+)"', plain, re.M)
        self.code = STRING.sub('""', plain)
        self.public, self.long = [], []
        for m in DEFINITION.finditer(self.code):
            first = self.code.count("\n", 0, m.start()) + 1
            end = self.code.find("\n}", m.end())
            lines = self.code.count("\n", m.end(), end)
            if not re.search(r"\bstatic\b", m.group(1)):
                self.public.append(m.group(2))
            if lines > MOST_IN_FUNCTION:
                self.long.append(f"{path}:{first}: {m.group(2)} has {lines} lines")
        self.words = set(re.findall(r"[A-Za-z_]\w*", self.code))


def floors():
    order = {}
    with open(os.path.join(SOURCE, "core/floors.txt")) as f:
        lines = [line.split() for line in f if line.strip() and not line.startswith("#")]
    for height, names in enumerate(reversed(lines)):
        for name in names:
            order[name] = height
    return order


def read_core():
    files = []
    for root, _, names in os.walk(os.path.join(SOURCE, "core")):
        for name in sorted(names):
            if name.endswith((".c", ".h")) and root != os.path.join(SOURCE, "core"):
                files.append(File(os.path.relpath(os.path.join(root, name), SOURCE)))
    return files


def arrows(files):
    """For each .c file the .c files that define what it calls: {path: {path: name}}."""
    owner = {name: f for f in files if f.path.endswith(".c") for name in f.public}
    uses = {}
    for f in files:
        if f.path.endswith(".c"):
            uses[f.path] = {}
            for word in f.words & owner.keys():
                if owner[word] is not f:
                    uses[f.path][owner[word].path] = word
    return uses


def may_use(order, a, b):
    return a == b or order[a] > order[b]


def every_folder_has_a_floor(files, order, uses):
    return [f"core/{f.folder} does not stand in core/floors.txt" for f in files if f.folder not in order]


def includes_go_down(files, order, uses):
    wrong = []
    for f in files:
        for name in f.includes:
            folder = name.split("/")[0]
            if "/" in name and folder in order and not may_use(order, f.folder, folder):
                wrong.append(f"{f.path} includes {name}")
    return wrong


def calls_go_down(files, order, uses):
    wrong = []
    for a, to in uses.items():
        for b, name in to.items():
            if not may_use(order, a.split("/")[1], b.split("/")[1]):
                wrong.append(f"{a} calls {name} of {b}")
    return wrong


def no_circles_within_a_folder(files, order, uses):
    wrong, done = [], set()

    def visit(path, trail):
        if path in trail:
            wrong.append(" -> ".join(trail[trail.index(path):] + [path]))
            return
        if path in done:
            return
        for other in sorted(uses.get(path, {})):
            if os.path.dirname(other) == os.path.dirname(path):
                visit(other, trail + [path])
        done.add(path)

    for path in sorted(uses):
        visit(path, [])
    return wrong


def only_problem_functions_use_lua(files, order, uses):
    """Lua belongs to case/ and describe/, and to the function results(...)."""
    return [f"{f.path} includes Lua" for f in files
            if re.search(r"#include <(lua|lauxlib|lualib)\.h>", f.text) and f.folder not in ("case", "describe")
            and not f.path.startswith("core/run/results")]


def files_and_functions_are_short(files, order, uses):
    wrong = [f"{f.path} has {f.text.count(chr(10))} lines" for f in files if f.text.count("\n") > MOST_LINES]
    return wrong + [line for f in files for line in f.long]


def problem_only_composes(files, order, uses):
    lines = sum(f.text.count("\n") for f in files if f.folder == "problem")
    return [f"core/problem has {lines} lines, 500 are too many"] if lines >= 500 else []


def no_mutable_globals(files, order, uses):
    """Objects in the writable sections of the library."""
    library = os.path.join(BUILD, "core", "libplugflow.so")
    sections = {}
    for m in re.finditer(r"^\s*\[\s*(\d+)\]\s+(\S+)",
                         subprocess.run(["readelf", "-SW", library], capture_output=True, text=True, check=True).stdout, re.M):
        sections[m.group(1)] = m.group(2)
    wrong = set()
    table = subprocess.run(["readelf", "-sW", library], capture_output=True, text=True, check=True).stdout
    if "OBJECT" not in table:
        return ["the library has no symbols; was it stripped?"]
    for line in table.splitlines():
        part = line.split()
        if len(part) >= 8 and part[3] in ("OBJECT", "TLS") and sections.get(part[6]) in (".data", ".bss", ".tbss", ".tdata"):
            name = part[7].split("@")[0]
            if name.split(".")[0] not in ALLOWED_GLOBALS and not name.startswith("__") and name != "completed.0":
                wrong.add(f"{name} in {sections[part[6]]} can change")
    return sorted(wrong)


def main():
    files, order = read_core(), floors()
    uses = arrows(files)
    tests = [every_folder_has_a_floor, includes_go_down, calls_go_down, no_circles_within_a_folder,
             only_problem_functions_use_lua, files_and_functions_are_short, problem_only_composes, no_mutable_globals]
    failed = 0
    print(f"1..{len(tests)}")
    for i, test in enumerate(tests, 1):
        wrong = test(files, order, uses)
        failed += bool(wrong)
        print(f"{'not ok' if wrong else 'ok'} {i} - {test.__name__}")
        for line in wrong[:40]:
            print(f"# {line}")
    return failed > 0


sys.exit(main())
