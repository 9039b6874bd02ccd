#!/usr/bin/env bash
# Format and lint: clang-format on every source, clang-tidy with the profile in .clang-tidy on every
# unit of the release build.
set -euo pipefail
cd "$(dirname "$0")/.."

bash scripts/install_dependencies.sh --lint
mapfile -t sources < <(git ls-files '*.h' '*.cpp')
clang-format --dry-run --Werror "${sources[@]}"
echo "clang-format: ${#sources[@]} files clean"

cmake --preset release >/dev/null
mapfile -t units < <(git ls-files '*.cpp' | while read -r unit; do
  if grep -q "\"file\": \"$PWD/$unit\"" build/release/compile_commands.json; then echo "$unit"; fi
done)
printf '%s\0' "${units[@]}" |
  xargs -0 -n 1 -P "$(nproc)" clang-tidy --quiet --warnings-as-errors='*' -p build/release \
    2> >(grep -v -E 'warnings? generated|Suppressed|Use -header-filter' >&2)
echo "clang-tidy: ${#units[@]} files clean"
