#!/usr/bin/env bash
# Runs the tests of a preset. A skipped test fails them: the set-up installs all that they need.
set -euo pipefail
cd "$(dirname "$0")/.."

log=$(mktemp)
trap 'rm -f "$log"' EXIT
ctest --preset "$1" -j "$(nproc)" | tee "$log"
if grep -q -E '\*\*\*(Skipped|Not Run)' "$log"; then
  echo "error: tests did not run:" >&2
  grep -E '\*\*\*(Skipped|Not Run)' "$log" >&2
  exit 1
fi
