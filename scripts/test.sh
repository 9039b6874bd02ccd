#!/usr/bin/env bash
# Installs what is missing, builds everything and runs the tests: label `default`, or the one
# given, as in `scripts/test.sh full`.
set -euo pipefail
cd "$(dirname "$0")/.."

bash scripts/install_dependencies.sh
cmake --preset release
cmake --build --preset release
ctest --preset "${1:-default}" -j "$(nproc)"
