// Five small scenes that together use every part of the kernels, so that few builds see them all. For tests of bits, not of pictures.
#pragma once

namespace stokes::tests {

/// Every surface, material and texture without fluorescence, under an image environment, through a lens.
inline constexpr const char* kSurfacesScene = R"({
  "camera": {"transform": {"from": [0, 1.2, 6], "at": [0, 0.6, 0], "up": [0, 1, 0]}, "vfov": 38, "resolution": [24, 16],
             "fdist": 6, "aperture": 0.05},
  "integrator": {"type": "path tracer mis", "max bounces": 12, "russian roulette": 3},
  "background": {"type": "environment", "filename": "textures/sky.hdr", "rotate": 30},
  "materials": [
    {"type": "lambertian", "name": "floor", "albedo": {"type": "checker", "even": 0.6, "odd": [0.3, 0.2, 0.1], "scale": 0.2}},
    {"type": "lambertian", "name": "image", "albedo": {"type": "image", "filename": "textures/uv_grid.png"}},
    {"type": "lambertian", "name": "marble", "albedo": {"type": "marble", "scale": 3, "veins": 0.2, "base": 0.7}},
    {"type": "lambertian", "name": "wire", "albedo": {"type": "wireframe", "base": 0.8, "wire": 0.1, "thickness": 0.05}},
    {"type": "metal", "name": "metal", "albedo": 0.9, "roughness": 0.2},
    {"type": "conductor", "name": "conductor", "eta": 0.2, "k": 3.4, "alpha": 0.2},
    {"type": "dielectric", "name": "flint", "ior": {"type": "cauchy", "A": 1.6, "B": 0.02}},
    {"type": "dielectric", "name": "frosted", "ior": 1.5, "alpha": 0.2},
    {"type": "phong", "name": "phong", "albedo": 0.8, "exponent": 16},
    {"type": "blinn_phong", "name": "blinn", "albedo": 0.8, "exponent": 64},
    {"type": "blend", "name": "varnish", "amount": {"type": "fresnel", "ior": 1.5}, "a": "image", "b": "metal"},
    {"type": "diffuse_light", "name": "light", "emit": 8},
    {"type": "diffuse_light", "name": "screen", "emit": {"type": "image", "filename": "textures/uv_grid.png"}}
  ],
  "surfaces": [
    {"type": "quad", "size": 12, "transform": [{"rotate": [-90, 1, 0, 0]}], "material": "floor"},
    {"type": "quad", "size": 1, "transform": [{"rotate": [90, 1, 0, 0]}, {"translate": [0, 3, 1]}], "material": "light"},
    {"type": "quad", "size": 1, "transform": [{"translate": [0, 1.8, -2]}], "material": "screen"},
    {"type": "sphere", "radius": 0.1, "transform": {"translate": [1.5, 2, 1]}, "material": "light"},
    {"type": "sphere", "radius": 0.4, "transform": {"translate": [-1.8, 0.4, 0]}, "material": "metal"},
    {"type": "sphere", "radius": 0.4, "transform": {"translate": [-0.9, 0.4, 0]}, "material": "conductor"},
    {"type": "sphere", "radius": 0.4, "transform": {"translate": [0, 0.4, 0]}, "material": "flint"},
    {"type": "sphere", "radius": 0.4, "transform": {"translate": [0.9, 0.4, 0]}, "material": "frosted"},
    {"type": "sphere", "radius": 0.4, "transform": [{"scale": [1, 1.4, 1]}, {"translate": [1.8, 0.56, 0]}], "material": "phong"},
    {"type": "sphere", "radius": 0.3, "transform": {"translate": [-1.4, 1.3, -1]}, "material": "blinn"},
    {"type": "sphere", "radius": 0.3, "transform": {"translate": [1.4, 1.3, -1]}, "material": "varnish"},
    {"type": "sphere", "radius": 0.3, "transform": {"translate": [0.7, 1.3, -1]}, "material": "marble"},
    {"type": "mesh", "filename": "meshes/icosahedron.obj", "transform": [{"scale": 0.4}, {"translate": [-0.6, 1.3, -1]}], "material": "wire"},
    {"type": "mesh", "filename": "meshes/prism.obj", "transform": [{"scale": 0.3}, {"translate": [0, 0.2, 1.5]}], "material": "flint"}
  ]
})";

