#!/usr/bin/env bash
# Splatting against the image reference for every shipped material on bunny, buddha and spot, at
# default settings: relative RMSE and mean ratio of the exitance, both schemes. Half an hour.
#
#     CELADON_MODELS=DIR tests/renderer/splatting/material_pairs.sh PROGRAM FOLDER [MODEL ...]
#
# The pictures (PNG) and the table (pairs.txt) go into FOLDER. Ends with 1 where the error is above
# 1 % or the mean off by more than 0.3 %.
set -euo pipefail
program=$(realpath "$1")
mkdir -p "$2"
cd "$2"
shift 2
models=("$@")
[ ${#models[@]} -gt 0 ] || models=(bunny_watertight_60k.obj happy_buddha_100k.obj spot_uv.obj)
status=0
render() { # MODEL MATERIAL OUT [OPTION ...]
    "$program" render "$CELADON_MODELS/mesh/$1" --material "$2" -o "$3" --size 320x240 --aov \
        --light directional:-0.4,-0.5,-0.77 "${@:4}" >/dev/null
}
printf '%-26s %-18s %-13s %8s %8s\n' model material scheme rmse% mean | tee pairs.txt
for model in "${models[@]}"; do
    for material in marble skin1 skin2 cream wholemilk ketchup apple potato jade yellow_wax \
        blue_wax banded_onyx artificial_stone veined_marble marble_chessboard; do
        render "$model" "$material" reference.exr --solver image-reference
        for scheme in hierarchical paper; do
            render "$model" "$material" picture.exr --scheme $scheme
            "$program" compare picture.exr reference.exr --layer exitance \
                --metric relative-rmse,mean-ratio >numbers.txt
            awk -v model="$model" -v material="$material" -v scheme=$scheme '
                $1 == "relativeRmse" { rmse = $2 } $1 == "meanRatio" { mean = $2 }
                END {
                    bad = rmse > 0.01 || mean > 1.003 || mean < 0.997
                    printf "%-26s %-18s %-13s %8.3f %8.5f%s\n", model, material, scheme,
                        rmse * 100, mean, bad ? "  <-" : ""
                    exit bad
                }' numbers.txt | tee -a pairs.txt || status=1
        done
        "$program" render "$CELADON_MODELS/mesh/$model" --material "$material" --size 320x240 \
            --light directional:-0.4,-0.5,-0.77 -o "${model%%_*}_$material.png" >/dev/null
    done
done
rm -f reference.exr picture.exr numbers.txt
exit $status
