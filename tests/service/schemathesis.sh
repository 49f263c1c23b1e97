#!/bin/sh
# Sends what the OpenAPI document allows, and what it does not, to a server of its own: no 5xx, no answer outside the
# document. Installs schemathesis from PyPI into an environment of its own.
#
# usage: tests/service/schemathesis.sh [target/debug/unwrapd]
set -eu
cd "$(dirname "$0")/../.."
program=${1:-target/debug/unwrapd}
work=$(mktemp -d)
trap 'kill "$server" 2>/dev/null; wait "$server" 2>/dev/null; rm -rf "$work"' EXIT

python3 -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet schemathesis==4.32.5 openapi-spec-validator==0.9.0
"$work/venv/bin/openapi-spec-validator" openapi/openapi.json

# A full queue would answer 503, which is documented, but tests nothing. Options are made up at random: some ask for much work, for
# which the calls behind them in the queue shall not wait.
UNWRAPD_QUEUE_DEPTH=100000 UNWRAPD_JOB_SECONDS=15 "$program" serve --listen 127.0.0.1:0 --data "$work/data" >"$work/address" &
server=$!
until [ -s "$work/address" ]; do kill -0 "$server"; done
address=$(sed 's/^listening on //' "$work/address")

# No schema says what a mesh file is: that a body is refused although it fits the schema is no fault. Nor is that the record of a job
# stays when it is deleted while it is live: it is cancelled then, as the answer 202 says.
SCHEMATHESIS_HOOKS=schemathesis_hooks PYTHONPATH=tests/service "$work/venv/bin/schemathesis" run \
    "$address/openapi.json" --checks all --exclude-checks positive_data_acceptance,use_after_free \
    --max-examples "${EXAMPLES:-50}" --workers 1 --seed 1 --request-timeout 60
