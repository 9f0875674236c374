"""Textures, of colours and of amounts."""
from spectra import spectrum_forms
from words import boolean, choice, definitions, described, keyed, listed, number, numbers, positive, ref, string, type_name, union, vector

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
