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

# SIGTERM is an interruption like Ctrl-C; a second signal ends the process at once.
rm -f c.exr*
"$STOKES" render "$FIXTURES/small.json" --device "$device" -q -o c.exr --spp 500000000 --checkpoint 100ms 2>err.txt &
pid=$!
await c.exr.checkpoint
kill -TERM $pid
wait $pid
[ $? -eq 6 ] || fail 'SIGTERM does not exit with 6'
rm -f d.exr*
"$STOKES" render "$FIXTURES/small.json" --device "$device" -q -o d.exr --spp 500000000 --checkpoint 100ms 2>err.txt &
pid=$!
await d.exr.checkpoint
kill -STOP $pid
kill -INT $pid
kill -TERM $pid
kill -CONT $pid
wait $pid
code=$?
[ $code -eq 143 ] || [ $code -eq 130 ] || fail "a second signal did not end the process at once: $code"
finish
