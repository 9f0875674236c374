// Drawing as SVG elements.
#include <cstdio>

#include "spectral/canvas.h"

namespace stokes {
namespace {

// Two decimals of a pixel, without trailing zeros.
std::string number(double v) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.2f", v);
  std::string s = buffer;
  while (s.back() == '0') s.pop_back();
  if (s.back() == '.') s.pop_back();
  return s == "-0" ? "0" : s;
}

std::string paint(const char* what, Ink ink) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, " %s=\"#%02x%02x%02x\"", what, ink.r, ink.g, ink.b);
  return ink.opacity < 1 ? std::string(buffer) + " " + what + "-opacity=\"" + number(ink.opacity) + "\"" : buffer;
}

std::string escaped(std::string_view text) {
  std::string s;
  for (const char c : text) {
    if (c == '&') s += "&amp;";
    else if (c == '<') s += "&lt;";
    else if (c == '>') s += "&gt;";
    else if (c == '"') s += "&quot;";
    else if (static_cast<unsigned char>(c) < 0x20) s += ' ';  // control characters are not allowed in XML
    else s += c;
  }
  return s;
}

}  // namespace

SvgCanvas::SvgCanvas(int width, int height) {
  const std::string w = std::to_string(width), h = std::to_string(height);
  svg_ = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + w + "\" height=\"" + h + "\" viewBox=\"0 0 " + w + " " + h +
         "\" font-family=\"Helvetica, Arial, sans-serif\">\n";
}

void SvgCanvas::rectangle(double x, double y, double width, double height, Ink ink) {
  svg_ += "<rect x=\"" + number(x) + "\" y=\"" + number(y) + "\" width=\"" + number(width) + "\" height=\"" + number(height) + "\"" +
          paint("fill", ink) + "/>\n";
}

void SvgCanvas::polyline(const std::vector<Point>& points, double width, Ink ink) {
  svg_ += "<polyline fill=\"none\" stroke-linejoin=\"round\" stroke-width=\"" + number(width) + "\"" + paint("stroke", ink) + " points=\"";
  for (const Point& p : points) svg_ += number(p.x) + "," + number(p.y) + " ";
  svg_ += "\"/>\n";
}

void SvgCanvas::text(double x, double y, std::string_view text, Anchor anchor, double size, Ink ink) {
  static constexpr const char* names[] = {"start", "middle", "end"};
  svg_ += "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" font-size=\"" + number(size) + "\" text-anchor=\"" + names[int(anchor)] +
          "\"" + paint("fill", ink) + ">" + escaped(text) + "</text>\n";
}

std::string SvgCanvas::finish() && {
  svg_ += "</svg>\n";
  return std::move(svg_);
}

}  // namespace stokes
