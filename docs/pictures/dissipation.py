#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws -dE/dt of runs of cases/taylor_green3d.lua over time, beside the dissipation of a direct simulation, as SVG.

    docs/pictures/dissipation.py OUT.svg NAME=FOLDER ...

E is the mean kinetic energy of each accepted step in FOLDER/run.jsonl (density 1, a box of pi^3)."""
import csv
import json
import math
import os
import sys

WIDTH, HEIGHT, LEFT, BOTTOM, TOP = 640, 400, 70, 50, 20
T_MOST, D_MOST = 10, 0.02
COLOURS = ["#440154", "#31688e", "#35b779", "#d08000"]


def rates(folder):
    t, e = [0.0], [0.125]
    with open(os.path.join(folder, "run.jsonl"), encoding="utf-8") as f:
        for line in f:
            event = json.loads(line)
            if event["event"] == "solve":
                t.append(event["t"])
                e.append(event["energy"] / math.pi**3)
    return [((a + b) / 2, (p - q) / (b - a)) for a, b, p, q in zip(t, t[1:], e, e[1:]) if a > 0.3]


def reference(root):
    with open(os.path.join(root, "tests/verify/reference/dairay2017_taylor_green_re1600.csv"), encoding="utf-8") as f:
        rows = csv.reader(line for line in f if not line.startswith("#"))
        return [(float(r[0]), float(r[2])) for r in rows if r[0][0].isdigit() and r[2]] + [(8, 0.0103729838977), (8.98, 0.01285)]


def place(t, d):
    return LEFT + t / T_MOST * (WIDTH - LEFT - 20), HEIGHT - BOTTOM - d / D_MOST * (HEIGHT - BOTTOM - TOP)


def main():
    out, runs = sys.argv[1], [a.split("=", 1) for a in sys.argv[2:]]
    svg = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" font-family="sans-serif" font-size="13">',
           '<rect width="100%" height="100%" fill="white"/>']
    for k in range(6):
        (x, y), (x1, _) = place(0, k * 0.004), place(T_MOST, 0)
        svg.append(f'<path d="M{x} {y}H{x1}" stroke="#ddd"/><text x="{x - 8}" y="{y + 4}" text-anchor="end">{k * 0.004:g}</text>')
        x, y = place(2 * k, 0)
        svg.append(f'<text x="{x}" y="{y + 18}" text-anchor="middle">{2 * k}</text>')
    svg.append(f'<text x="{WIDTH / 2}" y="{HEIGHT - 10}" text-anchor="middle">t</text>'
               f'<text x="16" y="{HEIGHT / 2}" transform="rotate(-90 16 {HEIGHT / 2})" text-anchor="middle">-dE/dt</text>')
    for i, (name, folder) in enumerate(runs):
        points = " ".join("%.1f,%.1f" % place(t, d) for t, d in rates(folder))
        svg.append(f'<polyline points="{points}" fill="none" stroke="{COLOURS[i % 4]}" stroke-width="1.8"/>'
                   f'<text x="{LEFT + 20}" y="{TOP + 20 + 18 * i}" fill="{COLOURS[i % 4]}">{name}</text>')
    for t, d in reference(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../..")):
        x, y = place(t, d)
        svg.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3.5" fill="black"/>')
    svg.append(f'<text x="{LEFT + 20}" y="{TOP + 20 + 18 * len(runs)}">&#9679; direct simulation, Dairay et al. 2017</text></svg>')
    with open(out, "w", encoding="utf-8") as f:
        f.write("\n".join(svg) + "\n")


main()
