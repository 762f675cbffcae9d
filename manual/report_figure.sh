#!/usr/bin/env bash
# manual/pictures/report.png: parts of the report of decks/bolted_flanges.lua, drawn by headless Chromium. Usage: manual/report_figure.sh [program]
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
program="${1:-$root/build/release/dygita}"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
program="$(realpath "$program")"
(cd "$root" && "$program" run decks/bolted_flanges.lua --out "$work" --quiet --no-frames)
# What stays on the picture: title, verdict, parts, assembly.
sed 's#</style>#section { display: none } section:nth-of-type(-n+3) { display: block } body { margin: 12px auto }</style>#' \
  "$work/bolted_flanges/base/report.html" > "$work/part.html"
chromium --headless --no-sandbox --disable-gpu --hide-scrollbars --window-size=1140,1640 --user-data-dir="$work/profile" \
  --screenshot="$work/report.png" "file://$work/part.html" 2>/dev/null
mv "$work/report.png" "$root/manual/pictures/report.png"
