#!/usr/bin/env python3
"""Mutates every shipped scene and checks each mutation with `stokes check`.

One that stays valid must exit 0. Every other must exit 2 with exactly one line on stderr, FILE:LINE:COLUMN: error: /pointer: message, in
under a second of CPU time and 512 MB. (The pointer of the whole file is empty.) Scenes with generated meshes are mutated in a coarse version; where that is
an error, the same mutation of the scene as it is must be one too, as fast.

Loading the program takes longer than most checks, so a process checks many scenes. What it takes bounds what each of them takes; when that is
too much, or the exit code is another than 0 and 2, or a line is of no scene, each scene of the batch is checked by a process of its own.

A scene that is sound but too large for the machine (20,000 hands) exits 4 with one line that says so; such are counted apart, and not as refused.

    malformed_scenes.py [--count N] [--seed N] [--scenes DIR] [--keep DIR] STOKES
"""
import argparse
import collections
import copy
import json
import os
import random
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import threading
from pathlib import Path

KIBIBYTES = 512 * 1024
BATCH, PATIENCE = 24, 20.0
LINE = re.compile(r"^(?:\./)?scene_([0-9]+)\.json:[1-9][0-9]*:[1-9][0-9]*: (error|warning): (/[^\n]*?: )?[^\n]+$")

# What stands for a number in text and is none in JSON, or none that a scene can use.
NUMBERS = ["NaN", "Infinity", "-Infinity", "1e999", "-1e999", "1e308", "-1e308", "1e-320", "-1", "0", "-0.0", "1.5", "2147483648", "4294967296",
           "99999999999999999999", "-99999999999999999999", "0x10", "01", "1.", ".5", "+1", "1e", "--1"]
VALUES = [None, True, False, "", "x", "vacuum", [], {}, [[]], [1], [1, 2, 3], [1, 2, 3, 4], -1, 0, 1e300, {"type": "constant", "value": 2}, {"type": "nonsense"},
          {"type": "file", "filename": "garbage"}, {"type": "sum", "of": []}, {"type": "sampled", "wavelengths": [500, 400], "values": [1, 1]}, "caf\u00e9", "a\u2028b", "x" * 100000]
FILES = ["missing.obj", "folder", "zero", "random", "pipe", "outside", "outside/secret.csv", "../../secret.csv", "/etc/passwd", "/dev/zero", "/dev/stdin", "/proc/self/mem",
         "garbage", "empty", "garbage.png", "huge.hdr", "huge.pfm", "bomb.exr", "nan.csv", "matrix.csv", "bad.obj", "nan.obj", "loop", "", ".", "..", "x\u0000y", "a" * 5000,
         "http://localhost/x.png", "garbage.png?x=1", "meshes/prism.obj", "textures/sky.hdr", "spectra/model_reradiation.csv"]
BYTES = [b"\xff", b"\xc0\xaf", b"\xed\xa0\x80", b"\x00", b"\x1b[31m", b"{", b"}", b"[", b"]", b",", b":", b'"', b"\\", b"\\u0000", b"\\ud800", b"//", b"/* */", b"\n\n", b"NaN"]


def walk(value, path=()):
    """The paths of all values, the root's included."""
    yield path
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, child in items:
        yield from walk(child, path + (key,))


def at(value, path):
    for key in path:
        value = value[key]
    return value


def pick(rng, scene, wanted):
    """A path to a value for which `wanted` holds, or None."""
    paths = [p for p in walk(scene) if p and wanted(at(scene, p))]
    return rng.choice(paths) if paths else None


def put(scene, path, value):
    at(scene, path[:-1])[path[-1]] = value


def is_number(v):
    return isinstance(v, (int, float)) and not isinstance(v, bool)


