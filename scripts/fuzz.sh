#!/usr/bin/env bash
# Fuzzes the readers and the whole path to the picture (docs/testing.md):
#
#   scripts/fuzz.sh [--seconds N | --runs N] [--seed N] [--fast] [reader|text_edit|customizer|flat|picture|mesh|boundary]
#
# For N seconds (60 unless said), or for N executions. They run side by side unless one is
# named. --fast leaves the sanitizers out. Inputs that reach new code gather in build/asan/new-NAME
# (build/fuzz-fast with --fast), where later runs begin; what breaks a rule goes to found-NAME, and
# the script fails.
set -euo pipefail
root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd -P)
source "$root/scripts/setup.sh"

usage() {
  say "usage: scripts/fuzz.sh [--seconds N | --runs N] [--seed N] [--fast] [reader|text_edit|customizer|flat|picture|mesh|boundary]"
  exit 2
}

limit=(-max_total_time=60)
seed=0 # libFuzzer's word for one of its own choice
preset=asan
names=(reader text_edit customizer flat picture mesh boundary)
while (($#)); do
  case $1 in
    --seconds | --runs | --seed)
      [[ ${2:-} =~ ^[0-9]+$ ]] || usage
      case $1 in
        --seconds) limit=("-max_total_time=$2") ;;
        --runs) limit=("-runs=$2") ;;
        --seed) seed=$2 ;;
      esac
      shift 2
      ;;
    --fast) preset=fuzz-fast && shift ;;
    reader | text_edit | customizer | flat | picture | mesh | boundary) names=("$1") && shift ;;
    *) usage ;;
  esac
done

need_packages "${build_packages[@]}" "${test_packages[@]}" "${sanitizer_packages[@]}"
cd "$root"
say "building the fuzzers"
cmake --preset "$preset" --log-level=WARNING >/dev/null
ninja -C "build/$preset" --quiet "${names[@]/%/_fuzzer}" >&2 </dev/null

folder=build/$preset

# start NAME: becomes its fuzzer; its words go to a file.
start() {
  local options=(-max_len=4096 "-dict=tests/fuzz/reader.dict")
  if [[ $1 == flat ]]; then options=(-max_len=1024 "-dict=tests/fuzz/flat.dict"); fi
  # Pictures are best when the models are large from the start.
  local corpus=$1
  if [[ $1 == picture || $1 == boundary ]]; then
    # How rare features are would cost five times what the runs themselves do.
    options=(-max_len=100 -len_control=0 -entropic=0)
    corpus=picture
  fi
  # A boundary takes longer the more there is in it, and few bodies meet in as many ways.
  if [[ $1 == boundary ]]; then options[0]=-max_len=40; fi
  if [[ $1 == customizer ]]; then options[1]=-dict=tests/fuzz/customizer.dict; fi
  if [[ $1 == mesh ]]; then options[1]=-dict=tests/fuzz/mesh.dict; fi
  # Fewer frames for each allocation and a smaller quarantine make it faster.
  export ASAN_OPTIONS=malloc_context_size=2:quarantine_size_mb=32:${ASAN_OPTIONS:-}
  export UBSAN_OPTIONS=print_stacktrace=1:${UBSAN_OPTIONS:-}
  exec "$folder/tests/fuzz/$1_fuzzer" "${limit[@]}" "-seed=$seed" -rss_limit_mb=1024 -timeout=10 \
    "${options[@]}" "-artifact_prefix=$folder/found-$1/" "$folder/new-$1" "tests/fuzz/corpus/$corpus" \
    </dev/null >"$folder/$1.log" 2>&1
}

# report_find NAME: what it found, and how to see it again.
report_find() {
  local log=$folder/$1.log input
  input=$(sed -n 's/.*Test unit written to //p' "$log" | tail -n 1)
  tail -n 60 "$log" | cut -c 1-500 >&2
  say "$1: FOUND something; all its words are in $log"
  say "again: $folder/tests/fuzz/$1_fuzzer ${input:-(no input was written)}"
}

declare -A running=()
trap 'kill "${running[@]}" 2>/dev/null || true' EXIT
trap 'exit 130' INT TERM
for name in "${names[@]}"; do
  mkdir -p "$folder/new-$name" "$folder/found-$name"
  start "$name" &
  running[$name]=$!
done
good=0
for name in "${names[@]}"; do
  if wait "${running[$name]}"; then
    say "$name: $(sed -n 's/^Done //p' "$folder/$name.log"), nothing found"
  else
    report_find "$name"
    good=1
  fi
  unset "running[$name]"
done
exit $good
