#!/bin/sh
# Runs the image as it is meant to be run, on a read-only root and without privileges, and asks of it what the README
# promises: one call, a job, its files, a restart that keeps them. There is nothing in the image to help with that.
#
# usage: docker build -f docker/Dockerfile -t unwrapd . && tests/container.sh [unwrapd]
set -eu
cd "$(dirname "$0")/.."
image=${1:-unwrapd}
volume=unwrapd-test-$$
container=
work=$(mktemp -d)
trap 'docker rm -f "$container" >/dev/null 2>&1; docker volume rm "$volume" >/dev/null 2>&1; rm -rf "$work"' EXIT

unprivileged="--read-only --cap-drop ALL --security-opt no-new-privileges -v $volume:/data"
start() {
    # shellcheck disable=SC2086
    container=$(docker run -d $unprivileged -p 127.0.0.1::8080 "$image")
    address=http://$(docker port "$container" 8080/tcp)
    curl -s --retry 50 --retry-delay 1 --retry-all-errors "$address/readyz" >/dev/null
    echo "$address is ready"
}
stop() {
    docker stop "$container" >/dev/null
    echo "stopped with $(docker inspect -f '{{.State.ExitCode}}' "$container")"
    docker rm "$container" >/dev/null
}
curl() { command curl -H "authorization: Bearer $key" "$@"; }
member() { sed -n "s/.*\"$1\":\"\([^\"]*\)\".*/\1/p"; }

# Others reach the service, so it does not start before there is a key.
# shellcheck disable=SC2086
if docker run --rm $unprivileged "$image" 2>"$work/refused"; then
    echo "it started without keys" >&2
    exit 1
fi
grep -q allow-anonymous "$work/refused"
# shellcheck disable=SC2086
key=$(docker run --rm $unprivileged "$image" keys create --owner tests)

start
[ "$(docker inspect -f '{{.Config.User}}' "$container")" = 65532:65532 ]
docker exec "$container" unwrapd health
until [ "$(docker inspect -f '{{.State.Health.Status}}' "$container")" = healthy ]; do sleep 1; done
curl -sSf "$address/healthz"
curl -sSf "$address/v1/unwrap" -H 'content-type: model/gltf-binary' --data-binary @tests/assets/Box.glb -o "$work/box.glb"
docker exec -i "$container" unwrapd verify - --bijective <"$work/box.glb"

id=$(curl -sSf "$address/v1/jobs?cut=auto" -H 'content-type: model/gltf-binary' -H 'prefer: wait=60' \
    --data-binary @tests/assets/Box.glb | member id)
state() { curl -sSf "$address/v1/jobs/$id" | member state; }
[ "$(state)" = succeeded ]
curl -sSf "$address/v1/jobs/$id/result" -o "$work/result.glb"
cmp "$work/box.glb" "$work/result.glb"

stop
start
[ "$(state)" = succeeded ]
curl -sSf "$address/v1/jobs/$id/result" | cmp - "$work/result.glb"
stop
docker image inspect -f '{{.Size}} bytes, user {{.Config.User}}' "$image"
echo "the container does what it should"
