#!/bin/sh
# Sends what the OpenAPI document allows, and what it does not, to servers of its own: no 5xx, no answer outside the document. Once
# without keys, then with keys to a caller who has none, and to one who asks for what belongs to another owner. Installs schemathesis
# from PyPI into an environment of its own.
#
# usage: tests/service/schemathesis.sh [target/debug/unwrapd]
set -eu
cd "$(dirname "$0")/../.."
program=${1:-target/debug/unwrapd}
work=$(mktemp -d)
server=
trap 'kill "$server" 2>/dev/null; wait "$server" 2>/dev/null; rm -rf "$work"' EXIT

python3 -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet schemathesis==4.32.5 openapi-spec-validator==0.9.0
"$work/venv/bin/openapi-spec-validator" openapi/openapi.json

# A full queue would answer 503, which is documented, but tests nothing. Options are made up at random: some ask for much work, for
# which the calls behind them in the queue shall not wait.
start() {
    UNWRAPD_QUEUE_DEPTH=100000 UNWRAPD_JOB_SECONDS=60 "$program" serve --listen 127.0.0.1:0 \
        --data "$work/$1" >"$work/address" &
    server=$!
    until [ -s "$work/address" ]; do kill -0 "$server"; done
    address=$(sed 's/^listening on //' "$work/address")
}
stop() {
    kill "$server"
    wait "$server" || true
    : >"$work/address"
}

# A drained or paused service refuses all else, as it says.
# No schema says what a mesh file is: that a body is refused although it fits the schema is no fault. Nor is that the record of a job
# stays when it is deleted while it is live: it is cancelled then, as the answer 202 says.
run() {
    SCHEMATHESIS_HOOKS=schemathesis_hooks PYTHONPATH=tests/service "$work/venv/bin/schemathesis" run "$@" \
        "$address/openapi.json" --checks all --exclude-checks "positive_data_acceptance,use_after_free$beside" \
        --exclude-operation-id startDrain --exclude-operation-id pauseQueue --max-examples "${EXAMPLES:-50}" --workers 1 --seed 1 --request-timeout 120 --max-response-time 120
}
member() { sed -n "s/.*\"$1\":\"\([^\"]*\)\".*/\1/p"; }

beside=
start open
run
stop

alice=$("$program" keys create --data "$work/keyed" --owner alice)
bob=$("$program" keys create --data "$work/keyed" --owner bob)
start keyed
# Whoever has no key is refused before anything else is looked at.
beside=,negative_data_rejection,missing_required_header,unsupported_method
run
beside=

# What is asked for is alice's; who asks is bob, and nothing of it may be in an answer.
call() { curl -sSf -H "Authorization: Bearer $alice" "$@"; }
SECRET_JOB=$(call "$address/v1/jobs" -H 'prefer: wait=60' -F mesh=@tests/assets/Box.glb -F 'metadata={"whose":"alice"}' | member id)
SECRET_SESSION=$(call -X POST "$address/v1/sessions?kind=edit_uv&job=$SECRET_JOB" | member id)
export SECRET_JOB SECRET_SESSION
run --header "Authorization: Bearer $bob"
call "$address/v1/jobs/$SECRET_JOB" | grep -q '"state":"succeeded"'
