#!/bin/sh
# Interruptions: prompt, saved, resumed to the same bits; foreign checkpoints are refused.
. "$(dirname -- "$0")/common.sh" "$@"
device=${2:-reference}

long() {
  "$STOKES" render "$FIXTURES/small.json" --device "$device" -q "$@"
}
# Waits until a file stands, for at most five minutes.
await() {
  tries=0
  until [ -e "$1" ] || [ $tries -ge 3000 ]; do
    sleep 0.1
    tries=$((tries + 1))
  done
}

# A render that would take days, checkpointed often; once a checkpoint is there, Ctrl-C.
"$STOKES" render "$FIXTURES/small.json" --device "$device" -q -o a.exr --spp 500000000 --checkpoint 100ms 2>err.txt &
pid=$!
await a.exr.checkpoint
[ -e a.exr.checkpoint ] || fail 'no checkpoint was written'
kill -INT $pid
wait $pid
[ $? -eq 6 ] || fail 'an interrupted render does not exit with 6'
says err.txt 'interrupted after [0-9]+ of 500000000 samples'
[ -s a.exr ] || fail 'the image so far is missing'
done=$("$STOKES" info a.exr.checkpoint | sed -n 's/^samples: 0:\([0-9]*\)$/\1/p')
[ "${done:-0}" -gt 0 ] || fail 'the checkpoint holds no samples'

# Resumed to somewhat more samples, it has the bits of a render that was never interrupted.
total=$((done + 7))
cp a.exr.checkpoint saved
expect 0 long -o a.exr --spp $total --resume
[ -e a.exr.checkpoint ] && fail 'the checkpoint of a finished render is still there'
expect 0 long -o b.exr --spp $total
expect 0 "$STOKES" compare a.exr b.exr --exact

# What does not belong is refused with the reason, and stays.
cp saved a.exr.checkpoint
for change in '--seed 77' '--size 8x8' '--set /background=0.9' '--aov albedo'; do
  # shellcheck disable=SC2086
  expect 2 long -o a.exr --spp $total --resume $change
  says err.txt 'a.exr.checkpoint: cannot be resumed: it'
done
for change in '--mode rgb:mode is spectral, not rgb' '--integrator nee:integrator is .*, not nee' '--wavelengths-per-path 8:wavelengths per path are 4, not 8' \
  '--spectral 400:700:3:spectral bins are 0' '--set /camera/fdist=2:other settings of it'; do
  # shellcheck disable=SC2086
  expect 2 long -o a.exr --spp $total --resume $(printf '%s' "$change" | sed 's/:[a-z][^:]*$//')
  says err.txt "cannot be resumed: .*${change##*:}.*--restart begins anew"
done
expect 2 long -o a.exr --spp 1 --resume
says err.txt 'more than the 1 asked for'
cmp -s saved a.exr.checkpoint || fail 'a refused checkpoint was changed'
head -c 1000 saved >a.exr.checkpoint
expect 2 long -o a.exr --spp $total --resume
says err.txt 'damaged'
cp saved a.exr.checkpoint
expect 64 long -o a.exr --spp $total --checkpoint 60s
says err.txt '--restart'
expect 0 long -o a.exr --spp 5 --restart --checkpoint 60s

# SIGTERM is an interruption like Ctrl-C. Signals within a moment are one: timeout signals its child and then its group, the child included.
start_endless() {
  output=$1
  shift
  rm -f "$output" "$output".checkpoint
  "$STOKES" render "$FIXTURES/small.json" --device "$device" -q -o "$output" --spp 500000000 --checkpoint 100ms "$@" 2>err.txt &
  pid=$!
  await "$output".checkpoint
}
start_endless c.exr
kill -TERM $pid
kill -INT $pid
wait $pid
[ $? -eq 6 ] || fail 'SIGTERM, twice in a moment, does not exit with 6'
[ -e c.exr.checkpoint ] || fail 'SIGTERM leaves no checkpoint'
for signal in INT TERM; do
  rm -f t.exr*
  for seconds in 3 10 30 90; do  # until a render has begun by then; before that it ends as any program does
    timeout --preserve-status -s $signal $seconds "$STOKES" render "$FIXTURES/small.json" --device "$device" -q -o t.exr --spp 500000000 2>err.txt
    code=$?
    [ $code -eq 6 ] && ! grep -q 'before the first sample' err.txt && break
  done
  [ $code -eq 6 ] || fail "stopped by timeout -s $signal, the exit code is $code and not 6"
  says err.txt 'interrupted after [0-9]+ of 500000000 samples'
  [ -s t.exr ] && [ -s t.exr.checkpoint ] || fail "timeout -s $signal: nothing is saved"
done

# A signal after that moment ends the process at once. What would end by itself until then is kept asleep: the worker or, where there is none, the
# process itself while it saves; on a fast machine that may be over, so it is tried several times.
for attempt in 1 2 3 4 5; do
  start_endless d.exr --size 1000x750
  worker=$(tr -d ' ' <"/proc/$pid/task/$pid/children")
  [ -z "$worker" ] || kill -STOP "$worker"
  kill -INT $pid
  sleep 0.1
  [ -n "$worker" ] || kill -STOP $pid 2>/dev/null
  sleep 0.6
  kill -TERM $pid 2>/dev/null
  kill -CONT $pid 2>/dev/null
  sleep 0.5
  [ -z "$worker" ] || kill -CONT "$worker" 2>/dev/null
  wait $pid
  code=$?
  [ $code -eq 6 ] || break
done
[ $code -eq 143 ] || fail "a second request did not end the process at once: $code, after $attempt attempts"
finish
