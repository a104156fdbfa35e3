#!/usr/bin/env bash
# Pictures of every panel and view, to be looked at: panel_pictures.sh PROGRAM FOLDER [quick]
# At 1280x720, 1920x1080 and at 200 % scale (1920x1080); with quick, at 1280x720 only. Fails where a
# picture is missing, or empty (of one color). Exit code 77: cannot run here.
set -u
program=$1
folder=$2
mode=${3:-all}

. "$(dirname "$0")/display.sh"
open_display "$folder" 1920x1080

# Each line: name of the picture, then the commands that lead to it, separated by tabs.
steps=$folder/steps.txt
tab() { printf '{"command":"window.tab","name":"%s"}' "$1"; }
view() { printf '{"command":"view.mode","name":"%s"%s}' "$1" "${2:-}"; }
{
    printf 'first\n'
    printf 'brush_lower\t{"command":"window.scroll","to":1}\n'
    printf 'brush_cursor\t{"command":"window.scroll","to":0}\t{"command":"window.cursor","place":[0.47,0.55]}\n'
    printf 'scribble\t{"command":"tool.choose","name":"scribble"}\n'
    printf 'stamp\t{"command":"tool.choose","name":"stamp"}\n'
    printf 'stamp_picture\t{"command":"stamp.open","file":"%s"}\n' "$folder/1280x720/first.png"
    printf 'clone\t{"command":"tool.choose","name":"paint"}\t{"command":"operator.change","name":"clone"}\t{"command":"clone.source","position":[13.464,31.261,24.724],"normal":[0.832,-0.113,0.544]}\n'
    printf 'gradient\t{"command":"tool.choose","name":"paint"}\t{"command":"operator.change","name":"gradient"}\t{"command":"gradient.line","from":[-30,20,40],"to":[30,80,20]}\n'
    printf 'profile\t{"command":"operator.change","name":"profile"}\t%s\n' "$(tab profile)"
    printf 'profile_lower\t{"command":"window.scroll","to":1}\n'
    printf 'material\t%s\n' "$(tab material)"
    printf 'material_lower\t{"command":"window.scroll","to":1}\n'
    printf 'light\t%s\t{"command":"window.scroll","to":0}\n' "$(tab light)"
    printf 'light_spot\t{"command":"light.add","kind":"point"}\t{"command":"light.add","kind":"spot"}\t{"command":"light.select","light":3}\n'
    environment=${CELADON_MODELS:-}/env/forest_zip_half.exr
    [ -f "$environment" ] && printf 'light_environment\t{"command":"environment.open","file":"%s"}\t{"command":"window.scroll","to":1}\n' "$environment"
    printf 'deform\t{"command":"environment.close"}\t{"command":"light.preset","name":"back"}\t{"command":"window.scroll","to":0}\t%s\n' "$(tab deform)"
    printf 'deform_amount\t{"command":"deform.add","type":"wave"}\t{"command":"deform.add","type":"twist"}\t{"command":"deform.key","deformer":1,"seconds":0}\t{"command":"deform.key","deformer":1,"seconds":2}\n'
    printf 'deform_lower\t{"command":"window.scroll","to":1}\n'
    printf 'deform_lattice\t{"command":"window.scroll","to":0}\t{"command":"deform.add","type":"lattice"}\t{"command":"deform.point","deformer":2,"point":[1,2,1],"by":[0,20,0]}\n'
    printf 'deform_handles\t{"command":"deform.handle.add","at":[0,50,0],"radius":15}\t{"command":"deform.handle.add","at":[0,-50,0],"radius":15}\t{"command":"deform.handle.change","handle":0,"move":[25,-10,0],"turnDegrees":[0,0,-30]}\n'
    printf 'deform_handles_lower\t{"command":"window.scroll","to":1}\n'
    printf 'view\t{"command":"deform.stack","deformers":[]}\t{"command":"window.scroll","to":0}\t%s\n' "$(tab view)"
    printf 'view_lower\t{"command":"window.scroll","to":1}\n'
    printf 'selection\t{"command":"window.scroll","to":0}\t{"command":"select.similar","position":[13.464,31.261,24.724],"normal":[0.832,-0.113,0.544],"tolerance":0.05}\n'
    printf 'exitance\t{"command":"select.change","what":"all"}\t%s\n' "$(view exitance)"
    printf 'level\t%s\n' "$(view level ',"level":3')"
    printf 'radius\t%s\n' "$(view radius)"
    printf 'albedo\t%s\n' "$(view albedo)"
    printf 'normals\t%s\n' "$(view normals)"
    printf 'uv\t%s\n' "$(view uv)"
    printf 'atlas\t%s\n' "$(view atlas)"
    printf 'irradiance\t%s\n' "$(view irradiance ',"level":0')"
    printf 'irradiance_mip\t%s\n' "$(view irradiance ',"level":4')"
    printf 'samples\t%s\n' "$(view samples ',"distance":12')"
    printf 'difference\t%s\n' "$(view difference)"
    printf 'menu_file\t%s\t{"command":"window.menu","name":"file"}\n' "$(view picture)"
    printf 'menu_edit\t{"command":"window.menu","name":"edit"}\n'
    printf 'menu_view\t{"command":"window.menu","name":"view"}\n'
    printf 'menu_help\t{"command":"window.menu","name":"help"}\n'
    printf 'help\t{"command":"window.menu","name":"none"}\t{"command":"window.show","help":true}\n'
    printf 'preferences\t{"command":"window.show","help":false,"preferences":true}\n'
    printf 'hidden\t{"command":"window.show","preferences":false,"panels":false}\n'
    printf 'notice\t{"command":"window.show","panels":true}\t{"command":"select.change","what":"none"}\t{"command":"edit.fill"}\n'
    printf 'question\t{"command":"window.dialog","name":"unsaved"}\n'
    printf 'dialog\t{"command":"window.dialog","name":"save"}\n'
} >"$steps"
sed 's/^[^\t]*\t*//' "$steps" | tr '\t' '\n' | grep . >"$folder/commands.jsonl"

take() { # take NAME SIZE SCALE
    local options=() number=0
    mkdir -p "$folder/$1"
    while IFS=$'\t' read -r -a fields; do
        number=$((number + ${#fields[@]} - 1))
        options+=(--screenshot-at "$number:$folder/$1/${fields[0]}.png")
    done <"$steps"
    "$program" edit --size "$2" --ui-scale "$3" --quality draft --replay "$folder/commands.jsonl" \
        "${options[@]}" --exit-after-replay || exit 1
    while IFS=$'\t' read -r -a fields; do
        # One color in all would take some 5 kB.
        [ "$(stat -c %s "$folder/$1/${fields[0]}.png" 2>/dev/null || echo 0)" -gt 30000 ] || {
            echo "$1/${fields[0]}.png is missing or empty"
            exit 1
        }
    done <"$steps"
}
take 1280x720 1280x720 1
if [ "$mode" = all ]; then
    take 1920x1080 1920x1080 1
    take scale200 1920x1080 2
fi
echo "$(find "$folder" -name '*.png' -path "$folder/[1s]*" | wc -l) pictures in $folder"
