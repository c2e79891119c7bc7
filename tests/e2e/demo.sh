#!/usr/bin/env bash
# The main job on a seeded sample collection: serve, ingest, search, draw.
#
#   tests/e2e/demo.sh BIN_FOLDER [OUT_FOLDER]
set -euo pipefail
bin=$1
out=${2:-build/demo}
rm -rf "$out"
mkdir -p "$out"
export PATH=$bin:$PATH

say() { printf '\n\033[1m== %s\033[0m\n' "$*"; }

argmeshd --data "$out/store" --listen 127.0.0.1:0 \
  --port-file "$out/address" 2>"$out/server.log" &
server=$!
stop() {
  kill -TERM "$server" 2>/dev/null || true
  wait "$server" 2>/dev/null || true
}
trap stop EXIT
for _ in $(seq 100); do
  [[ -s $out/address ]] && break
  kill -0 "$server" 2>/dev/null ||
    { cat "$out/server.log" >&2; echo "the server did not start" >&2; exit 1; }
  sleep 0.1
done
ARGMESH_SERVER=$(cat "$out/address")
export ARGMESH_SERVER
say "serving on $ARGMESH_SERVER, store in $out/store"

say "sample collection"
argmesh sample --out "$out/meshes" --shapes-per-class 6
argmesh ingest --collection demo --labels "$out/meshes/labels.tsv" \
  "$out/meshes"

say "global: what is like this as a whole?"
query=$(argmesh list --collection demo --json |
  grep -o '"shape": *"quadruped-[^"]*"' | head -1 | cut -d'"' -f4)
argmesh search --collection demo --mode global --limit 8 --shape "$query"

say "partial: what contains this part?"
part=$out/half.off
argmesh sample --part quadruped --out "$part"
argmesh search --collection demo --mode partial --limit 8 "$part"

say "pictures"
argmesh picture levels --collection demo "$query" --up z --out "$out/levels.png"
argmesh picture modes --collection demo "$query" --up z --out "$out/modes.png"
argmesh picture results --collection demo --mode global --shape "$query" \
  --up z --out "$out/global.png"
argmesh picture results --collection demo --mode partial "$part" \
  --up z --out "$out/partial.png"
second=$(argmesh search --collection demo --mode global --limit 1 --json \
  --shape "$query" | grep -o '"shape": *"[^"]*"' | head -1 | cut -d'"' -f4)
argmesh picture match --collection demo "$query" "$second" \
  --up z --out "$out/match.png"
ls "$out"/*.png
