#!/bin/bash
# How long Cycles' random walk (Debian's package blender) needs for a picture of 2 % noise of a medium
# lit by a sun, from the front and from behind. The noise is that of two pictures of different seeds;
# it falls as one over the square root of time.
#   tests/renderer/reference/cycles_time.sh build/release/celadon MODEL.ply FOLDER [SAMPLES]
set -euo pipefail
program=$(realpath "$1")
model=$(realpath "$2")
folder=$3
samples=${4:-16}
mkdir -p "$folder"
folder=$(realpath "$folder")
script=$(dirname "$(realpath "$0")")/cycles_time.py
command -v blender > /dev/null || { echo "blender is not installed" >&2; exit 1; }

for path in 0.01 0.05; do
    for back in 0 1; do
        log="$folder/cycles.log"
        blender -b -P "$script" -- "$model" "$folder" "$path" "$back" 1 "$samples" "$samples" > "$log" 2>&1
        seconds=$(awk '/^CYCLES/ { n = $3 } END { print n }' "$log")
        noise=$("$program" compare "$folder/cycles_1.exr" "$folder/cycles_2.exr" --metric relative-rmse |
            awk '{ print $NF }')
        awk -v path="$path" -v back="$back" -v t="$seconds" -v e="$noise" -v n="$samples" 'BEGIN {
            e /= sqrt(2)
            printf "free path %s of the radius, %s: %d samples %.1f s, noise %.2f %%; 2 %% after %.0f s\n",
                path, back == 1 ? "back lit" : "front lit", n, t, 100 * e, t * (e / 0.02) ^ 2 }'
    done
done
