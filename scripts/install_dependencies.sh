#!/usr/bin/env bash
# Installs the Debian packages that are missing: for building and testing; with --lint those of the
# format and lint checks too, with --full those of the tests of label `full`. Does nothing where
# everything is there.
set -euo pipefail
cd "$(dirname "$0")/.."

packages=(
  build-essential cmake ninja-build
  libeigen3-dev                                   # linear algebra
  libompl-dev libboost-serialization-dev          # sampling planners, and what their package
  libboost-filesystem-dev libboost-system-dev     # needs but does not ask for
  libfcl-dev                                      # distances of obstacles
  libnlopt-cxx-dev coinor-libipopt-dev            # optimisation
  libyaml-cpp-dev nlohmann-json3-dev libcli11-dev zlib1g-dev # files and command line
  libsqlite3-dev                                  # results of benchmark suites
  libassimp-dev libpolyclipping-dev libtinyxml2-dev # meshes of objects
  libtinygltf-dev                                 # plans as animated GLB files
  libmujoco-dev                                   # a second opinion on plans
  libfccp-dev                                     # benchmarks only: tables of real pushes
  libgtest-dev libvalijson-dev                    # tests only
)
packages_of_node=no
case "${1:-}" in
  "") ;;
  # Debian's clang-tidy walks through all system headers for each source, four times as long.
  --lint) packages+=(clang clang-format clang-tidy-22 git) ;;
  --full)
    packages+=(
      chromium            # opens the pages of the viewer
      ompl-demos          # OMPL's script reads benchmark logs
      slurm-wlm munge     # suites on a cluster of two nodes
    )
    # Node may be there from elsewhere; Debian's npm would not go with it.
    if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
      packages+=(nodejs npm)
    fi
    packages_of_node=yes ;;
  *)
    echo "usage: install_dependencies.sh [--lint | --full]" >&2
    exit 2 ;;
esac

# The judge of GLB files, and what makes the viewer's bundle, at the versions of the lock file.
install_packages_of_node() {
  if [ "$packages_of_node" = no ] || [ -d viewer/node_modules/gltf-validator ]; then return; fi
  npm --prefix viewer ci --ignore-scripts --no-audit --no-fund || {
    echo "error: npm could not install viewer/package-lock.json, which tests of label full need" >&2
    exit 1
  }
}

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query -W -f='${Status}' "$package" 2>/dev/null) || status=""
  case "$status" in
    "install ok installed") ;;
    *) missing+=("$package") ;;
  esac
done
if [ ${#missing[@]} -eq 0 ]; then
  install_packages_of_node
  exit 0
fi

echo "Installing from Debian: ${missing[*]}"
as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "error: missing ${missing[*]}; run this as root, or install sudo" >&2
    exit 1
  fi
  as_root=(sudo)
fi
if ! command -v apt-get >/dev/null; then
  echo "error: missing ${missing[*]}; this script knows Debian's apt-get only" >&2
  exit 1
fi
"${as_root[@]}" apt-get update -qq || {
  echo "error: apt-get update failed; still missing: ${missing[*]}" >&2
  exit 1
}
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
  apt-get install -y -q --no-install-recommends "${missing[@]}" || {
  echo "error: apt-get could not install: ${missing[*]}" >&2
  exit 1
}
install_packages_of_node
