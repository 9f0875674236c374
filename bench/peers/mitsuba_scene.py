"""Translates the suite's scenes into Mitsuba's: quads, spheres and OBJ meshes of lambertian, mirror, smooth dielectric and
interface, area lights and a constant background with spectra that are constant or sampled, one homogeneous medium. Refuses
everything else, so that nothing is compared that is not the same."""


def spectrum(value):
    """A reflectance, radiance or coefficient."""
    if isinstance(value, (int, float)):
        return {"type": "uniform", "value": float(value)}
    if value["type"] == "constant":
        return {"type": "uniform", "value": float(value["value"])}
    if value["type"] == "sampled":
        join = lambda numbers: ", ".join(str(n) for n in numbers)
        return {"type": "irregular", "wavelengths": join(value["wavelengths"]), "values": join(value["values"])}
    raise ValueError(f"no spectrum of Mitsuba for {value}")


def emission(value):
    if not isinstance(value, dict) or value["type"] != "constant":
        raise ValueError("emissions must be constant: a number would be D65-shaped")
    return spectrum(value)


def transform(mi, entries):
    """The list of steps as one matrix: the first step is applied first."""
    T = mi.ScalarTransform4f
    total = T()
    for step in entries if isinstance(entries, list) else [entries]:
        if "translate" in step:
            m = T().translate(step["translate"])
        elif "rotate" in step:
            m = T().rotate(step["rotate"][1:], step["rotate"][0])
        elif "scale" in step:
            m = T().scale(step["scale"])
        elif "from" in step:
            # A frame whose -z looks at the target, where Mitsuba's +z does.
            m = T().look_at(origin=step["from"], target=step["at"], up=step["up"]) @ T().rotate([0, 1, 0], 180)
        else:
            raise ValueError(f"no transform of Mitsuba for {step}")
        total = m @ total
    return total


def bsdf(material):
    kind = material["type"]
    if kind == "lambertian":
        return {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": spectrum(material["albedo"])}}
    if kind == "metal" and material["roughness"] == 0:
        return {"type": "conductor", "material": "none", "specular_reflectance": spectrum(material["albedo"])}
    if kind == "dielectric":
        return {"type": "dielectric", "int_ior": float(material["ior"]), "ext_ior": 1.0}
    if kind == "interface":
        return {"type": "null"}
    if kind == "diffuse_light":
        return {"type": "diffuse", "reflectance": spectrum(0)}
    raise ValueError(f"no material of Mitsuba for {kind}")


def shape(mi, surface, materials, media):
    T = mi.ScalarTransform4f
    to_world = transform(mi, surface.get("transform", []))
    if surface["type"] == "quad":
        # Mitsuba's rectangle is 2 units wide.
        result = {"type": "rectangle", "to_world": to_world @ T().scale([surface["size"] / 2, surface["size"] / 2, 1])}
    elif surface["type"] == "sphere":
        result = {"type": "sphere", "to_world": to_world @ T().scale(surface["radius"])}
    elif surface["type"] == "mesh" and "filename" in surface:
        result = {"type": "obj", "filename": surface["filename"], "face_normals": True, "to_world": to_world}
    else:
        raise ValueError(f"no shape of Mitsuba for {surface}")
    material = materials[surface["material"]]
    result["bsdf"] = bsdf(material)
    if material["type"] == "diffuse_light":
        result["emitter"] = {"type": "area", "radiance": emission(material["emit"])}
    elif material["type"] in ("interface", "dielectric"):
        for side, name in (("interior", surface.get("inside")), ("exterior", surface.get("outside"))):
            if name in media:
                result[side] = {"type": "ref", "id": name}
    return result


def mitsuba_scene(mi, scene, size, spp, film="xyz"):
    """The scene as a dict for mi.load_dict. One bounce of ours is one of Mitsuba's, whose depth also counts the light."""
    integrator = scene["integrator"]
    roulette = integrator["russian roulette"]
    media = {m["name"]: m for m in scene.get("media", [])}
    materials = {m["name"]: m for m in scene["materials"]}
    camera = scene["camera"]
    result = {
        "type": "scene",
        "integrator": {"type": "volpath" if media else "path", "max_depth": integrator["max bounces"] + 1,
                       "rr_depth": 1 << 20 if roulette is False else int(roulette)},
        "sensor": {"type": "perspective", "fov": camera["vfov"], "fov_axis": "y", "near_clip": 0.01, "far_clip": 1e4,
                   "to_world": mi.ScalarTransform4f().look_at(origin=camera["transform"]["from"], target=camera["transform"]["at"],
                                                              up=camera["transform"]["up"]),
                   "film": {"type": "hdrfilm", "width": size, "height": size, "pixel_format": film, "component_format": "float32",
                            "rfilter": {"type": "box"}},
                   "sampler": {"type": "independent", "sample_count": spp}}}
    for name, medium in media.items():
        result[name] = {"type": "homogeneous", "albedo": spectrum(medium["albedo"]), "sigma_t": float(medium["sigma_t"]),
                        "phase": {"type": "hg", "g": float(medium["g"])} if medium["g"] else {"type": "isotropic"}}
    if scene["background"] != 0:
        result["background"] = {"type": "constant", "radiance": emission(scene["background"])}
    for i, surface in enumerate(scene["surfaces"]):
        result[f"surface_{i}"] = shape(mi, surface, materials, media)
    return result
