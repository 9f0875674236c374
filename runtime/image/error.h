// The exception of outputs that could not be written, and of image files that could not be read.
#pragma once
#include <stdexcept>
#include <string>

namespace stokes {

/// An output could not be written; what stood there before is intact. what() names the file and the cause.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A file given as input (image, part, checkpoint) is missing, damaged or not of the kind that is needed.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace stokes
