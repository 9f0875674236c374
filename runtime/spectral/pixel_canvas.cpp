// Drawing as anti-aliased pixels, with text in the built-in font.
#include <algorithm>
#include <cmath>

#include "spectral/canvas.h"

namespace stokes {
namespace {

double distance_to_segment(Point p, Point a, Point b) {
  const double dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
  const double t = square > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / square, 0.0, 1.0) : 0;
  return std::hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

}  // namespace

PixelCanvas::PixelCanvas(int width, int height) : pixels_{width, height, std::vector<std::uint8_t>(std::size_t(3) * width * height, 255)} {}

void PixelCanvas::blend(int x, int y, double coverage, Ink ink) {
  if (x < 0 || y < 0 || x >= pixels_.width || y >= pixels_.height || coverage <= 0) return;
  std::uint8_t* pixel = &pixels_.rgb[3 * (std::size_t(y) * pixels_.width + x)];
  const double amount = std::min(coverage, 1.0) * ink.opacity;
  const std::uint8_t colour[3] = {ink.r, ink.g, ink.b};
  for (int c = 0; c < 3; c++) pixel[c] = std::uint8_t(std::lround(pixel[c] + amount * (colour[c] - pixel[c])));
}

void PixelCanvas::rectangle(double x, double y, double width, double height, Ink ink) {
  const auto overlap = [](double begin, double end, int pixel) { return std::min(end, pixel + 1.0) - std::max(begin, double(pixel)); };
  for (int row = std::max(0, int(std::floor(y))); row < std::min(double(pixels_.height), y + height); row++)
    for (int column = std::max(0, int(std::floor(x))); column < std::min(double(pixels_.width), x + width); column++)
      blend(column, row, std::max(0.0, overlap(x, x + width, column)) * std::max(0.0, overlap(y, y + height, row)), ink);
}

void PixelCanvas::polyline(const std::vector<Point>& points, double width, Ink ink) {
  // Coverage is collected first, so that joints are not painted twice.
  std::vector<float> coverage(std::size_t(pixels_.width) * pixels_.height, 0.0f);
  const double reach = width / 2 + 1;
  for (std::size_t i = 1; i < points.size(); i++) {
    const Point a = points[i - 1], b = points[i];
    const int x0 = std::max(0, int(std::min(a.x, b.x) - reach)), x1 = std::min(pixels_.width - 1, int(std::max(a.x, b.x) + reach));
    const int y0 = std::max(0, int(std::min(a.y, b.y) - reach)), y1 = std::min(pixels_.height - 1, int(std::max(a.y, b.y) + reach));
    for (int y = y0; y <= y1; y++)
      for (int x = x0; x <= x1; x++) {
        float& c = coverage[std::size_t(y) * pixels_.width + x];
        c = std::max(c, float(width / 2 + 0.5 - distance_to_segment({x + 0.5, y + 0.5}, a, b)));
      }
  }
  for (int y = 0; y < pixels_.height; y++)
    for (int x = 0; x < pixels_.width; x++) blend(x, y, std::min(width, double(coverage[std::size_t(y) * pixels_.width + x])), ink);
}

void PixelCanvas::text(double x, double y, std::string_view text, Anchor anchor, double size, Ink ink) {
  const int scale = std::max(1, int(std::lround(size / 8)));
  // Bytes of a multi-byte UTF-8 character after its first draw nothing.
  std::string shown;
  for (const char c : text)
    if ((static_cast<unsigned char>(c) & 0xc0) != 0x80) shown += c;
  const int length = int(shown.size()) * 6 * scale - scale;
  int left = int(std::lround(x)) - (anchor == Anchor::Start ? 0 : anchor == Anchor::Middle ? length / 2 : length);
  const int top = int(std::lround(y)) - 7 * scale;
  for (const char c : shown) {
    const char* rows = glyph(c);
    for (int row = 0; row < 7 * scale; row++)
      for (int column = 0; column < 5 * scale; column++)
        if (rows[row / scale * 6 + column / scale] == '#') blend(left + column, top + row, 1, ink);
    left += 6 * scale;
  }
}

}  // namespace stokes
