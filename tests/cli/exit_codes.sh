#!/bin/sh
# Exit codes and messages: render farms act on the former, people on the latter.
. "$(dirname -- "$0")/common.sh" "$@"

# The command line itself.
expect 0 "$STOKES" --help
says out.txt 'render +Renders'
expect 0 "$STOKES" render --help
says out.txt 'device .*=auto'
expect 0 "$STOKES" --version
says out.txt '^stokes [0-9]+\.[0-9]+\.[0-9]+ \('
expect 64 "$STOKES"
expect 64 "$STOKES" rendr x.json
says err.txt .
expect 64 "$STOKES" render
expect 64 render --no-such-flag
for flags in '--spp 0' '--spp 1.5' '--spp many' '--seed -1' '--size 16' '--size 0x4' '--size 4x' '--crop 0,0.5,0' '--crop 0.5,0.5,0,1' \
  '--crop 0,17,0,4' '--crop 0,2.5,0,4' '--max-time fast' '--max-time -1s' '--max-time 0' '--integrator bdpt' '--mode mono' \
  '--wavelengths-per-path 3' '--set nonsense' '--aov roughness' '--spectral 400:300:4' '--spectral 200:300:4' '--spectral 400:700' \
  '--spectral 400:700:0' '--mode rgb --spectral 400:700:3' '--samples 4:2' '--samples 0:13' '--samples 5' '--resume --restart' '-o picture.jpg' \
  '--progress loud' '--checkpoint now' '--threads -1' '--kernel-dir no/such/folder'; do
  # shellcheck disable=SC2086
  expect 64 render -o x.exr $flags
  [ -s err.txt ] || fail "no message for $flags"
done
[ -e x.exr ] && fail 'a refused render left an output'

# Scenes: one line in the manner of compilers.
expect 2 "$STOKES" render no-such.json --device reference
sed 's/"max bounces"/"max bouces"/' "$FIXTURES/small.json" >bad.json
expect 2 "$STOKES" render bad.json --device reference
says err.txt '^bad\.json:4:[0-9]+: error: .*max bounces'
[ "$(wc -l <err.txt)" -eq 1 ] || fail 'a scene error takes more than one line'
[ -e bad.exr ] && fail 'a bad scene left an output'
# bench measures in a process of its own, which must end after an error too.
expect 2 timeout 60 "$STOKES" bench bad.json
says err.txt '^bad\.json:4:[0-9]+: error: .*max bouces'
expect 2 "$STOKES" check "$FIXTURES/small.json" bad.json
says out.txt 'small.json: ok'
expect 0 "$STOKES" check "$FIXTURES/small.json"
expect 2 render --set /camera/vfov=900
says err.txt 'vfov'

# Values that CLI11 would let pass: empty ones, NaN, and leading zeros, which it takes for octal.
for flags in '--seed 010' '--spp 012' '--png --exposure nan'; do
  # shellcheck disable=SC2086
  expect 64 render -o x.exr $flags
done
for option in -o --samples --device --checkpoint --size --aov; do
  expect 64 "$STOKES" render "$FIXTURES/small.json" "$option" ''
  says err.txt 'is empty'
done
expect 64 "$STOKES" rendr "$FIXTURES/small.json"
says err.txt "there is no command called 'rendr'"

# Names that steer a terminal or break lines.
strange=$(printf 'a\033[31mb\nc')
expect 2 "$STOKES" info "$strange"
[ "$(wc -l <err.txt)" -eq 1 ] || fail "a name with a line feed breaks the line: $(cat err.txt)"
grep -q "$(printf '\033')" err.txt && fail 'a name steers the terminal'
expect 5 render -o "$strange/x.exr"
[ "$(wc -l <err.txt)" -eq 1 ] || fail 'a name with a line feed breaks the line of an output error'

# A pipe that nobody writes to is not waited for; one of the shell's is read.
mkfifo pipe.json
expect 2 timeout 20 "$STOKES" check pipe.json
says err.txt '^pipe.json:1:1: error: .*pipe'
expect 2 timeout 20 "$STOKES" bench --suite pipe.json
expect 0 sh -c 'cat "$2" | "$1" check /dev/stdin' sh "$STOKES" "$FIXTURES/small.json"

# Numbers beyond single precision: refused, or told apart from surfaces, but no crash (an assertion of Embree's).
expect 2 render --set /surfaces/0/radius=1e19
says err.txt '/surfaces/0: .*1e15'
expect 2 render --set '/camera/transform={"translate":[1e19,0,0]}'
says err.txt '/camera: .*1e15'
expect 2 render --set /camera/aperture=1e19
printf '{"camera": {"resolution": [4, 3]}, "sampler": {"samples": 4}, "background": 1, "media": [{"type": "homogeneous", "name": "fog", "sigma_t": 1e-20, "albedo": 0.99}],
 "surfaces": [{"type": "sphere", "material": {"type": "interface"}, "inside": "fog", "outside": "fog"}]}' >thin.json
