// Primary rays. Knows the camera of layout.h, nothing of films or scenes.
#ifndef STOKES_CAMERA_CL
#define STOKES_CAMERA_CL
#include "sampling.cl"
#include "view.cl"

STOKES_FN Real3 vec3_lanes(Vec3 a) { return real3(real(a.x), real(a.y), real(a.z)); }

/// The ray through the point (px, py) of the full image, in pixels from its top left corner. lens_u and lens_v are uniform in
/// (0, 1) and only read where SCENE_HAS_LENS. d is a unit vector.
STOKES_FN void camera_ray(const SceneView* view, Real px, Real py, Real lens_u, Real lens_v, Real3* o, Real3* d) {
  const __global Camera* camera = &view->scene->camera;
  const Real3 axis_x = vec3_lanes(camera->axis_x), axis_y = vec3_lanes(camera->axis_y), axis_z = vec3_lanes(camera->axis_z);
  const Real x = fma(px, real(2.0f / (float)camera->width), real(-1.0f)) * camera->half_width;
  const Real y = fma(py, real(-2.0f / (float)camera->height), real(1.0f)) * camera->half_height;
  const Real3 across = madd3(scale3(axis_x, x), axis_y, y);
  *o = vec3_lanes(camera->position);
  if (camera->type == CAMERA_ORTHOGRAPHIC) {
    *o = add3(*o, across);
    *d = neg3(axis_z);
    return;
  }
  Real3 direction = sub3(across, axis_z);
  if (SCENE_HAS_LENS) {
    // The ray from a point of the lens to the point in focus.
    Real lens_x, lens_y;
    sample_disk(lens_u, lens_v, &lens_x, &lens_y);
    const Real3 shift = madd3(scale3(axis_x, lens_x * camera->lens_radius), axis_y, lens_y * camera->lens_radius);
    direction = sub3(scale3(direction, real(camera->focal_distance)), shift);
    *o = add3(*o, shift);
  }
  *d = normalize3(direction);
}
#endif
