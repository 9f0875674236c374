#!/usr/bin/env python3
"""Writes schema.json: the scene format as a JSON schema, from which editors complete keys and show what they mean.

Usage: make.py [FILE]. A key is listed in the spelling of ../README.md, so that editors offer one; the reader's other spellings (spaces and
underscores are the same in keys, hyphens too in names of types) are accepted by patterns. The schema is never stricter than the reader;
what a schema cannot say (names that are defined, files, sums) is left to `stokes check`. Draft 7, the latest that all editors know.
"""
import json
import pathlib
import re
import sys

INF = float("inf")
definitions = {}


def ref(name):
    return {"$ref": f"#/definitions/{name}"}


def number(text, low=-INF, high=INF, open_low=False, open_high=False, default=None, kind="number"):
    """A number in a range; `open_` ends do not belong to it."""
    schema = {"type": kind, "description": text}
    if low > -INF:
        schema["exclusiveMinimum" if open_low else "minimum"] = low
    if high < INF:
        schema["exclusiveMaximum" if open_high else "maximum"] = high
    if default is not None:
        schema["default"] = default
    return schema


def integer(text, low, high, default=None):
    return number(text, low, high, default=default, kind="integer")


def positive(text, default=None):
    return number(text, 0, open_low=True, default=default)


def fraction(text, default=None):
    return number(text, 0, 1, default=default)


def boolean(text, default=None):
    return {"type": "boolean", "description": text, **({} if default is None else {"default": default})}


def string(text, **more):
    return {"type": "string", "description": text, **more}


def choice(text, *values, default=None):
    return {"enum": list(values), "description": text, **({} if default is None else {"default": default})}


def numbers(text, count, item=None):
    return {"type": "array", "description": text, "items": item or {"type": "number"}, "minItems": count, "maxItems": count}


def vector(text):
    return numbers(text, 3)


def listed(text, item, least=0):
    return {"type": "array", "description": text, "items": item, **({"minItems": least} if least else {})}


def described(schema, text, default=None):
    """A reference with a text of its own (draft 7 ignores what stands beside $ref)."""
    return {"description": text, "allOf": [schema], **({} if default is None else {"default": default})}


def spellings(name, separators):
    return "^" + re.sub("[ _-]", separators, name) + "$"


def keyed(text, properties, required=(), example=None, **more):
    """An object of these keys and no others."""
    patterns = {}
    for key, schema in properties.items():
        if re.search("[ _]", key):
            patterns[f"^(?!{key}$){spellings(key, '[ _]')[1:]}"] = schema
    schema = {"type": "object", "description": text, "properties": properties, "additionalProperties": False}
    if patterns:
        schema["patternProperties"] = patterns
    if required:
        schema["required"] = list(required)
    if example is not None:
        schema["examples"] = [example]
    return {**schema, **more}


def type_name(text, names, more=()):
    """The value of "type": the documented names are offered, their other spellings accepted."""
    return {"type": "string", "description": text,
            "anyOf": [{"enum": list(names)}, {"pattern": "|".join(spellings(n, "[ _-]") for n in [*names, *more])}]}


def union(text, family, names, aliases=None, default=None):
    """One of the definitions "FAMILY: NAME" by the value of "type"."""
    aliases = aliases or {}
    cases = []
    for name in names:
        all_names = [name, *aliases.get(name, ())]
        match = {"properties": {"type": {"pattern": "|".join(spellings(n, "[ _-]") for n in all_names)}}}
        if name != default:
            match["required"] = ["type"]
        prefix = family if isinstance(family, str) else family[name]
        cases.append({"if": match, "then": ref(f"{prefix}: {name}")})
    return {"type": "object", "properties": {"type": type_name(text, names, [a for n in names for a in aliases.get(n, ())])},
            **({} if default else {"required": ["type"]}), "allOf": cases}


