#!/usr/bin/env python3
"""Renders by `stokes distribute --workers 2` while a worker, chosen at random, is killed by SIGKILL at a random time, and compares the
bits with one render's. Usage: kill_workers.py STOKES [--count N] [--spp N] [--seed N] [--starting]; with --starting the worker is killed
before it has said that it is ready. Exit 77 where the module distributed is missing."""
import argparse
import importlib.util
import os
import pathlib
import random
import signal
import subprocess
import sys
import tempfile
import time

SCENE = pathlib.Path(__file__).parents[1] / "cli" / "small.json"
PARTS = 8


def children(pid):
    found = []
    for task in pathlib.Path(f"/proc/{pid}/task").glob("*/children"):
        found += [int(word) for word in task.read_text().split()]
    return found


def workers(program):
    """The Dask worker processes of a running `stokes distribute`."""
    found = []
    for driver in children(program):
        for child in children(driver):
            if b"spawn_main" in pathlib.Path(f"/proc/{child}/cmdline").read_bytes():
                found.append(child)
    return found


def rendering(pid):
    """True while a worker has a stokes beneath it. (While it starts, a worker may have other children for a moment.)"""
    return any(b"\0render\0" in pathlib.Path(f"/proc/{child}/cmdline").read_bytes() for child in children(pid))


def kill_one(process, chance, delay, starting):
    """Waits until a worker renders (`starting`: until one is there), then `delay` seconds, and kills one of the workers. Returns its id, or
    None if all was over."""
    while process.poll() is None:
        try:
            candidates = workers(process.pid)
            if starting and candidates or any(rendering(pid) for pid in candidates):
                time.sleep(delay)
                victim = chance.choice(workers(process.pid))
                os.kill(victim, signal.SIGKILL)
                return victim
        except (OSError, IndexError):
            pass
        time.sleep(0.02)
    return None


def run_one(stokes, folder, spp, chance, starting):
    """One render with one worker killed. Returns (victim, parts that were there at its death)."""
    job, output = folder / "job", folder / "out.exr"
    command = [stokes, "distribute", SCENE, "-o", output, "--workers", "2", "--parts", str(PARTS), "--dir", job, "--device", "reference", "-q",
               "--spp", str(spp)]
    process = subprocess.Popen(command, env={**os.environ, "STOKES_DASK_PYTHON": sys.executable}, stdout=subprocess.DEVNULL)
    victim = kill_one(process, chance, chance.uniform(0, 0.3 if starting else 1.5), starting)
    there = len(list(job.glob("part-*.film")))
    code = process.wait(timeout=300)
    if code != 0:
        raise SystemExit(f"kill_workers: FAILED: exit code {code}")
    return victim, there


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("stokes")
    parser.add_argument("--count", type=int, default=1)
    parser.add_argument("--spp", type=int, default=16000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--starting", action="store_true")
    options = parser.parse_args()
    if not importlib.util.find_spec("distributed"):
        print(f"kill_workers: skipped: {sys.executable} has no module 'distributed'")
        return 77
    chance = random.Random(options.seed)
    with tempfile.TemporaryDirectory() as name:
        whole = pathlib.Path(name) / "whole.exr"
        subprocess.run([options.stokes, "render", SCENE, "-o", whole, "--device", "reference", "-q", "--spp", str(options.spp)], check=True, stdout=subprocess.DEVNULL)
        kills = attempts = 0
        while kills < options.count and attempts < 3 * options.count:
            attempts += 1
            folder = pathlib.Path(name) / str(attempts)
            folder.mkdir()
            victim, there = run_one(options.stokes, folder, options.spp, chance, options.starting)
            same = subprocess.run([options.stokes, "compare", whole, folder / "out.exr", "--exact"], stdout=subprocess.DEVNULL).returncode == 0
            if not same:
                raise SystemExit("kill_workers: FAILED: the bits differ")
            kills += victim is not None and there < PARTS
            print(f"{attempts}: worker {victim} killed with {there} of {PARTS} parts there; complete, same bits", flush=True)
    print(f"kill_workers: {kills} renders whose worker was killed before the last part, all complete with the bits of one render")
    return 0 if kills == options.count else 1


if __name__ == "__main__":
    sys.exit(main())
