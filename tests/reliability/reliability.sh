#!/usr/bin/env bash
# What the service promises when something fails, measured: one row each.
#
#   tests/reliability/reliability.sh FOLDER_OF_THE_PROGRAMS [--full]
#
# A test says what it measured in a line that begins with "measured: ".
set -euo pipefail

programs=$(realpath "$1")
if [[ ${2:-} == --full ]]; then
  export ARGMESH_KILL_ROUNDS=${ARGMESH_KILL_ROUNDS:-200}
  export ARGMESH_FAILPOINT_TIMES=${ARGMESH_FAILPOINT_TIMES:-25}
  export ARGMESH_POWER_LOSS_IMAGES=${ARGMESH_POWER_LOSS_IMAGES:-1000}
  export ARGMESH_MODEL_OPERATIONS=${ARGMESH_MODEL_OPERATIONS:-20000}
  export ARGMESH_HOSTILE_PEERS=${ARGMESH_HOSTILE_PEERS:-10000}
  export ARGMESH_SLOW_PEER_SECONDS=${ARGMESH_SLOW_PEER_SECONDS:-60}
  export ARGMESH_HOSTILE_RATIO=${ARGMESH_HOSTILE_RATIO:-2}
  export ARGMESH_CANCELLED_CALLS=${ARGMESH_CANCELLED_CALLS:-1000}
  export ARGMESH_OVERLOAD_SECONDS=${ARGMESH_OVERLOAD_SECONDS:-60}
  export ARGMESH_SOAK_SECONDS=${ARGMESH_SOAK_SECONDS:-1800}
  export ARGMESH_DAMAGED_SNAPSHOTS=${ARGMESH_DAMAGED_SNAPSHOTS:-5000}
fi

export ARGMESH_CANCELLED_CALLS=${ARGMESH_CANCELLED_CALLS:-200}
export ARGMESH_OVERLOAD_SECONDS=${ARGMESH_OVERLOAD_SECONDS:-10}

log=$(mktemp)
trap 'rm -f "$log"' EXIT
table=()
failed=0

# row NAME PROGRAM TESTS
row() {
  local start=$SECONDS outcome=kept figure
  printf '%s\n' "== $1" >&2
  if ! "$programs/$2" --gtest_filter="$3" >"$log" 2>&1; then
    outcome=BROKEN
    failed=1
    cat "$log" >&2
  elif grep -q '^\[  SKIPPED \]' "$log"; then
    outcome=skipped
  fi
  figure=$(sed -n 's/^measured: //p' "$log" | paste -sd ';')
  table+=("$(printf '%-26s %-8s %5d s  %s' "$1" "$outcome" \
    $((SECONDS - start)) "${figure:-$(grep -c '^\[       OK' "$log") tests}")")
}

# Files in memory, where only what is asked of the disk counts.
in_memory() {
  if [[ -d /dev/shm ]]; then TMPDIR=/dev/shm row "$@"; else row "$@"; fi
}

in_memory "power loss" power_loss_test '*'
in_memory "failpoints" failpoint_test '*'
in_memory "operations and restarts" server_storage_test 'CatalogModelTest.*'
in_memory "damaged snapshots" server_storage_test \
  'RestoreTest.RefusesEvery*:SealedArchiveTest.Notices*'
row "full disk" disk_full_test '*'
row "stop with calls in flight" lifecycle_test \
  '*CallInFlight*:*WhileItDrains:*WhenTheGraceIsOver'
row "stop under load" stop_test '*'
row "same answers after restart" kill_test '*.AnswersTheSame*'
row "kill -9 in an ingest" kill_test '*.LosesNothing*'
row "hostile peers" hostile_peers_test '*'
row "cancellation" cancellation_test '*'
row "overload" overload_test '*'
row "memory over time" soak_test '*'

printf '\n'
printf '%s\n' "${table[@]}"
exit "$failed"