/// Fog round a chromatic ball behind glass and a dense mesh behind an index-matched boundary, whose walks skip empty space. The camera sees the
/// boundary through nothing: paths start beyond it.
inline constexpr const char* kMediaScene = R"({
  "camera": {"transform": {"from": [0, 0.4, 5], "at": [0, 0, 0]}, "vfov": 40, "resolution": [20, 16]},
  "integrator": {"type": "path tracer volumetric mis", "max bounces": 48, "russian roulette": 8},
  "background": 0.1,
  "media": [
    {"type": "homogeneous", "name": "fog", "sigma_t": 0.1, "albedo": 0.9, "g": 0.3},
    {"type": "homogeneous_hg", "name": "jade", "sigma_s": [2, 6, 3], "sigma_a": [0.6, 0.05, 0.4], "phase function": {"type": "hg", "g": 0.5}},
    {"type": "homogeneous", "name": "milk", "sigma_t": 60, "albedo": 0.99}
  ],
  "materials": [
    {"type": "lambertian", "name": "white", "albedo": 0.75},
    {"type": "dielectric", "name": "glass", "ior": 1.4},
    {"type": "interface", "name": "boundary"},
    {"type": "diffuse_light", "name": "light", "emit": 12}
  ],
  "surfaces": [
    {"type": "quad", "size": 8, "transform": [{"rotate": [-90, 1, 0, 0]}, {"translate": [0, -1, 0]}], "material": "white", "outside": "fog"},
    {"type": "quad", "size": 2, "transform": [{"rotate": [90, 1, 0, 0]}, {"translate": [0, 3, 0]}], "material": "light", "outside": "fog"},
    {"type": "sphere", "radius": 0.8, "transform": {"translate": [-1, 0, 0]}, "material": "glass", "inside": "jade", "outside": "fog"},
    {"type": "mesh", "filename": "meshes/icosahedron.obj", "transform": {"translate": [1.1, 0, 0]}, "material": "boundary", "inside": "milk",
     "outside": "fog"}
  ]
})";

/// Lamps in thin fog of a colour, beside a ball of denser fog, a boundary and a mirror.
inline constexpr const char* kThinFogScene = R"({
  "camera": {"transform": {"from": [0, 0.4, 4], "at": [0, 0, 0]}, "vfov": 44, "resolution": [20, 16], "medium": "haze"},
  "integrator": {"type": "path tracer volumetric mis", "max bounces": 12, "russian roulette": 4},
  "background": 0.1,
  "media": [
    {"type": "homogeneous", "name": "haze", "sigma_t": [0.05, 0.1, 0.2], "albedo": 0.9, "g": 0.3},
    {"type": "homogeneous", "name": "cloud", "sigma_t": 12, "albedo": 0.9}
  ],
  "materials": [
    {"type": "lambertian", "name": "white", "albedo": 0.75},
    {"type": "metal", "name": "mirror", "albedo": 0.9},
    {"type": "interface", "name": "boundary"},
    {"type": "diffuse_light", "name": "light", "emit": 40}
  ],
  "surfaces": [
    {"type": "quad", "size": 6, "transform": [{"rotate": [-90, 1, 0, 0]}, {"translate": [0, -1, 0]}], "material": "white", "outside": "haze"},
    {"type": "quad", "size": 0.2, "transform": [{"rotate": [90, 1, 0, 0]}, {"translate": [0.6, 0.9, 0]}], "material": "light", "outside": "haze"},
    {"type": "sphere", "radius": 0.06, "transform": {"translate": [-0.8, 0.3, 0.4]}, "material": "light", "outside": "haze"},
    {"type": "sphere", "radius": 1, "transform": [{"scale": [0.05, 0.1, 0.05]}, {"translate": [0.1, 0.6, 0.3]}], "material": "light", "outside": "haze"},
    {"type": "mesh", "filename": "meshes/icosahedron.obj", "transform": [{"scale": 0.08}, {"translate": [1, 0.1, 0.6]}], "material": "light", "outside": "haze"},
    {"type": "sphere", "radius": 0.4, "transform": {"translate": [-0.4, -0.5, 0]}, "material": "boundary", "inside": "cloud", "outside": "haze"},
    {"type": "sphere", "radius": 0.4, "transform": {"translate": [0.6, -0.5, 0]}, "material": "mirror", "outside": "haze"}
  ]
})";

