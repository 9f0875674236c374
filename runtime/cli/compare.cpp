// `stokes compare`: how much two images differ, and whether the difference is more than their noise.
#include "image/compare.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/commands.h"
#include "cli/exit_codes.h"
#include "cli/overwriting.h"
#include "image/error.h"
#include "image/image_file.h"
#include "image/parity.h"
#include "image/replace_file.h"
#include "view/report.h"

namespace stokes {
namespace {

struct CompareOptions {
  std::string a, b, html;
  double alpha = 0.01;
  int block = 0;
  std::optional<double> max_mse, max_relative_mse, max_flip;
  bool exact = false, json = false;
};

bool has_variance(const Image& image) { return image.find("Variance.R") && image.find("Variance.G") && image.find("Variance.B"); }

/// Given limits decide; else the noise, where both images say what theirs is; else every value must be equal.
bool is_different(const CompareOptions& o, const ImageDifference& d, const std::optional<ParityResult>& parity) {
  if (d.not_finite > 0) return true;
  if (o.exact) return !d.identical;
  if (o.max_mse || o.max_relative_mse || o.max_flip)
    return (o.max_mse && d.mse > *o.max_mse) || (o.max_relative_mse && d.relative_mse > *o.max_relative_mse) || (o.max_flip && d.flip > *o.max_flip);
  return parity ? !parity->agree : !d.identical;
}

void print_json(const ImageDifference& d, const std::optional<ParityResult>& parity, bool different) {
  nlohmann::ordered_json j;
  j["different"] = different;
  j["identical"] = d.identical;
  j["mse"] = d.mse;
  j["relmse"] = d.relative_mse;
  j["flip"] = d.flip;
  j["largest"] = d.largest;
  j["largest_at"] = {d.largest_x, d.largest_y};
  j["mean_a"] = d.mean_a;
  j["mean_b"] = d.mean_b;
  j["not_finite"] = d.not_finite;
  if (parity) {
    j["agree"] = parity->agree;
    j["p"] = parity->p;
    j["largest_z"] = std::fabs(parity->worst.z);
    j["threshold_z"] = parity->threshold;
    j["block"] = parity->block;
    for (const ParityTest& t : parity->means) j["mean_z"][t.channel] = t.z;
  }
  std::cout << j.dump(2) << "\n";
}

void print_text(const ImageDifference& d, const std::optional<ParityResult>& parity) {
  std::printf("MSE      %.6g\nrelMSE   %.6g\nFLIP     %.6g\nlargest  %.6g at (%d, %d)\n", d.mse, d.relative_mse, d.flip, d.largest, d.largest_x, d.largest_y);
  std::printf("means    %.6g %.6g %.6g and %.6g %.6g %.6g\n", d.mean_a[0], d.mean_a[1], d.mean_a[2], d.mean_b[0], d.mean_b[1], d.mean_b[2]);
  if (d.not_finite > 0) std::printf("different: %llu values are not finite, and count for nothing above\n", static_cast<unsigned long long>(d.not_finite));
  if (parity) std::printf("noise    %s", describe(*parity).c_str());
  if (d.not_finite == 0 && (d.identical || !parity))
    std::printf("%s\n", d.identical ? "identical" : "not identical (no variances to judge by: render with --aov variance)");
}

/// An image in colour; one of a single channel is grey.
Image read_picture(const std::string& path) {
  Image image = read_image(path);
  const bool colour = image.find("R") && image.find("G") && image.find("B");
  if (!colour && image.channels.size() != 1) throw InputError(path + ": has no channels R, G and B");
  if (!colour) {
    const std::vector<float> values = image.channels[0].values;
    image.channels = {{"R", values}, {"G", values}, {"B", values}};
  }
  return image;
}

std::string file_name(const std::string& path) { return std::filesystem::path(path).filename().string(); }

int run_compare(const CompareOptions& o) {
  require_no_other_file(o.html);
  const Image a = read_picture(o.a), b = read_picture(o.b);
  const ImageDifference difference = compare_images(a, b);
  std::optional<ParityResult> parity;
  if (has_variance(a) && has_variance(b)) {
    ParityOptions options;
    options.alpha = o.alpha;
    options.block = o.block;
    parity = test_parity(estimate_of(a), estimate_of(b), options);
  }
  const bool different = is_different(o, difference, parity);
  if (!o.html.empty()) {
    const std::string title = file_name(o.a) + " against " + file_name(o.b);
    write_bytes(o.html, comparison_report(title, {{title, file_name(o.a), file_name(o.b), a, b, difference, parity, different, {}}}));
  }
  if (o.json)
    print_json(difference, parity, different);
  else
    print_text(difference, parity);
  return different ? kExitDifferent : kExitDone;
}

}  // namespace

Command add_compare(CLI::App& root) {
  auto o = std::make_shared<CompareOptions>();
  CLI::App* app = root.add_subcommand("compare", "Compares two images; B is the one trusted more. Exit code 7 where they differ: by more than the\n"
                                                 "limits given, else by more than their noise (needs Variance channels in both), else in any value");
  app->add_option("a", o->a, "A.exr")->required();
  app->add_option("b", o->b, "B.exr")->required();
  app->add_option("--alpha", o->alpha, "Probability of calling equal renders different")->capture_default_str()->check(CLI::Range(1e-12, 0.5));
  app->add_option("--block", o->block, "Edge of the pixel blocks tested; 0: by the samples")->capture_default_str()->check(CLI::Range(0, 4096));
  app->add_option("--max-mse", o->max_mse, "Largest MSE that passes");
  app->add_option("--max-relmse", o->max_relative_mse, "Largest relMSE that passes");
  app->add_option("--max-flip", o->max_flip, "Largest FLIP that passes");
  app->add_flag("--exact", o->exact, "Any differing value is a difference");
  app->add_option("--html", o->html, "FILE: one page with both pictures under a slider, maps, spectra and the numbers");
  app->add_flag("--json", o->json, "As JSON");
  return {app, [o] { return run_compare(*o); }};
}

}  // namespace stokes
