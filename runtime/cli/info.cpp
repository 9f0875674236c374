// `stokes info`: what an image, checkpoint or part holds.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/exit_codes.h"
#include "image/film_file.h"
#include "image/image_file.h"
#include "input/text.h"

namespace stokes {
namespace {

using Json = nlohmann::ordered_json;

struct InfoOptions {
  std::string file;
  bool json = false;
};

Json describe_film(const FilmRecord& r) {
  const FilmTotals totals = film_totals(r.film);
  Json j;
  j["kind"] = "film";
  j["version"] = r.identity.version;
  j["scene"] = r.identity.scene;
  j["scene_hash"] = r.identity.scene_hash;
  j["seed"] = r.identity.seed;
  j["device"] = r.identity.device;
  j["integrator"] = r.identity.integrator;
  j["samples"] = std::to_string(r.sample_begin) + ":" + std::to_string(r.sample_end);
  j["samples_total"] = r.samples_total;
  j["render_seconds"] = r.render_seconds;
  j["width"] = r.film.width;
  j["height"] = r.film.height;
  j["crop"] = {r.film.crop_x, r.film.crop_x + r.film.width, r.film.crop_y, r.film.crop_y + r.film.height};
  j["full_size"] = {r.film.full_width, r.film.full_height};
  j["invalid_samples"] = totals.invalid;
  return j;
}

Json describe_image(const Image& image) {
  Json j;
  j["kind"] = "image";
  j["width"] = image.width;
  j["height"] = image.height;
  j["window"] = {image.x, image.y};
  j["full_size"] = {image.full_width, image.full_height};
  j["channels"] = Json::array();
  for (const Image::Channel& channel : image.channels) j["channels"].push_back(channel.name);
  for (const auto& [name, value] : image.metadata) j["metadata"][name] = value;
  return j;
}

void print(const Json& j, const std::string& indent) {
  for (const auto& [key, value] : j.items()) {
    if (value.is_object()) {
      std::printf("%s%s:\n", indent.c_str(), visible_line(key).c_str());
      print(value, indent + "  ");
    } else {
      const std::string text = value.is_string() ? value.get<std::string>() : value.dump(-1, ' ', false, Json::error_handler_t::replace);
      std::printf("%s%s: %s\n", indent.c_str(), visible_line(key).c_str(), visible_line(text).c_str());
    }
  }
}

int run_info(const InfoOptions& o) {
  const Json j = holds_film(o.file) ? describe_film(read_film(o.file)) : describe_image(read_image(o.file));
  if (o.json)
    std::cout << j.dump(2, ' ', false, Json::error_handler_t::replace) << "\n";
  else
    print(j, "");
  return kExitDone;
}

}  // namespace

Command add_info(CLI::App& root) {
  auto o = std::make_shared<InfoOptions>();
  CLI::App* app = root.add_subcommand("info", "Says what an image, checkpoint or part holds");
  app->add_option("file", o->file, "FILE")->required();
  app->add_flag("--json", o->json, "As JSON");
  return {app, [o] { return run_info(*o); }};
}

}  // namespace stokes
