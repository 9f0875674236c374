#!/usr/bin/env python3
"""The JSON schema and `stokes check` must judge alike: every scene of scenes/ and every change listed as sound passes both, every change
listed as broken fails both.

Usage: schema.py STOKES. Needs jsonschema (Debian python3-jsonschema).
"""
import copy
import json
import pathlib
import re
import subprocess
import sys
import tempfile

import jsonschema

HERE = pathlib.Path(__file__).parent
SCENES = HERE.parent.parent / "scenes"


def without_comments(text):
    """The starters' comments stand on lines of their own."""
    return re.sub(r"^\s*//.*$", "", text, flags=re.MULTILINE)


def changed(scene, change):
    """A copy of the scene with values at JSON pointers set, or removed where the value is the text "(none)"."""
    scene = copy.deepcopy(scene)
    for pointer, value in change.items():
        *path, last = pointer[1:].split("/")
        node = scene
        for token in path:
            node = node[int(token)] if isinstance(node, list) else node[token]
        if isinstance(node, list):
            last = int(last)
        if value == "(none)":
            del node[last]
        else:
            node[last] = value
    return scene


def judgements(stokes, scenes):
    """Whether `stokes check` finds each scene sound, and its messages; one process for all, in scenes/ for the files they name."""
    with tempfile.TemporaryDirectory() as folder:
        files = []
        for i, scene in enumerate(scenes):
            files.append(pathlib.Path(folder) / f"{i}.json")
            files[-1].write_text(json.dumps(scene))
        run = subprocess.run([stokes, "check", *map(str, files)], capture_output=True, text=True, check=False)
        errors = {line.split(":")[0]: line for line in run.stderr.splitlines() if ": error: " in line}
        sound = {line.split(":")[0] for line in run.stdout.splitlines() if ": ok (" in line}
        return [(str(f) in sound, errors.get(str(f), "")) for f in files]


def main():
    schema = json.loads((SCENES / "schema" / "schema.json").read_text())
    jsonschema.Draft7Validator.check_schema(schema)
    validator = jsonschema.Draft7Validator(schema)
    failures = []

    made = HERE.parent.parent / "scenes" / "schema" / "make.py"
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.executable, str(made), f"{folder}/schema.json"], check=True)
        if pathlib.Path(folder, "schema.json").read_text() != (SCENES / "schema" / "schema.json").read_text():
            failures.append("schema.json is not what make.py writes")

    shipped = sorted([*SCENES.glob("*.json"), *SCENES.glob("starters/*.json")])
    for file in shipped:
        error = next(validator.iter_errors(json.loads(without_comments(file.read_text()))), None)
        if error:
            failures.append(f"{file.name}: the schema refuses {'/'.join(map(str, error.path))}: {error.message[:200]}")

    cases = json.loads((HERE / "schema_cases.json").read_text())
    changes = [(change, True) for change in cases["sound"]] + [(change, False) for change in cases["broken"]]
    scenes = [changed(cases["scene"], change) for change, _ in changes]
    for (change, expected), scene, (sound, message) in zip(changes, scenes, judgements(sys.argv[1], scenes), strict=True):
        valid = validator.is_valid(scene)
        if sound != expected or valid != expected:
            failures.append(f"{json.dumps(change)}: expected {'sound' if expected else 'broken'}, the schema says {valid}, check says {sound} {message}")

    print(f"{len(shipped)} scenes, {len(cases['sound'])} sound changes, {len(cases['broken'])} broken ones, {len(failures)} failures")
    print("\n".join(failures))
    return 1 if failures or len(shipped) < 60 else 0


if __name__ == "__main__":
    sys.exit(main())
