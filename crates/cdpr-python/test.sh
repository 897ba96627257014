#!/usr/bin/env bash
# Tests the Python package as a user has it: a fresh environment, a wheel, pytest, and the type stubs.
# Arguments are further packages to test with, such as engines:
#   crates/cdpr-python/test.sh distributed ray
# Without them the tests of these engines are left out, and pytest says so.
set -euo pipefail
cd "$(dirname "$0")/../.."

target=${CARGO_TARGET_DIR:-$PWD/target}
# Always in the same place: PyO3 is built again for every other path of an interpreter.
environment=$target/python-tests
trap 'rm -rf "$environment"' EXIT

python3 -m venv --clear "$environment"
# They come over the network while the program and the wheel are compiled.
"$environment/bin/pip" install --quiet pytest scipy pandas matplotlib mypy mujoco anywidget SALib "$@" &
packages=$!
cargo build --quiet --bin cdpr
# In the profile of the tests, so that nothing is compiled twice; a wheel is otherwise built as a release.
"$environment/bin/pip" wheel --quiet --no-deps --wheel-dir "$environment/wheel" \
    --config-settings=build-args="--profile dev" ./crates/cdpr-python
wait "$packages"
"$environment/bin/pip" install --quiet "$environment"/wheel/*.whl
cd crates/cdpr-python
CDPR=$target/debug/cdpr "$environment/bin/python" -m pytest -q -rs -p no:cacheprovider tests
"$environment/bin/python" -m mypy.stubtest cdpr --mypy-config-file pyproject.toml \
    --allowlist tests/stubtest-allowed.txt
