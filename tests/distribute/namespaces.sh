#!/bin/bash
# Dask's scheduler and two workers as separate hosts: three network namespaces on one bridge, and `stokes distribute` in the first.
# Usage, as root: namespaces.sh STOKES PYTHON   (a Python with the module distributed). Reaches nothing but those namespaces.
set -eu
stokes=$(realpath "$1") python=$2
scene=$(realpath "$(dirname "$0")/../cli/small.json")
spp=${SPP:-8000}
folder=$(mktemp -d)
tag=st$$
pids=()

cleanup() {
  [ ${#pids[@]} -eq 0 ] || kill "${pids[@]}" 2>/dev/null || true
  wait 2>/dev/null || true
  for i in 0 1 2; do ip netns del "$tag$i" 2>/dev/null || true; done
  rm -rf "$folder"
}
trap cleanup EXIT

# Host 0 has the bridge; 1 and 2 reach it over a pair of veth devices each.
for i in 0 1 2; do
  ip netns add "$tag$i"
  ip -n "$tag$i" link set lo up
done
ip -n "${tag}0" link add bridge type bridge
ip -n "${tag}0" addr add 10.83.0.1/24 dev bridge
ip -n "${tag}0" link set bridge up
for i in 1 2; do
  ip -n "${tag}0" link add "to$i" type veth peer name eth netns "$tag$i"
  ip -n "${tag}0" link set "to$i" master bridge up
  ip -n "$tag$i" addr add "10.83.0.$((i + 1))/24" dev eth
  ip -n "$tag$i" link set eth up
done

cd "$folder"
ip netns exec "${tag}0" "$python" -m distributed.cli.dask_scheduler --host 10.83.0.1 --port 8786 --no-dashboard >scheduler.log 2>&1 &
pids+=($!)
for i in 1 2; do
  ip netns exec "$tag$i" "$python" -m distributed.cli.dask_worker tcp://10.83.0.1:8786 --nthreads 1 --no-dashboard --name "host$i" \
    --local-directory "$folder/worker$i" >"worker$i.log" 2>&1 &
  pids+=($!)
done

"$stokes" render "$scene" --device reference -q --spp "$spp" -o whole.exr >/dev/null
ip netns exec "${tag}0" env STOKES_DASK_PYTHON="$python" "$stokes" distribute "$scene" --device reference --spp "$spp" --parts 12 --dir job \
  --scheduler tcp://10.83.0.1:8786 -o out.exr
"$stokes" compare whole.exr out.exr --exact >/dev/null
grep -h -o 'Starting established connection.*' scheduler.log | sort -u | head -4 || true
echo "namespaces: complete, same bits; a worker in each of two namespaces, and the scheduler in a third"
