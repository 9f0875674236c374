#!/usr/bin/env python3
"""Splits renders into parts and merges them in random order: partitions.py STOKES [--device reference] [--parts 1,2,3,7,16] [--repeat 1] [--seed 1].

The merged image must have the bits of one render. Then, of each partition, a part is left out, doubled, damaged or replaced by one of another seed;
the merge must name it and write nothing."""
import argparse
import os
import random
import subprocess
import sys
import tempfile

SCENE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "cli", "small.json")
SAMPLES = 48


def arguments():
    parser = argparse.ArgumentParser()
    parser.add_argument("stokes")
    parser.add_argument("--device", default="reference")
    parser.add_argument("--parts", default="1,2,3,7,16")
    parser.add_argument("--repeat", type=int, default=1)
    parser.add_argument("--seed", type=int, default=1)
    return parser.parse_args()


class Splitter:
    def __init__(self, options):
        self.stokes, self.device = os.path.abspath(options.stokes), options.device
        self.rng = random.Random(options.seed)
        self.failures = 0

    def run(self, *command):
        return subprocess.run([self.stokes, *command], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)

    def render(self, output, *more):
        result = self.run("render", SCENE, "--device", self.device, "-q", "--spp", str(SAMPLES), "--aov", "all", "-o", output, *more)
        if result.returncode != 0:
            sys.exit(f"{output}: {result.stderr}")

    def complain(self, text):
        self.failures += 1
        print("FAILED:", text)

    def split(self, count):
        """Renders the parts, in random order, and returns their names in the samples' order."""
        cuts = [0, *sorted(self.rng.sample(range(1, SAMPLES), count - 1)), SAMPLES]
        ranges = list(zip(cuts, cuts[1:]))
        names = [f"part{count}_{a}_{b}.{self.rng.choice(['exr', 'film'])}" for a, b in ranges]
        for i in self.rng.sample(range(count), count):
            self.render(names[i], "--samples", "%d:%d" % ranges[i])
        return names

    def refused(self, parts, name, why):
        """A merge of the parts, in random order, must exit with 2, name a file and write nothing."""
        parts = self.rng.sample(parts, len(parts))
        result = self.run("merge", "-o", "bad.exr", *parts)
        lines = result.stderr.strip().splitlines()
        if result.returncode != 2 or len(lines) != 1 or name not in result.stderr or os.path.exists("bad.exr"):
            self.complain(f"{why} of {len(parts)} parts: exit code {result.returncode}, not naming {name}: {result.stderr}")

    def check(self, count):
        names = self.split(count)
        shuffled = self.rng.sample(names, count)
        result = self.run("merge", "-o", "merged.exr", *shuffled)
        if result.returncode != 0 or self.run("compare", "whole.exr", "merged.exr", "--exact").returncode != 0:
            self.complain(f"{count} parts: not the bits of one render: {shuffled} {result.stderr}")
        victim = self.rng.choice(names)
        begin, end = victim.split(".")[0].split("_")[1:]
        if count > 1:
            self.refused([n for n in names if n != victim], f"{begin}:{end} are missing", "a gap")
        self.refused([*names, victim], victim, "a part given twice")
        foreign = "foreign.exr"
        self.render(foreign, "--samples", f"{begin}:{end}", "--seed", "99")
        if count > 1:
            self.refused([foreign if n == victim else n for n in names], foreign, "a foreign part")
        with open(victim, "rb") as file:
            content = bytearray(file.read())
        # In the sums, which are at the end of either format.
        content[len(content) - 30 - self.rng.randrange(1000)] ^= 1 << self.rng.randrange(8)
        damaged = "damaged." + victim.split(".")[1]
        with open(damaged, "wb") as file:
            file.write(content)
        self.refused([damaged if n == victim else n for n in names], damaged, "a damaged part")


def main():
    options = arguments()
    with tempfile.TemporaryDirectory() as folder:
        splitter = Splitter(options)
        os.chdir(folder)
        os.environ["XDG_CACHE_HOME"] = folder + "/cache"
        splitter.render("whole.exr")
        for _ in range(options.repeat):
            for count in map(int, options.parts.split(",")):
                splitter.check(count)
        print(f"partitions {options.parts} on {options.device}, {options.repeat} times: {splitter.failures} failures")
        os.chdir("/")
    return 1 if splitter.failures else 0


if __name__ == "__main__":
    sys.exit(main())
