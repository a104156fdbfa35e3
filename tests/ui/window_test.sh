#!/usr/bin/env bash
# The editor in a real window, by real mouse and key events:
#   window_test.sh PROGRAM STROKE_REGION DRIVER_RESET FOLDER
# Waits on the editor's state file (--state), never on time alone. Exit code 77: cannot run here.
set -u
program=$1
strokeRegion=$2
driverReset=$3
folder=$4

. "$(dirname "$0")/display.sh"
open_display "$folder" 1000x700 xdotool
model=builtin:sphere
bunny=${CELADON_MODELS:-}/mesh/bunny_watertight_60k.obj
[ -f "$bunny" ] && model=$bunny
state=$folder/state.json

fail() {
    echo "failed: $*" >&2
    cat "$state" >&2 2>/dev/null
    exit 1
}

# await SECONDS TEXT: until the state file holds TEXT.
await() {
    local end=$((SECONDS + $1))
    until grep -q -e "$2" "$state" 2>/dev/null; do
        [ $SECONDS -lt $end ] || fail "no $2 within $1 s"
        kill -0 "$editor" 2>/dev/null || fail "the editor ended while waiting for $2"
        sleep 0.05
    done
}

start() { # start ARGUMENTS: until the first picture is there
    rm -f "$state"
    "$program" edit "$model" --size 900x600 --quality draft --state "$state" "$@" 2>"$folder/stderr" &
    editor=$!
    await 60 '"open":true'
    await 60 '"rung":[0-9]'
}

kill_editor() { # nothing is said or saved
    kill -9 "$editor"
    wait "$editor" 2>/dev/null
    editor=
}

recover() { # recover STROKES: what the last process left, at the next start
    start
    await 30 '"asking":true'
    xdotool key Return # Recover
    await 60 "\"strokes\":$1"
}

stroke() { # a short stroke across the middle of the viewport
    xdotool mousemove 250 300 mousedown 1
    for x in 255 262 270 280 292 305; do
        xdotool mousemove "$x" 300
    done
    xdotool mouseup 1
}

save_as() { # save_as FILE [KEY]: the name that is proposed is typed over
    await 30 '"typing":false'
    xdotool key "${2:-ctrl+s}"
    await 30 '"typing":true'
    xdotool type --delay 20 "$1"
    xdotool key Return
}

# A stroke, undo, redo, save, close. What is saved differs exactly where the stroke was.
start --record "$folder/record.jsonl"
printf '{"command":"file.save","file":"%s"}\n' "$folder/before.subedit.exr" >"$folder/save.jsonl"
"$program" edit "$model" --size 400x300 --quality draft --replay "$folder/save.jsonl" \
    --exit-after-replay 2>"$folder/stderr" || fail "saving at once ended with $?"
