"""Translates the suite's scenes into LuxCore's properties and meshes: quads, spheres and OBJ meshes of lambertian, mirror, smooth dielectric
and interface, area lights, a constant background and homogeneous grey media, in RGB. What LuxCore cannot say the same way is listed in
README.md of the folder above; everything else is refused."""
import math

import pyluxcore

from rgb_scene import WHITE, coefficients, emission, geometry, reflectance


def properties(values):
    """{"a.b": value or list of values} as LuxCore's."""
    result = pyluxcore.Properties()
    for name, value in values.items():
        result.Set(pyluxcore.Property(name, value))
    return result


def mean_cosine(k):
    """Of Schlick's phase function (1 - k^2) / (4 pi (1 - k cos)^2)."""
    return 0.0 if k == 0 else 1 / k - (1 - k * k) / (2 * k * k) * math.log((1 + k) / (1 - k))


def bisect(f, target):
    """Where a rising f of [0, 1) reaches the target."""
    low, high = 0.0, 1 - 1e-9
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if f(middle) < target else (low, middle)
    return low


def asymmetry(g):
    """LuxCore has no phase function of Henyey and Greenstein's: its "asymmetry" a is Schlick's k = 1.55 a - 0.55 a^3, which, for the same
    number, leans far more forward. This is the one with a mean cosine of g."""
    if g < 0:
        raise ValueError("no backward scattering here")
    return bisect(lambda a: mean_cosine(min(1.55 * a - 0.55 * a ** 3, 1 - 1e-9)), g) if g else 0.0


def volume(medium):
    absorption, scattering = coefficients(medium)
    return {"type": "homogeneous", "absorption": [absorption] * 3, "scattering": [scattering] * 3,
            "asymmetry": [asymmetry(float(medium["g"]))] * 3, "multiscattering": True}


def material(description):
    kind = description["type"]
    if kind == "lambertian":
        return {"type": "matte", "kd": reflectance(description["albedo"])}
    if kind == "metal" and description["roughness"] == 0:
        return {"type": "mirror", "kr": reflectance(description["albedo"])}
    if kind == "dielectric":
        return {"type": "glass", "kr": [1.0] * 3, "kt": [1.0] * 3, "exteriorior": 1.0, "interiorior": float(description["ior"])}
    if kind == "interface":
        return {"type": "null"}
    if kind == "diffuse_light":
        # Without a power, "emission" is the radiance.
        return {"type": "matte", "kd": [0.0] * 3, "emission": (emission(description["emit"]) * WHITE).tolist(), "emission.power": 0.0,
                "emission.efficiency": 0.0, "emission.gain": [1.0] * 3}
    raise ValueError(f"no material of LuxCore for {kind}")


def add_surface(scene, name, surface, description, media):
    """A mesh with a material of its own, since media are the materials' there."""
    points, faces, smooth = geometry(surface)
    triangles = [(face[0], face[i], face[i + 1]) for face in faces for i in range(1, len(face) - 1)]
    normals = None
    if smooth:
        centre = [sum(axis) / len(points) for axis in zip(*points)]
        normals = [tuple((a - b) / math.dist(p, centre) for a, b in zip(p, centre)) for p in points]
    scene.DefineMesh(name, [tuple(p) for p in points], triangles, normals, None, None, None)
    values = {f"scene.materials.{name}.{key}": value for key, value in material(description).items()}
    if description["type"] in ("dielectric", "interface"):
        for side, where in (("inside", "interior"), ("outside", "exterior")):
            if surface.get(side) in media:
                values[f"scene.materials.{name}.volume.{where}"] = surface[side]
    scene.Parse(properties({**values, f"scene.objects.{name}.shape": name, f"scene.objects.{name}.material": name}))


def build(description, size):
    """The scene of LuxCore, for square pictures of `size` pixels: its pictures are a pixel lower than their camera says, so the screen is
    moved by one."""
    scene = pyluxcore.Scene()
    camera, media = description["camera"], {m["name"]: m for m in description.get("media", [])}
    values = {"scene.camera.type": "perspective", "scene.camera.lookat.orig": camera["transform"]["from"],
              "scene.camera.lookat.target": camera["transform"]["at"], "scene.camera.up": camera["transform"]["up"],
              "scene.camera.fieldofview": camera["vfov"], "scene.camera.screenwindow": [-1, 1, -1 - 2 / size, 1 - 2 / size],
              "scene.camera.autovolume.enable": False, "scene.camera.cliphither": 0.01}
    if any("vacuum" in (s.get("inside"), s.get("outside")) for s in description["surfaces"]):
        values["scene.volumes.vacuum.type"] = "clear"
        media["vacuum"] = None
    for name, medium in media.items():
        if medium:
            values.update({f"scene.volumes.{name}.{key}": value for key, value in volume(medium).items()})
    if description["background"] != 0:
        values.update({"scene.lights.background.type": "constantinfinite",
                       "scene.lights.background.color": (emission(description["background"]) * WHITE).tolist()})
    scene.Parse(properties(values))
    materials = {m["name"]: m for m in description["materials"]}
    for i, surface in enumerate(description["surfaces"]):
        add_surface(scene, f"surface{i}", surface, materials[surface["material"]], media)
    return scene


def settings(integrator, size, seed, spp):
    """Path tracing with nothing but what our scene asks for. A path of LuxCore counts its vertices, ours its bounces."""
    roulette, depth = integrator["russian roulette"], integrator["max bounces"] + 1
    values = {f"path.pathdepth.{kind}": depth for kind in ("total", "diffuse", "glossy", "specular")}
    return properties({
        **values, "renderengine.type": "PATHCPU", "renderengine.seed": seed + 1, "native.threads.count": 1,
        "path.russianroulette.depth": 1 << 20 if roulette is False else int(roulette), "path.russianroulette.cap": 0.0,
        "path.clamping.variance.maxvalue": 0.0, "path.hybridbackforward.enable": False,
        "sampler.type": "RANDOM", "sampler.random.adaptive.strength": 0.0,
        "film.width": size, "film.height": size, "film.filter.type": "BOX", "film.filter.width": 0.5, "film.opencl.enable": False,
        "film.imagepipelines.0.0.type": "NOP", "film.outputs.0.type": "RGB", "film.outputs.0.filename": "unused.exr", "batch.haltspp": spp})
