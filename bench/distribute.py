#!/usr/bin/env python3
"""How much faster two Dask workers of one core each are than one: whole runs of `stokes distribute`, by the clock, in turn. Prints each pair,
the ratios' median and spread, and the processor time of either; says so where others' work on the machine spoils the clock. Beside them two
plain renders of half the samples each run side by side: what the machine's two cores allow, without Dask, parts and merging.

Usage: distribute.py STOKES [--pairs 3] [--spp N] [--size WxH] [--scene FILE]. STOKES_DASK_PYTHON names the Python with Dask, as for `stokes`."""
import argparse
import os
import pathlib
import resource
import statistics
import subprocess
import sys
import tempfile
import time

SCENES = pathlib.Path(__file__).resolve().parent / "scenes"


def busy_jiffies():
    """Processor time of the whole machine, in s."""
    fields = [int(word) for word in open("/proc/stat").readline().split()[1:9]]
    return (sum(fields) - fields[3] - fields[4]) / os.sysconf("SC_CLK_TCK")


def run(options, workers, folder):
    """Seconds by the clock, our own processor seconds, and those of everything else meanwhile."""
    out = folder / f"{workers}.exr"
    command = [options.stokes, "distribute", options.scene, "-o", out, "--workers", str(workers), "--threads", "1", "--parts", str(options.parts), "-q",
               "--spp", str(options.spp), "--size", options.size]
    before, machine, start = resource.getrusage(resource.RUSAGE_CHILDREN), busy_jiffies(), time.monotonic()
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    wall = time.monotonic() - start
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    own = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return wall, own, max(0.0, busy_jiffies() - machine - own)


def run_halves(options, folder):
    """Seconds by the clock of two renders of one core each, side by side, of half the samples each."""
    middle = options.spp // 2
    command = [options.stokes, "render", options.scene, "--threads", "1", "-q", "--spp", str(options.spp), "--size", options.size]
    start = time.monotonic()
    renders = [subprocess.Popen(command + ["--samples", samples, "--restart", "-o", folder / f"half{i}.film"], stdout=subprocess.DEVNULL)
               for i, samples in enumerate((f"0:{middle}", f"{middle}:{options.spp}"))]
    if any([render.wait() for render in renders]):
        sys.exit("a render of half the samples failed")
    return time.monotonic() - start


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("stokes")
    parser.add_argument("--scene", default=SCENES / "s1.json")
    parser.add_argument("--size", default="256x256")
    parser.add_argument("--spp", type=int, default=2400)
    parser.add_argument("--parts", type=int, default=16)
    parser.add_argument("--pairs", type=int, default=3)
    options = parser.parse_args()
    ratios, overheads, disturbed = [], [], 0.0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        subprocess.run([options.stokes, "render", options.scene, "-q", "--spp", "1", "--size", options.size, "-o", folder / "warm.exr"], check=True, stdout=subprocess.DEVNULL)
        for pair in range(options.pairs):
            one, own_one, other_one = run(options, 1, folder)
            two, own_two, other_two = run(options, 2, folder)
            halves = run_halves(options, folder)
            ratios.append(one / two)
            overheads.append(two / halves)
            disturbed = max(disturbed, other_one / one, other_two / two)
            print(f"{pair + 1}: one worker {one:.1f} s ({own_one:.1f} s of processor), two {two:.1f} s ({own_two:.1f} s): ratio {one / two:.2f}; "
                  f"two plain renders side by side {halves:.1f} s", flush=True)
        same = subprocess.run([options.stokes, "compare", "--exact", folder / "1.exr", folder / "2.exr"], stdout=subprocess.DEVNULL).returncode == 0
    print(f"two workers are {statistics.median(ratios):.2f} times as fast as one ({min(ratios):.2f} to {max(ratios):.2f}); the bits are {'the same' if same else 'NOT the same'}")
    print(f"two workers take {statistics.median(overheads):.2f} times as long as two plain renders side by side ({min(overheads):.2f} to {max(overheads):.2f})")
    if disturbed > 0.1:
        print(f"others used up to {disturbed:.1f} processors meanwhile: on a quiet machine the ratio may differ")
    return 0 if same else 1


if __name__ == "__main__":
    sys.exit(main())
