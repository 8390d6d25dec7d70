# shellcheck shell=bash
# What run, test and the scripts share. To be sourced, with `root` set to the repository's folder.
# All messages go to standard error: standard output belongs to the program that is run.

# shellcheck source=scripts/packages.sh disable=SC2154
source "$root/scripts/packages.sh"

say() { printf 'whittle: %s\n' "$*" >&2; }

# The user's own build; run and test share it.
build="$root/build/release"

# need_packages NAME...: installs those that are missing, by apt, as root or through sudo.
need_packages() {
  if ! command -v dpkg-query >/dev/null; then
    say "not a Debian system; these packages, or their like, must be there: $*"
    return
  fi
  local name status missing=()
  declare -A installed=()
  while read -r name status; do
    if [[ $status == ii* ]]; then installed[$name]=1; fi
  done < <(dpkg-query -W -f '${Package} ${db:Status-Abbrev}\n' "$@" 2>/dev/null)
  for name; do
    if [[ -z ${installed[$name]:-} ]]; then missing+=("$name"); fi
  done
  if ((${#missing[@]} == 0)); then return; fi

  local as_root=()
  if ((EUID != 0)); then
    if ! command -v sudo >/dev/null; then
      say "missing packages, and neither root nor sudo to install them; as root, run:"
      say "  apt-get install --no-install-recommends ${missing[*]}"
      exit 3
    fi
    as_root=(sudo)
  fi
  say "installing by apt: ${missing[*]}"
  local apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq
             -o DPkg::Lock::Timeout=300 -o Dpkg::Use-Pty=0)
  local log
  log=$(mktemp)
  # Lists that are old or absent are the usual reason for a failure, so they are fetched first; if
  # that fails (no network), the packages may still be in apt's cache.
  "${apt[@]}" update </dev/null >"$log" 2>&1 || true
  if ! "${apt[@]}" install -y --no-install-recommends "${missing[@]}" </dev/null >>"$log" 2>&1; then
    tail -n 20 "$log" >&2
    rm -f "$log"
    say "apt could not install them (its last lines are above)"
    exit 3
  fi
  rm -f "$log"
}

# cached VARIABLE: its value in the build folder's CMake cache, or nothing.
cached() { sed -n "s/^$1:[A-Z]*=//p" "$build/CMakeCache.txt" 2>/dev/null || true; }

# configure OPTION...: runs CMake with the preset `release`.
configure() {
  local fresh=()
  # A tree that was copied or moved carries a cache that CMake would refuse.
  if [[ -f $build/CMakeCache.txt && $(cached CMAKE_HOME_DIRECTORY) != "$root" ]]; then
    fresh=(--fresh)
  fi
  say "configuring build/release"
  (cd "$root" && cmake --preset release --log-level=WARNING "${fresh[@]}" "$@") >&2 </dev/null
}

# build_targets TARGET...: builds them, all if none is named; silent if there is nothing to do.
build_targets() {
  if ninja -C "$build" -n "$@" 2>/dev/null | grep -q 'no work to do'; then return; fi
  say "building${*:+ }$* (the first time takes some minutes)"
  # On a terminal ninja keeps to one line; elsewhere it would write one for every file.
  local quiet=()
  if [[ ! -t 2 ]]; then quiet=(--quiet); fi
  ninja -C "$build" "${quiet[@]}" "$@" >&2 </dev/null
}
