#!/usr/bin/env bash
# Tests the Python package as a user has it: a fresh environment, a wheel, pytest. Further packages to test with, such as dask and ray, are arguments:
#   crates/cdpr-python/test.sh distributed ray
# Without them, the tests of these engines are left out, and pytest says so.
set -euo pipefail
cd "$(dirname "$0")/../.."

environment=$(mktemp -d)
trap 'rm -rf "$environment"' EXIT

cargo build --release --quiet --package cdpr-cli
python3 -m venv "$environment"
"$environment/bin/pip" install --quiet ./crates/cdpr-python pytest pandas matplotlib mypy "$@"
cd crates/cdpr-python
CDPR="${CARGO_TARGET_DIR:-../../target}/release/cdpr" "$environment/bin/python" -m pytest -q -rs -p no:cacheprovider tests
"$environment/bin/python" -m mypy.stubtest cdpr
