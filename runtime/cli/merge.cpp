// `stokes merge`: parts of one render into the whole, by adding integers, so that the bits are those of one render.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>

#include "cli/commands.h"
#include "cli/exit_codes.h"
#include "cli/outputs.h"
#include "cli/overwriting.h"
#include "image/error.h"
#include "image/replace_file.h"

namespace stokes {
namespace {

struct MergeOptions {
  std::vector<std::string> parts;
  OutputOptions output;
};

struct Part {
  std::string path;
  FilmRecord record;
};

std::string range_text(int begin, int end) { return std::to_string(begin) + ":" + std::to_string(end); }

void require_same_render(const Part& part, const Part& first) {
  std::string reason = film_mismatch(part.record, first.record);
  if (reason.empty() && part.record.samples_total != first.record.samples_total)
    reason = "it is of a render of " + std::to_string(part.record.samples_total) + " samples, not " + std::to_string(first.record.samples_total);
  if (!reason.empty()) throw InputError(part.path + ": does not belong to " + first.path + ": " + reason);
}

/// The parts, in the order of their samples, must cover every sample exactly once.
void require_complete(const std::vector<Part>& parts) {
  int next = 0;
  for (std::size_t i = 0; i < parts.size(); i++) {
    const FilmRecord& r = parts[i].record;
    if (r.sample_begin > next) throw InputError("the samples " + range_text(next, r.sample_begin) + " are missing (before " + parts[i].path + ")");
    if (r.sample_begin < next)
      throw InputError(parts[i].path + ": overlaps " + parts[i - 1].path + ": both hold samples of " + range_text(r.sample_begin, std::min(next, r.sample_end)));
    next = r.sample_end;
  }
  const int total = parts.front().record.samples_total;
  if (next < total) throw InputError("the samples " + range_text(next, total) + " are missing (after " + parts.back().path + ")");
}

/// The whole, of the sum of all films and of what the parts say besides.
FilmRecord add_parts(std::vector<Part>& parts, Film film) {
  FilmRecord whole = std::move(parts.front().record);
  whole.film = std::move(film);
  for (std::size_t i = 1; i < parts.size(); i++) {
    const FilmRecord& part = parts[i].record;
    whole.sample_end = part.sample_end;
    whole.render_seconds += part.render_seconds;
    whole.rays += part.rays;
    whole.shadow_rays += part.shadow_rays;
    whole.scatterings += part.scatterings;
    whole.paths += part.paths;
    if (whole.identity.device.find(part.identity.device) == std::string::npos) {
      std::cerr << "note: " << parts[i].path << " was rendered on " << part.identity.device
                << "; parts of different devices merge, but are not the bits of one device's render\n";
      whole.identity.device += ", " + part.identity.device;
    }
  }
  return whole;
}

int run_merge(MergeOptions o) {
  require_no_input(o.output, o.parts, "the merge");
  require_outputs(o.output);
  std::vector<Part> parts;
  // Sums do not depend on the order: each part is added when it is read, so that two films need memory, not as many as there are parts.
  Film sum;
  for (const std::string& path : o.parts) {
    parts.push_back({path, read_film(path)});
    require_same_render(parts.back(), parts.front());
    Film& film = parts.back().record.film;
    std::vector<std::int64_t> words = std::move(film.words);
    film.words = {};
    if (parts.size() == 1) {
      sum = film;
      sum.words = std::move(words);
      continue;
    }
    Film part = film;
    part.words = std::move(words);
    film_accumulate(sum, part);
  }
  std::stable_sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.record.sample_begin < b.record.sample_begin; });
  require_complete(parts);
  const FilmRecord whole = add_parts(parts, std::move(sum));
  for (const auto& [name, value] : whole.notes) o.output.variance |= name == kVarianceNote;
  for (const std::string& file : write_outputs(whole, o.output)) std::cout << file << "\n";
  const FilmTotals totals = film_totals(whole.film);
  if (totals.invalid == 0) return kExitDone;
  std::cerr << "error: " << totals.invalid << " invalid samples (NaN, infinite or too large) were left out; the first at pixel ("
            << totals.first_invalid_x << ", " << totals.first_invalid_y << ")\n";
  return kExitInternal;
}

}  // namespace

Command add_merge(CLI::App& root) {
  auto o = std::make_shared<MergeOptions>();
  CLI::App* app = root.add_subcommand("merge", "Adds parts (render --samples a:b) up to the whole image");
  app->add_option("-o,--output", o->output.path, "OUT.exr, .png or .film")->required();
  app->add_option("parts", o->parts, "PART ...")->required();
  o->output.add_picture_to(*app);
  app->add_flag("--variance", o->output.variance, "Add Variance.R, .G, .B [as the parts were asked for]");
  return {app, [o] { return run_merge(*o); }};
}

}  // namespace stokes
