// A compiled scene seen from elsewhere, without compiling it again. Knows cameras; what moves them is not its business.
#pragma once
#include "compiled/compiled_scene.h"

namespace stokes {

/// The header of `scene` with another camera: its pixels, its place, the medium that it then stands in (one that the scene file names
/// stays) and the film's unit of depth. A lens may change its aperture, but not become a pinhole or the reverse: that is compiled in.
/// What was marked for speed with the first camera in mind (media that only refracted light enters, thin media) stays marked.
layout::Scene look_from(const CompiledScene& scene, const CameraDescription& camera);

}  // namespace stokes
