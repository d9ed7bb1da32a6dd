#!/usr/bin/env bash
# Installs what is missing, builds the server and its page, and shows the runs in a folder in a browser.
#   Tools/view.sh [FOLDER] [OPTION...]     (default: the current folder; options of build/release/Tools/view, as
#                                          --port 8123)
# The address that it prints has the token that lets you in. Ctrl-C ends the server, not the runs.
# Only drivers that are built can be started from the page: cmake --build --preset release --target RotatingDrum
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/read-options.sh"
case ${1:-} in
    -h | --help) print_head; exit 0 ;;
esac
given=.
if [[ -n ${1:-} && $1 != -* ]]; then given=$1; shift; fi
folder=$(cd "$given" 2>/dev/null && pwd) || refuse "there is no folder $given"
cd "$(dirname "${BASH_SOURCE[0]}")/.."

Tools/install-dependencies.sh --view --page --check >/dev/null 2>&1 || Tools/install-dependencies.sh --view --page
log=$(mktemp)
trap 'rm -f "$log"' EXIT
quietly() { "$@" >"$log" 2>&1 || { cat "$log" >&2; refuse "'$*' failed; its output is above"; }; }
echo "== Building (preset release; minutes the first time)"
quietly cmake --preset release -D PENDULAR_VIEW=ON
quietly cmake --build --preset release --parallel "$(getconf _NPROCESSORS_ONLN)" --target view view-page

# Opens the printed address, where there is a screen and a program that does so. Arguments of programs can be seen by all
# who use the machine, and the address has the token: the browser gets a file that only this user can read, and that
# leads on.
show() {
    trap '' INT  # the server ends first
    local page='' line
    while IFS= read -r line; do
        echo "$line"
        if [[ $line == http* && -n ${DISPLAY:-}${WAYLAND_DISPLAY:-} ]] && command -v xdg-open >/dev/null; then
            page=$(umask 077 && mktemp --suffix=.html)
            printf '<!doctype html><meta http-equiv="refresh" content="0; url=%s">\n' "$line" >"$page"
            xdg-open "$page" >/dev/null 2>&1 &
        fi
    done
    [[ -z $page ]] || rm -f "$page"
}
rm -f "$log"
exec build/release/Tools/view "$folder" "$@" > >(show)
