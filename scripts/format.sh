#!/usr/bin/env bash
# Formats the C++ sources and wraps the documentation in place. With --check it only says what is not
# formatted, and fails.
set -euo pipefail
root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd -P)
source "$root/scripts/setup.sh"

need_packages clang-format
cd "$root"
mode=(-i)
if [[ ${1:-} == --check ]]; then mode=(--dry-run --Werror); fi
find src apps tests benchmarks include -regex '.*\.\(h\|cpp\)' -print0 2>/dev/null |
  xargs -0 --no-run-if-empty clang-format "${mode[@]}"
if [[ ${1:-} == --check ]]; then mode=(--check); else mode=(); fi
find . -name '*.md' -not -path './build/*' -print0 | xargs -0 scripts/wrap_docs.py "${mode[@]}"
