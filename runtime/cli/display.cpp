// A tev viewer that watches a render. See display.h.
#include "cli/display.h"

#include <cstdio>
#include <memory>

#include "image/error.h"
#include "view/tev.h"

namespace stokes {

DisplayFeed open_display(const std::string& address, const std::string& image_name) {
  if (address.empty()) return {};
  std::shared_ptr<DisplayServer> server;
  try {
    server = std::make_shared<DisplayServer>(address, image_name);
  } catch (const std::runtime_error& error) {
    throw OutputError(std::string("--display-server: ") + error.what());
  }
  return [server, lost = false](const Film& film) mutable {
    if (lost || server->show(film)) return;
    lost = true;
    std::fprintf(stderr, "warning: the display server has gone away; rendering goes on without it\n");
  };
}

}  // namespace stokes