# Spectra -----------------------------------------------------------------------------------------------------------------------------
SPECTRUM_TYPE = "The form of the spectrum"
spectrum_forms = {
    "sampled": ("Piecewise linear between samples.",
                {"wavelengths": listed("nm, increasing", {"type": "number"}, 1), "values": listed("One a wavelength", {"type": "number"}, 1)},
                ["wavelengths", "values"], {"wavelengths": [400, 700], "values": [0.2, 0.8]}),
    "file": ("Piecewise linear between the rows of a CSV of two columns, nm and value.",
             {"filename": string("Relative to the scene file")}, ["filename"], {"filename": "spectrum.csv"}),
    "constant": ("The same at every wavelength, also as an emission.",
                 {"value": number("Truly constant"),
                  "color": {"type": ["number", "array"], "items": {"type": "number"}, "minItems": 3, "maxItems": 3,
                            "description": "darts' constant texture: a number or [r, g, b] as if it stood alone"}}, [], {"value": 0.5},
                 {"oneOf": [{"required": ["value"]}, {"required": ["color"]}]}),
    "rgb": ("An upsampled colour whose ultraviolet is given.",
            {"value": vector("Linear sRGB"), "uv": number("The value below 380 nm (else that at 380 nm)", 0)}, ["value"],
            {"value": [0.8, 0.2, 0.1], "uv": 0.1}),
    "box": ("`value` within the range, else 0.", {"range": numbers("[from, to] in nm", 2), "value": number("Inside the range", default=1)},
            ["range"], {"range": [500, 600]}),
    "gaussian": ("A bell curve.", {"mean": number("nm"), "stddev": positive("nm"), "value": number("At the mean", default=1)},
                 ["mean", "stddev"], {"mean": 550, "stddev": 20}),
    "blackbody": ("Planck's law, normalised to a luminance of 1.", {"temperature": number("Kelvin", 100, 1e7)}, ["temperature"],
                  {"temperature": 2856}),
    "illuminant": ("A standard illuminant, normalised to a luminance of 1.", {"name": choice("CIE's name", "D65", "A", "E", "F11")}, ["name"],
                   {"name": "D65"}),
    "cauchy": ("An index of refraction: A + B / wavelength^2.", {"A": number("Without unit"), "B": number("um^2")}, ["A", "B"],
               {"A": 1.5, "B": 0.004}),
    "sellmeier": ("An index of refraction: n^2 = 1 + sum of B w^2 / (w^2 - C).", {"B": vector("Without unit"), "C": vector("um^2")}, ["B", "C"],
                  {"B": [1.04, 0.23, 1.01], "C": [0.006, 0.02, 103.6]}),
    "product": ("The product of spectra.", {"of": listed("The factors", ref("any spectrum"), 1)}, ["of"], {"of": [0.5, 0.5]}),
    "sum": ("The sum of spectra.", {"of": listed("The terms", ref("any spectrum"), 1)}, ["of"], {"of": [0.25, 0.25]}),
}
for name, (text, keys, required, example, *more) in spectrum_forms.items():
    common = {"type": True, "name": string("What the scene calls it"), "scale": number("Multiplies the values", default=1),
              "extrapolate": choice("Beyond the samples: nothing, or the last one [zero for emission and dyes, else hold]", "zero", "hold")}
    definitions[f"spectrum: {name}"] = keyed(text, {**common, **keys}, ["type", *required], {"type": name, **example}, **(more[0] if more else {}))
definitions["spectrum"] = union(SPECTRUM_TYPE, "spectrum", spectrum_forms)


def spectrum(what, low=-INF, high=INF, open_ends=False, objects="spectrum", meaning=""):
    """A number, [r, g, b], a name or an object, with the range that the reader checks on the first two."""
    bounds = number("", low, high, open_ends, open_ends and high < INF)
    limits = {k: v for k, v in bounds.items() if k not in ("type", "description")}
    return {"description": f"{what}: a number, [r, g, b] in linear sRGB, the name of a spectrum, or an object.{meaning}",
            "type": ["number", "array", "string", "object"], **limits, "items": {"type": "number", **limits}, "minItems": 3, "maxItems": 3,
            "if": {"type": "object"}, "then": ref(objects)}


