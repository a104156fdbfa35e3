#!/usr/bin/env bash
# A pen with pressure paints in the editor's window, from the driver of an X server down:
#   pen_test.sh PROGRAM FOLDER
# Exit code 77: cannot run here. It takes an X server that may use its input drivers, and so root.
set -u
program=$1
folder=$2
source=$(cd "$(dirname "$0")" && pwd)
. "$source/display.sh"
for tool in Xorg python3; do
    command -v "$tool" >/dev/null || { echo "skipped: $tool is missing"; exit 77; }
done
own_folders "$folder"
state=$folder/state.json
width=1024
height=768

fail() {
    echo "failed: $*" >&2
    tail -5 "$folder/Xorg.log" "$folder/stderr" "$state" >&2 2>/dev/null
    exit 1
}

await() { # await TEXT: until the state file holds it
    local end=$((SECONDS + 60))
    until grep -q -e "$1" "$state" 2>/dev/null; do
        [ $SECONDS -lt $end ] || fail "no $1 within a minute"
        sleep 0.05
    done
}

device() { # device NAME SOCKET HAS_PRESSURE
    printf 'Section "InputDevice"\n Identifier "%s"\n Driver "inputtest"\n' "$1"
    printf ' Option "SocketPath" "%s"\n Option "DeviceType" "PointerAbsolute"\n' "$2"
    printf ' Option "PointerHasPressure" "%s"\nEndSection\n' "$3"
}

# Sockets have short names, whatever the folder is called.
sockets=$(mktemp -d)
{
    printf 'Section "ServerFlags"\n Option "AutoAddDevices" "false"\nEndSection\n'
    printf 'Section "Device"\n Identifier "card"\n Driver "dummy"\n VideoRam 16384\nEndSection\n'
    printf 'Section "Monitor"\n Identifier "monitor"\n HorizSync 5-1000\n VertRefresh 5-200\n'
    printf ' Modeline "mode" 65 1024 1048 1184 1344 768 771 777 806\nEndSection\n'
    printf 'Section "Screen"\n Identifier "screen"\n Device "card"\n Monitor "monitor"\n DefaultDepth 24\n'
    printf ' SubSection "Display"\n Depth 24\n Modes "mode"\n EndSubSection\nEndSection\n'
    device "Test mouse" "$sockets/mouse" false
    device "Test pen" "$sockets/pen" true
    device "Test pen eraser" "$sockets/eraser" true
    printf 'Section "ServerLayout"\n Identifier "layout"\n Screen "screen"\n'
    printf ' InputDevice "Test mouse"\n InputDevice "Test pen"\n InputDevice "Test pen eraser"\nEndSection\n'
} >"$folder/xorg.conf"
start_server Xorg -config "$folder/xorg.conf" -logfile "$folder/Xorg.log" -noreset -nolisten tcp
for _ in $(seq 100); do [ -S "$sockets/eraser" ] && break; sleep 0.1; done
[ -S "$sockets/eraser" ] || { echo "skipped: the X server has no test devices"; exit 77; }

"$program" edit builtin:sphere --size 900x600 --quality draft --state "$state" \
    --record "$folder/record.jsonl" 2>"$folder/stderr" &
editor=$!
await '"open":true'
await '"rung":[0-9]'

# Each device has one connection for good: the driver serves no second one.
for device in mouse pen eraser; do
    mkfifo "$sockets/to-$device"
    python3 "$source/pen_device.py" "$sockets/$device" $width $height <"$sockets/to-$device" &
done
exec 4>"$sockets/to-pen" 5>"$sockets/to-eraser" 6>"$sockets/to-mouse"

# draw PRESSURE...: a stroke to the right, a point for each pressure
draw() {
    local x=300 pressure
    printf 'move 300 300 0\nsleep 0.3\nmove 300 300 %s\npress\n' "$1"
    for pressure in "${@:2}"; do
        x=$((x + 16))
        printf 'move %d 300 %s\n' "$x" "$pressure"
    done
    printf 'release\n'
}

draw 0.125 0.25 0.5 0.75 1 >&4
await '"strokes":1'
draw 0.5 0.5 0.5 >&5
await '"strokes":2'
printf '%s\n' 'move 310 310' 'sleep 0.3' press 'move 330 310' 'move 350 310' release >&6
await '"strokes":3'
exec 4>&- 5>&- 6>&-
rm -r "$sockets"

# What each stroke holds, see the record.
python3 - "$folder/record.jsonl" <<'END' || fail "the record does not hold what the pen did"
import json
import sys

edits = [json.loads(line)["edit"] for line in open(sys.argv[1]) if '"paint.edit"' in line]
pen, eraser, mouse = [[p.get("pressure", 1) for p in e["path"]] for e in edits]
print("pen", pen, "\neraser", eraser, "\nmouse", mouse)
# The pen's own numbers are there, in their order, and those between lie between.
wanted = [0.125, 0.25, 0.5, 0.75, 1]
assert all(any(abs(p - w) < 2e-3 for p in pen) for w in wanted), "a pressure is missing"
assert all(a <= b + 2e-3 for a, b in zip(pen, pen[1:])), "they are not in order"
assert abs(pen[0] - 0.125) < 2e-3, "it begins with another"
assert all(abs(p - 0.5) < 2e-3 for p in eraser), "the eraser's are others"
assert all(p == 1 for p in mouse), "the mouse has a pressure"
assert len(mouse) > 1, "it began where the mouse had come by then, not where it was pressed"
operators = [json.dumps(e["operator"]) for e in edits]
assert operators[0] == operators[2] != operators[1], "the eraser paints like the tip"
END
echo "passed"
