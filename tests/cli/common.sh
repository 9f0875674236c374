# Sourced by the command line's tests: STOKES is the executable, FIXTURES this folder; each test has an empty folder of its own.
set -u
STOKES=$1
FIXTURES=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)
WORK=$(mktemp -d)
trap 'rm -rf "$WORK"' EXIT
cd "$WORK" || exit 1
unset STOKES_DEVICE
failures=0

fail() {
  printf 'FAILED: %s\n' "$*"
  failures=$((failures + 1))
}

# expect CODE COMMAND...: runs it with its outputs in out.txt and err.txt and compares the exit code.
expect() {
  expected=$1
  shift
  "$@" >out.txt 2>err.txt
  code=$?
  if [ "$code" -ne "$expected" ]; then
    fail "exit code $code, not $expected: $*"
    sed 's/^/    /' out.txt err.txt
  fi
}

# says FILE PATTERN: the output of the last command matches an extended regular expression.
says() {
  grep -Eq -- "$2" "$1" || {
    fail "no line of $1 matches '$2':"
    sed 's/^/    /' "$1"
  }
}

# A render of the small scene on the reference, which needs no OpenCL.
render() {
  "$STOKES" render "$FIXTURES/small.json" --device reference -q "$@"
}

finish() {
  [ "$failures" -eq 0 ] || {
    printf '%s failures\n' "$failures"
    exit 1
  }
  printf 'ok\n'
}
