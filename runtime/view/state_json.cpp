// What a page is told, as JSON. See state_json.h.
#include "view/state_json.h"

#include <charconv>
#include <fstream>
#include <nlohmann/json.hpp>

namespace stokes {
namespace {

using Json = nlohmann::ordered_json;

const char* phase_name(SessionPhase phase) {
  switch (phase) {
    case SessionPhase::Preparing: return "preparing";
    case SessionPhase::Preview: return "preview";
    case SessionPhase::Rendering: return "rendering";
    case SessionPhase::Stopped: return "stopped";
    case SessionPhase::Done: return "done";
    case SessionPhase::Failed: return "failed";
  }
  return "";
}

/// `file:line:column: error: text` taken apart, with the file's line where it can be read.
Json describe_error(const std::string& message) {
  Json j;
  j["message"] = message;
  const std::size_t mark = message.find(": error: ");
  const std::size_t column_at = mark == std::string::npos ? mark : message.rfind(':', mark - 1);
  const std::size_t line_at = column_at == std::string::npos || column_at == 0 ? std::string::npos : message.rfind(':', column_at - 1);
  if (line_at == std::string::npos) return j;
  int line = 0, column = 0;
  const char* text = message.data();
  if (std::from_chars(text + line_at + 1, text + column_at, line).ptr != text + column_at) return j;
  if (std::from_chars(text + column_at + 1, text + mark, column).ptr != text + mark) return j;
  j["file"] = message.substr(0, line_at);
  j["line"] = line;
  j["column"] = column;
  j["text"] = message.substr(mark + 9);
  std::ifstream file(message.substr(0, line_at));
  std::string source;
  for (int i = 0; i < line && std::getline(file, source); i++) {}
  if (file && source.size() < 400) j["source"] = source;
  return j;
}

Json triple(Vec3d v) { return {v.x, v.y, v.z}; }

/// A transform as a scene file may hold it.
Json describe_camera(const SessionState& state) {
  const Affine& t = state.camera.transform;
  Json j;
  j["transform"] = {{"o", triple(t.translation())}, {"x", triple(t.column(0))}, {"y", triple(t.column(1))}, {"z", triple(t.column(2))}};
  if (state.camera.orthographic) j["height"] = state.camera.height;
  if (state.camera.aperture > 0) j["fdist"] = state.camera.fdist;
  return j;
}

}  // namespace

std::string to_json(const SessionState& s) {
  Json j;
  j["version"] = s.version;
  j["frame"] = s.frame;
  j["phase"] = phase_name(s.phase);
  j["samples"] = s.samples;
  j["samples_total"] = s.samples_total;
  j["progress"] = s.progress;
  j["samples_per_second"] = s.samples_per_second;
  j["seconds_left"] = s.seconds_left;
  j["build_seconds"] = s.build_seconds;
  j["size"] = {s.width, s.height};
  j["frame_size"] = {s.frame_width, s.frame_height};
  j["device"] = s.device;
  j["layers"] = s.layers;
  j["warnings"] = s.warnings;
  j["spectral"] = s.spectral;
  j["fluorescent"] = s.fluorescent;
  j["moved"] = s.moved;
  j["camera"] = describe_camera(s);
  j["error"] = s.error.empty() ? Json() : describe_error(s.error);
  return j.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string to_json(const Probe& p) {
  Json j;
  j["rgb"] = p.rgb;
  j["error"] = p.error;
  j["alpha"] = p.alpha;
  j["samples"] = p.samples;
  j["begin"] = p.begin;
  j["end"] = p.end;
  j["spectrum"] = p.spectrum;
  j["fluorescent"] = p.fluorescent;
  j["energy"] = p.energy;
  j["fluorescent_energy"] = p.fluorescent_energy;
  return j.dump();
}

}  // namespace stokes
