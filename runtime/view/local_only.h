// Who may talk to a server that is meant for this machine's own browser. Pure functions of two headers.
#pragma once
#include <string>

namespace stokes {

/// Whether a Host header names this machine itself: localhost, 127.0.0.1 or [::1], with any port (a tunnel may change it). A page of
/// another site whose name was made to point here (DNS rebinding) sends that name.
bool is_local_host(const std::string& host);

/// Whether a request with this Origin header (empty: none was sent) comes from the page of `host` and not from another site's.
bool is_same_origin(const std::string& origin, const std::string& host);

}  // namespace stokes