class Mutation:
    """Mutations of parsed JSON; each returns text, or None where the scene has nothing of the kind."""

    def __init__(self, rng):
        self.rng = rng

    def delete(self, s):
        path = pick(self.rng, s, lambda v: True)
        del at(s, path[:-1])[path[-1]]
        return json.dumps(s, indent=1)

    def rename(self, s):
        path = pick(self.rng, s, lambda v: isinstance(v, dict) and v)
        owner = at(s, path) if path else s
        key = self.rng.choice(list(owner))
        i = self.rng.randrange(len(key) + 1)
        new = self.rng.choice([key[:i] + "x" + key[i:], key[:i] + key[i + 1:], key.upper(), key + "\n", "", key * 3000])
        items = [(new if k == key else k, v) for k, v in owner.items()]
        owner.clear()
        owner.update(items)
        return json.dumps(s, indent=1)

    def duplicate(self, s):
        path = pick(self.rng, s, lambda v: isinstance(v, dict) and v)
        owner = at(s, path) if path else s
        key = self.rng.choice(list(owner))
        owner["@twice@"] = owner[key]
        spelt = self.rng.choice([key, key.replace(" ", "_"), key.replace("_", " ")])
        return json.dumps(s, indent=1).replace('"@twice@"', json.dumps(spelt))

    def retype(self, s):
        put(s, pick(self.rng, s, lambda v: True), copy.deepcopy(self.rng.choice(VALUES)))
        return json.dumps(s, indent=1)

    def number(self, s):
        path = pick(self.rng, s, is_number)
        if not path:
            return None
        put(s, path, "@number@")
        return json.dumps(s, indent=1).replace('"@number@"', self.rng.choice(NUMBERS))

    def absurd(self, s):
        camera = s.get("camera", {})
        big = [1, 65535, 65536, 65537, 1 << 20, (1 << 31) - 1, 1 << 31, 1 << 40, 0, -64, 1e30]
        if self.rng.random() < 0.6:
            camera["resolution"] = [self.rng.choice(big), self.rng.choice(big)]
        else:
            s.setdefault("sampler", {})["samples"] = self.rng.choice([0, -1, 1 << 30, (1 << 30) + 1, (1 << 31) - 1, 1 << 31, 1e18, 1.5])
        return json.dumps(s, indent=1)

    def deep(self, s):
        depth = self.rng.choice([90, 99, 100, 101, 200, 5000])
        path = pick(self.rng, s, lambda v: True)
        put(s, path, "@deep@")
        opening, closing = self.rng.choice([("[", "]"), ('{"a":', "}"), ('{"type":"sum","of":[', "]}"), ('{"type":"group","children":[', "]}")])
        return json.dumps(s, indent=1).replace('"@deep@"', opening * depth + "1" + closing * depth)

    def unfold(self, s):
        """Names used twice and twice again: as a tree it would have 2^60 leaves; or a chain of 20,000."""
        twice = self.rng.random() < 0.5
        n = 60 if twice else 20000
        if self.rng.random() < 0.5:
            s["spectra"] = [{"name": "u0", "type": "constant", "value": 0.1}] + [
                {"name": f"u{i}", "type": "product", "of": [f"u{i - 1}"] * (2 if twice else 1)} for i in range(1, n)]
        else:
            s["materials"] = [{"name": "u0", "type": "lambertian"}] + [
                {"name": f"u{i}", "type": "blend", "a": f"u{i - 1}", "b": f"u{i - 1}" if twice else "u0"} for i in range(1, n)] + s.get("materials", [])
        return json.dumps(s, indent=1)

    def many(self, s):
        path = pick(self.rng, s, lambda v: isinstance(v, list) and v)
        if not path:
            return None
        at(s, path).extend([copy.deepcopy(at(s, path)[0])] * self.rng.choice([1, 3, 20000]))
        return json.dumps(s)

    def file(self, s):
        name = self.rng.choice(FILES)
        path = pick(self.rng, s, lambda v: isinstance(v, dict) and "filename" in v)
        if path and self.rng.random() < 0.7:
            at(s, path)["filename"] = name
            return json.dumps(s, indent=1)
        where = self.rng.randrange(4)
        if where == 0:
            s["background"] = {"type": "environment", "filename": name}
        elif where == 1:
            s.setdefault("surfaces", []).append({"type": "mesh", "filename": name, "material": {"type": "lambertian"}})
        elif where == 2:
            s["background"] = {"type": "file", "filename": name}
        else:
            s.setdefault("materials", []).insert(0, {"type": "lambertian", "name": "painted x", "albedo": {"type": "image", "filename": name}})
        return json.dumps(s, indent=1)

    def reference(self, s):
        path = pick(self.rng, s, lambda v: isinstance(v, str))
        if not path:
            return None
        text = at(s, path)
        put(s, path, self.rng.choice(["no such thing", text + "x", text[:-1], text.upper(), "\x07" + text, " "]))
        return json.dumps(s, indent=1)

    def swap(self, s):
        a, b = (pick(self.rng, s, lambda v: not isinstance(v, (dict, list))) for _ in range(2))
        va, vb = at(s, a), at(s, b)
        put(s, a, vb)
        put(s, b, va)
        return json.dumps(s, indent=1)


