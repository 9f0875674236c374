// A tev viewer that watches a render: from an option's text to a function that shows films. Knows no packets.
#pragma once
#include <functional>
#include <string>

#include "image/film.h"

namespace stokes {

/// Shows a film. Says once on stderr when the viewer has gone away, and then does nothing.
using DisplayFeed = std::function<void(const Film&)>;

/// Connects to the viewer at `address` (host:port); an empty one gives an empty function. Throws OutputError when nobody answers.
DisplayFeed open_display(const std::string& address, const std::string& image_name);

}  // namespace stokes