expect 0 "$STOKES" render thin.json --device reference -q -o thin.exr

# Limits, and files of strangers.
expect 2 render --limit pixels=100 -o x.exr
says err.txt 'small\.json:[0-9]+:[0-9]+: error: /camera/resolution: .*--limit pixels'
expect 4 render --limit memory=1K -o x.exr
expect 64 render --limit pixel=100 -o x.exr
expect 64 render --limit pixels=many -o x.exr
mkdir -p far a/b
printf '400,1\n700,1\n' >far/lamp.csv
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 2\n' >a/flat.obj
printf '{"camera": {}, "background": {"type": "file", "filename": "../../far/lamp.csv"},
 "surfaces": [{"type": "mesh", "filename": "../flat.obj", "material": {"type": "lambertian"}}]}' >a/b/scene.json
cd a || exit 1
expect 2 "$STOKES" check b/scene.json
says err.txt '^b/scene\.json:1:[0-9]+: error: /background/filename: .*--allow-outside'
expect 0 "$STOKES" check --allow-outside b/scene.json
[ "$(grep -c 'warning: .*1 of 2 triangles' err.txt)" -eq 1 ] || fail "the dropped triangle is not told once: $(cat err.txt)"
expect 0 env STOKES_ALLOW_OUTSIDE=1 "$STOKES" render b/scene.json --device reference --progress none --size 4x4 --spp 1 -o x.exr
[ "$(grep -c 'warning: .*1 of 2 triangles' err.txt)" -eq 1 ] || fail "render does not tell the dropped triangle once: $(cat err.txt)"
cd ..
expect 0 "$STOKES" check a/b/scene.json

# A picture with a broken chunk: one line, though the library behind has its own to say.
expect 0 "$STOKES" render "$FIXTURES/small.json" --device reference --spp 1 -o picture.exr --png
at=$(grep -abo IDAT picture.png | head -1 | cut -d: -f1)
printf XX | dd of=picture.png bs=1 seek=$((at + 12)) conv=notrunc 2>/dev/null
printf '{"camera": {}, "background": {"type": "environment", "filename": "picture.png"}}' >picture.json
expect 2 "$STOKES" check picture.json
[ "$(wc -l <err.txt)" -eq 1 ] || fail "a broken picture takes more than one line: $(cat err.txt)"
says err.txt '^picture\.json:1:[0-9]+: error: /background'

# Devices.
expect 3 "$STOKES" render "$FIXTURES/small.json" --device 'no such device' -o x.exr
expect 3 env STOKES_DEVICE=nonesuch "$STOKES" render "$FIXTURES/small.json" -o x.exr
says err.txt nonesuch
expect 0 env STOKES_DEVICE=reference "$STOKES" render "$FIXTURES/small.json" -o x.exr

# Memory: need and have.
expect 4 render --size 65536x65536 --spp 1 -o big.exr
says err.txt 'needs .*GiB.*free'

# Outputs that cannot be written; found out before rendering, and the old file is intact.
expect 5 render -o no/such/folder/x.exr
says err.txt 'no/such/folder'
mkdir folder.exr
expect 5 render -o folder.exr
ln -s /dev/full full.exr
expect 5 render -o full.exr
ln -s round.exr circle.exr
ln -s circle.exr round.exr
expect 5 render -o circle.exr
[ -L circle.exr ] || fail 'a circle of links was replaced'
# A picture that the scene reads, and one that a page would overwrite.
expect 0 render -o sky.png --spp 1
cp sky.png sky.kept
expect 64 render -o sky.png --allow-outside --set '/background={"type":"environment","filename":"'"$WORK"'/sky.png"}'
says err.txt 'sky.png would be overwritten, and the scene reads it'
expect 64 "$STOKES" compare sky.png sky.png --html sky.png
says err.txt 'sky.png exists and is no HTML page'
expect 0 "$STOKES" compare sky.png sky.png --html page
expect 0 "$STOKES" compare sky.png sky.png --html page
cmp -s sky.png sky.kept || fail 'a picture was overwritten'
# A disk without room for checkpoints: the render goes on, and its picture, which is smaller, is written.
expect 0 prlimit --fsize=10000 "$STOKES" render "$FIXTURES/small.json" --device reference -q --spp 100000000 --max-time 2s --checkpoint 200ms -o room.exr
says err.txt '^warning: room.exr.checkpoint: cannot be written: .*; rendering goes on'
[ -s room.exr ] || fail 'a full disk for checkpoints lost the picture'
# Closed standard streams: no file takes their place, into which messages would then be written.
expect 0 sh -c '"$@" 2>&-' sh "$STOKES" render "$FIXTURES/small.json" --device reference -o closed.exr --progress plain
"$STOKES" render "$FIXTURES/small.json" --device reference -q --spp 500000000 --checkpoint none -o closed.exr <&- >&- 2>&- &
pid=$!
sleep 1
for stream in 0 1 2; do
  [ "$(readlink "/proc/$pid/fd/$stream")" = /dev/null ] || fail "the closed stream $stream is free for any file"
