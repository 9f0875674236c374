// Triangle meshes from OBJ files and generators. Knows nothing of materials beyond their names.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "scene/read_context.h"

namespace stokes {

/// A mesh before it is divided by material: positions are shared, corners name position, normal and uv separately.
struct RawMesh {
  struct Corner {
    int position = -1, normal = -1, uv = -1;  // -1: there is none
  };
  struct Face {
    Corner corners[3];
    int material = 0;  // index into materials
  };
  std::vector<Vec3d> positions, normals;
  std::vector<std::array<double, 2>> uvs;
  std::vector<Face> faces;
  std::vector<std::string> materials = {""};                      // by `usemtl`; "" for faces before the first one
  std::vector<std::pair<std::string, std::vector<float>>> masks;  // per position
};

/// Reads an OBJ file; polygons become fans. Every number and index is checked, and the limits before memory is spent. Libraries of materials
/// and whatever else the file names are not looked at. Throws SceneError at `node`.
RawMesh read_obj(const ReadContext& context, const JsonNode& node, const std::string& path);

RawMesh raw_mesh_of(const MeshData& mesh);

/// Drops faces without area; returns how many.
std::size_t drop_degenerate_faces(RawMesh& mesh);

/// Moves every position by `distance` (measured after `to_world`) along its normal: the average of the file's normals there, or of
/// the adjacent faces. Returns how many faces turned over.
std::size_t offset_positions(RawMesh& mesh, double distance, const Affine& to_world);

/// The surface at signed `distance` (measured after `to_world`) from a closed mesh, with the masks and uvs of the nearest points. Throws
/// std::runtime_error when the mesh is not closed or nothing is left. `faulty` counts the places that are not as offset.h promises.
RawMesh offset_surface(const RawMesh& mesh, double distance, const Affine& to_world, std::size_t* faulty = nullptr);

/// The faces of each material, with vertices of their own.
std::vector<MeshData> extract_materials(const RawMesh& mesh);

}  // namespace stokes
