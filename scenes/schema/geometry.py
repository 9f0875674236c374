"""Transforms and the surfaces that stand in them."""
from matter import any_material, worn
from words import boolean, choice, definitions, described, keyed, listed, number, numbers, positive, ref, string, union, vector

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
