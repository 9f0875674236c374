#!/usr/bin/env python3
"""Kills renders with SIGKILL: kill_render.py STOKES [--count 100] [--device auto] [--seed 1].

Of four kills one comes at any moment from the start, one at any moment after the first checkpoint, one while a checkpoint is being written and one
while the output is (both are seen by their temporary files). After each the output must be absent, the old file byte for byte, or the whole image;
then a resumed render must have the bits of an undisturbed one, leave no checkpoint and no temporary file, and no process may be left."""
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
    parser.add_argument("--spp", type=int, default=100)
    parser.add_argument("--size", default="160x120")
    return parser.parse_args()


class Render:
    def __init__(self, options):
        self.stokes = os.path.abspath(options.stokes)
        self.device, self.spp, self.size = options.device, options.spp, options.size

    def command(self, output, *more):
        return [self.stokes, "render", SCENE, "--device", self.device, "-q", "-o", output, "--spp", str(self.spp), "--size", self.size, *more]

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


def temporaries(stem):
    """Files in the making: of the output by the stem out.exr, of its checkpoint by out.exr.checkpoint."""
    other = "." + stem + ".checkpoint."
    return [name for name in os.listdir(".") if name.startswith("." + stem + ".") and name.endswith(".tmp") and not name.startswith(other)]


def wait_until(process, condition):
    """Looks many times in a millisecond, and no longer than the render takes."""
    while process.poll() is None and not condition():
        time.sleep(0.00002)


def wait_for_moment(process, aim, moment):
    """Returns at the time to kill. The moment is in seconds after the start or, with another aim than "any", after the first checkpoint."""
    if aim != "any":
        wait_until(process, lambda: os.path.exists("out.exr.checkpoint"))
    if aim == "output":
        wait_until(process, lambda: temporaries("out.exr"))
        return
    time.sleep(moment)
    if aim == "checkpoint":
        wait_until(process, lambda: temporaries("out.exr.checkpoint"))


def kill_one(render, aim, moment, old):
    """Returns what the kill left (the output "absent", "old" or "new"; checkpoints; files half written) and a complaint or None."""
    if old is None and os.path.exists("out.exr"):
        os.remove("out.exr")
    if old is not None:
        with open("out.exr", "wb") as file:
            file.write(old)
    process = subprocess.Popen(render.command("out.exr", "--checkpoint", "1ms", "--resume"), stdout=subprocess.DEVNULL)
    wait_for_moment(process, aim, moment)
    process.send_signal(signal.SIGKILL)
    process.wait()
    deadline = time.monotonic() + 20
    while survivors(os.getcwd()) and time.monotonic() < deadline:
        time.sleep(0.01)
    if survivors(os.getcwd()):
        return "", "a process outlives the killed render"

    found = ["checkpoint"] if os.path.exists("out.exr.checkpoint") else []
    halves = (("half a checkpoint", "out.exr.checkpoint"), ("half an image", "out.exr"))
    found += [half for half, stem in halves if temporaries(stem)]
    content = open("out.exr", "rb").read() if os.path.exists("out.exr") else None
    if content == old:
        left = "absent" if old is None else "old"
    elif content is not None and render.same("truth.exr", "out.exr"):
        left = "new"
    else:
        return "", "the output is torn"
    left = " + ".join([left] + found)
    render.run("out.exr", "--resume")
    if not render.same("truth.exr", "out.exr"):
        return left, "the resumed render has other bits"
    rubbish = sorted(set(os.listdir(".")) - {"truth.exr", "out.exr", "cache"})
    return left, f"left behind: {rubbish}" if rubbish else None


def time_render(render):
    """Seconds from the start to the first checkpoint, and from there to the end."""
    start = time.monotonic()
    process = subprocess.Popen(render.command("out.exr", "--checkpoint", "1ms"), stdout=subprocess.DEVNULL)
    wait_until(process, lambda: os.path.exists("out.exr.checkpoint"))
    saved = time.monotonic()
    if process.wait() != 0:
        sys.exit("a render fails undisturbed")
    return saved - start, time.monotonic() - saved


def main():
    options = arguments()
    rng = random.Random(options.seed)
    render = Render(options)
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        os.environ["XDG_CACHE_HOME"] = os.path.join(os.getcwd(), "cache")
        render.run("truth.exr")  # builds the kernels too
        before, after = time_render(render)
        old = b"what stood here before" * 100
        seen, failures = {}, 0
        for number in range(options.count):
            aim = ("checkpoint", "output", "later", "any")[number % 4]
            moment = rng.uniform(0, before + after if aim == "any" else after)
            left, complaint = kill_one(render, aim, moment, old if number // 4 % 2 else None)
            if complaint:
                failures += 1
                print(f"FAILED: kill {number} ({aim}) after {moment:.3f} s: {complaint}", flush=True)
            seen[left] = seen.get(left, 0) + 1
        print(f"{options.count} kills, first checkpoint after {before:.2f} s, end {after:.2f} s later: {dict(sorted(seen.items()))}; {failures} failures")
        os.chdir("/")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