/// Dyes on surfaces, in paint and in a medium, with and without a Stokes mask, and a measured matrix.
inline constexpr const char* kFluorescenceScene = R"({
  "camera": {"transform": {"from": [0, 0, 6], "at": [0, 0, 0]}, "vfov": 36, "resolution": [24, 12]},
  "integrator": {"type": "fluorescent mis", "max bounces": 16, "russian roulette": 4},
  "background": 0.3,
  "media": [
    {"type": "homogeneous", "name": "ink", "sigma_s": 0.3, "sigma_a": 0.05, "dyes": [
      {"absorption": {"type": "gaussian", "mean": 460, "stddev": 22, "value": 3}, "emission": {"type": "gaussian", "mean": 515, "stddev": 18},
       "yield": 0.85}]}
  ],
  "materials": [
    {"type": "dielectric", "name": "glass", "ior": 1.33},
    {"type": "reradiation", "name": "measured", "filename": "spectra/model_reradiation.csv"},
    {"type": "diffuse_fluorescent", "name": "two dyes", "albedo": 0.2, "dyes": [
      {"absorption": {"type": "gaussian", "mean": 375, "stddev": 22, "value": 0.9}, "emission": {"type": "gaussian", "mean": 450, "stddev": 25},
       "yield": 0.9, "concentration": 0.5},
      {"absorption": {"type": "gaussian", "mean": 460, "stddev": 22, "value": 0.85}, "emission": {"type": "gaussian", "mean": 515, "stddev": 18},
       "yield": 0.85, "concentration": 0.5, "stokes": true}]},
    {"type": "painted", "name": "painted", "base": {"type": "lambertian", "albedo": [0.5, 0.35, 0.28]}, "paint": "two dyes",
     "mask": {"type": "region", "shapes": [{"sphere": [2.2, 0.4, 0.8], "radius": 0.5}, {"box": [[1, -0.7, 0], [2, 0, 1]]}]}},
    {"type": "uv_light", "name": "lamp", "power": 40}
  ],
  "surfaces": [
    {"type": "sphere", "radius": 0.7, "transform": {"translate": [-2, 0, 0]}, "material": "glass", "inside": "ink"},
    {"type": "sphere", "radius": 0.7, "transform": {"translate": [-0.6, 0, 0]}, "material": "measured"},
    {"type": "sphere", "radius": 0.7, "transform": {"translate": [0.8, 0, 0]}, "material": "two dyes"},
    {"type": "sphere", "radius": 0.7, "transform": {"translate": [2, 0, 0]}, "material": "painted"},
    {"type": "quad", "size": 2, "transform": [{"from": [0, 0, 0], "at": [-2, -3, -3], "up": [0, 0, 1]}, {"translate": [2, 3, 3]}],
     "material": "lamp"}
  ]
})";

/// Three channels in place of wavelengths, in a chromatic medium, where any channel may be the hero.
inline constexpr const char* kRgbScene = R"({
  "camera": {"transform": {"from": [0, 0, 5], "at": [0, 0, 0]}, "vfov": 34, "resolution": [20, 16]},
  "integrator": {"type": "path tracer volumetric mis", "max bounces": 32, "mode": "rgb", "russian roulette": 4},
  "background": [0.2, 0.3, 0.5],
  "media": [{"type": "homogeneous_hg", "name": "jade", "sigma_s": [2, 6, 3], "sigma_a": [0.6, 0.05, 0.4], "phase function": {"type": "hg", "g": 0.5}}],
  "materials": [
    {"type": "dielectric", "name": "glass", "ior": 1.4},
    {"type": "lambertian", "name": "image", "albedo": {"type": "image", "filename": "textures/uv_grid.png"}},
    {"type": "diffuse_light", "name": "light", "emit": [12, 10, 8]}
  ],
  "surfaces": [
    {"type": "sphere", "material": "glass", "inside": "jade"},
    {"type": "quad", "size": 4, "transform": {"translate": [0, 0, -1.5]}, "material": "image"},
    {"type": "quad", "size": 2, "transform": [{"rotate": [90, 1, 0, 0]}, {"translate": [0, 3, 0]}], "material": "light"}
  ]
})";

/// 200 mean free paths across, nearly without absorption.
inline constexpr const char* kThickBallScene = R"({
  "camera": {"transform": {"from": [0, 0, 4], "at": [0, 0, 0], "up": [0, 1, 0]}, "vfov": 22, "resolution": [16, 16]},
  "background": {"type": "constant", "value": 1},
  "integrator": {"type": "path tracer volumetric mis", "max bounces": 100000, "russian roulette": false},
  "media": [{"type": "homogeneous", "name": "milk", "sigma_t": 100, "albedo": 0.9999, "g": 0}],
  "materials": [{"type": "interface", "name": "boundary"}],
  "surfaces": [{"type": "sphere", "name": "ball", "radius": 1, "material": "boundary", "inside": "milk", "outside": "vacuum"}]
})";

}  // namespace stokes::tests
