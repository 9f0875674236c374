// From a place on the film to a ray. Knows the camera's layout struct only.
#pragma once
#include "compiled/compiled_scene.h"
#include "reference/intersect.h"

namespace stokes::reference {

/// The ray through the pixel coordinates (px, py), in pixels of the full image from its top left corner. `lens_u`, `lens_v` in [0, 1)
/// choose the point on the lens.
Ray camera_ray(const layout::Camera& camera, double px, double py, double lens_u, double lens_v);

}  // namespace stokes::reference
