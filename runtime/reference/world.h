// A compiled scene with what the reference makes of it once per render: Embree's BVH and the lights' cumulative table.
#pragma once
#include "reference/light.h"
#include "reference/spectrum.h"
#include "reference/traverse.h"

namespace stokes::reference {

/// Keeps a reference to the compiled scene, which must outlive it. Safe to read from many threads.
struct World {
  explicit World(const CompiledScene& compiled)
      : scene(compiled), traversal(compiled), lights(compiled), albedo_white(compiled.features.rgb ? Vec3d{1, 1, 1} : sensor_white(compiled)) {}

  const CompiledScene& scene;
  Traversal traversal;
  Lights lights;
  Vec3d albedo_white;  ///< what the film sees of a spectrum of 1: the white that albedo AOVs are relative to
};

}  // namespace stokes::reference