def mutate_text(rng, text):
    data = text.encode()
    i = rng.randrange(len(data) + 1)
    how = rng.randrange(7)
    if how == 0:
        return data[:i]
    if how == 1:
        return data[:i] + data[i + rng.choice([1, 1, 1, 2, 10]):]
    if how == 2:
        return data[:i] + rng.choice(BYTES) + data[i:]
    if how == 3:
        j = min(len(data), i + rng.randrange(1, 200))
        return data[:j] + data[i:j] + data[j:]
    if how == 4:
        return data[:i] + bytes([rng.randrange(256)]) + data[i + 1:]
    if how == 5:
        return b"\xef\xbb\xbf" * rng.choice([1, 2]) + data + rng.choice([b"", b"x", b"{}", b"\x00"])
    return data[:i] + rng.choice(NUMBERS).encode() + data[i + 1:]


NAMES = [n for n in vars(Mutation) if not n.startswith("_")]


def mutate(seed, text):
    """The mutation that `seed` stands for, as bytes: the same kind at the same place in any version of the scene."""
    rng = random.Random(seed)
    if rng.random() < 0.3:
        return "text", mutate_text(rng, text)
    while True:
        kind = rng.choice(NAMES)
        result = getattr(Mutation(rng), kind)(json.loads(text))
        if result is not None:
            return kind, result.encode("utf-8", "surrogatepass")


