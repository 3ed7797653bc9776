#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Structs and enumerators of the public headers grow at the end only: what each frozen header has stands first, in the
same order and of the same type, in the header of now.

    layout.py SOURCE
"""
import glob
import os
import re
import sys


def members(body):
    """(type, declarator) of every member, in order."""
    for statement in re.sub(r"\s+", " ", body).split(";"):
        statement = statement.strip()
        if not statement:
            continue
        if "(" in statement:  # a function
            yield ("", statement)
            continue
        first, *others = [s.strip() for s in statement.split(",")]
        kind, name = re.match(r"(.*?)\s*(\**(?:const )?\**\w+(?:\[\w+\])*)$", first).groups()
        stem = kind.rstrip("* ")
        stars = "*" * kind.count("*")
        yield (stem, stars + name)
        for other in others:
            yield (stem, other)


def parts(path):
    text = re.sub(r"/\*.*?\*/", " ", open(path, encoding="utf-8").read(), flags=re.S)
    structs = {m.group(1): list(members(m.group(2))) for m in re.finditer(r"typedef struct (\w+) \{(.*?)\}\s*\w+;", text, re.S)}
    values = dict(re.findall(r"\b(PF_\w+)\s*=\s*(-?\d\w*(?:\s*<<\s*\d+)?)", " ".join(re.findall(r"enum \w* ?\{(.*?)\}", text, re.S))))
    return structs, values


def main(source):
    wrong, n = [], 0
    frozen = sorted(glob.glob(os.path.join(source, "tests/abi/frozen/*_1_*.h")))
    for path in frozen:
        name = os.path.basename(path).split("_1_")[0] + ".h"
        now_structs, now_values = parts(os.path.join(source, "include/plugflow", name))
        structs, values = parts(path)
        for struct, was in structs.items():
            has = now_structs.get(struct, [])
            for i, member in enumerate(was):
                n += 1
                if i >= len(has) or has[i] != member:
                    wrong.append("%s: member %d of %s was \"%s %s\" in %s, is %s" % (
                        name, i, struct, *member, os.path.basename(path), '"%s %s"' % has[i] if i < len(has) else "gone"))
                    break
        for key, value in values.items():
            n += 1
            if now_values.get(key) != value:
                wrong.append("%s: %s was %s in %s, is %s" % (name, key, value, os.path.basename(path), now_values.get(key)))
    for line in wrong:
        print("# " + line)
    ok = not wrong and n > 400 and len(frozen) >= 6
    print("1..1\n%s 1 - %d members and values of %d frozen headers stand where they stood" % ("ok" if ok else "not ok", n, len(frozen)))
    return 0 if ok else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