EMITS = " A number or [r, g, b] is D65-shaped, so that the pixel is exactly that."
definitions["any spectrum"] = spectrum("A spectrum")
definitions["reflectance"] = spectrum("A reflectance within [0, 1]", 0, 1)
definitions["colour"] = spectrum("A reflectance within [0, 1]", 0, 1, objects="spectrum or texture", meaning=" Or a texture.")
definitions["emission"] = spectrum("An emission, W m^-2 sr^-1 nm^-1 or relative", 0, meaning=EMITS)
definitions["textured emission"] = spectrum("An emission, W m^-2 sr^-1 nm^-1 or relative", 0, objects="spectrum or texture",
                                            meaning=EMITS + " Or a texture.")
definitions["index"] = spectrum("An index of refraction, more than 0", 0, open_ends=True)
definitions["absorption index"] = spectrum("An index of absorption, not negative", 0)
definitions["coefficient"] = spectrum("A coefficient, not negative", 0)
definitions["anisotropy"] = spectrum("The mean cosine of scattering, within (-1, 1)", -1, 1, open_ends=True)
definitions["plain constant"] = keyed("darts' constant texture, as a number.", {"type": {"const": "constant"}, "value": number("The number"),
                                                                               "color": number("The number, as darts calls it")},
                                      ["type"], {"type": "constant", "value": 0.5})

# Transforms --------------------------------------------------------------------------------------------------------------------------
LOOK = {"from": vector("Where it stands [0, 0, 1]"), "at": vector("What it looks at [0, 0, 0]"), "to": vector("The same as \"at\""),
        "up": vector("What is up [0, 1, 0]")}
AXES = {"x": vector("The first column"), "y": vector("The second column"), "z": vector("The third column"), "o": vector("The origin")}
COMMANDS = {
    "translate": vector("Moves by [x, y, z] in scene units"),
    "scale": {"type": ["number", "array"], "items": {"type": "number"}, "minItems": 3, "maxItems": 3, "description": "Scales by s or [x, y, z]"},
    "rotate": numbers("[degrees, ax, ay, az]: about an axis", 4),
    "matrix": numbers("16 numbers, row by row; the last row is 0 0 0 1", 16),
    "angle": number("Degrees, about \"axis\""), "axis": vector("The axis of \"angle\""),
}
definitions["transform: look at"] = keyed("Stands at \"from\" and looks along its -z at \"at\".", LOOK, [], {"from": [0, 0, 4]}, minProperties=1)
definitions["transform: axes"] = keyed("An affine map by its columns.", AXES, [], {"o": [0, 0, 1]}, minProperties=1)
definitions["transform command"] = keyed(
    "One command of a transform.", {**COMMANDS, **LOOK, **AXES}, [], {"translate": [0, 0, 1]},
    anyOf=[ref("transform: look at"), ref("transform: axes"), *({"required": [k], "maxProperties": 1} for k in list(COMMANDS)[:4]),
           {"required": ["angle", "axis"], "maxProperties": 2}])
definitions["transform"] = {"description": "A command, or an array of them applied in listed order, the first entry first.",
                            "type": ["object", "array"], "items": ref("transform command"),
                            "if": {"type": "object"}, "then": ref("transform command")}

# Textures ----------------------------------------------------------------------------------------------------------------------------
lookup = {"type": True, "name": string("Not used"), "xform": ref("transform"), "transform": ref("transform"),
          "mapping3d": ref("texture mapping"), "mapping": ref("texture mapping")}
definitions["texture mapping"] = keyed("From world to texture space.",
                                       {"type": type_name("The only mapping", ["transform", "identity"]), "transform": ref("transform")}, [],
                                       {"type": "transform"})
