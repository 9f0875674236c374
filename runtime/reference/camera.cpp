// Perspective (thin lens) and orthographic cameras. See camera.h.
#include "reference/camera.h"

#include "reference/sampling.h"

namespace stokes::reference {

Ray camera_ray(const layout::Camera& camera, double px, double py, double lens_u, double lens_v) {
  const Vec3d x = vec(camera.axis_x), y = vec(camera.axis_y), z = vec(camera.axis_z), position = vec(camera.position);
  const double film_x = 2 * px / camera.width - 1, film_y = 1 - 2 * py / camera.height;
  const Vec3d on_film = film_x * camera.half_width * x + film_y * camera.half_height * y;
  if (camera.type == layout::CAMERA_ORTHOGRAPHIC) return {position + on_film, normalize(-z)};

  // The focal plane stands perpendicular to the axis, so the ray's point on it does not depend on the lens.
  if (camera.lens_radius <= 0) return {position, normalize(on_film - z)};
  const Vec3d focus = position + (on_film - z) * camera.focal_distance;
  const Vec3d lens = camera.lens_radius * sample_disk(lens_u, lens_v);
  const Vec3d origin = position + lens.x * x + lens.y * y;
  return {origin, normalize(focus - origin)};
}

}  // namespace stokes::reference
