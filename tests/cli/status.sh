#!/bin/sh
# A job folder: its parts by unit and by the commands that `status` prints; missing, damaged, unfinished and foreign parts are named.
. "$(dirname -- "$0")/common.sh" "$@"

small=$FIXTURES/small.json
expect 0 render -o whole.exr --aov all
plan() {
  "$STOKES" distribute "$small" --device reference -q --plan "$@"
}
unit() {
  "$STOKES" distribute --dir "my job" -q --unit "$@"
}
expect 0 plan -o out.exr --dir "my job" --parts 4 --aov all
says out.txt '^4$'
expect 6 "$STOKES" status "my job"
says out.txt '# 0 of 4 parts are done'
says out.txt '# part 1, samples 3:6: missing'

# Units in any order and twice; one that is done is not rendered again.
expect 0 unit 2
expect 0 unit 0
cp "my job/part-0000000-0000003.film" first.film
ls -i "my job/part-0000000-0000003.film" >inode
expect 0 unit 0
ls -i "my job/part-0000000-0000003.film" | cmp -s inode - || fail 'a part that was done is rendered again'
expect 6 "$STOKES" status "my job"
says out.txt '# 2 of 4 parts'
grep -q 'samples 0:3' out.txt && fail 'a part that is done is named as open'

# A cut, a flipped, a foreign and an unfinished part.
head -c 3000 first.film >"my job/part-0000000-0000003.film"
cp first.film "my job/part-0000003-0000006.film"
expect 0 "$STOKES" render "$small" --device reference -q --aov all --seed 1 --samples 6:9 -o "my job/part-0000006-0000009.film"
expect 0 "$STOKES" render "$small" --device reference -q --aov all --samples 9:11 -o "my job/part-0000009-0000012.film"
expect 6 "$STOKES" status "my job"
says out.txt 'samples 0:3: damaged: is damaged: it is cut short'
says out.txt 'samples 3:6: foreign: it holds the samples 0:3'
says out.txt 'samples 6:9: foreign: its seed is 1, not 5'
says out.txt 'samples 9:12: unfinished: it holds the samples 9:11'
cp first.film "my job/part-0000000-0000003.film"
printf '\001' | dd of="my job/part-0000000-0000003.film" bs=1 seek=2500 conv=notrunc 2>/dev/null
expect 6 "$STOKES" status "my job" --json
says out.txt '"reason": "is damaged: its checksum is wrong"'
says out.txt '"complete": false'

# What status prints is a script that makes all good, and merges to the bits of one render.
"$STOKES" status "my job" >script
expect 0 sh -e script
expect 0 "$STOKES" status "my job"
says out.txt '# 4 of 4 parts'
expect 0 "$STOKES" compare whole.exr out.exr --exact

# Ranges that are not of one length, and the scene's changes, go with the job.
expect 0 plan -o five.exr --dir five --parts 5 --set /background=0.1 --crop 2,9,1,7 --seed 9
"$STOKES" status five >script
expect 0 sh -e script
expect 0 render -o one.exr --set /background=0.1 --crop 2,9,1,7 --seed 9
expect 0 "$STOKES" compare one.exr five.exr --exact

# Another render does not get into the folder; a scene that has changed meanwhile is refused; so is what is no job.
expect 2 plan -o five.exr --dir five --parts 5 --seed 9
says err.txt 'five: holds another job: its window is'
expect 2 plan -o five.exr --dir five --parts 4 --set /background=0.1 --crop 2,9,1,7 --seed 9
says err.txt 'its job has 5 parts, not 4'
cp "$small" changing.json
expect 0 "$STOKES" distribute changing.json --device reference -q --plan -o c.exr --dir c --parts 2
sed 's/"radius": 1/"radius": 1.1/' "$small" >changing.json
expect 2 "$STOKES" distribute --dir c --unit 0 -q
says err.txt 'changing.json: is not the scene that is expected'
[ -e c/part-0000000-0000006.film ] && fail 'a part of a changed scene was written'
expect 2 "$STOKES" status nowhere
says err.txt 'nowhere: is no job folder'
printf '{"stokes_job": 1}' >c/job.json
expect 2 "$STOKES" status c
says err.txt 'job.json: is damaged'
# A manifest whose parts do not make up the render, or lie elsewhere.
broken() {
  sed "$1" "my job/job.json" >c/job.json
  expect 2 "$STOKES" status c
  says err.txt "job.json: is damaged: $2"
  expect 2 "$STOKES" distribute --dir c --unit 0 -q
}
broken 's/"samples": 12,/"samples": 13,/' 'its parts end at sample 12 of 13'
tr -d '\n' <"my job/job.json" >flat.json
cp flat.json "my job/job.json"
broken 's/\[ *3, *6 *\]/[ 4, 6 ]/' 'part 1 has the samples 4:6 where 3 is next'
broken 's/\[ *3, *6 *\]/[ 3, 3 ]/' 'part 1 has the samples 3:3 where 3 is next'
broken 's/\[ *3, *6 *\]/[ 3, 1e300 ]/' '1e.300 stands where an integer is expected'
broken 's|"part-0000003|"../part-0000003|' 'part 1 does not lie in the folder'
expect 64 unit 4
expect 64 "$STOKES" distribute "$small" -o out.exr
expect 64 "$STOKES" distribute "$small" -o out.exr --scheduler localhost
expect 64 "$STOKES" distribute "$small" -o out.exr --workers 2 --plan

# Without Python, or a Python without Dask, one line says what is missing; the plan stays for other engines.
expect 3 env STOKES_DASK_PYTHON=/nowhere/python3 "$STOKES" distribute "$small" --device reference -q -o w.exr --workers 1
says err.txt '/nowhere/python3 cannot be run'
printf '#!/bin/sh\nexec /usr/bin/env python3 -S -E "$@"\n' >bare
chmod +x bare
expect 3 env STOKES_DASK_PYTHON="$WORK/bare" "$STOKES" distribute "$small" --device reference -q -o w.exr --workers 1
says err.txt "pip install distributed"
[ "$(wc -l <err.txt)" -eq 1 ] || fail 'the error is more than a line'

# Workers beyond the parts that are left would have nothing to do.
printf '#!/bin/sh\nshift 2\nprintf "%%s\\n" "$1" >asked.json\nexit 3\n' >python
chmod +x python
expect 3 env STOKES_DASK_PYTHON="$WORK/python" "$STOKES" distribute "$small" --device reference -q -o few.exr --workers 1000 --spp 3
says asked.json '"workers":3'
finish
