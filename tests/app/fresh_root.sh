#!/usr/bin/env bash
# dygita and ParaView live side by side, whichever comes first: in a Debian of its own, made for this and removed again,
# ./run.sh installs and builds beside ParaView and its Python and removes no package; in another one, ParaView installs
# beside what ./run.sh has installed. As root, with the package mmdebstrap; some 20 minutes, 5 GB in TMPDIR.
#   tests/app/fresh_root.sh [before|after]     ParaView before dygita, or after it; else both
set -euo pipefail

source="$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.." && pwd)"
suite="$(. /etc/os-release && echo "$VERSION_CODENAME")"
paraview=(paraview python3-paraview)

fail() {
  printf '\nFAILED: %s\n' "$1" >&2
  exit 1
}

# This system's own sources of packages.
sources() {
  local file
  for file in /etc/apt/sources.list.d/debian.sources /etc/apt/sources.list; do
    [[ ! -s "$file" ]] || { echo "$file" && return; }
  done
  fail "no list of sources in /etc/apt"
}

root=""
clean_up() { [[ -z "$root" ]] || rm -rf --one-file-system "$root"; }
trap clean_up EXIT

make_root() {
  clean_up
  root="$(mktemp -d --tmpdir dygita_root.XXXXXX)"
  mmdebstrap --quiet --variant=minbase --include=ca-certificates "$suite" "$root" "$(sources)"
  mkdir "$root/dygita"
  (cd "$source" && git ls-files -z --cached --others --exclude-standard | tar -c --null -T - --ignore-failed-read) |
    tar -x -C "$root/dygita"
}

in_root() {
  unshare --mount --pid --fork bash -c 'mount -t proc proc "$0/proc" && mount --bind /dev "$0/dev" && exec chroot "$0" "$@"' \
    "$root" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin TERM=dumb DEBIAN_FRONTEND=noninteractive "$@"
}

packages() { in_root dpkg-query -W -f '${db:Status-Abbrev} ${Package}\n' | sed -n 's/^ii *//p' | sort; }

paraview_before() {
  make_root
  in_root apt-get update
  in_root apt-get install -y --no-install-recommends "${paraview[@]}"
  local before lost
  before="$(packages)"
  in_root bash -c 'cd /dygita && ./run.sh install && cmake --preset release && cmake --build --preset release --target dygita'
  in_root bash -c 'cd /dygita && build/release/dygita run decks/crush.lua --set n=1 --set dt=1.2*us --quiet'
  lost="$(comm -23 <(echo "$before") <(packages))"
  [[ -z "$lost" ]] || fail "./run.sh has removed: $lost"
  # What it wrote is opened by the ParaView beside it.
  in_root python3 -c 'import paraview.simple as pv
reader = pv.PVDReader(FileName="/dygita/out/crush/base/crush.pvd")
reader.UpdatePipeline()
assert reader.GetDataInformation().GetNumberOfCells() > 0 and len(reader.TimestepValues) > 2
print("ParaView", pv.GetParaViewVersion(), "opens", len(reader.TimestepValues), "frames")'
  echo "ParaView first, dygita after it: no package of $(wc -l <<<"$before") was removed"
}

paraview_after() {
  make_root
  in_root bash -c 'cd /dygita && ./run.sh install'
  local told
  told="$(in_root apt-get -s install "${paraview[@]}")"
  ! grep '^Remv' <<<"$told" || fail "ParaView would remove what ./run.sh has installed"
  grep -q '^Inst python3-paraview' <<<"$told" || fail "ParaView would not be installed"
  echo "dygita first, ParaView after it: nothing would be removed"
}

((EUID == 0)) || fail "to make a root one has to be root"
command -v mmdebstrap >/dev/null || fail "no mmdebstrap (its package has that name)"
case "${1:-both}" in
  before) paraview_before ;;
  after) paraview_after ;;
  both) paraview_after && paraview_before ;;
  *) fail "before, after or nothing" ;;
esac
