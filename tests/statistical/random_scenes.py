#!/usr/bin/env python3
"""Scenes at random, for `stokes parity`: what no shipped scene combines, the reference and the kernel must still agree on.

  random_scenes.py STOKES [--count 40] [--seed 1] [--spp 256] [--keep FOLDER] [-- OPTION ... of stokes parity]

Each scene draws surfaces, materials, media, lights, camera and integrator from the whole format (docs: the scene format). The level alpha is
shared out over all scenes, so one disagreement is a finding. Exit code 1 when there is one. With 256 samples a scene's means are known to some
percent: this finds gross faults of odd combinations (10 % more albedo: one of three scenes noticed it at 64), finer ones are for the truth tables."""
import argparse
import json
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile

SCENES = pathlib.Path(__file__).resolve().parents[2] / "scenes"


class Draw:
    def __init__(self, seed):
        self.r = random.Random(seed)

    def u(self, a, b):
        return round(self.r.uniform(a, b), 4)

    def chance(self, p):
        return self.r.random() < p

    def reflectance(self, top=0.9):
        return self.r.choice([
            lambda: self.u(0.05, top),
            lambda: [self.u(0.02, top) for _ in range(3)],
            lambda: {"type": "gaussian", "mean": self.u(400, 700), "stddev": self.u(15, 80), "value": self.u(0.2, top)},
            lambda: {"type": "box", "range": [self.u(380, 500), self.u(520, 700)], "value": self.u(0.2, top)},
            lambda: {"type": "sampled", "wavelengths": [320, 450, 520, 610, 750], "values": [self.u(0.02, top) for _ in range(5)]},
            lambda: {"type": "product", "of": [self.u(0.5, 0.95), [self.u(0.1, top) for _ in range(3)]]},
        ])()

    def emission(self, scale):
        return self.r.choice([
            lambda: scale,
            lambda: [round(scale * self.u(0.2, 1), 4) for _ in range(3)],
            lambda: {"type": "blackbody", "temperature": self.u(2000, 9000), "scale": scale},
            lambda: {"type": "illuminant", "name": self.r.choice(["D65", "A", "E"]), "scale": scale},
            lambda: {"type": "gaussian", "mean": self.u(330, 640), "stddev": self.u(10, 60), "value": round(scale * 0.02, 5)},
        ])()

    def dyes(self, count):
        found = [self.dye() for _ in range(count)]
        for dye in found:
            dye["absorption"]["value"] = round(dye["absorption"]["value"] / count, 4)
        return found

    def dye(self):
        peak = self.u(340, 500)
        return {"absorption": {"type": "gaussian", "mean": peak, "stddev": self.u(15, 40), "value": self.u(0.3, 0.9)},
                "emission": {"type": "gaussian", "mean": peak + self.u(40, 140), "stddev": self.u(12, 40), "value": 1},
                "yield": self.u(0.3, 1), "yield_type": self.r.choice(["photon", "energy"]), "concentration": self.u(0.2, 1)}

    def texture(self):
        t = self.r.choice([
            lambda: {"type": "checker", "even": self.reflectance(), "odd": self.reflectance(), "scale": self.u(0.05, 0.3)},
            lambda: {"type": "marble", "base": self.reflectance(), "veins": self.reflectance(), "scale": self.u(1, 6)},
            lambda: {"type": "image", "filename": "textures/uv_grid.png", "raw": self.chance(0.3), "scale": self.u(0.3, 0.9),
                     "wrap": self.r.choice(["repeat", "clamp"]), "filter": self.r.choice(["bilinear", "nearest"])},
            lambda: {"type": "wireframe", "base": self.reflectance(), "wire": self.reflectance(), "thickness": self.u(0.02, 0.1)},
        ])()
        if self.chance(0.3):
            t["transform"] = self.place()
        return t

    def ior(self):
        return self.r.choice([lambda: self.u(1.1, 1.9), lambda: {"type": "cauchy", "A": self.u(1.3, 1.6), "B": self.u(0.002, 0.01)},
                              lambda: {"type": "sellmeier", "B": [1.03961212, 0.231792344, 1.01046945], "C": [0.00600069867, 0.0200179144, 103.560653]}])()

    def mask(self):
        return self.r.choice([
            lambda: {"type": "checker", "even": 0, "odd": self.u(0.3, 1), "scale": self.u(0.05, 0.3)},
            lambda: {"type": "region", "shapes": [{"sphere": [self.u(-0.6, 0.6) for _ in range(3)], "radius": self.u(0.2, 0.6)},
                                                  {"box": [[-0.3, -1, -0.3], [self.u(0, 1), 0, 1]]}]},
            lambda: {"type": "image", "filename": "textures/uv_grid.png", "raw": True},
        ])()

    def opaque(self, depth=0):
        kinds = [
            lambda: {"type": "lambertian", "albedo": self.texture() if self.chance(0.5) else self.reflectance()},
            lambda: {"type": "metal", "albedo": self.reflectance(0.95), "roughness": self.r.choice([0, self.u(0, 0.6)])},
            lambda: {"type": "conductor", "eta": self.u(0.1, 1.5), "k": self.u(1, 5), "alpha": self.u(0.05, 0.6)},
            lambda: {"type": self.r.choice(["phong", "blinn_phong"]), "albedo": self.reflectance(), "exponent": self.u(2, 80)},
            lambda: {"type": "diffuse_fluorescent", "albedo": self.reflectance(0.4), "dyes": self.dyes(self.r.choice([1, 1, 2]))},
            lambda: {"type": "reradiation", "filename": "spectra/model_reradiation.csv"},
        ]
        if depth == 0:
            kinds += [
                lambda: {"type": "blend", "a": self.opaque(1), "b": self.opaque(1),
                         "amount": self.r.choice([self.u(0, 1), {"type": "fresnel", "ior": self.u(1.2, 2)}])},
                lambda: {"type": "painted", "base": self.opaque(1), "paint": self.opaque(1),
                         "mask": self.mask()},
            ]
        return self.r.choice(kinds)()

    def medium(self, thickness):
        m = {"type": "homogeneous", "g": self.r.choice([0, self.u(-0.6, 0.9)])}
        if self.chance(0.5):
            m["sigma_s"], m["sigma_a"] = self.coefficient(thickness), self.coefficient(0.4 * thickness)
        else:
            m["sigma_t"], m["albedo"] = self.coefficient(thickness), self.reflectance(0.98)
        if self.chance(0.15):
            dye = self.dye()
            dye["absorption"]["value"] = self.u(0.1 * thickness, thickness)
            m["dyes"] = [{key: dye[key] for key in ("absorption", "emission", "yield")}]
        return m

    def coefficient(self, size):
        return self.r.choice([
            lambda: self.u(0.1 * size, size),
            lambda: {"type": "sampled", "wavelengths": [300, 500, 700], "values": [self.u(0.1 * size, size) for _ in range(3)]},
            lambda: [self.u(0.1 * size, size) for _ in range(3)],
        ])()

    def place(self):
        t = []
        if self.chance(0.3):
            t.append({"scale": [self.u(0.5, 1.2) for _ in range(3)]})
        if self.chance(0.5):
            t.append({"rotate": [self.u(0, 360), self.u(-1, 1), self.u(-1, 1), 1]})
        return t + [{"translate": [self.u(-0.7, 0.7), self.u(-0.7, 0.5), self.u(-0.6, 0.6)]}]

    def thing(self, around):
        """A closed body or a leaf of two sides, somewhere in the room."""
        s = {"transform": self.place()}
        if self.chance(0.1):
            return {"type": "group", "transform": [{"scale": self.u(0.6, 1)}, {"rotate": [self.u(0, 360), 0, 1, 0]}], "surfaces": [self.thing(around) for _ in range(2)]}
        kind = self.r.choice(["sphere", "sphere", "quad", "triangle", "mesh"] + ["head"] * self.chance(0.15))
        if kind == "head":
            s = {"type": "mesh", "generator": self.r.choice(["head", "hand"]), "resolution": 8,
                 "transform": [{"scale": 0.004}, {"translate": [self.u(-0.5, 0.5), self.u(-0.3, 0.3), self.u(-0.5, 0.5)]}]}
        elif kind == "sphere":
            s.update(type="sphere", radius=self.u(0.15, 0.4))
        elif kind == "mesh":
            s["transform"].insert(0, {"scale": self.u(0.15, 0.4)})
            s.update(type="mesh", filename="meshes/icosahedron.obj")
            if self.chance(0.4):
                s["offset"] = self.u(-0.03, 0.05)
        elif kind == "quad":
            s.update(type="quad", size=[self.u(0.2, 0.8), self.u(0.2, 0.8)])
        else:
            s.update(type="triangle", v0=[-0.3, -0.2, 0], v1=[self.u(0.2, 0.5), -0.2, 0.1], v2=[0, self.u(0.2, 0.5), -0.1])
            if self.chance(0.5):
                s["normals"] = [[self.u(-0.4, 0.4), self.u(-0.4, 0.4), 1] for _ in range(3)]
            if self.chance(0.5):
                s["uvs"] = [[0, 0], [1, self.u(-0.5, 0.5)], [self.u(0, 1), 1]]
        s["outside"] = around
        closed = kind in ("sphere", "mesh", "head")
        s["inside"] = around
        if closed and self.chance(0.5):
            s["inside"] = "filling" if self.chance(0.7) else "vacuum"
            s["material"] = self.r.choice([
                lambda: {"type": "dielectric", "ior": self.ior()},
                lambda: {"type": "dielectric", "ior": self.ior(), "alpha": self.u(0.05, 0.5)},
                lambda: {"type": "dielectric", "ior": self.ior(), "scatter_albedo": self.reflectance(0.95)},
                lambda: {"type": "interface"},
            ])()
        else:
            s["material"] = self.opaque()
        if self.chance(0.1):
            s["flip"] = True
        if self.chance(0.1):
            s["emit"] = self.emission(0.5)
        return s

    def room(self, around):
        walls = [([-90, 1, 0, 0], [0, -1, 0]), ([90, 1, 0, 0], [0, 1, 0]), (None, [0, 0, -1]), ([90, 0, 1, 0], [-1, 0, 0]), ([-90, 0, 1, 0], [1, 0, 0])]
        for turn, shift in walls:
            if self.chance(0.2):
                continue
            yield {"type": "quad", "size": 2, "material": self.opaque() if self.chance(0.3) else {"type": "lambertian", "albedo": self.reflectance()},
                   "outside": around, "inside": around, "transform": ([{"rotate": turn}] if turn else []) + [{"translate": shift}]}

    def lights(self, around):
        for i in range(self.r.choice([1, 1, 2, 3])):
            material = {"type": "uv_light", "power": self.u(2, 30)} if self.chance(0.15) else {"type": "diffuse_light", "emit": self.emission(self.u(3, 20))}
            shape = {"type": "sphere", "radius": self.u(0.05, 0.2)} if self.chance(0.3) else {"type": "quad", "size": self.u(0.2, 0.8)}
            yield {**shape, "material": material, "outside": around, "inside": around,
                   "transform": [{"rotate": [90, 1, 0, 0]}, {"translate": [self.u(-0.6, 0.6), 0.98 - 0.2 * i, self.u(-0.6, 0.6)]}]}

    def scene(self):
        around = "fog" if self.chance(0.35) else "vacuum"
        camera = {"transform": {"from": [self.u(-0.6, 0.6), self.u(-0.3, 0.6), self.u(2.6, 4)], "at": [0, 0, 0], "up": [0, 1, 0]}, "vfov": self.u(30, 60),
                  "resolution": [32, 32]}
        if self.chance(0.2):
            camera["aperture"], camera["fdist"] = self.u(0.01, 0.1), self.u(2, 4)
        if self.chance(0.1):
            camera = {"type": "orthographic", "height": 2.2, "transform": camera["transform"], "resolution": [32, 32]}
        surfaces = list(self.room(around)) + list(self.lights(around)) + [self.thing(around) for _ in range(self.r.randint(1, 5))]
        media = [dict(self.medium(1.2), name="fog"), dict(self.medium(8), name="filling")]
        fluorescent = any(word in json.dumps([surfaces, media]) for word in ("dyes", "reradiation"))
        integrator = {"type": self.r.choice(["path tracer mis", "path tracer mis", "path tracer nee", "path tracer mats", "path tracer volumetric mis", "fluorescent mis"]),
                      "max bounces": self.r.choice([1, 2, 5, 12, 64]), "russian roulette": self.chance(0.5), "wavelengths per path": self.r.choice([1, 4, 4, 8]), "equiangular": self.chance(0.7)}
        if self.chance(0.15) and not fluorescent:
            integrator["mode"] = "rgb"
        scene = {"camera": camera, "sampler": {"type": "independent", "samples": 256, "seed": self.r.randrange(1000)}, "integrator": integrator,
                 "media": media}
        if self.chance(0.5):
            scene["background"] = self.r.choice([
                lambda: self.emission(self.u(0.05, 0.8)),
                lambda: {"type": "environment", "filename": "textures/sky.hdr", "rotate": self.u(0, 360), "scale": self.u(0.1, 1)}])()
        if around == "fog":
            camera["medium"] = "fog"
        scene["surfaces"] = surfaces
        return scene


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("stokes")
    p.add_argument("--count", type=int, default=40)
    p.add_argument("--seed", type=int, default=1)
    p.add_argument("--spp", type=int, default=256)
    p.add_argument("--keep", default="", help="a folder for the scenes that disagree")
    p.add_argument("--timeout", type=float, default=300, help="seconds a scene")
    ours, options = sys.argv[1:], []
    if "--" in ours:
        options = ours[ours.index("--") + 1:]
        ours = ours[:ours.index("--")]
    o = p.parse_args(ours)
    alpha = 0.01 / o.count
    findings = 0
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(o.keep or temporary)
        for files in ("textures", "spectra", "meshes"):
            shutil.copytree(SCENES / files, folder / files, dirs_exist_ok=True)
        for i in range(o.seed, o.seed + o.count):
            path = folder / f"random_{i}.json"
            path.write_text(json.dumps(Draw(i).scene(), indent=1))
            try:
                run = subprocess.run([o.stokes, "parity", path, "--spp", str(o.spp), "--alpha", str(alpha), *options], capture_output=True, text=True, timeout=o.timeout)
                code, text = run.returncode, (run.stdout + run.stderr).strip()
            except subprocess.TimeoutExpired:
                code, text = 124, f"not done after {o.timeout:g} s"
            print(i, code, text.splitlines()[-1] if code == 0 and text else "\n" + text, flush=True)
            if code:
                findings += 1
            elif o.keep:
                path.unlink()
    print(f"{o.count} scenes, {findings} findings (alpha {alpha:.2g} each)")
    return findings > 0


if __name__ == "__main__":
    sys.exit(main())
