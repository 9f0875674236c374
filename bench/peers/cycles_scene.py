"""Builds the suite's scenes in Blender for Cycles: quads, spheres and OBJ meshes of lambertian, mirror, smooth dielectric and interface,
area lights, a constant background and homogeneous media. Cycles is an RGB renderer: a spectrum becomes linear sRGB, reflectances as
seen in equal-energy light. What Cycles cannot say the same way is listed in README.md of the folder above; everything else is refused."""
import math

import bpy
import mathutils
import numpy as np

XYZ_TO_SRGB = np.array([[3.2404542, -1.5371385, -0.4985314], [-0.9692660, 1.8760108, 0.0415560], [0.0556434, -0.2040259, 1.0572252]])


def observer(nm):
    """The CIE 1931 observer, as the sums of Gaussians of Wyman, Sloan and Shirley 2013."""
    g = lambda mean, below, above: np.exp(-0.5 * ((nm - mean) * np.where(nm < mean, below, above)) ** 2)
    return np.array([1.056 * g(599.8, 0.0264, 0.0323) + 0.362 * g(442.0, 0.0624, 0.0374) - 0.065 * g(501.1, 0.0490, 0.0382),
                     0.821 * g(568.8, 0.0213, 0.0247) + 0.286 * g(530.9, 0.0613, 0.0322),
                     1.217 * g(437.0, 0.0845, 0.0278) + 0.681 * g(459.0, 0.0385, 0.0725)])


NM = np.arange(360.0, 831.0)
OBSERVER = observer(NM)
OBSERVER /= OBSERVER.sum(1, keepdims=True)  # an equal-energy spectrum of 1 has X = Y = Z = 1
WHITE = XYZ_TO_SRGB @ np.ones(3)


def reflectance(value):
    """R, G, B of a reflectance: what it leaves of equal-energy light."""
    if isinstance(value, (int, float)):
        return [float(value)] * 3
    if value["type"] == "constant":
        return [float(value["value"])] * 3
    if value["type"] == "sampled":
        curve = np.interp(NM, value["wavelengths"], value["values"])
        return np.clip(XYZ_TO_SRGB @ (OBSERVER @ curve) / WHITE, 0, 1).tolist()
    raise ValueError(f"no colour of Cycles for {value}")


def emission(value):
    if not isinstance(value, dict) or value["type"] != "constant":
        raise ValueError("emissions must be constant: a number would be D65-shaped")
    return float(value["value"])


def transform(entries):
    """The list of steps as one matrix: the first step is applied first."""
    total = mathutils.Matrix.Identity(4)
    for step in entries if isinstance(entries, list) else [entries]:
        if "translate" in step:
            m = mathutils.Matrix.Translation(step["translate"])
        elif "rotate" in step:
            m = mathutils.Matrix.Rotation(math.radians(step["rotate"][0]), 4, mathutils.Vector(step["rotate"][1:]))
        elif "scale" in step:
            factors = step["scale"] if isinstance(step["scale"], list) else [step["scale"]] * 3
            m = mathutils.Matrix.Diagonal((*factors, 1))
        elif "from" in step:
            m = frame(step)
        else:
            raise ValueError(f"no transform of Cycles for {step}")
        total = m @ total
    return total


def frame(step):
    """A frame whose -z looks at the target, which Blender's camera does too."""
    z = (mathutils.Vector(step["from"]) - mathutils.Vector(step["at"])).normalized()
    x = mathutils.Vector(step["up"]).cross(z).normalized()
    m = mathutils.Matrix((x, z.cross(x), z)).transposed().to_4x4()
    m.translation = step["from"]
    return m


def add_volume(tree, output, medium):
    """Scattering and absorption are grey, so two nodes give sigma_t and the albedo."""
    extinction, albedo = float(medium["sigma_t"]), reflectance(medium["albedo"])[0]
    scatter, absorb, both = (tree.nodes.new("ShaderNode" + name) for name in ("VolumeScatter", "VolumeAbsorption", "AddShader"))
    scatter.inputs["Color"].default_value = (1, 1, 1, 1)
    scatter.inputs["Density"].default_value = extinction * albedo
    scatter.inputs["Anisotropy"].default_value = float(medium["g"])
    absorb.inputs["Color"].default_value = (0, 0, 0, 1)
    absorb.inputs["Density"].default_value = extinction * (1 - albedo)
    tree.links.new(scatter.outputs[0], both.inputs[0])
    tree.links.new(absorb.outputs[0], both.inputs[1])
    tree.links.new(both.outputs[0], output.inputs["Volume"])


def add_emission(material, tree, output, strength):
    """A constant, which Cycles has a quick way for. It cannot shine on the front alone then, as our lights do: it is looked for on the
    front alone, and the suite's lamps have nothing behind them that would see the rest."""
    node = tree.nodes.new("ShaderNodeEmission")
    node.inputs["Color"].default_value = (*WHITE, 1)
    node.inputs["Strength"].default_value = strength
    tree.links.new(node.outputs[0], output.inputs["Surface"])
    material.cycles.emission_sampling = "FRONT"


