#!/usr/bin/env bash
# Installs a build into an empty folder, and builds and runs a project that
# finds it there.
#
#   tests/e2e/install_test.sh SOURCE_FOLDER BUILD_FOLDER
set -euo pipefail
source_folder=$1
build_folder=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

cmake --install "$build_folder" --prefix "$folder/installed" >/dev/null
"$folder/installed/bin/argmesh" --version
"$folder/installed/bin/argmeshd" --version
cmake -S "$source_folder/tests/e2e/consumer" -B "$folder/build" -G Ninja \
  -DCMAKE_PREFIX_PATH="$folder/installed" >/dev/null
cmake --build "$folder/build"
"$folder/build/consumer"
