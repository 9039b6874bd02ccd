#!/usr/bin/env bash
# Installs what is missing, builds the program, plans one of the shipped problems and says where
# the plan lies. Safe to run again.
set -euo pipefail
cd "$(dirname "$0")/.."

bash scripts/install_dependencies.sh
cmake --preset release
cmake --build --preset release --target prehensile

echo
problem=problems/published/tee_21.yaml
echo "build/release/prehensile plan $problem -o plan.json"
exec build/release/prehensile plan "$problem" -o plan.json