def shader(description, medium):
    """A material of Blender; `medium` is what is behind the surface, or None."""
    material = bpy.data.materials.new(description["name"])
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    kind = description["type"]
    if kind == "diffuse_light":
        add_emission(material, tree, output, emission(description["emit"]))
    elif kind == "lambertian" or (kind == "metal" and description["roughness"] == 0):
        node = tree.nodes.new("ShaderNodeBsdfDiffuse" if kind == "lambertian" else "ShaderNodeBsdfAnisotropic")
        node.inputs["Color"].default_value = (*reflectance(description["albedo"]), 1)
        node.inputs["Roughness"].default_value = 0
        tree.links.new(node.outputs[0], output.inputs["Surface"])
    elif kind == "dielectric":
        node = tree.nodes.new("ShaderNodeBsdfGlass")
        node.inputs["IOR"].default_value = float(description["ior"])
        node.inputs["Roughness"].default_value = 0
        tree.links.new(node.outputs[0], output.inputs["Surface"])
    elif kind != "interface":
        raise ValueError(f"no material of Cycles for {kind}")
    if medium and kind in ("dielectric", "interface"):
        add_volume(tree, output, medium)
        material.cycles.homogeneous_volume = True
    return material


def read_obj(path):
    positions, faces = [], []
    for line in open(path):
        words = line.split()
        if words and words[0] == "v":
            positions.append([float(w) for w in words[1:4]])
        elif words and words[0] == "f":
            faces.append([int(w.split("/")[0]) - 1 for w in words[1:]])
    return positions, faces


def geometry(surface):
    """Points in the scene's space, faces, and whether normals are interpolated."""
    to_world = transform(surface.get("transform", []))
    if surface["type"] == "quad":
        h = surface["size"] / 2
        points, faces, smooth = [(-h, -h, 0), (h, -h, 0), (h, h, 0), (-h, h, 0)], [(0, 1, 2, 3)], False
    elif surface["type"] == "sphere":
        # Cycles has no spheres: 20,480 triangles with the sphere's normals.
        import bmesh
        ball = bmesh.new()
        bmesh.ops.create_icosphere(ball, subdivisions=6, radius=surface["radius"])
        points, faces, smooth = [v.co[:] for v in ball.verts], [[v.index for v in f.verts] for f in ball.faces], True
        ball.free()
    elif surface["type"] == "mesh" and "filename" in surface:
        (points, faces), smooth = read_obj(surface["filename"]), False
    else:
        raise ValueError(f"no shape of Cycles for {surface}")
    return [tuple(to_world @ mathutils.Vector(p)) for p in points], faces, smooth


def add_object(scene, name, points, faces, smooth, material):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(points, [], faces)
    mesh.materials.append(material)
    mesh.polygons.foreach_set("use_smooth", [smooth] * len(mesh.polygons))
    scene.collection.objects.link(bpy.data.objects.new(name, mesh))


def add_surfaces(scene, description):
    """Quads that bound the same medium without a surface of their own become one closed mesh: Cycles counts entries by object."""
    media = {m["name"]: m for m in description.get("media", [])}
    materials = {m["name"]: m for m in description["materials"]}
    hulls = {}
    for i, surface in enumerate(description["surfaces"]):
        material, medium = materials[surface["material"]], surface.get("inside")
        points, faces, smooth = geometry(surface)
        if material["type"] == "interface":
            hull = hulls.setdefault(medium, (material, [], []))
            base = len(hull[1])
            hull[1].extend(points)
            hull[2].extend([[base + k for k in face] for face in faces])
        else:
            add_object(scene, f"surface {i}", points, faces, smooth, shader(material, media.get(medium)))
    for medium, (material, points, faces) in hulls.items():
        corners = sorted({tuple(round(c, 5) for c in p) for p in points})
        index = {p: k for k, p in enumerate(corners)}
        welded = [index[tuple(round(c, 5) for c in p)] for p in points]
        add_object(scene, f"hull of {medium}", corners, [[welded[k] for k in face] for face in faces], False, shader(material, media[medium]))


def add_camera(scene, description):
    camera = bpy.data.cameras.new("camera")
    item = bpy.data.objects.new("camera", camera)
    scene.collection.objects.link(item)
    scene.camera = item
    camera.sensor_fit = "VERTICAL"
    camera.angle = math.radians(description["vfov"])
    camera.clip_start, camera.clip_end = 0.01, 1e4
    item.matrix_world = frame(description["transform"])


def set_integrator(scene, description):
    """Path tracing with nothing but what our scene asks for. Cycles' first bounce is our second: its direct light is bounce 0."""
    cycles = scene.cycles
    cycles.device = "CPU"
    roulette, bounces = description["russian roulette"], min(1024, description["max bounces"] - 1)
    for kind in ("max", "diffuse", "glossy", "transmission", "volume"):
        setattr(cycles, f"{kind}_bounces", bounces)
    cycles.transparent_max_bounces = 1024
    cycles.min_light_bounces = cycles.min_transparent_bounces = 1024 if roulette is False else int(roulette)
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.pixel_filter_type = "BOX"
    cycles.filter_width = 1
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.light_sampling_threshold = 0
    cycles.blur_glossy = 0
    cycles.caustics_reflective = cycles.caustics_refractive = True


def build(description, size, threads):
    """The scene of Blender, ready to be rendered."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    render = scene.render
    render.engine = "CYCLES"
    render.threads_mode, render.threads = "FIXED", threads
    render.resolution_x = render.resolution_y = size
    render.resolution_percentage = 100
    scene.view_settings.view_transform = "Raw"
    render.image_settings.file_format, render.image_settings.color_depth, render.image_settings.color_mode = "OPEN_EXR", "32", "RGB"
    set_integrator(scene, description["integrator"])
    scene.world = bpy.data.worlds.new("world")
    scene.world.use_nodes = True
    background = scene.world.node_tree.nodes["Background"]
    background.inputs[0].default_value = (*WHITE, 1)
    background.inputs[1].default_value = emission(description["background"]) if description["background"] != 0 else 0
    add_surfaces(scene, description)
    add_camera(scene, description["camera"])
    return scene
