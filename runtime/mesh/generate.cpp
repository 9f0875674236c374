// Names and parameters of the procedural meshes.
#include "mesh/generate.h"

#include <stdexcept>

#include "mesh/hand.h"
#include "mesh/head.h"
#include "mesh/in_parallel.h"

namespace stokes {
namespace {

MeshData cut(const Field& field, Vec3d lo, Vec3d hi, double resolution) {
  const Vec3d margin = Vec3d{1, 1, 1} * (2 * resolution);
  return isosurface(sample_field(field, lo - margin, hi + margin, resolution), 0, &field);
}

[[noreturn]] void unknown_parameter(const std::string& mesh, const std::string& name) {
  throw std::invalid_argument("the " + mesh + " has no parameter \"" + name + "\"");
}

HeadShape head_shape(const GeneratorOptions& options) {
  HeadShape shape;
  if (!options.pose.empty()) throw std::invalid_argument("the head has no poses; use the parameter \"pitch\"");
  for (const auto& [name, value] : options.parameters) {
    if (name == "pitch" && std::abs(value) <= 30) shape.pitch = value;
    else if (name == "cut" && value >= -240 && value <= -125) shape.cut_y = value;
    else if (name == "asymmetry" && std::abs(value) <= 3) shape.asymmetry = value;
    else if (name == "pitch" || name == "cut" || name == "asymmetry") throw std::invalid_argument("the head's parameter \"" + name + "\" is out of range");
    else unknown_parameter("head", name);
  }
  return shape;
}

MeshData generate_head(const GeneratorOptions& options) {
  const HeadShape shape = head_shape(options);
  Vec3d lo, hi;
  head_bounds(shape, lo, hi);
  MeshData mesh = cut(head_field(shape), lo, hi, options.resolution);
  for (const auto& [name, mask] : head_masks(shape)) {
    std::vector<float> values(mesh.positions.size());
    in_parallel(values.size(), [&, &mask = mask](std::size_t i) { values[i] = static_cast<float>(mask(mesh.positions[i])); });
    mesh.masks.emplace_back(name, std::move(values));
  }
  return mesh;
}

double* hand_parameter(HandPose& pose, const std::string& name) {
  if (name == "arch") return &pose.arch;
  const std::size_t dot = name.find('.');
  if (dot == std::string::npos) return nullptr;
  const std::string digit = name.substr(0, dot), joint = name.substr(dot + 1);
  if (digit == "thumb") {
    if (joint == "radial") return &pose.thumb.radial;
    if (joint == "palmar") return &pose.thumb.palmar;
    if (joint == "pronation") return &pose.thumb.pronation;
    if (joint == "mcp") return &pose.thumb.mcp;
    return joint == "ip" ? &pose.thumb.ip : nullptr;
  }
  HandPose::Finger* f = digit == "index" ? &pose.index : digit == "middle" ? &pose.middle : digit == "ring" ? &pose.ring : digit == "little" ? &pose.little : nullptr;
  if (!f) return nullptr;
  if (joint == "mcp") return &f->mcp;
  if (joint == "pip") return &f->pip;
  if (joint == "dip") return &f->dip;
  if (joint == "spread") return &f->spread;
  return joint == "roll" ? &f->roll : nullptr;
}

HandPose hand_pose(const GeneratorOptions& options) {
  const std::string name = options.pose.empty() ? "open" : options.pose;
  const HandPose* known = find_hand_pose(name);
  if (!known) throw std::invalid_argument("the hand has no pose \"" + name + "\"; it has open, relaxed, cupping and pointing");
  HandPose pose = *known;
  for (const auto& [parameter, value] : options.parameters) {
    double* target = hand_parameter(pose, parameter);
    if (!target) unknown_parameter("hand", parameter);
    if (!(std::abs(value) <= 120)) throw std::invalid_argument("the hand's parameter \"" + parameter + "\" is out of range");
    *target = value;
  }
  return pose;
}

MeshData generate_hand(const GeneratorOptions& options) {
  const HandPose pose = hand_pose(options);
  Vec3d lo, hi;
  hand_bounds(pose, lo, hi);
  return cut(hand_field(pose), lo, hi, options.resolution);
}

void check_resolution(double resolution) {
  if (!(resolution >= 0.3 && resolution <= 10)) throw std::invalid_argument("the resolution must lie in [0.3, 10] mm");
}

[[noreturn]] void unknown_generator(const std::string& name) {
  throw std::invalid_argument("there is no generator \"" + name + "\"; there are head and hand");
}

}  // namespace

GeneratorPlan plan_mesh(const std::string& name, const GeneratorOptions& options) {
  check_resolution(options.resolution);
  GeneratorPlan plan;
  if (name == "head") {
    const HeadShape shape = head_shape(options);
    head_bounds(shape, plan.lo, plan.hi);
    for (const auto& mask : head_masks(shape)) plan.masks.push_back(mask.first);
  } else if (name == "hand") {
    hand_bounds(hand_pose(options), plan.lo, plan.hi);
  } else {
    unknown_generator(name);
  }
  // The grid in floats, and the mesh that is cut from it: about as many triangles as twice the box's sides have cells.
  const Vec3d cells = (plan.hi - plan.lo) / options.resolution;
  const double grid = (cells.x + 4) * (cells.y + 4) * (cells.z + 4) * sizeof(float);
  const double faces = 4 * (cells.x * cells.y + cells.y * cells.z + cells.z * cells.x);
  plan.bytes = static_cast<std::uint64_t>(grid + 300 * faces);
  return plan;
}

MeshData generate_mesh(const std::string& name, const GeneratorOptions& options) {
  check_resolution(options.resolution);
  if (name == "head") return generate_head(options);
  if (name == "hand") return generate_hand(options);
  unknown_generator(name);
}

}  // namespace stokes