definitions["region shape"] = keyed(
    "One of sphere, box and capsule, in world space.",
    {"sphere": vector("The centre"), "box": numbers("Two corners", 2, vector("A corner")), "capsule": numbers("Two ends", 2, vector("An end")),
     "radius": positive("Of the sphere or capsule")}, [], {"sphere": [0, 0, 0], "radius": 1},
    oneOf=[{"required": ["sphere", "radius"]}, {"required": ["box"]}, {"required": ["capsule", "radius"]}])
amount_of = "Two colours, which may be textures"
colour_textures = {
    "checker": ("A checkerboard in world space.", {"even": described(ref("colour"), "Where the product of sines is positive", 0),
                                                   "odd": described(ref("colour"), "Where it is negative", 1), "scale": positive("x/scale", 1)}, [], {}),
    "marble": ("Veins by turbulence.", {"base": described(ref("reflectance"), "Between the veins", 1),
                                        "veins": described(ref("reflectance"), "The veins", 0), "scale": number("Frequency", default=1)}, [], {}),
    "image": ("Pixels by uv.", {"filename": string("Relative to the scene file"), "raw": boolean("Do not decode sRGB", False),
                                "scale": number("Multiplies the pixels", 0, default=1), "wrap": choice("Outside [0, 1]", "repeat", "clamp", default="repeat"),
                                "filter": choice("Between pixels", "bilinear", "nearest", default="bilinear")}, ["filename"], {"filename": "image.png"}),
    "wireframe": ("The edges of triangles.", {"base": described(ref("colour"), "Inside", 0.8), "wire": described(ref("colour"), "At the edges", 0),
                                              "thickness": number("In barycentric coordinates", 0, default=0.05)}, [], {}),
}
number_textures = {
    "fresnel": ("The unpolarised reflectance at the angle of view.", {"ior": positive("From 1 into this", 1.5)}, [], {}),
    "region": ("1 inside any of the shapes, else 0.", {"shapes": listed("In world space", ref("region shape"), 1)}, ["shapes"],
               {"shapes": [{"sphere": [0, 0, 0], "radius": 1}]}),
    "mesh mask": ("A number per vertex that a generated mesh brings along.", {"name": string("The head has lips, lashes, brows")}, ["name"],
                  {"name": "lips"}),
}
for name, (text, keys, required, example) in {**colour_textures, **number_textures}.items():
    definitions[f"texture: {name}"] = keyed(text, {**lookup, **keys}, ["type", *required], {"type": name, **example})
families = {**dict.fromkeys(spectrum_forms, "spectrum"), **dict.fromkeys([*colour_textures, *number_textures], "texture")}
definitions["spectrum or texture"] = union("A form of spectrum or a texture", families, [*spectrum_forms, *colour_textures])
definitions["amount"] = {
    "description": "A number within [0, 1], or a texture.", "type": ["number", "object"], "minimum": 0, "maximum": 1,
    "if": {"type": "object"},
    "then": {"if": {"properties": {"type": {"const": "constant"}}}, "then": ref("plain constant"),
             "else": union("The kind of texture", "texture", [*colour_textures, *number_textures])}}

# Media -------------------------------------------------------------------------------------------------------------------------------
unit = choice("Coefficients are in 1/unit", "m", "cm", "mm")


def dye(where, yields):
    return {"absorption": described(ref("coefficient" if where == "medium" else "reflectance"), "What it absorbs, by wavelength"),
            "emission": described(ref("coefficient"), "The shape of what it emits, by wavelength"), "yield": fraction("Emitted over absorbed", 1),
            "yield_type": choice("Whether the yield counts photons or energy", "photon", "energy", default="photon"),
            "concentration": number("Multiplies the absorption", 0, INF if where == "medium" else 1, default=1),
            "stokes": boolean("Nothing is emitted at wavelengths shorter than absorbed ones", False)}