def prepare(folder, scenes):
    """The scene's folder: what the shipped scenes name, and what they should not."""
    for name in ("meshes", "textures", "spectra"):
        shutil.copytree(scenes / name, folder / name)
    outside = folder.parent.parent / "elsewhere"
    outside.mkdir()
    (outside / "secret.csv").write_text("400,0.5\n700,0.5\n")
    (folder.parent.parent / "secret.csv").write_text("400,0.5\n700,0.5\n")
    (folder / "outside").symlink_to(outside)
    (folder / "zero").symlink_to("/dev/zero")
    (folder / "random").symlink_to("/dev/urandom")
    (folder / "loop").symlink_to("loop")
    os.mkfifo(folder / "pipe")
    (folder / "folder").mkdir()
    (folder / "empty").write_bytes(b"")
    noise = random.Random(7).randbytes(4096)
    (folder / "garbage").write_bytes(noise)
    (folder / "garbage.png").write_bytes(b"\x89PNG\r\n\x1a\n" + noise)
    (folder / "huge.hdr").write_bytes(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2000000000 +X 2000000000\n" + noise)
    (folder / "huge.pfm").write_bytes(b"PF\n30000 30000\n-1.0\n" + noise)
    (folder / "bomb.exr").write_bytes(b"\x76\x2f\x31\x01\x02\0\0\0" + b"channels\0chlist\0\x13\0\0\0R\0\x02\0\0\0\0\0\0\0\x01\0\0\0\x01\0\0\0\0"
                                      + b"compression\0compression\0\x01\0\0\0\x03dataWindow\0box2i\0\x10\0\0\0\0\0\0\0\0\0\0\0\xfe\xff\xff\x3f\xfe\xff\xff\x3f"
                                      + b"displayWindow\0box2i\0\x10\0\0\0\0\0\0\0\0\0\0\0\xfe\xff\xff\x3f\xfe\xff\xff\x3flineOrder\0lineOrder\0\x01\0\0\0\0"
                                      + b"pixelAspectRatio\0float\0\x04\0\0\0\0\0\x80\x3fscreenWindowCenter\0v2f\0\x08\0\0\0\0\0\0\0\0\0\0\0"
                                      + b"screenWindowWidth\0float\0\x04\0\0\0\0\0\x80\x3f\0" + noise)
    (folder / "nan.csv").write_text("400,0.5\n500,nan\n")
    (folder / "matrix.csv").write_text("x,300\n400,1e999\n")
    (folder / "bad.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n")
    (folder / "nan.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 0e999 0\nf 1 2 3\n")


class Checker:
    """Scenes through `stokes check`: what each came to."""

    def __init__(self, stokes, folder, allowed):
        """`allowed`: CPU seconds within which an error must be told."""
        self.stokes, self.folder, self.allowed = stokes, folder, allowed
        self.env = {k: v for k, v in os.environ.items() if k != "STOKES_ALLOW_OUTSIDE"}
        self.seconds, self.kibibytes = 0.0, 0

    def run(self, numbers):
        """Exit code (negative: signal; None: too slow), standard error, CPU seconds, KiB."""
        with open(self.folder / "err.txt", "w+b") as err:
            process = subprocess.Popen([self.stokes, "check", "-q", *(f"scene_{i}.json" for i in numbers)], cwd=self.folder, env=self.env,
                                       stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=err,
                                       preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (int(PATIENCE), int(PATIENCE) + 1)))
            # A read that blocks takes no CPU time: a clock ends it too.
            clock = threading.Timer(10 * PATIENCE, process.kill)
            clock.start()
            _, status, usage = os.wait4(process.pid, 0)
            clock.cancel()
            process.returncode = os.waitstatus_to_exitcode(status)
            err.seek(0)
            return process.returncode, err.read().decode("utf-8", "replace"), usage.ru_utime + usage.ru_stime, usage.ru_maxrss

    def check(self, scenes):
        """For each of `scenes` (bytes): "" when it is valid, None when it is too large for the machine, its error line, or a list of what is wrong with
        how it was refused."""
        for i, data in enumerate(scenes):
            (self.folder / f"scene_{i}.json").write_bytes(data)
        return self.halve(range(len(scenes)))

    def halve(self, numbers):
        """The results of `numbers`: by one process, else by one for each half, at last by one for each scene."""
        if len(numbers) == 1:
            return [self.alone(numbers[0])]
        middle = len(numbers) // 2
        return self.judge(numbers) or self.halve(numbers[:middle]) + self.halve(numbers[middle:])

    def judge(self, numbers):
        """The results of one process, or None when it gives no answer for each."""
        code, error, seconds, kibibytes = self.run(numbers)
        lines = {i: [] for i in numbers}
        for line in error.splitlines():
            match = LINE.match(line)
            if not match or int(match[1]) not in lines:
                return None
            if match[2] == "error":
                lines[int(match[1])].append(line)
        if code != (2 if any(lines.values()) else 0) or not error.endswith("\n") and error or any(len(found) > 1 for found in lines.values()):
            return None
        if any(lines.values()) and (seconds >= self.allowed or kibibytes >= KIBIBYTES):
            return None
        self.seconds, self.kibibytes = max(self.seconds, seconds), max(self.kibibytes, kibibytes)
        return ["".join(lines[i]) for i in numbers]

    def alone(self, number):
        results = self.judge([number])
        if results is not None:
            return results[0]
        code, error, seconds, kibibytes = self.run([number])
        if code == 0:
            return ""
        if code == 4 and re.fullmatch(r"[^\n]*error: [^\n]*out of memory: [^\n]+ needs [^\n]+\n", error) and kibibytes < KIBIBYTES:
            return None
        return [f"exit code {code}, {seconds:.2f} s, {kibibytes / 1024:.0f} MiB: {error[:300]!r}"]


