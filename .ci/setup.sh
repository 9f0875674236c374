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

# A Python of build/venv that sees Debian's packages and has nanobind from PyPI, which Debian lacks. False, with a line that says why, where it
# cannot be had.
python_environment() {
  venv=$1/build/venv
  "$venv/bin/python" -c 'import nanobind' 2>/dev/null && return
  debian=/usr/bin/python3
  [ -x "$debian" ] || debian=python3
  printf 'installing nanobind from PyPI into build/venv\n' >&2
  if ! { "$debian" -m venv --system-site-packages "$venv" &&
    "$venv/bin/pip" install --quiet --disable-pip-version-check --retries 1 --timeout 15 nanobind; } >&2; then
    printf 'the Python package is neither built nor tested: nanobind could not be installed from PyPI\n' >&2
    return 1
  fi
}

# configured ROOT [-DNAME:TYPE=VALUE ...]: true where the build folder is configured with these values.
configured() {
  cache=$1/build/CMakeCache.txt
  [ -f "$1/build/build.ninja" ] || return
  shift
  for option in "$@"; do
    grep -qxF "${option#-D}" "$cache" || return
  done
}

# build ROOT TARGET [-DNAME:TYPE=VALUE ...]: configures where that was not done yet, then builds; ninja's output is shown when it has work or
# fails.
build() {
  root=$1 target=$2
  shift 2
  if ! configured "$root" "$@"; then
    printf 'configuring\n' >&2
    if ! cmake -S "$root" -B "$root/build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo "$@" >"$root/.configure.tmp" 2>&1; then
      cat "$root/.configure.tmp" >&2
      rm -f "$root/.configure.tmp" "$root/build/CMakeCache.txt"
      exit 1
    fi
    rm -f "$root/.configure.tmp"
  fi
  printf 'building\n' >&2
  ninja -C "$root/build" --quiet "$target" >&2
}
