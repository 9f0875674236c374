#!/bin/sh
# `stokes import`: scenes of Mitsuba and pbrt that are understood as a whole, what is listed by line, and what is refused.
. "$(dirname -- "$0")/common.sh" "$@"
SOURCES=$FIXTURES/import

for name in box fog rough; do
  expect 0 "$STOKES" import "$SOURCES/$name.xml" -o $name.json --strict
  [ -s err.txt ] && fail "$name.xml: $(cat err.txt)"
  expect 0 "$STOKES" render $name.json --device reference -q --spp 2
done
expect 0 "$STOKES" import "$SOURCES/box.pbrt" -o pbrt.json
# The patches are said to become triangles, at their lines in the included file; nothing else is said.
says err.txt 'walls.pbrt:6: note: bilinear'
says err.txt 'walls.pbrt:10: note: bilinear'
[ "$(grep -c ': note: ' err.txt)" -eq 2 ] || fail "notes on box.pbrt: $(cat err.txt)"
expect 2 "$STOKES" import "$SOURCES/box.pbrt" -o pbrt.json --strict --force
expect 0 "$STOKES" check pbrt.json

# The same box by three ways: the picture of box.xml without its cube is that of box.pbrt.
"$STOKES" render box.json --device reference -q --spp 64 --size 16x12 --aov variance --set '/surfaces/5/transform={"translate":[0,9,0]}' -o a.exr
"$STOKES" render pbrt.json --device reference -q --spp 64 --seed 7 --size 16x12 --aov variance -o b.exr
expect 0 "$STOKES" compare a.exr b.exr

# Files that the scene leaves where they are: said where rendering will ask for a permission.
mkdir -p far near/by
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\n' >far/corner.obj
printf '<scene version="3.0.0"><sensor type="perspective"><float name="fov" value="40"/></sensor>\n<shape type="obj"><string name="filename" value="corner.obj"/></shape></scene>\n' >far/corner.xml
cd near/by || exit 1
expect 0 "$STOKES" import ../../far/corner.xml -o corner.json
says err.txt 'corner\.json names .*far/corner\.obj, so rendering it needs --allow-outside'
expect 0 "$STOKES" check --allow-outside corner.json
cd ../..

# Nothing is dropped in silence: each thing of strange.xml that has no counterpart, by its line.
expect 0 "$STOKES" import "$SOURCES/strange.xml" -o strange.json
for line in 2 5 6 8 10 12; do
  says err.txt "strange.xml:$line: note: "
done
says err.txt 'strange.xml:8: note: .*principled'
says err.txt 'strange.xml:12: note: <emitter type="point"> has no counterpart'
expect 0 "$STOKES" check strange.json
expect 2 "$STOKES" import "$SOURCES/strange.xml" -o strict.json --strict
expect 0 "$STOKES" import "$SOURCES/strange.pbrt" -o strange_pbrt.json
for line in 1 2 3 4 5 7 8 9 10 12 13 14 15 17 20 21 22 24 25 26 27 28 29 30 31 32 33 36 37 39 40 41 44 45 46 47 48 50 51; do
  says err.txt "strange.pbrt:$line: note: "
done
says err.txt 'strange.pbrt:51: note: "float power" of AreaLightSource has no counterpart'
says err.txt 'strange.pbrt:48: note: a shape of type "loopsubdiv" has no counterpart'
expect 0 "$STOKES" check strange_pbrt.json
[ -s strange_meshes/corner_0.obj ] || fail 'the PLY mesh was not written as OBJ'

# As Mitsuba 3 does it: an axis of rotation is not normalised, and a <spectrum> of one number is white of equal energy, also as an emission.
cat >turn.xml <<'END'
<scene version="3.0.0">
  <shape type="rectangle">
    <transform name="to_world"><rotate x="1" y="1" angle="30"/></transform>
    <emitter type="area"><spectrum name="radiance" value="2.5"/></emitter>
  </shape>
  <emitter type="constant"><float name="radiance" value="1.5"/></emitter>
</scene>
END
expect 0 "$STOKES" import turn.xml -o turn.json
tr -d ' \n' <turn.json >turn.txt
says turn.txt '"matrix":\[1.0,0.13397[0-9]*,0.5,'
says turn.txt '"emit":{"type":"constant","value":2.5}'
says turn.txt '"background":1.5'

# A packed mesh, one that ends early, and an element of nothing many times.
gzip -c "$SOURCES/corner.ply" >packed.ply.gz
printf 'Camera "perspective"\nWorldBegin\nShape "plymesh" "string filename" "packed.ply.gz"\n' >packed.pbrt
expect 0 "$STOKES" import packed.pbrt -o packed.json --strict
head -c 90 packed.ply.gz >cut.ply.gz
sed s/packed.ply/cut.ply/ packed.pbrt >cut.pbrt
expect 2 "$STOKES" import cut.pbrt -o x.json
says err.txt '^cut.pbrt:3: error: cut.ply.gz cannot be read as PLY: it is packed, and damaged'
sed 's/^element face/element void 99999999999999\n&/' "$SOURCES/corner.ply" >packed.ply
sed s/packed.ply.gz/packed.ply/ packed.pbrt >void.pbrt
expect 0 timeout 20 "$STOKES" import void.pbrt -o void.json