DYE = {"absorption": {"type": "gaussian", "mean": 375, "stddev": 20, "value": 0.9}, "emission": {"type": "gaussian", "mean": 450, "stddev": 25}}
for where in ("surface", "medium"):
    definitions[f"dye: {where}"] = keyed(f"A dye of a {where}.", {"name": string("For people"), **dye(where, True)}, ["absorption", "emission"], DYE)
phase_types = type_name("The phase function", ["hg", "henyey_greenstein", "isotropic"])
definitions["phase function"] = keyed("How a medium scatters.", {"type": phase_types, "g": ref("anisotropy")}, ["type"],
                                      {"type": "hg", "g": 0.5})
phase = {"description": "How the medium scatters [isotropic]", "type": ["string", "object"], "if": {"type": "object"},
         "then": ref("phase function"), "else": phase_types}
coefficient_names = ["sigma_t", "sigma_s", "sigma_a", "albedo"]
pairs = [[a, b] for i, a in enumerate(coefficient_names) for b in coefficient_names[i + 1:]]
triples = [[n for n in coefficient_names if n != left] for left in coefficient_names]
definitions["medium: homogeneous"] = keyed(
    "Exactly two of sigma_t, sigma_s, sigma_a and albedo.",
    {"type": True, "name": string("What surfaces call it"), "sigma_t": described(ref("coefficient"), "Extinction, 1/unit"),
     "sigma_s": described(ref("coefficient"), "Scattering, 1/unit"), "sigma_a": described(ref("coefficient"), "Absorption, 1/unit"),
     "albedo": described(ref("reflectance"), "Scattering over extinction"), "total": described(ref("coefficient"), "darts' sigma_t"),
     "real fraction": fraction("darts': multiplies the coefficients", 1), "g": described(ref("anisotropy"), "Mean cosine of Henyey-Greenstein", 0),
     "phase function": phase, "unit": unit, "dyes": listed("What fluoresces in it", ref("dye: medium"), 1)},
    ["type"], {"type": "homogeneous", "name": "fog", "sigma_t": 1, "albedo": 0.9},
    anyOf=[*({"required": p} for p in pairs), {"required": ["total"]}, *({"required": [n.replace("_", " ")]} for n in coefficient_names[:3])],
    **{"not": {"anyOf": [{"required": t} for t in triples]}})
definitions["medium: vacuum"] = keyed("Nothing.", {"type": True, "name": string("What surfaces call it"), "phase function": True}, ["type"],
                                      {"type": "vacuum", "name": "nothing"})
definitions["medium"] = union("The kind of medium", "medium", ["homogeneous", "vacuum"], {"homogeneous": ["homogeneous_hg"]})
definitions["medium or name"] = {"description": "A medium, the name of one, \"vacuum\", \"air\" or null.", "type": ["string", "object", "null"],
                                 "if": {"type": "object"}, "then": ref("medium")}

# Materials ---------------------------------------------------------------------------------------------------------------------------
alpha = fraction("GGX roughness; 0 is smooth", 0)
worn = ref("material or name")
plain_ior = {"description": "Index of refraction, a number [1.5]", "type": ["number", "object"], "exclusiveMinimum": 0,
             "if": {"type": "object"}, "then": ref("plain constant")}
