#!/usr/bin/env bash
# Runs the commands of the README's section "Your own meshes" as they stand
# there, in a folder and a home of their own.
#
#   tests/e2e/readme_test.sh SOURCE_FOLDER BIN_FOLDER
set -euo pipefail
source_folder=$1
bin=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

commands=$folder/commands.sh
awk '/^## /{section = $0}
     /^```/{inside = !inside && /^```sh/; next}
     inside && section == "## Your own meshes"' \
  "$source_folder/README.md" >"$commands"
for word in "./run build" argmeshd "argmesh ingest" "argmesh search"; do
  grep -qF -- "$word" "$commands" ||
    { echo "no '$word' in the README's commands" >&2; exit 1; }
done

off_as_obj() {
  awk 'NR == 2 {vertices = $1}
       NR > 2 && NR <= vertices + 2 {print "v", $0}
       NR > vertices + 2 {print "f", $2 + 1, $3 + 1, $4 + 1}' "$1"
}

# What the README takes for granted: a checkout that builds, and meshes.
mkdir -p "$folder/checkout/build/release" "$folder/home"
ln -s "$bin" "$folder/checkout/build/release/bin"
printf '#!/bin/sh\ntest "$1" = build\n' >"$folder/checkout/run"
chmod +x "$folder/checkout/run"
"$bin/argmesh" sample --out "$folder/home/models" --shapes-per-class 2 \
  --classes mug,quadruped,table >/dev/null
cd "$folder/checkout"
cp "$folder/home/models/mug/mug-01.off" a.off
cp "$folder/home/models/mug/mug-02.off" b.off
off_as_obj a.off >query.obj
"$bin/argmesh" sample --part quadruped --out piece.off >/dev/null
off_as_obj piece.off >piece.obj

# The server ends with the commands, and takes a port that is free.
port_file=$folder/address
sed -i "s|^\(build/release/bin/argmeshd .*\) --listen [^ ]* &|\1 --listen 127.0.0.1:0 --port-file $port_file \&\nuntil [ -s $port_file ]; do sleep 0.1; done|
        s|127.0.0.1:7411|\$(cat $port_file)|" "$commands"
HOME=$folder/home bash -euxo pipefail -c \
  'trap "kill -TERM \$!; wait \$!" EXIT; . "$1"' - "$commands"
[[ -s match.png ]] || { echo "no picture was written" >&2; exit 1; }