def coarse(text):
    """The scene with generated meshes of 8 mm and simple offsets. Its text keeps its length, so that mutations find the same places."""
    text = re.sub(r'("generator":[^{}]*?"resolution": *)([0-9.]+)', lambda m: m[1] + "8".ljust(len(m[2])), text)
    return text.replace('"distance field"', '"normals"'.ljust(len('"distance field"')))


def check_batch(checker, seed, paths, numbers):
    """Number, scene, kind, bytes and result of each mutation."""
    made = []
    for i in numbers:
        path = paths[i % len(paths)]
        text = path.read_text()
        kind, data = mutate(f"{seed}:{i}", coarse(text))
        made.append([i, path, kind, data, text])
    results = checker.check([data for _, _, _, data, _ in made])
    fine = [k for k, (i, _, _, _, text) in enumerate(made) if results[k] != "" and coarse(text) != text]
    for k in fine:
        made[k][3] = mutate(f"{seed}:{made[k][0]}", made[k][4])[1]
    for k, result in zip(fine, checker.check([made[k][3] for k in fine]) if fine else []):
        results[k] = result
    return [(i, path, kind, data, result) for (i, path, kind, data, _), result in zip(made, results)]


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("stokes", type=Path)
    p.add_argument("--count", type=int, default=10000, help="how many that are refused")
    p.add_argument("--seed", type=int, default=1)
    p.add_argument("--seconds", type=float, default=1.0, help="of CPU time for each that is refused")
    p.add_argument("--scenes", type=Path, default=Path(__file__).resolve().parents[2] / "scenes")
    p.add_argument("--keep", type=Path, help="a folder for the mutations that fail")
    a = p.parse_args()
    paths = sorted(a.scenes.glob("*.json"))
    outcomes, kinds, failures = collections.Counter(), collections.Counter(), []
    with tempfile.TemporaryDirectory(prefix="stokes-malformed-") as top:
        folder = Path(top) / "project" / "scenes"
        folder.mkdir(parents=True)
        prepare(folder, a.scenes)
        checker = Checker(a.stokes.resolve(), folder, a.seconds)
        first = 0
        while outcomes["refused"] + len(failures) < a.count:
            for i, path, kind, data, result in check_batch(checker, a.seed, paths, range(first, first + BATCH)):
                if not result:
                    outcomes["too large" if result is None else "valid"] += 1
                    continue
                kinds[kind] += 1
                if isinstance(result, str):
                    outcomes["refused"] += 1
                    outcomes["rootless"] += not re.search(r": error: /", result)
                    continue
                failures.append(f"{i} ({path.stem}, {kind}): {result[0]}")
                print("FAILED", failures[-1], flush=True)
                if a.keep:
                    a.keep.mkdir(parents=True, exist_ok=True)
                    (a.keep / f"{i}_{path.stem}.json").write_bytes(data)
            first += BATCH
            if first % (10 * BATCH) == 0:
                print(f"{first} mutations, {outcomes['refused']} refused", file=sys.stderr, flush=True)
    print(f"{first} mutations of {len(paths)} scenes: {outcomes['valid']} stayed valid (exit 0), {outcomes['too large']} became too large (exit 4), {outcomes['refused']} were refused "
          f"(exit 2, one line; {outcomes['rootless']} of them about the whole file, whose pointer is empty), {len(failures)} failed")
    print(f"a process of up to {BATCH} scenes took at most {checker.seconds:.2f} s of CPU time and {checker.kibibytes / 1024:.0f} MiB")
    print("refused by kind: " + ", ".join(f"{k} {n}" for k, n in kinds.most_common()))
    return 1 if failures or outcomes["refused"] == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
