"""Spectra: the forms that they have, and the ranges of those that keys ask for."""
from words import INF, choice, definitions, keyed, listed, number, numbers, positive, ref, string, union, vector

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