any_material = {"type": "lambertian"}
materials = {
    "lambertian": ("A matte surface.", {"albedo": described(ref("colour"), "Reflectance", 0.5)}, [], {}),
    "metal": ("darts' metal: the mirror direction plus a point in a sphere.",
              {"albedo": described(ref("colour"), "Reflectance", 0.8),
               "roughness": {"type": ["number", "object"], "minimum": 0, "description": "Radius of the sphere, 1 at most [0]",
                             "if": {"type": "object"}, "then": ref("plain constant")}}, [], {}),
    "conductor": ("A metal by its complex index of refraction, with GGX.", {"eta": ref("index"), "k": ref("absorption index"), "alpha": alpha},
                  ["eta", "k"], {"eta": 0.2, "k": 3.9}),
    "dielectric": ("Glass, water, skin's boundary: reflects and refracts.",
                   {"ior": described(ref("index"), "Inside over outside", 1.5), "alpha": alpha,
                    "scatter_albedo": described(ref("colour"), "The fraction kept at each reflection and refraction", 1)}, [], {}),
    "interface": ("An index-matched boundary: only the medium changes.", {}, [], {}),
    "phong": ("darts' glossy lobe about the mirror direction.", {"albedo": described(ref("colour"), "Reflectance", 0.5),
                                                                 "exponent": number("Sharpness", 0, default=1)}, [], {}),
    "blinn_phong": ("darts' glossy lobe of half vectors.", {"albedo": described(ref("colour"), "Reflectance", 0.5),
                                                            "exponent": number("Sharpness", 0, default=1)}, [], {}),
    "diffuse_light": ("A lamp that shines from its front side.", {"emit": described(ref("textured emission"), "Emission", 1)}, [], {}),
    "uv_light": ("A lamp of ultraviolet, 365 +- 10 nm unless \"emit\" says otherwise.",
                 {"emit": described(ref("textured emission"), "Emission"), "power": number("W per m^2", 0)}, [], {}),
    "diffuse_fluorescent": ("A matte surface with a dye, or with several.",
                            {"albedo": described(ref("colour"), "Reflectance without the dyes", 0), **dye("surface", True),
                             "dyes": listed("Several dyes", ref("dye: surface"), 1)}, [], DYE,
                            {"oneOf": [{"required": ["absorption", "emission"]}, {"required": ["dyes"]}]}),
    "reradiation": ("A measured matrix: a CSV or a bispectral EXR.", {"filename": string("Relative to the scene file")}, ["filename"],
                    {"filename": "matrix.csv"}),
    "blend": ("Two materials mixed.", {"a": worn, "b": worn, "amount": described(ref("amount"), "How much of b", 0.5)}, ["a", "b"],
              {"a": any_material, "b": any_material}),
    "fresnel_blend": ("darts' older spelling of a blend by a fresnel texture.", {"refr": worn, "refl": worn, "ior": plain_ior}, ["refr", "refl"],
                      {"refr": any_material, "refl": any_material}),
    "painted": ("A base with paint where a mask says so.", {"base": worn, "paint": worn, "mask": described(ref("amount"), "Where the paint lies")},
                ["base", "paint", "mask"], {"base": any_material, "paint": any_material, "mask": 0.5}),
    "skin": ("Human skin: an epidermis with melanin over a dermis with blood.",
             {"melanosome fraction": fraction("Of the epidermis, 0.02 fair to 0.43 dark", 0.25), "blood fraction": fraction("Of the dermis", 0.01),
              "oxygenation": fraction("Of the blood", 0.75), "epidermis thickness": number("Millimetres", 0.001, 10, default=0.06),
              "g": number("Mean cosine of scattering", 0, 0.99, default=0.8), "ior": described(ref("index"), "Of the skin over air", 1.4),
              "alpha": alpha}, [], {}),
}
for name, (text, keys, required, example, *more) in materials.items():
    definitions[f"material: {name}"] = keyed(text, {"type": True, "name": string("What surfaces call it"), **keys}, ["type", *required],
                                             {"type": name, **example}, **(more[0] if more else {}))
definitions["material"] = union("The kind of material", "material", materials)
definitions["material or name"] = {"description": "A material, or the name of an earlier one.", "type": ["string", "object"],
                                   "if": {"type": "object"}, "then": ref("material")}

# Surfaces ----------------------------------------------------------------------------------------------------------------------------
every_surface = {
    "type": True, "name": string("For people and for `stokes plot`"), "transform": ref("transform"), "material": worn,
    "outside": described(ref("medium or name"), "The medium on the side that the normal points to"),
    "inside": described(ref("medium or name"), "The medium on the other side"), "flip": boolean("Reverses the normal", False),
    "emit": described(ref("emission"), "Emission from the front side, beside the material's")}
