// The camera's basis and lens, and the medium that it stands in.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "compiled/bounds.h"
#include "compiled/compilation.h"
#include "compiled/first_hit.h"
#include "compiled/look_from.h"
#include "compiled/shapes.h"

namespace stokes::compiled {
namespace {

void check_camera(const Compilation& c, const CameraDescription& camera) {
  const double determinant = camera.transform.determinant();
  if (!(std::abs(determinant) > 0) || !std::isfinite(determinant)) c.fail(camera.pointer, "the camera's transform must be invertible");
  if (!camera.orthographic && !(camera.vfov > 0 && camera.vfov < 180)) c.fail(camera.pointer, "vfov must be between 0 and 180 degrees");
  if (camera.orthographic && !(camera.height > 0)) c.fail(camera.pointer, "height must be positive");
  if (camera.width <= 0 || camera.height_pixels <= 0) c.fail(camera.pointer, "the resolution must be positive");
  if (!(camera.aperture >= 0)) c.fail(camera.pointer, "the aperture must not be negative");
  if (camera.aperture > 0 && !(camera.fdist > 0)) c.fail(camera.pointer, "fdist must be positive");
  const Vec3d x = camera.transform.column(0), y = camera.transform.column(1), z = camera.transform.column(2);
  const double aspect = double(camera.width) / camera.height_pixels;
  const double film = camera.orthographic ? camera.height * std::max(aspect * length(x), length(y)) : 0;
  const double lens = camera.aperture > 0 ? camera.aperture * length(x) + camera.fdist * length(z) : 0;
  if (!(length(camera.transform.translation()) + film + lens <= kFarthestCoordinate)) c.fail(camera.pointer, "the camera, its film or its focus lies farther than 1e15 from the origin, beyond what single precision can be trusted with");
}

// The side of the first surface along the view tells the medium; nothing in view is vacuum.
std::uint32_t medium_in_front(const CompiledScene& scene, Vec3d position, Vec3d direction) {
  const std::optional<FirstHit> hit = first_hit(scene, position, direction);
  if (!hit) return 0;
  const layout::Surface& surface = scene.surfaces[hit->surface];
  return dot(hit->normal, direction) < 0 ? surface.medium_outside : surface.medium_inside;
}

// Everything but the medium.
layout::Camera layout_camera(const CameraDescription& camera) {
  layout::Camera out{};
  const Vec3d x = camera.transform.column(0), y = camera.transform.column(1), z = camera.transform.column(2);
  const double half_height = camera.orthographic ? camera.height / 2 : std::tan(camera.vfov * std::numbers::pi / 360);
  const double aspect = double(camera.width) / camera.height_pixels;
  // Axes are stored without their scale. Seen from the centre of projection only the ratio to the depth axis matters.
  const double depth = camera.orthographic ? 1 : length(z);
  out.position = to_float(camera.transform.translation());
  out.type = camera.orthographic ? layout::CAMERA_ORTHOGRAPHIC : layout::CAMERA_PERSPECTIVE;
  out.axis_x = to_float(normalize(x));
  out.axis_y = to_float(normalize(y));
  out.axis_z = to_float(normalize(z));
  out.half_width = float(half_height * aspect * length(x) / depth);
  out.half_height = float(half_height * length(y) / depth);
  out.lens_radius = float(camera.aperture * length(x));
  out.focal_distance = float(camera.fdist * length(z));
  out.width = std::uint32_t(camera.width);
  out.height = std::uint32_t(camera.height_pixels);
  return out;
}

std::uint32_t medium_before(const CompiledScene& scene, const layout::Camera& camera) {
  return medium_in_front(scene, to_double(camera.position), -1.0 * to_double(camera.axis_z));
}

}  // namespace

void compile_camera(Compilation& c) {
  const CameraDescription& camera = c.scene.camera;
  check_camera(c, camera);
  layout::Camera& out = c.out.header.camera;
  out = layout_camera(camera);
  out.medium = camera.medium ? compile_medium(c, camera.medium->get()) : medium_before(c.out, out);
  c.out.features.lens = camera.aperture > 0;
}

}  // namespace stokes::compiled

namespace stokes {

layout::Scene look_from(const CompiledScene& scene, const CameraDescription& camera) {
  layout::Scene header = scene.header;
  header.camera = compiled::layout_camera(camera);
  header.camera.medium = camera.medium ? scene.header.camera.medium : compiled::medium_before(scene, header.camera);
  header.depth_quantum = compiled::depth_quantum(header);
  return header;
}

}  // namespace stokes
