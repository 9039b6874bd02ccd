#!/usr/bin/env bash
# Installs what is missing, builds everything and runs the tests: label `default`, or the one
# given, as in `scripts/test.sh full`.
set -euo pipefail
cd "$(dirname "$0")/.."

label=${1:-default}
bash scripts/install_dependencies.sh
if [ "$label" = full ]; then bash scripts/install_dependencies.sh --full; fi
cmake --preset release
cmake --build --preset release
bash scripts/run_tests.sh "$label"
