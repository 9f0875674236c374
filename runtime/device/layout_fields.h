// Every member of every struct in kernels/layout.h, once: S(struct, F(member) ...). The layout check makes both the host's table
// and the device's probe kernel from it. That none is missing is checked too: members' sizes must add up to their struct's.
#pragma once

// clang-format off
#define STOKES_LAYOUT_STRUCTS(S)                                                                                              \
  S(Vec3, F(x) F(y) F(z))                                                                                                     \
  S(Quad, F(normal) F(offset) F(dual_u) F(u0) F(dual_v) F(v0) F(corner) F(area) F(edge_u) F(surface) F(edge_v) F(light)       \
           F(reach_u) F(growth_u) F(reach_v) F(growth_v))                                                                     \
  S(Sphere, F(center) F(radius) F(to_local) F(surface) F(light) F(flip))                                                      \
  S(Ellipsoid, F(to_local) F(to_world) F(surface) F(light) F(flip) F(area))                                                   \
  S(Triangle, F(v0) F(v1) F(v2) F(surface) F(light) F(area) F(mesh) F(padding))                                               \
  S(Surface, F(material) F(medium_outside) F(medium_inside) F(emission) F(flags) F(padding))                                  \
  S(Camera, F(position) F(type) F(axis_x) F(half_width) F(axis_y) F(half_height) F(axis_z) F(lens_radius) F(focal_distance)   \
            F(width) F(height) F(medium))                                                                                     \
  S(Material, F(type) F(albedo) F(eta) F(k) F(parameter) F(child_a) F(child_b) F(amount_texture) F(amount) F(first_dye)       \
              F(dye_count) F(flags))                                                                                          \
  S(Texture, F(type) F(a) F(b) F(scale) F(parameter) F(image_offset) F(image_width) F(image_height) F(first_shape)            \
             F(shape_count) F(flags) F(uv_wrap) F(to_texture))                                                                \
  S(Region, F(a) F(radius) F(b) F(shape))                                                                                     \
  S(Medium, F(sigma_t) F(sigma_s) F(g) F(flags) F(first_dye) F(dye_count) F(mean_free_path) F(padding))                       \
  S(Dye, F(absorption) F(emission) F(excitation) F(yield) F(strength) F(flags) F(curves) F(padding))                                   \
  S(Distribution, F(spectrum) F(cdf) F(integral) F(strength))                                                                 \
  S(Reradiation, F(offset) F(columns) F(rows) F(li_min) F(li_step) F(lo_min) F(lo_step) F(first_excitation))                  \
  S(Light, F(type) F(primitive) F(emission) F(probability) F(alias_threshold) F(alias) F(area) F(padding))                    \
  S(Environment, F(image_offset) F(width) F(height) F(scale) F(to_local) F(illuminant) F(padding))                            \
  S(Room, F(low) F(high) F(faces))                                                                                            \
  S(Scene, F(camera) F(integrator) F(max_bounces) F(russian_roulette) F(quad_count) F(sphere_count) F(ellipsoid_count)        \
           F(triangle_count) F(light_count) F(background_light) F(background) F(has_environment) F(scene_radius)              \
           F(scene_center) F(film_quantum) F(depth_quantum) F(spectral_bins) F(spectral_begin) F(spectral_end)                \
           F(film_channels) F(film_stride) F(box_low) F(box_high) F(room_quads) F(room_count) F(rooms))                           \
  S(Launch, F(seed) F(pixel_begin) F(pixel_end) F(sample_begin) F(sample_end) F(chunk) F(crop_x) F(crop_y) F(crop_width)      \
            F(crop_height) F(padding))
// clang-format on
