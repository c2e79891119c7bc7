#!/usr/bin/env bash
# Runs every fuzzer for so many executions: one line each, with what was found.
#
#   tests/fuzz/fuzz.sh FOLDER_OF_THE_PROGRAMS EXECUTIONS [NAME...]
#
# Inputs that reached something new are kept beside the programs, in corpus/NAME;
# what broke something in findings/. Exit code 1 when anything did.
set -euo pipefail

programs=$(realpath "$1")
executions=$2
names=("${@:3}")
if ((${#names[@]} == 0)); then
  for program in "$programs"/fuzz_*; do names+=("$(basename "$program")"); done
fi
mkdir -p "$programs/../findings"
found=0
for name in "${names[@]}"; do
  corpus=$programs/../corpus/$name
  mkdir -p "$corpus"
  log=$(mktemp)
  outcome="no finding"
  start=$SECONDS
  # What leaked is looked for at the end: after one input a server's threads may
  # have what they hold in nobody's sight.
  "$programs/$name" -runs="$executions" -timeout=60 -rss_limit_mb=4096 \
    -detect_leaks=0 -max_len=20000 -print_final_stats=1 \
    -artifact_prefix="$programs/../findings/$name-" "$corpus" >"$log" 2>&1 || {
    outcome="BROKEN, see $log"
    found=1
  }
  printf '%-22s %9d executions %6d s  %s\n' "$name" \
    "$(sed -n 's/^stat::number_of_executed_units: *//p' "$log" | tail -1)" \
    $((SECONDS - start)) "$outcome"
  [[ $outcome == BROKEN* ]] || rm -f "$log"
done
exit "$found"