# Refused, in one line at its place.
expect 5 "$STOKES" import "$SOURCES/fog.xml" -o box.json
says err.txt 'box.json exists already'
expect 64 "$STOKES" import "$SOURCES/../small.json" -o x.json
expect 2 "$STOKES" import no-such.xml -o x.json
says err.txt '^no-such.xml:1: error: '
printf '<scene version="3.0.0">\n  <shape type="sphere">\n</scene>\n' >torn.xml
expect 2 "$STOKES" import torn.xml -o x.json
says err.txt '^torn.xml:[23]: error: not XML'
printf '<scene version="3.0.0">\n<shape type="sphere"><ref id="gone"/></shape></scene>\n' >ref.xml
expect 2 "$STOKES" import ref.xml -o x.json
says err.txt '^ref.xml:2: error: nothing has the id "gone"'
printf 'WorldBegin\nShape "sphere" "float radius" [ big ]\n' >word.pbrt
expect 2 "$STOKES" import word.pbrt -o x.json
says err.txt '^word.pbrt:2: error: .*radius'
printf 'WorldBegin\nShape "trianglemesh" "point3 P" [ 0 0 0 1 0 0 0 1 0 ] "integer indices" [ 0 1 3 ]\n' >index.pbrt
expect 2 "$STOKES" import index.pbrt -o x.json
says err.txt '^index.pbrt:2: error: an index is out of range'
sed 's/^4 0 1 2 3/4 0 1 2 7/' "$SOURCES/corner.ply" >corner.ply
printf '<scene version="3.0.0">\n<shape type="ply"><string name="filename" value="corner.ply"/></shape></scene>\n' >ply.xml
expect 2 "$STOKES" import ply.xml -o x.json
says err.txt '^ply.xml:2: error: corner.ply cannot be read as PLY: a face refers to vertex 7'

# Files of strangers: each is refused within moments, at its place, with no crash, no endless reading and no memory to speak of.
mkdir hostile && cd hostile || exit 1
refuse() {
  pattern=$1
  shift
  expect 2 timeout 120 "$STOKES" import "$@" -o x.json
  says err.txt "$pattern"
}
# mitsuba NAME BODY, pbrt NAME BODY: a scene of these elements or directives.
mitsuba() { printf '<scene version="3.0.0">\n%s</scene>\n' "$2" >"$1.xml"; }
pbrt() { printf 'WorldBegin\n%s\n' "$2" >"$1.pbrt"; }
mitsuba circle '<bsdf type="twosided" id="a"><ref id="b"/></bsdf><bsdf type="twosided" id="b"><ref id="a"/></bsdf>'
refuse '^circle.xml:2: error: BSDFs lie in each other' circle.xml
python3 -c "print('<scene version=\"3.0.0\"><shape type=\"sphere\">' + '<bsdf type=\"twosided\">' * 100000 + '</bsdf>' * 100000 + '</shape></scene>')" >deep.xml
refuse '^deep.xml:1: error: elements lie in each other' deep.xml
printf '<scene version="3.0.0"><shape type="sphere" id="\377"/></scene>' >bytes.xml
refuse '^bytes.xml:1: error: .*not UTF-8' bytes.xml
mitsuba colour '<shape type="sphere"><bsdf type="diffuse"><rgb name="reflectance" value="#zz0000"/></bsdf></shape>'
refuse '^colour.xml:2: error: expected #rrggbb' colour.xml
printf 'WorldBegin\nNamedMaterial "\377"\n' >bytes.pbrt
refuse '^bytes.pbrt:2: error: a string is not UTF-8' bytes.pbrt
mkfifo pipe
printf 'Include "pipe"\n' >pipe.pbrt
refuse '^pipe.pbrt:1: error: the file "pipe" cannot be read: it is no regular file' pipe.pbrt
mitsuba pipe '<shape type="ply"><string name="filename" value="pipe"/></shape>'
refuse '^pipe.xml:2: error: .*no regular file' pipe.xml
# Twenty groups, each of two instances of the one before.
{
  echo '<scene version="3.0.0"><shape type="shapegroup" id="g0"><shape type="sphere"/></shape>'
  for i in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20; do
    instance="<shape type=\"instance\"><ref id=\"g$((i - 1))\"/></shape>"
    echo "<shape type=\"shapegroup\" id=\"g$i\">$instance$instance</shape>"
  done
  echo '</scene>'
} >groups.xml
refuse '^groups.xml:[0-9]+: error: more than [0-9]+ surfaces' groups.xml
pbrt outside 'Include "/dev/zero"'
refuse '^outside.pbrt:2: error: .*--allow-outside' outside.pbrt
for i in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20; do printf 'Include "%s.pbrt"\nInclude "%s.pbrt"\n' $((i + 1)) $((i + 1)) >$i.pbrt; done
echo Identity >21.pbrt
refuse 'error: files include each other without end, or too often' 1.pbrt
{ echo WorldBegin && echo 'ObjectBegin "o"' && yes 'Shape "sphere"' | head -1000 && echo ObjectEnd && yes 'ObjectInstance "o"' | head -100000; } >many.pbrt
refuse '^many.pbrt:[0-9]+: error: more than [0-9]+ surfaces' many.pbrt
printf 'ply\nformat ascii 1.0\nelement vertex 99999999999\nelement face 99999999999\nend_header\n' >empty.ply
mitsuba ply '<shape type="ply"><string name="filename" value="empty.ply"/></shape>'
refuse '^ply.xml:2: error: empty.ply cannot be read as PLY: it holds no faces' ply.xml
expect 64 "$STOKES" import many.pbrt -o many.pbrt --force
says err.txt 'does not end in .json'
pbrt ball 'Shape "sphere"'
expect 0 "$STOKES" import ball.pbrt -o ball.json
pbrt mesh 'Shape "trianglemesh" "point3 P" [ 0 0 0 1 0 0 0 1 0 ]'
touch taken_meshes
expect 5 "$STOKES" import mesh.pbrt -o taken.json
says err.txt 'taken_meshes cannot be made'
cd ..
for left in x.json hostile/x.json; do
  [ -e $left ] && fail 'a refused import left a scene'
done
finish
