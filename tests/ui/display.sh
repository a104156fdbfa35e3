# For the scripts of this folder, which source it: a display and folders of their own.

# own_folders FOLDER: empties it, and keeps what the editor remembers below it.
own_folders() {
    rm -rf "$1"
    mkdir -p "$1/config" "$1/state" "$1/cache"
    export XDG_CONFIG_HOME=$1/config XDG_STATE_HOME=$1/state
    export XDG_CACHE_HOME=$1/cache XDG_DATA_HOME=$1/data
    unset WAYLAND_DISPLAY
    displayFile=$1/display
}

# start_server SERVER ARGUMENT...: an X server. Ends with exit code 77 where none comes up. When the
# script ends, so do the server and the process that $editor names.
start_server() {
    editor=
    exec 3>"$displayFile"
    "$@" -displayfd 3 >/dev/null 2>&1 &
    server=$!
    trap close_display EXIT
    for _ in $(seq 100); do [ -s "$displayFile" ] && break; sleep 0.1; done
    DISPLAY=:$(cat "$displayFile")
    export DISPLAY
    [ "$DISPLAY" != ":" ] || { echo "skipped: no X server"; exit 77; }
}

# open_display FOLDER SIZE TOOL...: both, with a screen of that size. Exit code 77 also where a tool
# is missing.
open_display() {
    local folder=$1 size=$2 tool
    shift 2
    for tool in Xvfb "$@"; do
        command -v "$tool" >/dev/null || { echo "skipped: $tool is missing"; exit 77; }
    done
    own_folders "$folder"
    start_server Xvfb -screen 0 "${size}x24"
}

close_display() {
    [ -n "$editor" ] && kill -9 "$editor" 2>/dev/null
    kill "$server" 2>/dev/null
    wait 2>/dev/null
}
