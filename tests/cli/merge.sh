#!/bin/sh
# Parts add up to the bits of one render; parts that do not fit are refused by name.
. "$(dirname -- "$0")/common.sh" "$@"

expect 0 render -o whole.exr --aov all
expect 0 render -o p1.exr --aov all --samples 0:5
expect 0 render -o p2.exr --aov all --samples 5:6
expect 0 render -o p3.film --aov all --samples 6:12
expect 0 "$STOKES" merge -o merged.exr p3.film p1.exr p2.exr
expect 0 "$STOKES" compare whole.exr merged.exr --exact
expect 7 "$STOKES" compare whole.exr p1.exr --exact
expect 0 "$STOKES" info p1.exr
says out.txt 'samples: 0:5'

refused() {
  pattern=$1
  shift
  rm -f no.exr
  expect 2 "$STOKES" merge -o no.exr "$@"
  says err.txt "$pattern"
  [ -e no.exr ] && fail "a refused merge wrote its output"
}
refused '5:6 are missing .*p3.film' p1.exr p3.film
refused '0:5 are missing .*p2.exr' p2.exr p3.film
refused '6:12 are missing .*p2.exr' p1.exr p2.exr
refused 'p1.exr: overlaps p1.exr' p1.exr p1.exr p2.exr p3.film
expect 0 render -o overlap.exr --aov all --samples 4:6
refused 'overlap.exr: overlaps p1.exr' p1.exr overlap.exr p3.film
expect 0 render -o seed.exr --aov all --samples 5:6 --seed 1
refused 'seed.exr: .*seed is 1, not 5' p1.exr seed.exr p3.film
expect 0 render -o scene.exr --aov all --samples 5:6 --set /background=0.1
refused 'scene.exr: .*another scene' p1.exr scene.exr p3.film
expect 0 render -o size.exr --aov all --samples 5:6 --crop 0,8,0,8
refused 'size.exr: .*window' p1.exr size.exr p3.film
expect 0 render -o total.exr --aov all --samples 5:6 --spp 13
refused 'total.exr: .*13 samples, not 12' p1.exr total.exr p3.film
refused 'whole.exr: holds no film' p1.exr whole.exr p3.film
head -c 3000 p3.film >cut.film
refused 'cut.film: is damaged' p1.exr p2.exr cut.film
cp p3.film flipped.film
printf '\001' | dd of=flipped.film bs=1 seek=2500 conv=notrunc 2>/dev/null
refused 'flipped.film: is damaged: its checksum' p1.exr p2.exr flipped.film
refused 'missing.exr: cannot be opened' p1.exr missing.exr
# No part is lost to the whole that is made of it.
cp p1.exr mine.exr
expect 64 "$STOKES" merge -o mine.exr mine.exr p2.exr p3.film
says err.txt 'mine.exr would be overwritten, and the merge reads it'
cmp -s p1.exr mine.exr || fail 'a part was overwritten'
finish