size = positive("Width or height")
surfaces = {
    "quad": ("A rectangle in its local xy-plane, normal +z.",
             {"size": {"type": ["number", "array"], "exclusiveMinimum": 0, "items": size, "minItems": 2, "maxItems": 2,
                       "description": "The full extent: a number or [width, height] [1]"}}, ["material"], {}),
    "sphere": ("A sphere, or by its transform an ellipsoid.", {"radius": positive("Scene units", 1)}, ["material"], {}),
    "triangle": ("One triangle.", {"v0": vector("A corner"), "v1": vector("A corner"), "v2": vector("A corner"),
                                   "positions": numbers("darts' spelling of the corners", 3, vector("A corner")),
                                   "normals": numbers("At the corners", 3, vector("A normal")), "uvs": numbers("At the corners", 3, numbers("[u, v]", 2))},
                 ["material"], {"v0": [0, 0, 0], "v1": [1, 0, 0], "v2": [0, 1, 0]},
                 {"oneOf": [{"required": ["v0", "v1", "v2"]}, {"required": ["positions"]}]}),
    "mesh": ("Triangles of an OBJ file, or of a generator.",
             {"filename": string("OBJ, relative to the scene file"), "generator": choice("A procedural mesh, in millimetres", "head", "hand"),
              "resolution": number("Millimetres, of a generated mesh", 0.3, 10, default=1.5),
              "pose": choice("Of the hand", "open", "relaxed", "cupping", "pointing"),
              "parameters": {"type": "object", "additionalProperties": {"type": "number"},
                             "description": "Of the head: pitch, cut, asymmetry; of the hand: joint angles such as index.mcp"},
              "offset": number("Moves every vertex along its normal, scene units; negative shrinks", default=0),
              "offset method": {"description": "How to offset [normals]", "type": "string",
                                "anyOf": [{"enum": ["normals", "distance field"]}, {"pattern": "^distance[ _-]field$"}]},
              "material prefix": string("Faces after `usemtl x` wear the material of this prefix and x")}, [], {"filename": "mesh.obj"},
             {"oneOf": [{"required": ["filename"]}, {"required": ["generator", "material"]}]}),
}
for name, (text, keys, required, example, *more) in surfaces.items():
    definitions[f"surface: {name}"] = keyed(text, {**every_surface, **keys}, ["type", *required],
                                            {"type": name, "material": any_material, **example}, **(more[0] if more else {}))
definitions["surface: group"] = keyed(
    "Surfaces under one transform.",
    {"type": True, "name": string("For people"), "transform": ref("transform"), "children": listed("The surfaces", ref("surface")),
     "surfaces": listed("The same as \"children\"", ref("surface")), "split method": True, "max leaf size": True},
    ["type"], {"type": "group", "children": []}, oneOf=[{"required": ["children"]}, {"required": ["surfaces"]}])
definitions["surface"] = union("The kind of surface", "surface", [*surfaces, "group"], {"group": ["bbh", "linear"]})

# Settings ----------------------------------------------------------------------------------------------------------------------------
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
    named = {"allOf": [ref("material")], "required": ["name"]}
    return keyed(
        "A scene of Stokes.",
        {"$schema": string("This schema's place, for editors"), "scene unit": choice("The length of one scene unit", "m", "cm", "mm"),
         "camera": ref("camera"), "sampler": ref("sampler"), "integrator": ref("integrator"), "background": background, "film": ref("film"),
         "accelerator": {"description": "darts'; accepted, not used"},
         "spectra": listed("Named spectra", {"allOf": [ref("spectrum")], "required": ["name"]}),
         "media": listed("Named media", {"allOf": [ref("medium")], "required": ["name"]}), "materials": listed("Named materials", named),
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
