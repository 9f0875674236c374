"""Builds the suite's scenes in Blender for Cycles: quads, spheres and OBJ meshes of lambertian, mirror, smooth dielectric and interface,
area lights, a constant background and homogeneous media, in RGB. What Cycles cannot say the same way is listed in README.md of the
folder above; everything else is refused."""
import math

import bpy
import mathutils

from rgb_scene import WHITE, coefficients, emission, frame, geometry, reflectance


def add_volume(tree, output, medium):
    """Scattering and absorption are grey, so two nodes give them."""
    absorption, scattering = coefficients(medium)
    scatter, absorb, both = (tree.nodes.new("ShaderNode" + name) for name in ("VolumeScatter", "VolumeAbsorption", "AddShader"))
    scatter.inputs["Color"].default_value = (1, 1, 1, 1)
    scatter.inputs["Density"].default_value = scattering
    scatter.inputs["Anisotropy"].default_value = float(medium["g"])
    absorb.inputs["Color"].default_value = (0, 0, 0, 1)
    absorb.inputs["Density"].default_value = absorption
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
    item.matrix_world = mathutils.Matrix(frame(description["transform"]).tolist())


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
