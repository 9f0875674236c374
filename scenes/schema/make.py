#!/usr/bin/env python3
"""Writes schema.json: the scene format as a JSON schema, from which editors complete keys and show what they mean.

Usage: make.py [FILE]. A key is listed in the spelling of ../README.md, so that editors offer one; the reader's other spellings (spaces and
underscores are the same in keys, hyphens too in names of types) are accepted by patterns. The schema is never stricter than the reader;
what a schema cannot say (names that are defined, files, sums) is left to `stokes check`. Draft 7, the latest that all editors know.

Here are the settings and the scene as a whole; spectra, textures, matter and geometry have files of their own, which words.py serves.
"""
import json
import pathlib
import sys

sys.dont_write_bytecode = True  # no __pycache__ among the scenes

# These two are imported for what they define.
import geometry  # noqa: F401
import matter  # noqa: F401
from spectra import EMITS, spectrum, spectrum_forms
from textures import families
from words import boolean, choice, definitions, described, integer, keyed, listed, number, numbers, positive, ref, string, type_name, union

side = integer("Pixels", 1, 65536)
orthographic = {"properties": {"type": {"const": "orthographic"}}, "required": ["type"]}
definitions["camera"] = keyed(
    "Looks down its local -z, +y up.",
    {"type": type_name("The projection [perspective]", ["perspective", "orthographic"], ["pinhole", "thin_lens"]), "transform": ref("transform"),
     "vfov": number("Vertical field of view, degrees", 0, 180, True, True, 90), "fdist": positive("Distance to the plane in focus, scene units", 1),
     "aperture": number("Radius of the lens, scene units", 0, default=0), "resolution": numbers("[width, height] [512, 512]", 2, side),
     "height": positive("Of an orthographic camera's view, scene units", 2),
     "medium": described(ref("medium or name"), "What the camera stands in [found from the scene]")}, [], {"vfov": 40},
    **{"if": orthographic, "then": {"not": {"required": ["vfov"]}}, "else": {"not": {"required": ["height"]}}})
definitions["sampler"] = keyed("How many samples.", {"type": string("Any; the renderer chooses its own generator"),
                                                     "samples": integer("Per pixel", 1, 2147483647, 16),
                                                     "seed": integer("Of the random numbers", 0, 4294967295, 0)}, [], {"samples": 64})
WORD = "(path|tracer|fluorescent|volumetric|volume)"
integrators = [*(f"path tracer {v}{e}" for v in ("", "volumetric ") for e in ("mis", "nee", "mats")), "path tracer volumetric",
               *(f"fluorescent {e}" for e in ("mis", "nee", "mats")), "normals", "ao"]
definitions["integrator"] = keyed(
    "How light is sought.",
    {"type": {"type": "string", "description": "mis: by both kinds of sampling; mats: by material alone; nee: by lamps alone [path tracer mis]",
              "anyOf": [{"enum": integrators}, {"pattern": f"^({WORD}[ _-]+)+(mats|nee|mis|mixture)$|^({WORD}[ _-]+)*{WORD}$"}]},
     "max bounces": integer("Scattering events at surfaces or in media", 0, 1000000000, 64),
     "russian roulette": {"type": ["boolean", "integer"], "minimum": 0, "maximum": 1000000000,
                          "description": "true: from bounce 5; false: never; or the first bounce at which it may end a path [true]"},
     "wavelengths per path": choice("Of the hero and its companions", 1, 4, 8, default=4),
     "mode": choice("rgb: three numbers in place of spectra", "spectral", "rgb", default="spectral"),
     "equiangular": boolean("Seek lamps along flights through thin media too", True), "recursive": True, "power": True}, [],
    {"type": "path tracer mis"})
definitions["environment"] = keyed("An image as the light.",
                                   {"type": {"const": "environment"}, "filename": string("Latitude-longitude, relative to the scene file"),
                                    "rotate": number("Degrees about +y", default=0), "scale": number("Multiplies the pixels", 0, default=1)},
                                   ["type", "filename"], {"type": "environment", "filename": "sky.exr"})
environment = {"properties": {"type": {"const": "environment"}}, "required": ["type"]}
background = spectrum("What is seen where there is nothing", 0, meaning=EMITS + " Or an environment map.")
background["then"] = {"if": environment, "then": ref("environment"), "else": ref("background spectrum")}
definitions["background spectrum"] = union("A form of spectrum, or an environment map", {**families, "environment": "spectrum"}, spectrum_forms)
definitions["background spectrum"]["properties"]["type"]["anyOf"][0]["enum"].insert(0, "environment")
definitions["film"] = keyed("What is recorded beside RGB.",
                            {"spectral": {"type": "array", "minItems": 3, "maxItems": 3, "description": "[from, to, n]: n equal bins, nm",
                                          "items": [number("nm", 280, 780), number("nm", 280, 780), integer("Bins", 1, 500)]}}, [],
                            {"spectral": [400, 700, 30]})


def scene():
    names = {"properties": {"name": {"minLength": 1}}}
    named = {"allOf": [ref("material")], "required": ["name"], **names}
    return keyed(
        "A scene of Stokes.",
        {"$schema": string("This schema's place, for editors"), "scene unit": choice("The length of one scene unit", "m", "cm", "mm"),
         "camera": ref("camera"), "sampler": ref("sampler"), "integrator": ref("integrator"), "background": background, "film": ref("film"),
         "accelerator": {"description": "darts'; accepted, not used"},
         "spectra": listed("Named spectra", {"allOf": [ref("spectrum")], "required": ["name"], **names}),
         "media": listed("Named media", {"allOf": [ref("medium")], "required": ["name"], **names}), "materials": listed("Named materials", named),
         "surfaces": listed("The shapes", ref("surface"))},
        ["camera"], {"camera": {}})


def build():
    whole = scene()
    definitions["scene"] = whole
    return {"$schema": "http://json-schema.org/draft-07/schema#", "title": "Stokes scene", "$comment": "Written by make.py; do not edit.",
            "allOf": [ref("scene")], "definitions": dict(sorted(definitions.items()))}


if __name__ == "__main__":
    output = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).with_name("schema.json")
    # A definition a line: short enough to embed, and a change shows as the lines it touches.
    text = json.dumps({**build(), "definitions": {}})
    lines = ",\n".join(f"{json.dumps(name)}: {json.dumps(schema)}" for name, schema in sorted(definitions.items()))
    output.write_text(text.replace('"definitions": {}', '"definitions": {\n' + lines + "\n}") + "\n")
