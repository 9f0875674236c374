// What a plot is drawn on: rectangles, lines and text in pixels, y downwards. Internal to plots.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "spectral/plot.h"

namespace stokes {

struct Ink {
  std::uint8_t r = 0, g = 0, b = 0;
  double opacity = 1;
};

struct Point {
  double x, y;
};

enum class Anchor { Start, Middle, End };

class Canvas {
 public:
  virtual ~Canvas() = default;
  virtual void rectangle(double x, double y, double width, double height, Ink ink) = 0;
  virtual void polyline(const std::vector<Point>& points, double width, Ink ink) = 0;
  /// `y` is the base line; `size` is the height of a line of text in pixels.
  virtual void text(double x, double y, std::string_view text, Anchor anchor, double size, Ink ink) = 0;
};

class SvgCanvas : public Canvas {
 public:
  SvgCanvas(int width, int height);
  void rectangle(double x, double y, double width, double height, Ink ink) override;
  void polyline(const std::vector<Point>& points, double width, Ink ink) override;
  void text(double x, double y, std::string_view text, Anchor anchor, double size, Ink ink) override;
  /// Closes the document.
  std::string finish() &&;

 private:
  std::string svg_;
};

class PixelCanvas : public Canvas {
 public:
  PixelCanvas(int width, int height);
  void rectangle(double x, double y, double width, double height, Ink ink) override;
  void polyline(const std::vector<Point>& points, double width, Ink ink) override;
  void text(double x, double y, std::string_view text, Anchor anchor, double size, Ink ink) override;
  Pixels finish() && { return std::move(pixels_); }

 private:
  void blend(int x, int y, double coverage, Ink ink);
  Pixels pixels_;
};

/// Rows of a 5 x 7 glyph for a printable ASCII character, '#' set and '.' clear, seven rows with a space between; others get a box.
const char* glyph(char c);

}  // namespace stokes
