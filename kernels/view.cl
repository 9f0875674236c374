// The scene as a kernel sees it: one private struct of pointers that every function takes. Knows the buffers, not what they mean.
#ifndef STOKES_VIEW_CL
#define STOKES_VIEW_CL
#include "layout.h"

typedef struct {
  const __global Scene* scene;
  const __global float* bvh_nodes;
  const __global float* bvh_leaves;
  const __global Quad* quads;
  const __global Sphere* spheres;
  const __global Ellipsoid* ellipsoids;
  const __global Triangle* triangles;
  const __global Vec3* positions;
  const __global Vec3* normals;
  const __global float* uvs;
  const __global Surface* surfaces;
  const __global Material* materials;
  const __global Texture* textures;
  const __global Region* regions;
  const __global float* texels;
  const __global float* spectra;
  const __global Medium* media;
  const __global Dye* dyes;
  const __global Distribution* distributions;
  const __global float* cdfs;
  const __global Reradiation* reradiations;
  const __global float* reradiation_values;
  const __global Light* lights;
  const __global Environment* environment;
  const __global float* environment_cdf;
  const __global float* camera_knots;
  const __global float* sensor;
} SceneView;
#endif
