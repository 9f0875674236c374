# Sourced by run.sh and test.sh: packages and build. Silent and quick where there is nothing to do.

# The packages of .ci/packages.txt that dpkg does not know as installed.
missing_packages() {
  while read -r package; do
    state=$(dpkg-query -W -f='${db:Status-Abbrev}' "$package" 2>/dev/null || true)
    case $state in
      ii*) ;;
      *) printf '%s ' "$package" ;;
    esac
  done <"$1/.ci/packages.txt"
}

install_packages() {
  if ! command -v dpkg-query >/dev/null; then
    printf 'this is no Debian: please see to these packages yourself: %s\n' "$(tr '\n' ' ' <"$1/.ci/packages.txt")" >&2
    return
  fi
  missing=$(missing_packages "$1")
  [ -n "$missing" ] || return 0
  if [ "$(id -u)" -ne 0 ]; then
    printf 'packages are missing; please run\n  sudo apt-get install --no-install-recommends -y %s\nand then this script again\n' "$missing" >&2
    exit 1
  fi
  printf 'installing: %s\n' "$missing" >&2
  export DEBIAN_FRONTEND=noninteractive
  # A package list that is old or empty is refreshed only when the installation needs it.
  # shellcheck disable=SC2086
  apt-get install --no-install-recommends -y $missing >&2 ||
    { apt-get update >&2 && apt-get install --no-install-recommends -y $missing >&2; }
}

# build ROOT TARGET: configures where that was not done yet, then builds; ninja's output is shown when it has work or fails.
build() {
  if [ ! -f "$1/build/build.ninja" ]; then
    printf 'configuring\n' >&2
    if ! cmake -S "$1" -B "$1/build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo >"$1/.configure.tmp" 2>&1; then
      cat "$1/.configure.tmp" >&2
      rm -f "$1/.configure.tmp" "$1/build/CMakeCache.txt"
      exit 1
    fi
    rm -f "$1/.configure.tmp"
  fi
  printf 'building\n' >&2
  ninja -C "$1/build" --quiet "$2" >&2
}
