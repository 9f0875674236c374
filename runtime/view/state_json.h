// What a page is told, as JSON. The names here are the page's; viewer.js reads them.
#pragma once
#include <string>

#include "view/session.h"

namespace stokes {

std::string to_json(const SessionState& state);
std::string to_json(const Probe& probe);

}  // namespace stokes