xdotool key x # the secondary profile: another r_s is not needed
stroke
await 30 '"strokes":1'
await 30 '"modified":true'
xdotool key ctrl+z
await 30 '"strokes":0'
xdotool key ctrl+shift+z
await 30 '"strokes":1'
save_as "$folder/painted.subedit.exr"
await 30 '"modified":false'
[ -s "$folder/painted.subedit.exr" ] || fail "nothing was saved"
ls "$folder"/state/celadon/*.journal >/dev/null 2>&1 || fail "there is no journal"
xdotool key ctrl+q
wait "$editor" || fail "the editor ended with $?"
editor=
ls "$folder"/state/celadon/*.journal >/dev/null 2>&1 && fail "the journal was left behind"
grep -q '"command":"paint.edit"' "$folder/record.jsonl" || fail "the stroke was not recorded"
"$strokeRegion" "$model" "$folder/record.jsonl" "$folder/before.subedit.exr" \
    "$folder/painted.subedit.exr" || fail "the material differs elsewhere than under the stroke"

# The same commands give the same bytes, in another window.
sed "s|painted.subedit.exr|replayed.subedit.exr|" "$folder/record.jsonl" | grep -v file.open >"$folder/replay.jsonl"
"$program" edit "$model" --size 500x400 --quality draft --replay "$folder/replay.jsonl" \
    --exit-after-replay 2>"$folder/stderr" || fail "the replay ended with $?: $(cat "$folder/stderr")"
cmp "$folder/painted.subedit.exr" "$folder/replayed.subedit.exr" || fail "the replay painted something else"

# Killed in the middle of a stroke: what was finished comes back.
model=builtin:sphere
start
stroke
await 30 '"strokes":1'
xdotool mousemove 250 330 mousedown 1 mousemove 270 330
kill_editor
xdotool mouseup 1
recover 1
await 30 '"modified":true'

# Unsaved changes are asked about; a small window and a broken file do no harm.
window=$(xdotool search --onlyvisible --name Celadon | tail -1)
xdotool windowsize "$window" 330 330
await 30 '"settled":true'
xdotool windowsize "$window" 900 600
await 30 '"settled":true'
xdotool key ctrl+q
await 30 '"asking":true'
xdotool key Escape
await 30 '"asking":false'
kill -0 "$editor" || fail "Escape closed the editor"

# Keys are what stands on them: Z and Y have changed places here.
if command -v setxkbmap >/dev/null; then
    setxkbmap de
    xdotool key ctrl+z
    await 30 '"strokes":0'
    await 30 '"modified":false'
    xdotool key ctrl+y
    await 30 '"strokes":1'
    setxkbmap us
fi

# The window goes away and comes back; a broken file is refused in a notice; the work stays.
xdotool windowunmap "$window"
sleep 0.5
xdotool windowmap "$window"
await 30 '"settled":true'
printf 'v 0 0 0\nf 1 2 3\n' >"$folder/broken.obj"
xdotool key ctrl+z
await 30 '"modified":false'
xdotool key ctrl+o
await 30 '"typing":true'
xdotool type --delay 20 "$folder/broken.obj"
xdotool key Return
await 30 '"notices":".*broken.obj.*line 2'
xdotool key ctrl+shift+z
await 30 '"strokes":1'
if /usr/bin/python3 -c 'import Xlib' 2>/dev/null; then # files dragged from another window
    printf 'v 0 0 0\nf 1 2 4\n' >"$folder/dropped.obj"
    "$(dirname "$0")/drop_files.py" "$window" 300 300 "$folder/dropped.obj" || fail "no drop"
    await 30 '"asking":true' # there are changes that are not saved
    xdotool key Escape
    await 30 '"asking":false'
    xdotool key ctrl+z
    await 30 '"modified":false'
    "$(dirname "$0")/drop_files.py" "$window" 300 300 "$folder/dropped.obj" || fail "no drop"
    await 30 '"notices":".*dropped.obj.*line 2'
    xdotool key ctrl+shift+z
    await 30 '"strokes":1'
fi
kill_editor
rm -f "$folder"/state/celadon/*.journal

# A second save: the name that is proposed is typed over.
start
stroke
await 30 '"strokes":1'
save_as "$folder/first.subedit.exr"
await 30 'Saved .*first.subedit.exr'
save_as "$folder/again.exr" ctrl+shift+s
await 30 'Saved .*again.subedit.exr'
[ -s "$folder/again.subedit.exr" ] || fail "the second save went elsewhere"

# One drag is one step, though it leaves the model and comes back. Enter in the dialog opens, and does
# not answer the question that follows.
xdotool mousemove 280 300 mousedown 1
for place in "200 380" "100 480" "6 560" "100 480" "200 380" "280 300"; do
    xdotool mousemove $place
done
xdotool mouseup 1
await 30 '"strokes":2'
await 30 '"modified":true'
touch "$folder/other.obj"
xdotool key ctrl+o
await 30 '"typing":true'
xdotool type --delay 20 "$folder/other.obj"
xdotool key Return
await 30 '"typing":false'
await 30 '"asking":true'
xdotool key Escape
await 30 '"asking":false'
await 5 '"modified":true'
cmp "$folder/first.subedit.exr" "$folder/again.subedit.exr" || fail "Enter saved over a file"
xdotool key ctrl+z
await 30 '"strokes":1'
await 30 '"modified":false'
kill_editor
rm -f "$folder"/state/celadon/*.journal

# A full disk (a limit on the size of files, which fails alike): a notice, and nothing is lost.
(
    trap '' XFSZ
    ulimit -f 64
    exec "$program" edit "$model" --size 900x600 --quality draft --state "$state" 2>"$folder/stderr"
) &
editor=$!
rm -f "$state"
await 60 '"rung":[0-9]'
stroke
await 30 '"strokes":1'
save_as "$folder/full.subedit.exr"
await 30 '"asking":false'
await 30 'full.subedit.exr'
await 5 '"modified":true'
[ -e "$folder/full.subedit.exr" ] && fail "half a file was left behind"
kill_editor

# The graphics driver is reset: the program ends, says why, and the work is there at the next start.
rm -f "$folder"/state/celadon/*.journal "$folder/reset"
export CELADON_DRIVER_RESET=$folder/reset
LD_PRELOAD=$driverReset start
stroke
await 30 '"strokes":1'
touch "$folder/reset"
xdotool mousemove 300 300 mousemove 310 310
wait "$editor"
[ $? -eq 4 ] || fail "a reset of the driver did not end with 4"
grep -q 'driver was reset' "$folder/stderr" || fail "nothing was said of the reset"
rm "$folder/reset"
recover 1

# No size at all, and back.
window=$(xdotool search --onlyvisible --name Celadon | tail -1)
xdotool windowsize "$window" 1 1
sleep 0.5
xdotool windowsize "$window" 900 600
await 30 '"viewport":\[[0-9]*,[0-9]*,[1-9][0-9][0-9],'
await 30 '"settled":true'
kill_editor
rm -f "$folder"/state/celadon/*.journal

# Broken files that are dropped, the picture, a turntable, an export: by replay.
printf '%s\n' '{"command":"edit.fill"}' \
    "{\"command\":\"file.save\",\"file\":\"$folder/whole.subedit.exr\"}" \
    "{\"command\":\"export.picture\",\"file\":\"$folder/picture.png\"}" \
    "{\"command\":\"window.drop\",\"file\":\"$folder/broken.obj\"}" \
    "{\"command\":\"export.turntable\",\"file\":\"$folder/turn.png\",\"frames\":3,\"size\":[96,64]}" \
    "{\"command\":\"file.export\",\"file\":\"$folder/exported.gltf\"}" >"$folder/drops.jsonl"
"$program" edit "$model" --size 500x400 --quality draft --replay "$folder/drops.jsonl" \
    --screenshot-at "2:$folder/filled.png" --screenshot "$folder/drops.png" --exit-after-replay 2>"$folder/stderr" ||
    fail "the replay of drops ended with $?: $(cat "$folder/stderr")"
for file in filled.png picture.png turn_0001.png turn_0002.png turn_0003.png exported.gltf exported.bin \
    exported.subedit.exr drops.png; do
    [ -s "$folder/$file" ] || fail "$file is missing"
done
"$program" info "$folder/exported.gltf" >/dev/null || fail "the export cannot be read"

# A material that only a glTF names is saved over, then the process is killed: all strokes come back,
# and undoing them leads to the material as it was opened.
rm -f "$folder"/state/celadon/*.journal # of the process that was killed above
model=$folder/exported.gltf
printf '{"command":"file.save","file":"%s"}\n' "$folder/opened.subedit.exr" >"$folder/save.jsonl"
"$program" edit "$model" --size 400x300 --quality draft --replay "$folder/save.jsonl" \
    --exit-after-replay 2>"$folder/stderr" || fail "saving at once ended with $?"
start
xdotool key x
stroke
await 30 '"strokes":1'
await 30 '"modified":true'
xdotool key ctrl+s # the file that the glTF names
await 30 '"modified":false'
cmp -s "$folder/opened.subedit.exr" "$folder/exported.subedit.exr" && fail "the stroke was not saved"
stroke
await 30 '"strokes":2'
kill_editor
recover 2
xdotool key ctrl+z ctrl+z
await 30 '"strokes":0'
save_as "$folder/undone.subedit.exr"
await 30 undone.subedit.exr
xdotool key ctrl+q
wait "$editor" || fail "the editor ended with $?"
editor=
cmp "$folder/opened.subedit.exr" "$folder/undone.subedit.exr" ||
    fail "what was recovered did not begin with the material as it was opened"
echo "passed in $SECONDS s"
