# For the scripts of this folder, which source it: a display and folders of their own.

# open_display FOLDER SIZE TOOL...: empties FOLDER, keeps what the editor remembers below it, and
# starts an X server of that size. Ends with exit code 77 where a tool or the server is missing. When the script
# ends, so do the server and the process that $editor names.
open_display() {
    local folder=$1 size=$2 tool
    shift 2
    for tool in Xvfb "$@"; do
        command -v "$tool" >/dev/null || { echo "skipped: $tool is missing"; exit 77; }
    done
    rm -rf "$folder"
    mkdir -p "$folder/config" "$folder/state" "$folder/cache"
    export XDG_CONFIG_HOME=$folder/config XDG_STATE_HOME=$folder/state
    export XDG_CACHE_HOME=$folder/cache XDG_DATA_HOME=$folder/data
    unset WAYLAND_DISPLAY
    editor=
    exec 3>"$folder/display"
    Xvfb -displayfd 3 -screen 0 "${size}x24" >/dev/null 2>&1 &
    server=$!
    trap close_display EXIT
    for _ in $(seq 100); do [ -s "$folder/display" ] && break; sleep 0.1; done
    DISPLAY=:$(cat "$folder/display")
    export DISPLAY
    [ "$DISPLAY" != ":" ] || { echo "skipped: no X server"; exit 77; }
}

close_display() {
    [ -n "$editor" ] && kill -9 "$editor" 2>/dev/null
    kill "$server" 2>/dev/null
    wait 2>/dev/null
}
