# shellcheck shell=bash
# Shared by demo and test: sourced, not run.

# step "what it does" COMMAND...: quiet; shows the command's output only if it fails, and the time if it took some.
step() {
  local what=$1 log started=$SECONDS
  shift
  log=$(mktemp)
  [ -t 2 ] && printf '%s ...\r' "$what" >&2
  if ! "$@" >"$log" 2>&1 </dev/null; then
    echo "$what: failed" >&2
    # The first error is the one to read; the end says where it stopped.
    grep -n -m 5 -E 'error|Error' "$log" >&2 || true
    tail -n 30 "$log" >&2
    rm -f "$log"
    return 1
  fi
  rm -f "$log"
  if [ $((SECONDS - started)) -ge 2 ]; then echo "$what: $((SECONDS - started)) s" >&2; fi
}

# configure_and_build PRESET FOLDER TARGET...
configure_and_build() {
  local preset=$1 folder=$2
  shift 2
  step "configure $preset" cmake --preset "$preset"
  step "build $preset" cmake --build "$folder" --target "$@"
}
