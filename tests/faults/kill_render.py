#!/usr/bin/env python3
"""Kills renders at random moments with SIGKILL: kill_render.py STOKES [--count 100] [--device auto] [--seed 1].

After each kill the output must be absent, the old file byte for byte, or the whole image; then a resumed render must have the bits of an
undisturbed one, leave no checkpoint and no temporary file, and no process may be left."""
import argparse
import os
import random
import signal
import subprocess
import sys
import tempfile
import time

SCENE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "cli", "small.json")


def arguments():
    parser = argparse.ArgumentParser()
    parser.add_argument("stokes")
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--device", default="auto")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--spp", type=int, default=4000)
    return parser.parse_args()


class Render:
    def __init__(self, options):
        self.stokes = os.path.abspath(options.stokes)
        self.device, self.spp = options.device, options.spp

    def command(self, output, *more):
        return [self.stokes, "render", SCENE, "--device", self.device, "-q", "-o", output, "--spp", str(self.spp), *more]

    def run(self, output, *more):
        subprocess.run(self.command(output, *more), check=True, stdout=subprocess.DEVNULL)

    def same(self, a, b):
        return subprocess.run([self.stokes, "compare", a, b, "--exact"], stdout=subprocess.DEVNULL).returncode == 0


def survivors(folder):
    """Processes that still work in the folder: a killed render's worker must not outlive it."""
    found = []
    for pid in filter(str.isdigit, os.listdir("/proc")):
        try:
            if int(pid) != os.getpid() and os.readlink(f"/proc/{pid}/cwd") == folder:
                found.append(pid)
        except OSError:
            pass
    return found


def kill_one(render, moment, old):
    """Returns what the kill left as the output ("absent", "old", "new"), whether there was a checkpoint, and a complaint or None."""
    if old is None and os.path.exists("out.exr"):
        os.remove("out.exr")
    if old is not None:
        with open("out.exr", "wb") as file:
            file.write(old)
    process = subprocess.Popen(render.command("out.exr", "--checkpoint", "1ms", "--resume"), stdout=subprocess.DEVNULL)
    time.sleep(moment)
    process.send_signal(signal.SIGKILL)
    process.wait()
    deadline = time.monotonic() + 20
    while survivors(os.getcwd()) and time.monotonic() < deadline:
        time.sleep(0.01)
    if survivors(os.getcwd()):
        return "", False, "a process outlives the killed render"

    checkpoint = os.path.exists("out.exr.checkpoint")
    content = open("out.exr", "rb").read() if os.path.exists("out.exr") else None
    if content == old:
        left = "absent" if old is None else "old"
    elif content is not None and render.same("truth.exr", "out.exr"):
        left = "new"
    else:
        return "", checkpoint, "the output is torn"
    render.run("out.exr", "--resume")
    if not render.same("truth.exr", "out.exr"):
        return left, checkpoint, "the resumed render has other bits"
    rubbish = sorted(set(os.listdir(".")) - {"truth.exr", "out.exr", "cache"})
    return left, checkpoint, f"left behind: {rubbish}" if rubbish else None


def main():
    options = arguments()
    rng = random.Random(options.seed)
    render = Render(options)
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        os.environ["XDG_CACHE_HOME"] = os.path.join(os.getcwd(), "cache")
        render.run("truth.exr")  # builds the kernels too
        start = time.monotonic()
        render.run("out.exr", "--checkpoint", "1ms")
        duration = time.monotonic() - start
        old = b"what stood here before" * 100
        seen, failures = {}, 0
        for number in range(options.count):
            moment = rng.uniform(0, 1.1 * duration)
            left, checkpoint, complaint = kill_one(render, moment, old if number % 2 else None)
            if complaint:
                failures += 1
                print(f"FAILED: kill {number} after {moment:.3f} s: {complaint}")
            key = left + (", checkpoint" if checkpoint else ", no checkpoint")
            seen[key] = seen.get(key, 0) + 1
        print(f"{options.count} kills within {1.1 * duration:.2f} s: {seen}; {failures} failures")
        os.chdir("/")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
