#!/bin/sh
# What bench, parity, compare, devices and plot say: numbers for people and for programs, and exit code 7 where a score or a picture is wrong.
# ./tools.sh STOKES. devices --check and its JSON need an OpenCL device.
. "$(dirname -- "$0")/common.sh" "$@"
scene=$FIXTURES/small.json

# is FILE EXPRESSION: what Python makes of a JSON file, j, is true.
is() {
  python3 -c "import json, sys; j = json.load(open('$1')); sys.exit(0 if $2 else 1)" || {
    fail "$1 is not as it should be: $2"
    cat "$1"
  }
}

# A suite: names, sizes, settings; a score counts only where the picture is the reference's.
cat >suite.json <<END
{"scenes": [{"file": "$scene", "name": "one", "spp": 16, "size": "12x10", "parity": {"size": "8x8", "spp": 32}},
            {"file": "$scene", "set": {"/sampler/samples": 16}}]}
END
expect 0 "$STOKES" bench --suite suite.json --device reference --repeat 2 --json
is out.txt '[c["name"] for c in j] == ["one", "small"]'
is out.txt 'j[0]["width"] == 12 and j[0]["samples"] == 12 * 10 * 16 and len(j[0]["cpu_seconds_runs"]) == 2'
is out.txt 'all(c["parity"]["agree"] and c["msamples_per_second"] > 0 and c["efficiency_rgb"] > 0 and c["peak_memory_bytes"] > 1e6 for c in j)'
expect 0 "$STOKES" bench "$scene" --device reference --no-parity --no-noise --no-cold --spp 8
says out.txt '^scene +Msamples/s'
says out.txt '^small +[0-9.]+ .* not asked$'
printf '{"scenes": [{}]}' >bad_suite.json
expect 2 "$STOKES" bench --suite bad_suite.json
says err.txt 'bad_suite.json: is no suite'
expect 2 "$STOKES" bench --suite none.json

# Two renders of one scene agree, of two do not.
expect 0 "$STOKES" parity "$scene" --devices reference --spp 16 --json
is out.txt 'j[0]["agree"] and j[0]["rejected"] == [] and 0 < j[0]["p"] <= 1 and set(j[0]["means"]) == set("RGBA")'
expect 0 "$STOKES" render "$scene" --device reference -q -o a.exr --aov variance --spp 64
expect 0 "$STOKES" render "$scene" --device reference -q -o b.exr --aov variance --spp 64 --set /background=0.9
expect 7 "$STOKES" compare a.exr b.exr --json
is out.txt 'j["different"] and not j["agree"] and j["mse"] > 0 and j["largest_z"] > j["threshold_z"] and set(j["mean_z"]) == set("RGB")'
expect 7 "$STOKES" compare a.exr b.exr
says out.txt 'parts at pixels \[[0-9]+,[0-9]+\) x'
expect 7 "$STOKES" compare a.exr b.exr --max-mse 1e-9
expect 0 "$STOKES" compare a.exr b.exr --max-mse 10 --max-relmse 100
expect 0 "$STOKES" render "$scene" --device reference -q -o plain.exr --spp 1
expect 7 "$STOKES" compare plain.exr a.exr
says out.txt 'not identical \(no variances to judge by'

# Grey pictures, and what is none; two that share a value that is no number are not called identical.
printf 'P5 3 2 255\n\001\100\200\300\010\020' >grey.pgm
printf 'P5 3 2 255\n\001\100\200\300\010\030' >other.pgm
expect 0 "$STOKES" compare grey.pgm grey.pgm --html grey.html
expect 7 "$STOKES" compare grey.pgm other.pgm
python3 -c "
import struct
values = [struct.pack('<f', v) for v in (0.5, float('nan'), 1, 1, 1, 1)]
open('nan.pfm', 'wb').write(b'PF\n2 1\n-1\n' + b''.join(values))"
if "$STOKES" info nan.pfm >/dev/null 2>&1; then
  expect 7 "$STOKES" compare nan.pfm nan.pfm
  says out.txt 'different: 1 values are not finite'
  grep -q '^identical' out.txt && fail 'a picture with a NaN is called identical'
fi

# Devices, and how they lay out what they share with the host.
expect 0 "$STOKES" devices --json
is out.txt 'sum(d["auto"] for d in j) == 1 and all(":" in d["id"] and d["memory_bytes"] > 0 for d in j)'
expect 0 "$STOKES" devices --check
says out.txt '^[0-9]+:[0-9]+  layout of shared structs: agrees'
expect 64 "$STOKES" devices --check --json

# Progress, on a terminal and in a file, and what a terminal sees when a render is over.
expect 0 script -qec "'$STOKES' render '$scene' --device reference -o t.exr --spp 100000000 --max-time 1s" /dev/null
says out.txt '\[=* *>? *\] +[0-9.]+ %  [0-9]+/100000000 samples.*ETA'
expect 0 "$STOKES" render "$scene" --device reference -o t.exr --spp 100000000 --max-time 1s --progress json
says err.txt '"samples_total":100000000,"mrays_per_second":[0-9.]+,"elapsed":1'

# Plots of everything that can be named.
for what in A E F11 blackbody:5000 gaussian:550:20 box:400:500 '[0.2,0.5,0.3]' '{"type":"illuminant","name":"D65"}' "$FIXTURES/../../scenes/fluorescent_box.json"; do
  expect 0 "$STOKES" plot "$what" -o plot.svg
  says plot.svg '<(path|polyline)'
done
printf '400,0.1\n500,0.4\n700,0.2\n' >curve.csv
expect 0 "$STOKES" plot curve.csv -o plot.png --samples 100 --role reflectance
expect 2 "$STOKES" plot blackbody:-1
expect 64 "$STOKES" plot gaussian:1
expect 64 "$STOKES" plot D65 -o plot.pdf
finish
