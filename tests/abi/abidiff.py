#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Binary compatibility of the public headers by libabigail's abidiff: a library with all structs and enums of the newest
frozen headers, compiled against those and against the headers of now.  The one change allowed is growth of a struct behind
what it was.  layout.py reads the same from the text; this sees what the compiler makes of it.

    abidiff.py SOURCE

Suppressions of abidiff are of no use here: one for members at the end hides every other change of that struct, too.
"""
import glob
import os
import re
import shutil
import subprocess
import sys
import tempfile

COMPILE = [os.environ.get("CC", "gcc"), "-std=gnu11", "-w", "-g", "-O0", "-fPIC", "-shared"]
# What must be found, so that the comparison is known to see: file, text of now, text with the fault.
PLANTED = [
    ("plugin.h", "double t, dt, shift;", "double t, shift, dt;"),
    ("plugin.h", "uint32_t n_in, n_out,", "uint32_t n_in, n_new, n_out,"),
    ("plugin.h", "PF_CUT = 6,", "PF_CUT = 66,"),
    ("plugin.h", "const uint8_t *depends;", "const uint16_t *depends;"),
    ("plugin.h", "int (*check)(const void *params, char *err, size_t nerr);", "int (*check)(const void *params, char *err, int nerr);"),
    ("solver.h", "double bytes;", "float bytes;"),
    ("mesh.h", "uint32_t facet_vertices;", "uint64_t facet_vertices;"),
]


def uses(headers):
    """A source that has all their structs and enums, in functions that are exported."""
    lines = ["#include <plugflow/%s>" % name for name in sorted(headers)]
    for text in headers.values():
        text = re.sub(r"/\*.*?\*/", " ", text, flags=re.S)
        lines += ["void use_%s(%s *v) { (void)v; }" % (s, s) for s in re.findall(r"\}\s*(pf_\w+);", text)]
        lines += ["void use_enum_%s(enum %s v) { (void)v; }" % (e, e) for e in re.findall(r"\benum (pf_\w+) \{", text)]
    return "\n".join(dict.fromkeys(lines)) + "\n", sum(line.startswith("void") for line in set(lines))


def library(folder, name, headers, source):
    os.makedirs(os.path.join(folder, name, "plugflow"))
    for header, text in headers.items():
        with open(os.path.join(folder, name, "plugflow", header), "w", encoding="utf-8") as f:
            f.write(text)
    with open(os.path.join(folder, name, "all.c"), "w", encoding="utf-8") as f:
        f.write(source)
    out = os.path.join(folder, name, "all.so")
    made = subprocess.run(COMPILE + ["-I", os.path.join(folder, name), os.path.join(folder, name, "all.c"), "-o", out],
                          capture_output=True, text=True)
    return out, made.stderr if made.returncode else ""


def incompatible(report):
    """Lines of abidiff's report that are no growth at the end, each under the type that it belongs to."""
    wrong, subject, size = [], "", 0
    for line in report.splitlines():
        s = line.strip()
        counts = re.match(r"Removed/Changed/Added (?:functions|variables) summary: (\d+) Removed, (\d+) Changed", s)
        changed = re.fullmatch(r"type size changed from (\d+) to (\d+) \(in bits\)", s)
        inserted = re.fullmatch(r"'.*', at offset (\d+) \(in bits\)", s)
        if counts:
            wrong += [s] if counts.groups() != ("0", "0") else []
        elif re.fullmatch(r"'struct \w+' changed:", s):
            subject, size = s, sys.maxsize
        elif changed and line.startswith("  type"):
            size = int(changed[1])
            wrong += [subject + " " + s] if int(changed[2]) <= size else []
        elif inserted:
            wrong += [subject + " inserted, not at the end: " + s] if int(inserted[1]) < size else []
        elif s and not re.match(r"(Leaf changes summary|Changed leaf types summary): |\d+ data member insertions?:$", s):
            wrong.append(subject + " " + s)
    return wrong


def compare(folder, name, frozen, headers, source):
    now, error = library(folder, name, headers, source)
    if error:
        return ["what the frozen headers have does not compile any more: " + error]
    run = subprocess.run(["abidiff", "--leaf-changes-only", "--no-show-locs", frozen, now], capture_output=True, text=True)
    if run.returncode & 3:  # not compared; 4: there are changes, 8: incompatible ones
        return ["abidiff failed: " + run.stdout + run.stderr]
    return incompatible(run.stdout) + (["abidiff says that it is incompatible"] if run.returncode & 8 else [])


def read(path):
    with open(path, encoding="utf-8") as f:
        return f.read()


def main(source):
    if not shutil.which("abidiff"):
        print("skipped: there is no abidiff here (Debian package abigail-tools)")
        return 0
    newest = {}
    for path in sorted(glob.glob(os.path.join(source, "tests/abi/frozen/*_1_*.h")), key=lambda p: (len(p), p)):
        newest[os.path.basename(path).split("_1_")[0] + ".h"] = path
    before = {name: read(path) for name, path in newest.items()}
    now = {name: read(os.path.join(source, "include/plugflow", name)) for name in newest}
    text, n = uses(before)
    with tempfile.TemporaryDirectory() as folder:
        frozen, error = library(folder, "frozen", before, text)
        wrong = [error] if error else compare(folder, "now", frozen, now, text)
        for k, (header, old, new) in enumerate(PLANTED if not wrong else []):
            faulty = dict(now, **{header: now[header].replace(old, new)})
            if faulty == now or not compare(folder, "fault%d" % k, frozen, faulty, text):
                wrong.append("a planted fault is not found: %s: \"%s\" for \"%s\"" % (header, new, old))
    for line in wrong:
        print(line)
    print("%d structs and enums of %s: %s" % (n, ", ".join(sorted(os.path.basename(p) for p in newest.values())),
                                              "%d incompatible changes" % len(wrong) if wrong else "compatible"))
    return 1 if wrong or n < 20 else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
