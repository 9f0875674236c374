// Shows a growing picture in the viewer tev. See tev.h. The packets follow tev's IPC as its client library `tevclient` 1.0.4 writes it.
#include "view/tev.h"

#include <netdb.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <stdexcept>

namespace stokes {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are sent as they lie in memory");

constexpr const char* kPort = "14158";
constexpr char kCloseImage = 2, kCreateImage = 4, kUpdateImage = 6;
constexpr int kTile = 128;  // pixels; packets of some 250 KB
constexpr int kTimeoutSeconds = 5;

/// A packet under construction; its length is filled in at the end.
class Packet {
 public:
  explicit Packet(char type) : bytes_(4, '\0') { bytes_ += type; }
  Packet& flag(bool value) {
    bytes_ += value ? '\1' : '\0';
    return *this;
  }
  Packet& text(const std::string& value) {
    bytes_.append(value.c_str(), value.size() + 1);
    return *this;
  }
  template <class Number>
  Packet& number(Number value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes_.append(raw, sizeof value);
    return *this;
  }
  Packet& floats(const std::vector<float>& values) {
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
    return *this;
  }
  std::string done() {
    const auto length = static_cast<std::uint32_t>(bytes_.size());
    std::memcpy(bytes_.data(), &length, sizeof length);
    return std::move(bytes_);
  }

 private:
  std::string bytes_;
};

int connect_to(const std::string& host, const std::string& port, std::string& why) {
  addrinfo hints = {}, *list = nullptr;
  hints.ai_socktype = SOCK_STREAM;
  if (const int code = getaddrinfo(host.c_str(), port.c_str(), &hints, &list)) {
    why = gai_strerror(code);
    return -1;
  }
  int connected = -1;
  for (const addrinfo* a = list; a && connected < 0; a = a->ai_next) {
    const int s = socket(a->ai_family, a->ai_socktype | SOCK_CLOEXEC, a->ai_protocol);
    if (s < 0) continue;
    // A viewer that hangs must not hold up the render for long. (On Linux this limits connect, too.)
    const timeval limit = {kTimeoutSeconds, 0};
    setsockopt(s, SOL_SOCKET, SO_SNDTIMEO, &limit, sizeof limit);
    if (connect(s, a->ai_addr, a->ai_addrlen) == 0)
      connected = s;
    else
      why = std::strerror(errno), close(s);
  }
  freeaddrinfo(list);
  return connected;
}

}  // namespace

namespace tev {

std::string create_image(const std::string& name, int width, int height, const std::vector<std::string>& channels, bool grab_focus) {
  Packet packet(kCreateImage);
  packet.flag(grab_focus).text(name).number<std::int32_t>(width).number<std::int32_t>(height);
  packet.number(static_cast<std::int32_t>(channels.size()));
  for (const std::string& channel : channels) packet.text(channel);
  return packet.done();
}

std::string update_image(const std::string& name, int x, int y, int width, int height, const std::vector<std::string>& channels,
                         const std::vector<float>& values, bool grab_focus) {
  const auto count = static_cast<std::int64_t>(channels.size());
  Packet packet(kUpdateImage);
  packet.flag(grab_focus).text(name).number(static_cast<std::int32_t>(count));
  for (const std::string& channel : channels) packet.text(channel);
  for (const int v : {x, y, width, height}) packet.number<std::int32_t>(v);
  for (std::int64_t i = 0; i < count; i++) packet.number(i);      // where a channel begins, in floats
  for (std::int64_t i = 0; i < count; i++) packet.number(count);  // and from pixel to pixel
  return packet.floats(values).done();
}

std::string close_image(const std::string& name) { return Packet(kCloseImage).text(name).done(); }

}  // namespace tev

DisplayServer::DisplayServer(const std::string& address, std::string image_name) : name_(std::move(image_name)) {
  const std::size_t colon = address.rfind(':');
  const std::string host = address.substr(0, colon), port = colon == std::string::npos ? kPort : address.substr(colon + 1);
  std::string why = "no address";
  socket_ = connect_to(host, port, why);
  if (socket_ < 0) throw std::runtime_error("no viewer answers at " + address + ": " + why);
}

DisplayServer::~DisplayServer() {
  if (socket_ >= 0) close(socket_);
}

bool DisplayServer::send(const std::string& bytes) {
  std::size_t sent = 0;
  while (socket_ >= 0 && sent < bytes.size()) {
    const ssize_t n = ::send(socket_, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
    if (n > 0) {
      sent += static_cast<std::size_t>(n);
    } else if (errno != EINTR) {
      close(socket_);
      socket_ = -1;
    }
  }
  return socket_ >= 0;
}

bool DisplayServer::show(const Film& film) {
  const std::vector<std::string> channels = {"R", "G", "B", "A"};
  if (film.width != width_ || film.height != height_) {
    if (!send(tev::create_image(name_, film.width, film.height, channels, width_ == 0))) return false;
    width_ = film.width;
    height_ = film.height;
  }
  for (int y0 = 0; y0 < film.height; y0 += kTile)
    for (int x0 = 0; x0 < film.width; x0 += kTile) {
      const int width = std::min(kTile, film.width - x0), height = std::min(kTile, film.height - y0);
      std::vector<float> values;
      for (int y = y0; y < y0 + height; y++)
        for (int x = x0; x < x0 + width; x++)
          for (int c = 0; c < 4; c++) values.push_back(static_cast<float>(film_mean(film, x, y, c)));
      if (!send(tev::update_image(name_, x0, y0, width, height, channels, values, false))) return false;
    }
  return true;
}

}  // namespace stokes
