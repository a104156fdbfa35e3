#!/usr/bin/env bash
# How fluent motion is in a real window, at 1280x720:
#   motion_speed.sh PROGRAM FOLDER [SECONDS]
# Plays a skinned model (CesiumMan of CELADON_MODELS, else a vase with a keyed twist) for so long, and
# drags a handle and a control point of a lattice by real mouse events. Prints pictures per second of
# each, and fails where pictures do not follow: below 4 a second, or where undo does not take a drag
# back. Leaves pictures in FOLDER. Wants a quiet machine. Exit code 77: cannot run here.
set -u
program=$1
folder=$2
seconds=${3:-4}

. "$(dirname "$0")/display.sh"
open_display "$folder" 1280x720 xdotool
state=$folder/state.json

fail() {
    echo "failed: $*" >&2
    cat "$state" >&2 2>/dev/null
    exit 1
}
field() { sed -n "s/.*\"$1\":\(\[[^]]*\]\|[^,}]*\).*/\1/p" "$state" 2>/dev/null; }
now() { date +%s%N; }
await() { # await SECONDS FIELD TEST VALUE
    local end=$((SECONDS + $1))
    until [ "$(field "$2")" "$3" "$4" ] 2>/dev/null; do
        [ $SECONDS -lt $end ] || fail "$2 is $(field "$2") after $1 s"
        sleep 0.02
    done
}
rate() { # rate PICTURES NANOSECONDS
    echo "scale=1; $1 * 1000000000 / $2" | bc
}
start() { # start MODEL COMMANDS...: the editor with the Deform tab open, when it is at rest
    local model=$1
    shift
    printf '%s\n' '{"command":"window.tab","name":"deform"}' "$@" >"$folder/setup.jsonl"
    rm -f "$state"
    "$program" edit "$model" --size 1280x720 --quality draft --replay "$folder/setup.jsonl" \
        --state "$state" 2>"$folder/stderr" &
    editor=$!
    await 60 replayed -eq $(($# + 1))
    await 60 settled = true
    sleep 1 # what a moving hand will need is rehearsed
}
stop() {
    kill "$editor"
    wait "$editor" 2>/dev/null
    editor=
}
picture() { # picture NAME: of the screen
    command -v import >/dev/null && import -window root "$folder/$1.png"
}

model=builtin:vase
keys=('{"command":"deform.add","type":"twist"}'
    '{"command":"deform.key","deformer":0,"seconds":0}'
    '{"command":"deform.change","deformer":0,"amount":-45,"seconds":2}')
if [ -f "${CELADON_MODELS:-}/gltf/CesiumMan.glb" ]; then
    model=$CELADON_MODELS/gltf/CesiumMan.glb
    keys=()
fi
start "$model" "${keys[@]}"
xdotool mousemove 200 300 key space
await 10 playing = true
sleep 0.5
before=$(field pictures)
begin=$(now)
sleep "$seconds"
playback=$(rate $(($(field pictures) - before)) $(($(now) - begin)))
picture playing
xdotool key space
await 10 playing = false
await 30 settled = true
picture stopped
stop

# drag: moves what is chosen to and fro; prints pictures per second.
drag() {
    local at x y before begin end i
    at=$(field control)
    at=${at#[}
    x=${at%%,*}
    y=${at#*,}
    y=${y%]}
    x=${x%.*}
    y=${y%.*}
    xdotool mousemove "$x" "$y" mousedown 1
    before=$(field pictures)
    begin=$(now)
    end=$((begin + seconds * 1000000000))
    i=0
    while [ "$(now)" -lt "$end" ]; do
        i=$((i + 1))
        xdotool mousemove $((x + (i < 60 ? i : 60) - i / 20 % 2)) $((y - i % 30))
        sleep 0.012
    done
    rate $(($(field pictures) - before)) $(($(now) - begin))
    xdotool mouseup 1
}
finish() { # finish NAME: the drag is one step that undo takes back
    await 30 settled = true
    picture "$1"
    local moved
    moved=$(field control)
    xdotool key ctrl+z
    await 10 undo = "$2"
    await 30 settled = true
    picture "$1"_undone
    [ "$(field control)" != "$moved" ] || fail "undo left $1 where it was"
    stop
}
start builtin:vase '{"command":"deform.handle.add","at":[0,-50,0],"radius":15}' \
    '{"command":"deform.handle.add","at":[0,50,0],"radius":15}'
handle=$(drag)
finish handle true
start builtin:vase '{"command":"deform.add","type":"lattice"}' \
    '{"command":"deform.select","deformer":0,"control":17}'
lattice=$(drag)
finish lattice true

echo "$playback pictures/s of playback (${model##*/}), $handle while a handle is dragged, $lattice while a control point is"
[ "$(echo "$playback >= 4 && $handle >= 4 && $lattice >= 4" | bc)" = 1 ]
