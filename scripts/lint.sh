#!/usr/bin/env bash
# Format and lint: clang-format on every source, clang-tidy with the profile in .clang-tidy on every
# unit of the preset `tidy`, which has no precompiled headers: each source includes what it uses.
# Without --all less is asked, to save time: tests and programs are left out, and so are the checks
# that follow the paths through functions.
set -euo pipefail
libraries_only=yes
checks=('--checks=-clang-analyzer-*')
if [ "${1:-}" = --all ]; then
  libraries_only=no
  checks=()
fi
cd "$(dirname "$0")/.."

bash scripts/install_dependencies.sh --lint
mapfile -t sources < <(git ls-files '*.h' '*.cpp')
if [ ${#sources[@]} -eq 0 ]; then
  echo "error: git lists no sources: expected a checkout of the project" >&2
  exit 1
fi
clang-format --dry-run --Werror "${sources[@]}"
echo "clang-format: ${#sources[@]} files clean"

cmake --preset tidy >/dev/null
units=()
for unit in "${sources[@]}"; do
  case "$unit" in
    tests/*.cpp | apps/*.cpp | benchmarks/*.cpp | examples/*.cpp)
      if [ $libraries_only = yes ]; then continue; fi ;;
    *.cpp) ;;
    *) continue ;;
  esac
  if grep -q "\"file\": \"$PWD/$unit\"" build/tidy/compile_commands.json; then
    units+=("$unit")
  else
    echo "not part of this build, not linted: $unit"
  fi
done
if [ ${#units[@]} -eq 0 ]; then
  echo "error: build/tidy compiles none of the sources" >&2
  exit 1
fi
printf '%s\0' "${units[@]}" |
  xargs -0 -n 1 -P "$(nproc)" clang-tidy-22 --quiet --warnings-as-errors='*' "${checks[@]}" -p build/tidy \
    2> >(grep -v -E 'warnings? generated|Suppressed|Use -header-filter' >&2)
echo "clang-tidy: ${#units[@]} files clean"