done
kill -9 $pid
wait $pid 2>/dev/null
printf old >old.exr
expect 5 sh -c 'ulimit -f 1; "$@"' sh "$STOKES" render "$FIXTURES/small.json" --device reference -q -o old.exr --size 64x64 --spp 1
[ "$(cat old.exr)" = old ] || fail 'a failed write damaged the old file'
[ -z "$(find . -name '*.tmp')" ] || fail 'a failed write left its temporary file'
# Disks that fill up at the beginning, the middle and the end of a small file, which libraries hold back until they close it.
# (Sizes vary by some bytes: metadata hold the time that a render took.)
for ending in exr png; do
  expect 0 render --spp 1 -o whole.$ending
  size=$(wc -c <whole.$ending)
  for limit in 150 $((size / 2)) $((size - 100)); do
    printf old >old.$ending
    expect 5 prlimit --fsize=$limit "$STOKES" render "$FIXTURES/small.json" --device reference -q --spp 1 -o old.$ending
    says err.txt "^error: old.$ending: cannot be written: "
    [ "$(cat old.$ending)" = old ] || fail "a file system with room for $limit of $size bytes damaged old.$ending"
  done
  expect 0 prlimit --fsize=$((size + 100)) "$STOKES" render "$FIXTURES/small.json" --device reference -q --spp 1 -o old.$ending
done
[ -z "$(find . -name '*.tmp')" ] || fail 'a full file system kept a temporary file'

# unwritable REASON: the renders to disk/old.* fail with the reason, and leave what was there.
unwritable() {
  for ending in exr png; do
    # shellcheck disable=SC2086
    expect 5 $as_user "$program" render small.json --device reference -q --spp 1 -o disk/old.$ending
    says err.txt "^error: disk/old.$ending: cannot be written: $1"
    [ "$(cat disk/old.$ending)" = old ] || fail "$1: disk/old.$ending is damaged"
  done
  [ -z "$(find disk -name '*.tmp')" ] || fail "$1: a temporary file was left"
}
cp "$FIXTURES/small.json" small.json
mkdir disk
# Real file systems, where this user may mount them.
as_user='' program=$STOKES
if mount -t tmpfs -o size=64k stokes-test disk 2>/dev/null; then
  trap 'umount "$WORK/disk"; rm -rf "$WORK"' EXIT
  printf old >disk/old.exr
  printf old >disk/old.png
  dd if=/dev/zero of=disk/filling bs=1024 2>/dev/null
  unwritable 'No space left on device'
  rm disk/filling
  mount -o remount,ro disk
  unwritable 'Read-only file system'
  umount disk
  trap 'rm -rf "$WORK"' EXIT
else
  printf 'full and read-only file systems: not tried, no right to mount\n'
fi
# A folder of someone else's; root, who may write everywhere, becomes nobody.
printf old >disk/old.exr
printf old >disk/old.png
chmod 755 "$WORK"
chmod 555 disk
if [ "$(id -u)" -eq 0 ]; then
  as_user='setpriv --reuid=65534 --regid=65534 --clear-groups' program=$WORK/stokes
  cp "$STOKES" stokes
fi
unwritable 'Permission denied'
# A file that may not be written, in a folder that may.
chmod 777 disk
chmod 444 disk/old.exr disk/old.png
unwritable 'Permission denied'
chmod 755 disk
rm -rf stokes disk
"$STOKES" check "$FIXTURES/small.json" >/dev/full 2>err.txt
[ $? -eq 5 ] || fail 'a full standard output is no success'

# Differences.
expect 0 render -o a.exr
expect 0 render -o b.exr
expect 0 "$STOKES" compare a.exr b.exr --exact
expect 0 render -o c.exr --seed 6
expect 7 "$STOKES" compare a.exr c.exr
expect 0 "$STOKES" compare a.exr c.exr --max-flip 0.9
expect 0 render -o av.exr --aov variance --spp 64
expect 0 render -o cv.exr --aov variance --spp 64 --seed 6
expect 0 "$STOKES" compare av.exr cv.exr
expect 0 render -o dv.exr --aov variance --spp 64 --set /materials/0/albedo=[0.2,0.2,0.1]
expect 7 "$STOKES" compare av.exr dv.exr
says out.txt DIFFER
expect 2 "$STOKES" compare a.exr no-such.exr
expect 0 render -o small.exr --size 8x6
expect 2 "$STOKES" compare a.exr small.exr
says err.txt 'different sizes'
finish
