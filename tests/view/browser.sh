#!/bin/sh
# The live page in a real Chromium, at phone and desktop width: tests/view/browser.sh STOKES [SCENE.json [FOLDER]]. Screenshots go to FOLDER
# (default: out). Not part of the default tests, because a browser is 400 MB; it installs one where there is none (Debian, as root).
set -eu
here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)
stokes=$1
scene=${2:-$here/../../scenes/fluorescent_box.json}
folder=${3:-out}
# Debian's Python where the one in PATH does not see Debian's modules.
python=${PYTHON:-python3}
[ -n "${PYTHON:-}" ] || python3 -c 'import websocket' 2>/dev/null || python=/usr/bin/python3
missing=
command -v chromium >/dev/null || missing="chromium"
"$python" -c 'import websocket' 2>/dev/null || missing="$missing python3-websocket"
[ -z "$missing" ] || DEBIAN_FRONTEND=noninteractive apt-get install --no-install-recommends -y $missing >&2
mkdir -p "$folder"
exec "$python" "$here/browser.py" "$stokes" "$scene" "$folder"
