#!/usr/bin/env bash
# Painting for a long time: painting_soak.sh PROGRAM FOLDER SECONDS
# Replays strokes with all kinds of operators again and again in a real window, each waiting for its
# light to be on screen, undoing now and then as hands do. Leaves FOLDER/painting_soak.svg (time of a
# stroke, and memory) and the numbers beside it. Fails where a stroke of the last third takes a
# quarter more processor time than one of the first, or where memory in the last third is more than a
# twentieth above the middle one's. An hour: SECONDS = 3600; undoing may take 256 MB, which it
# reaches on the way. Exit code 77: cannot run here.
set -u
program=$1
folder=$2
seconds=$3

. "$(dirname "$0")/display.sh"
open_display "$folder" 1280x720
mkdir -p "$folder/config/celadon"
echo '{"undoMegabytes": 256}' >"$folder/config/celadon/preferences.json"

# Strokes around the vase's belly: 40 points each, every fifth taken back and done again.
awk 'BEGIN {
    n = split("scale-albedo tint scale-range mix", op, " ")
    for (i = 0; i < 60; ++i) {
        name = op[i % n + 1]
        if (name == "scale-albedo") o = "{\"name\":\"scale-albedo\",\"factor\":[0.9,0.95,1.1]}"
        if (name == "tint") o = "{\"name\":\"tint\",\"color\":[0.4,0.9,0.5],\"amount\":0.5}"
        if (name == "scale-range") o = "{\"name\":\"scale-range\",\"factor\":[0.9,0.9,0.9]}"
        if (name == "mix") o = "{\"name\":\"mix\",\"profile\":{\"albedo\":[0.6,0.5,0.3],\"effectiveRadiusMm\":[5,4,3]},\"amount\":0.4}"
        path = ""
        for (k = 0; k < 40; ++k) {
            a = 0.7 * i + 0.02 * k
            path = path (k ? "," : "") sprintf("{\"positionMm\":[%.4f,%.4f,%.4f]}", 38 * sin(a), 50 + 20 * sin(0.9 * i), 38 * cos(a))
        }
        printf "{\"command\":\"paint.edit\",\"material\":0,\"edit\":{\"command\":\"stroke\",\"operator\":%s,\"brush\":{\"radiusMm\":12,\"flow\":0.5},\"path\":[%s]}}\n", o, path
        if (i % 5 == 4) print "{\"command\":\"edit.undo\"}\n{\"command\":\"edit.redo\"}"
    }
}' >"$folder/strokes.jsonl"

"$program" edit --size 1280x720 --quality draft --replay "$folder/strokes.jsonl" \
    --repeat-for "$seconds" --trace "$folder/painting_soak.svg" --exit-after-replay || exit 1

# Medians of the thirds, after the first tenth, which warms up.
awk -F, 'NR > 1 { t[n] = $4; w[n] = $2 + $3; m[n] = $5; ++n }
function median(a, from, to,   i, j, k, b) {
    k = 0
    for (i = from; i < to; ++i) { # insertion: a few hundred values
        for (j = k++; j > 0 && b[j] > a[i]; --j) b[j + 1] = b[j]
        b[j + 1] = a[i]
    }
    return b[int((k + 1) / 2)]
}
END {
    s = int(n / 10); third = int((n - s) / 3)
    t1 = median(t, s, s + third); t3 = median(t, n - third, n)
    w1 = median(w, s, s + third); w3 = median(w, n - third, n)
    m1 = median(m, s, s + third); m2 = median(m, s + third, n - third); m3 = median(m, n - third, n)
    printf "%d commands; processor time of a stroke %.0f ms, at the end %.0f ms; on the clock %.0f and %.0f ms; memory of the thirds %.0f, %.0f and %.0f MB\n", n, t1, t3, w1, w3, m1, m2, m3
    exit !(t3 <= 1.25 * t1 && m3 <= 1.05 * m2)
}' "$folder/painting_soak.csv"
