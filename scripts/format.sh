#!/usr/bin/env bash
# Formats the C++ sources in place; with --check only says what is not formatted, and fails.
set -euo pipefail
root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd -P)
source "$root/scripts/setup.sh"

need_packages clang-format
cd "$root"
mode=(-i)
if [[ ${1:-} == --check ]]; then mode=(--dry-run --Werror); fi
find src apps tests benchmarks include -regex '.*\.\(h\|cpp\)' -print0 2>/dev/null |
  xargs -0 --no-run-if-empty clang-format "${mode[@]}"
