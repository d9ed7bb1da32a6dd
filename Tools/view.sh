#!/usr/bin/env bash
# Installs what is missing, builds the server and its page, and shows the runs in a folder in a browser.
#   Tools/view.sh [FOLDER] [OPTION...]     (default: the current folder; options of build/release/Tools/view)
# The address that it prints has the token that lets you in. Ctrl-C ends the server, not the runs.
# Only drivers that are built can be started from the page: cmake --build --preset release --target RotatingDrum
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/read-options.sh"
read_argument "$@"
folder=$(cd "${1:-.}" 2>/dev/null && pwd) || refuse "there is no folder ${1:-.}"
shift $(($# > 0 ? 1 : 0))
cd "$(dirname "${BASH_SOURCE[0]}")/.."

Tools/install-dependencies.sh --view --page --check >/dev/null 2>&1 || Tools/install-dependencies.sh --view --page
log=$(mktemp)
trap 'rm -f "$log"' EXIT
quietly() { "$@" >"$log" 2>&1 || { cat "$log" >&2; refuse "'$*' failed; its output is above"; }; }
echo "== Building (preset release; minutes the first time)"
quietly cmake --preset release -D PENDULAR_VIEW=ON
quietly cmake --build --preset release --parallel "$(getconf _NPROCESSORS_ONLN)" --target view view-page

# Opens the printed address, where there is a screen and a program that does so.
show() {
    while IFS= read -r line; do
        echo "$line"
        if [[ $line == http* && -n ${DISPLAY:-}${WAYLAND_DISPLAY:-} ]] && command -v xdg-open >/dev/null; then
            xdg-open "$line" >/dev/null 2>&1 &
        fi
    done
}
rm -f "$log"
exec build/release/Tools/view "$folder" "$@" > >(show)
