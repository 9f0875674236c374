"""What things are made of: dyes, media, materials."""
from words import INF, boolean, choice, definitions, described, fraction, keyed, listed, number, ref, string, type_name, union

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
