// The kernel: each work-item renders its run of pixels of one launch. Knows the buffers and which integrator was built.
#include "preview.cl"
#include "volpath.cl"

/// `film` holds film_stride words for each pixel of the window, `counters` COUNTER_COUNT for each work-item; both are added to.
__kernel void render(const __global Scene* scene, const __global float* bvh_nodes, const __global float* bvh_leaves,
                     const __global Quad* quads, const __global Sphere* spheres, const __global Ellipsoid* ellipsoids,
                     const __global Triangle* triangles, const __global Vec3* positions, const __global Vec3* normals,
                     const __global float* uvs, const __global Surface* surfaces, const __global Material* materials,
                     const __global Texture* textures, const __global Region* regions, const __global float* texels,
                     const __global float* spectra, const __global Medium* media, const __global Dye* dyes,
                     const __global Distribution* distributions, const __global float* cdfs, const __global Reradiation* reradiations,
                     const __global float* reradiation_values, const __global Light* lights, const __global Environment* environment,
                     const __global float* environment_cdf, const __global float* camera_knots, const __global float* sensor,
                     const __global Launch* launch, __global long* film, __global ulong* counters) {
  const SceneView view = {scene,     bvh_nodes,     bvh_leaves, quads,        spheres,            ellipsoids, triangles,   positions, normals,
                          uvs,       surfaces,      materials,  textures,     regions,            texels,     spectra,     media,     dyes,
                          distributions, cdfs, reradiations, reradiation_values, lights, environment, environment_cdf, camera_knots, sensor};
  const uint item = (uint)get_global_id(0);
  PathQueue queue = queue_make(launch, item);
  Counters counted = {{0, 0, 0, 0}};
  if (FILM_TAKES_RGB)
    trace_previews(&view, launch, &queue, film, &counted);
  else
    trace_paths(&view, launch, &queue, film, &counted);
  for (int i = 0; i < COUNTER_COUNT; i++) counters[item * COUNTER_COUNT + (uint)i] += counted.count[i];
}
