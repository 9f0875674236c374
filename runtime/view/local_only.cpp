// Who may talk to a server that is meant for this machine's own browser. See local_only.h.
#include "view/local_only.h"

#include <algorithm>
#include <cctype>

namespace stokes {

bool is_local_host(const std::string& host) {
  for (const std::string name : {"localhost", "127.0.0.1", "[::1]"}) {
    if (host.compare(0, name.size(), name) != 0) continue;
    const std::string rest = host.substr(name.size());
    if (rest.empty()) return true;
    const bool port = rest[0] == ':' && rest.size() > 1 && rest.size() <= 6 &&
                      std::all_of(rest.begin() + 1, rest.end(), [](unsigned char c) { return std::isdigit(c); });
    if (port) return true;
  }
  return false;
}

bool is_same_origin(const std::string& origin, const std::string& host) { return origin.empty() || origin == "http://" + host; }

}  // namespace stokes
