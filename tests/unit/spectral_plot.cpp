// Plots: the SVG is well formed and holds what it was given, the pixels show the curve where it is, and the strip is a spectrum.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "spectral/canvas.h"
#include "spectral/plot.h"

namespace stokes {
namespace {

Plot example() {
  Spectrum box;
  box.kind = SpectrumKind::Box;
  box.value = 2, box.a = 400, box.b = 500;
  Plot plot{"A <box> & more", "1/nm", {{"the \"box\"", tabulate(box, SpectrumRole::Emission), {}}, {"zero", {}, {}}}};
  for (int i = 0; i < 1000; i++) plot.curves[0].samples.push_back(float(400.05 + i / 10.0));
  return plot;
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) n++;
  return n;
}

bool is(const Pixels& p, int x, int y, int r, int g, int b) {
  const std::uint8_t* c = &p.rgb[3 * (std::size_t(y) * p.width + x)];
  return c[0] == r && c[1] == g && c[2] == b;
}

TEST(Plot, SvgHoldsEveryCurveAndEscapesNames) {
  const std::string svg = plot_svg(example());
  EXPECT_EQ(count(svg, "<polyline"), 2u);
  EXPECT_NE(svg.find("A &lt;box&gt; &amp; more"), std::string::npos);
  EXPECT_NE(svg.find("the &quot;box&quot;"), std::string::npos);
  EXPECT_EQ(svg.find("<box>"), std::string::npos);
  EXPECT_EQ(count(svg, "fill-opacity=\"0.25\""), 20u);  // the histogram: twenty bins of 5 nm hold samples
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_TRUE(svg.ends_with("</svg>\n"));
}

TEST(Plot, PixelsShowTheCurveAtItsHeight) {
  const Pixels p = plot_pixels(example(), 800, 400);
  ASSERT_EQ(p.rgb.size(), 800u * 400 * 3);
  // At 450 nm: the area spans 76 to 776 across, and the box's top is at 1 / 1.04 of its height of 64 to 326.
  const int x = 76 + 700 * 170 / 500, top = int(326 - 262 / 1.04);
  bool found = false;
  for (int y = top - 2; y <= top + 2; y++) found |= is(p, x, y, 0, 114, 178);
  EXPECT_TRUE(found);
  for (int y = 70; y < top - 4; y++) EXPECT_FALSE(is(p, x, y, 0, 114, 178)) << y;
  // The histogram of even samples fills the box up to its top, as it is on the curve's scale.
  EXPECT_FALSE(is(p, x + 2, top + 6, 255, 255, 255));
}

TEST(Plot, NothingToShowIsStillAPlot) {
  EXPECT_NE(plot_svg({}).find("</svg>"), std::string::npos);
  Plot flat{"", "", {{"", {}, {500}}}};
  EXPECT_EQ(plot_svg(flat).find("nan"), std::string::npos);
  EXPECT_EQ(plot_pixels(flat, 300, 200).rgb.size(), 300u * 200 * 3);
}

TEST(Plot, StripIsBlackOutsideTheVisible) {
  const Pixels s = wavelength_strip(500, 3);
  ASSERT_EQ(s.rgb.size(), 4500u);
  for (int x = 0; x < 100; x++) EXPECT_TRUE(is(s, x, 1, 0, 0, 0)) << x;
  const auto at = [&](int lambda) { return &s.rgb[3 * (500 + lambda - 280)]; };
  EXPECT_GT(at(450)[2], std::max(at(450)[0], at(450)[1]));
  EXPECT_GT(at(530)[1], std::max(at(530)[0], at(530)[2]));
  EXPECT_GT(at(640)[0], std::max(at(640)[1], at(640)[2]));
  EXPECT_LT(at(779)[0], 40);
}

TEST(Plot, GlyphsAreSevenRowsOfFive) {
  for (char c = ' '; c <= '~'; c++) {
    const std::string rows = glyph(c);
    ASSERT_EQ(rows.size(), 41u) << c;
    for (std::size_t i = 0; i < 41; i++) ASSERT_TRUE(i % 6 == 5 ? rows[i] == ' ' : rows[i] == '#' || rows[i] == '.') << c;
  }
  EXPECT_EQ(std::string(glyph('\n')).size(), 41u);
  EXPECT_STRNE(glyph('0'), glyph('O'));
}

}  // namespace
}  // namespace stokes
