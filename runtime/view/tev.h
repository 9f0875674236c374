// Shows a growing picture in the viewer tev (https://github.com/Tom94/tev) by its protocol of packets over TCP. Knows films and sockets.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "image/film.h"

namespace stokes {

/// Packets: 32 bits of length (itself included), a byte of type, then fields; numbers little-endian, strings ended by a zero byte.
namespace tev {
/// Makes, or replaces, an image without pixels.
std::string create_image(const std::string& name, int width, int height, const std::vector<std::string>& channels, bool grab_focus);
/// Sets a rectangle of pixels; `values` holds height * width * channels floats, interleaved, row 0 at the top.
std::string update_image(const std::string& name, int x, int y, int width, int height, const std::vector<std::string>& channels,
                         const std::vector<float>& values, bool grab_focus);
std::string close_image(const std::string& name);
}  // namespace tev

/// A connection to a tev that is running.
class DisplayServer {
 public:
  /// `address` is host:port, or a host alone (port 14158). Throws std::runtime_error with the reason when it cannot be reached.
  DisplayServer(const std::string& address, std::string image_name);
  ~DisplayServer();
  DisplayServer(const DisplayServer&) = delete;
  DisplayServer& operator=(const DisplayServer&) = delete;
  /// Sends R, G, B, A of the film. False once the connection is lost; then it stays lost.
  bool show(const Film& film);

 private:
  bool send(const std::string& bytes);
  int socket_ = -1;
  std::string name_;
  int width_ = 0, height_ = 0;
};

}  // namespace stokes
