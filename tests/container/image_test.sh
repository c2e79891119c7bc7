#!/usr/bin/env bash
# Builds the image of docker/Dockerfile without any registry and runs it as
# production does: not root, read-only root, no capabilities. Exit code 77, with
# the reason, where the tools cannot do that.
#
#   tests/container/image_test.sh
set -euo pipefail
cd "$(dirname "$0")/../.."

skip() { printf 'skipped: %s\n' "$*" >&2; exit 77; }
fail() { printf 'failed: %s\n' "$*" >&2; exit 1; }

for tool in buildah podman runc mmdebstrap; do
  command -v "$tool" >/dev/null || skip "$tool is not installed (./run image)"
done
[[ $(id -u) == 0 ]] || skip "needs root, for mmdebstrap and buildah"

work=$(mktemp -d /tmp/argmesh-image-XXXXXX)
name=argmesh-test-$$
store=(--root "$work/store" --runroot "$work/run")
cleanup() {
  podman "${store[@]}" rm -f -t 5 "$name" >/dev/null 2>&1 || true
  podman "${store[@]}" volume rm "$name" >/dev/null 2>&1 || true
  buildah "${store[@]}" --storage-driver overlay umount -a >/dev/null 2>&1 || true
  rm -rf "$work"
}
trap cleanup EXIT

cat >"$work/containers.conf" <<TEXT
[containers]
default_ulimits = ["nofile=4096:4096","nproc=4096:4096"]
cgroups = "enabled"
netns = "host"
[engine]
cgroup_manager = "cgroupfs"
events_logger = "file"
runtime = "runc"
TEXT
export CONTAINERS_CONF=$work/containers.conf

# A base of this machine's own Debian mirror, under the name the Dockerfile asks
# for.
mmdebstrap --quiet --variant=minbase bookworm "$work/base.tar" 2>"$work/log" ||
  skip "mmdebstrap cannot make a base here: $(tail -1 "$work/log")"
podman "${store[@]}" import --quiet "$work/base.tar" \
  docker.io/library/debian:bookworm-slim >/dev/null 2>"$work/log" ||
  skip "podman cannot keep images here: $(tail -1 "$work/log")"
base_bytes=$(podman "${store[@]}" image inspect --format '{{.Size}}' \
  docker.io/library/debian:bookworm-slim)

# What this machine has compiled already is not compiled again.
cache=()
if command -v ccache >/dev/null; then
  mkdir -p "$(ccache -k cache_dir)"
  cache=(--volume "$(ccache -k cache_dir):/ccache")
fi
buildah "${store[@]}" --storage-driver overlay bud --isolation chroot \
  --pull-never --format docker --layers=false --quiet "${cache[@]}" \
  --build-arg VERSION=1.2.3 \
  -f docker/Dockerfile -t localhost/argmesh:test . >"$work/log" 2>&1 ||
  fail "the image does not build: $(tail -5 "$work/log")"

inspect() {
  podman "${store[@]}" image inspect --format "$1" localhost/argmesh:test
}
[[ $(inspect '{{.Config.User}}') == 10001:10001 ]] || fail "the image runs as root"
[[ $(inspect '{{.Config.Healthcheck}}') == *"argmesh health"* ]] ||
  fail "the image has no health check"
[[ $(inspect '{{index .Config.Labels "org.opencontainers.image.title"}}') == argmesh ]] ||
  fail "the image has no title"
[[ $(inspect '{{index .Config.Labels "org.opencontainers.image.version"}}') == 1.2.3 ]] ||
  fail "the image does not say its version"
added=$(($(inspect '{{.Size}}') - base_bytes))
printf 'image: %d MB over its base of %d MB\n' $((added / 1000000)) \
  $((base_bytes / 1000000))
((added <= 150000000)) || fail "the image is $added bytes over its base"

# Without certificate and keys it must not come up.
if podman "${store[@]}" run --rm --network host --no-healthcheck \
  localhost/argmesh:test >"$work/log" 2>&1; then
  fail "it serves everybody in plain text"
fi
grep -q "refusing to listen" "$work/log" ||
  skip "podman cannot run containers here: $(tail -1 "$work/log")"

in_container() { podman "${store[@]}" exec "$name" "$@"; }

# start: a new container on the same volume, until it serves. The health check
# is the image's own; what runs it every ten seconds elsewhere is missing here.
start() {
  podman "${store[@]}" run -d --network host --health-interval disable \
    --name "$name" --read-only --tmpfs /tmp --volume "$name:/var/lib/argmesh" \
    --cap-drop all --security-opt no-new-privileges --memory 1g \
    -e ARGMESH_LISTEN=127.0.0.1:17411 -e ARGMESH_METRICS_LISTEN= \
    -e ARGMESH_SERVER=127.0.0.1:17411 localhost/argmesh:test >/dev/null
  for ((i = 0; i < 100; ++i)); do
    podman "${store[@]}" healthcheck run "$name" >/dev/null 2>&1 && return
    sleep 0.2
  done
  fail "it does not serve: $(podman "${store[@]}" logs "$name" 2>&1 | tail -3)"
}

# stop: by SIGTERM, which must end it cleanly.
stop() {
  local code
  podman "${store[@]}" stop -t 25 "$name" >/dev/null
  code=$(podman "${store[@]}" inspect --format '{{.State.ExitCode}}' "$name")
  [[ $code == 0 ]] || fail "it ended with $code after SIGTERM"
  podman "${store[@]}" rm "$name" >/dev/null
}

start
in_container argmesh sample --out /tmp/mugs --classes mug \
  --shapes-per-class 2 --vertices 1500
in_container argmesh ingest --collection mugs /tmp/mugs
[[ $(in_container id -u) == 10001 ]] || fail "it runs as another user"
if in_container touch /usr/local/bin/x 2>/dev/null; then
  fail "its root can be written"
fi
for tool in gcc g++ cc1plus cmake ninja protoc git; do
  if in_container sh -c "command -v $tool" >/dev/null; then
    fail "there is $tool in the image"
  fi
done
stop
start
[[ $(in_container argmesh list --collection mugs --json) == *mug* ]] ||
  fail "its data did not outlive the container"
stop
echo "passed"
