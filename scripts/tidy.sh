#!/usr/bin/env bash
# Checks sources by clang-tidy; .clang-tidy says for what. Arguments: .cpp files; all without any.
# Needs a configured build/release, which ./test leaves behind.
set -euo pipefail
root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd -P)
source "$root/scripts/setup.sh"

need_packages clang-tidy
if [[ ! -f $build/compile_commands.json ]]; then
  say "there is no build/release/compile_commands.json yet; run ./test first"
  exit 2
fi
cd "$root"
if (($# == 0)); then
  mapfile -t files < <(find src apps -name '*.cpp' ! -name '*_test.cpp' | sort)
  set -- "${files[@]}"
fi
printf '%s\0' "$@" | xargs -0 -n 1 -P "$(nproc)" clang-tidy -p "$build" --quiet
