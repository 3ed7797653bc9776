# SPDX-License-Identifier: GPL-3.0-or-later
# Benchmarks: seconds by phase of fixed problems, one thread and all. Usage: bench.sh PROGRAM
set -eu
plugflow=$1
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

number() { sed -n "s/.*\"$1\": \([0-9.e+-]*\).*/\1/p" "$out/o/summary.json" | head -n 1; }

printf '%-34s %8s %8s %7s %9s %8s %8s %9s\n' problem threads unknowns newton assemble factor total peak_MB
bench() {
    name=$1
    shift
    for threads in 1 "$(nproc)"; do
        "$plugflow" run "$@" --quiet --threads "$threads" --out "$out/o" >/dev/null
        printf '%-34s %8s %8s %7s %9.2f %8.2f %8.2f %9.0f\n' "$name" "$threads" "$(number unknowns)" "$(number newton_iterations)" \
            "$(number assemble)" "$(number factor)" "$(number total)" "$(number peak_memory_bytes | awk '{print $1 / 1e6}')"
    done
}
bench "cavity 2D 96^2, Re 100" cases/cavity2d.lua --set n=96
bench "cavity 3D 8^3 hexes, Re 100" cases/cavity3d.lua --set n=8
bench "cavity 3D 12^3 hexes, Re 100" cases/cavity3d.lua --set n=12
bench "cavity 3D 6^3 x 6 tets, Re 100" cases/cavity3d.lua --set n=6 --set shape=tets
bench "Taylor-Green 48^2, 50 steps" cases/taylor_green.lua --set n=48 --set dt=0.01
