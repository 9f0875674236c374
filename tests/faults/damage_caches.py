#!/usr/bin/env python3
"""Damages kernel caches and renders: damage_caches.py STOKES OPENCL_FAULTS.SO [--count 100] [--seed 1] [--trust].

Half of the damage is done to Stokes' own cache, half to the driver's in POCL_CACHE_DIR; each file may be emptied, cut, filled with zeros or have
bits flipped. The first is none of these: the kernels of another picture stand in the file of ours, sound and of the length that its header says, so
that only the checksum tells. Every render must succeed with the bits of the first and without a crash of the driver, which would have been given
what is damaged. --trust is the control: the driver uses its cache as it would by itself, ours is
empty, and all damage is done to the code that the driver loads. Then drivers must crash, which a further attempt or an exit code tells; where none
does, the damage is harmless and the test without --trust shows nothing."""
import argparse
import collections
import os
import random
import shutil
import struct
import subprocess
import sys
import tempfile

SCENE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "cli", "small.json")


def arguments():
    parser = argparse.ArgumentParser()
    parser.add_argument("stokes")
    parser.add_argument("faults")
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--trust", action="store_true")
    return parser.parse_args()


def files_below(folder):
    return sorted(os.path.join(root, name) for root, _, names in os.walk(folder) for name in names
                  if os.path.getsize(os.path.join(root, name)) > 0)


def damage(path, rng):
    """Damages a file in a random way, and says which."""
    size = os.path.getsize(path)
    way = rng.choice(["emptied", "cut", "flipped", "zeroed"])
    with open(path, "r+b") as file:
        if way == "emptied":
            file.truncate(0)
        elif way == "cut":
            file.truncate(rng.randrange(size))
        elif way == "flipped":
            for _ in range(rng.randint(1, 16)):
                at = rng.randrange(size)
                file.seek(at)
                byte = file.read(1)[0]
                file.seek(at)
                file.write(bytes([byte ^ 1 << rng.randrange(8)]))
        else:
            at = rng.randrange(size)
            file.seek(at)
            file.write(bytes(min(4096, size - at)))
    return way


def largest(folder):
    """The kernels among the files of our cache; what else is there is some bytes long."""
    return max(files_below(folder), key=os.path.getsize)


def swap_kernels(path, others):
    """Puts the kernels of the file `others` into that at `path`; the header keeps its magic, key and checksum, and says their length."""
    header = struct.Struct("<8s2QQQ")  # as in runtime/device/binary_cache.cpp
    with open(others, "rb") as file:
        kernels = file.read()[header.size:]
    with open(path, "r+b") as file:
        magic, key0, key1, length, checksum = header.unpack(file.read(header.size))
        if magic != b"STOKESB1" or length + header.size != os.path.getsize(path):
            sys.exit("the cache's files have another header than this test knows")
        file.seek(0)
        file.write(header.pack(magic, key0, key1, len(kernels), checksum) + kernels)
        file.truncate()
    return "swapped"


def main():
    options = arguments()
    rng = random.Random(options.seed)
    stokes, faults = os.path.abspath(options.stokes), os.path.abspath(options.faults)
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        environment = {**os.environ, "XDG_CACHE_HOME": folder + "/cache", "POCL_CACHE_DIR": folder + "/driver"}
        sharing = {**environment, "LD_PRELOAD": faults, "OPENCL_FAULTS_SHARED_CACHE": "1"}

        def render(output, env, integrator="normals"):
            return subprocess.run([stokes, "render", SCENE, "--integrator", integrator, "-o", output], env=env,
                                  stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, timeout=300)

        # The driver's cache is filled as it would fill it itself, without being given a folder of its own.
        if render("truth.exr", sharing).returncode != 0:
            sys.exit("the first render failed")
        if not files_below("driver"):
            sys.exit("the driver has no cache that could be damaged (is it PoCL?)")
        for name in ("cache", "driver"):
            shutil.copytree(name, name + ".whole")

        others = None
        if not options.trust:
            if render("other.exr", {**environment, "XDG_CACHE_HOME": folder + "/other"}, "ao").returncode != 0:
                sys.exit("the render of another picture failed")
            others = largest("other")
            if os.path.basename(others) == os.path.basename(largest("cache")):
                sys.exit("two pictures have the same kernels")

        failures, crashes, ways = 0, 0, collections.Counter()
        for number in range(options.count):
            for name in ("cache", "driver"):
                shutil.rmtree(name, ignore_errors=True)
                if name == "driver" or not options.trust:
                    shutil.copytree(name + ".whole", name)
            victim = "driver" if options.trust or number % 2 else "cache"
            if number == 0 and others:
                path = largest("cache")
                way = swap_kernels(path, others)
            else:
                path = rng.choice([path for path in files_below(victim) if path.endswith(".so") or not options.trust])
                way = damage(path, rng)
            ways[f"{victim} {way}"] += 1
            try:
                result = render("out.exr", sharing if options.trust else environment)
                code, text = result.returncode, result.stderr.decode(errors="replace").strip()
            except subprocess.TimeoutExpired:
                code, text = "none", "did not end"
            same = code == 0 and subprocess.run([stokes, "compare", "truth.exr", "out.exr", "--exact"], stdout=subprocess.DEVNULL).returncode == 0
            crashes += "a crash (signal" in text
            if not same:
                failures += 1
                print(f"FAILED: {number}: {os.path.relpath(path)} {way}: exit code {code}: {text or 'other bits'}")
        print(f"{options.count} renders with damaged caches ({dict(sorted(ways.items()))}): {failures} failures, {crashes} crashes")
        os.chdir("/")
    return int(crashes == 0) if options.trust else int(failures + crashes > 0)


if __name__ == "__main__":
    sys.exit(main())
