#!/bin/sh
# What a render writes and prints.
. "$(dirname -- "$0")/common.sh" "$@"

# The default name is the scene's, in the current folder; results go to stdout, the rest to stderr.
expect 0 "$STOKES" render "$FIXTURES/small.json" --device reference --png
[ "$(cat out.txt)" = 'small.exr
small.png' ] || fail "stdout is not the two names: $(cat out.txt)"
[ -s small.exr ] && [ -s small.png ] || fail 'an output is missing'

# Channels and metadata.
expect 0 render -o all.exr --aov all --spectral 400:700:3
expect 0 "$STOKES" info all.exr
for name in '"R","G","B","A"' Albedo.R N.Z '"Z"' Variance.G Fluorescence.Energy 'S0.450,000000nm' 'S0.650,000000nm' \
  'spectralLayoutVersion: 1.0' 'emissiveUnits: W.m\^-2.sr\^-1' 'stokes:seed: 5' 'stokes:samples: 12' 'stokes:device: reference' 'stokes:scene_hash: [0-9a-f]{16}' \
  'stokes:driver' 'stokes:integrator' 'stokes:render_seconds' 'compression: zip'; do
  says out.txt "$name"
done

# The summary.
expect 0 render -o j.exr --json
for key in output render_seconds build_seconds load_seconds samples rays shadow_rays scatterings device driver seed peak_memory_bytes invalid_samples; do
  says out.txt "\"$key\": "
done

# Options override the scene, --set too, and every way to say a thing gives the same picture.
expect 0 render -o a.exr --spp 3 --seed 9 --size 10x8
expect 0 render -o b.exr --set /sampler/samples=3 --set /sampler/seed=9 --set '/camera/resolution=[10,8]'
expect 0 "$STOKES" compare a.exr b.exr --exact
expect 0 "$STOKES" info a.exr
says out.txt 'width: 10'
expect 0 render -o c.exr --crop 0.25,0.75,0,0.5
expect 0 render -o d.exr --crop 4,12,0,6
expect 0 "$STOKES" compare c.exr d.exr --exact
expect 0 "$STOKES" info c.exr
says out.txt 'full_size: \[16,12\]'
says out.txt 'window: \[4,0\]'

# The image does not depend on threads.
expect 0 render -o t1.exr --threads 1
expect 0 render -o t3.exr --threads 3
expect 0 "$STOKES" compare t1.exr t3.exr --exact

# A time limit ends a long render in time, with fewer samples and success.
expect 0 render -o m.exr --spp 100000000 --max-time 1s --json
says out.txt '"complete": true'

# Progress as JSON lines on stderr.
expect 0 "$STOKES" render "$FIXTURES/small.json" --device reference -o p.exr --progress json
says err.txt '^\{"progress":1\.000000,"samples":12,'

# Comparisons as one page; parity needs an OpenCL device, which is another test's business.
expect 0 render -o v1.exr --aov variance --spectral 400:700:3
expect 0 render -o v2.exr --aov variance --spectral 400:700:3 --seed 8
expect 0 "$STOKES" compare v1.exr v2.exr --html compare.html
says compare.html 'v1.exr against v2.exr'
says compare.html '"verdict":"They agree within their noise"'
says compare.html '"spectra":\{"begin":400.0,"end":700.0'
expect 0 "$STOKES" parity "$FIXTURES/small.json" --devices reference --spp 16 --html parity.html
says parity.html '"convergence":\[\[1,[0-9.e-]*\],\[2,'
expect 5 "$STOKES" compare v1.exr v2.exr --html nowhere/compare.html

# Nobody listens there: an output error before any work is done.
expect 5 render -o w.exr --display-server 127.0.0.1:1
says err.txt 'no viewer answers'

# The part that reads and writes images stands beside the program; a broken one is told in one line.
mkdir copy
cp "$STOKES" copy/stokes
echo 'no library' >copy/libstokes_image_codec.so
expect 5 copy/stokes render "$FIXTURES/small.json" --device reference -q -o copy.exr
says err.txt '^error: images cannot be read or written: .*libstokes_image_codec.so'
[ "$(wc -l <err.txt)" -eq 1 ] || fail 'more than one line'
[ ! -e copy.exr ] || fail 'an output without a picture'
expect 0 copy/stokes render "$FIXTURES/small.json" --device reference -q -o copy.film

# Plots.
expect 0 "$STOKES" plot D65 -o d65.svg
says d65.svg '<svg'
expect 0 "$STOKES" plot "$FIXTURES/small.json#red" -o red.png --samples 1000
expect 2 "$STOKES" plot "$FIXTURES/small.json#blue"
says err.txt 'it has: red'
expect 64 "$STOKES" plot nonsense
finish
