// A job folder's manifest and the state of its parts.
#include "distribute/job_folder.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "image/error.h"
#include "image/replace_file.h"

namespace stokes {
namespace {
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int kFormat = 1;

std::string checkpoint_of(const JobPart& part) { return part.file + ".checkpoint"; }

/// Calls `field(name, value...)` for what a manifest says of its film; several values are a list.
template <class Record, class Field>
void for_each_field(Record& r, const Field& field) {
  auto& f = r.film;
  field("version", r.identity.version);
  field("scene_hash", r.identity.scene_hash);
  field("device", r.identity.device);
  field("seed", r.identity.seed);
  field("samples", r.samples_total);
  field("window", f.crop_x, f.crop_y, f.width, f.height);
  field("full_size", f.full_width, f.full_height);
  field("channels", f.channels);
  field("spectral", f.spectral_begin, f.spectral_end, f.spectral_bins);
  field("quanta", f.quantum, f.depth_quantum);
  field("stride", f.stride);
}

Json wanted_to_json(const FilmRecord& r) {
  Json j;
  for_each_field(r, [&](const char* name, const auto& first, const auto&... rest) {
    if constexpr (sizeof...(rest) == 0)
      j[name] = first;
    else
      j[name] = Json::array({first, rest...});
  });
  return j;
}

/// Into a field of the record. Throws std::range_error for a number that is no integer or too large for it, which the library would convert somehow.
template <class T>
void read_value(const Json& value, T& field) {
  if constexpr (std::is_integral_v<T>) {
    const bool fits = value.is_number_unsigned() ? std::in_range<T>(value.get<std::uint64_t>())
                                                 : value.is_number_integer() && std::in_range<T>(value.get<std::int64_t>());
    if (!fits) throw std::range_error(value.dump().substr(0, 40) + " stands where an integer is expected");
  }
  value.get_to(field);
}

FilmRecord wanted_from_json(const Json& j) {
  FilmRecord r;
  for_each_field(r, [&](const char* name, auto& first, auto&... rest) {
    const Json& value = j.at(name);
    if constexpr (sizeof...(rest) == 0) {
      read_value(value, first);
    } else {
      std::size_t i = 0;
      read_value(value.at(i++), first);
      (read_value(value.at(i++), rest), ...);
    }
  });
  return r;
}

/// Why a film is no part of the job, whatever its samples: one phrase, or empty.
std::string foreign(const FilmRecord& found, const Job& job) {
  const FilmRecord& wanted = job.wanted;
  std::string reason = film_mismatch(found, wanted);
  if (reason.empty() && !wanted.identity.device.empty() && found.identity.device != wanted.identity.device)
    reason = "it was rendered on " + found.identity.device + ", not on " + wanted.identity.device;
  if (reason.empty() && found.samples_total != wanted.samples_total)
    reason = "it is of a render of " + std::to_string(found.samples_total) + " samples, not " + std::to_string(wanted.samples_total);
  return reason;
}

std::string range_text(int begin, int end) { return std::to_string(begin) + ":" + std::to_string(end); }

/// InputErrors begin with the file's name, which the report gives already.
std::string without_name(const std::string& message, const std::string& file) {
  const std::string prefix = file + ": ";
  return message.compare(0, prefix.size(), prefix) == 0 ? message.substr(prefix.size()) : message;
}

/// Of a manifest's parts: the first thing that is wrong with them, or empty. They cover the samples one after the other, and lie in the folder.
std::string fault_of(const Job& job, const std::vector<std::string>& files) {
  int next = 0;
  for (std::size_t i = 0; i < files.size(); i++) {
    const JobPart& part = job.parts[i];
    if (part.begin != next || part.end <= part.begin) return "part " + std::to_string(i) + " has the samples " + range_text(part.begin, part.end) + " where " + std::to_string(next) + " is next";
    if (files[i].empty() || fs::path(files[i]).filename() != files[i]) return "part " + std::to_string(i) + " does not lie in the folder";
    next = part.end;
  }
  if (next != job.wanted.samples_total) return "its parts end at sample " + std::to_string(next) + " of " + std::to_string(job.wanted.samples_total);
  return {};
}

bool is_plain(char c) { return std::isalnum(static_cast<unsigned char>(c)) || std::string("_-./:,+@%").find(c) != std::string::npos; }

}  // namespace

const char* part_state_name(PartState state) {
  switch (state) {
    case PartState::Done: return "done";
    case PartState::Missing: return "missing";
    case PartState::Unfinished: return "unfinished";
    case PartState::Damaged: return "damaged";
    case PartState::Foreign: return "foreign";
  }
  return "";
}

std::vector<JobPart> cut_samples(int samples, int count, const std::string& folder) {
  std::vector<JobPart> parts;
  const std::int64_t pieces = std::clamp(count, 1, samples);
  for (std::int64_t i = 0; i < pieces; i++) {
    const int begin = static_cast<int>(i * samples / pieces), end = static_cast<int>((i + 1) * samples / pieces);
    char name[48];
    std::snprintf(name, sizeof name, "part-%07d-%07d.film", begin, end);
    parts.push_back({begin, end, (fs::path(folder) / name).string()});
  }
  return parts;
}

std::string manifest_path(const std::string& folder) { return (fs::path(folder) / "job.json").string(); }

void write_job(const Job& job) {
  Json j = {{"stokes_job", kFormat}, {"scene", job.scene},          {"options", job.options}, {"wanted", wanted_to_json(job.wanted)},
            {"output", job.output},  {"merge", job.merge_options}, {"parts", Json::array()}};
  for (const JobPart& part : job.parts)
    j["parts"].push_back({{"samples", {part.begin, part.end}}, {"file", fs::path(part.file).filename().string()}});
  write_bytes(manifest_path(job.folder), j.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

Job read_job(const std::string& folder) {
  const std::string path = manifest_path(folder);
  std::ifstream file(path);
  if (!file) throw InputError(folder + ": is no job folder: there is no " + path);
  try {
    const Json j = Json::parse(file);
    if (j.at("stokes_job") != kFormat) throw InputError(path + ": is of another version of the job format");
    Job job;
    job.folder = folder;
    job.scene = j.at("scene");
    job.options = j.at("options").get<std::vector<std::string>>();
    job.wanted = wanted_from_json(j.at("wanted"));
    job.output = j.at("output");
    job.merge_options = j.at("merge").get<std::vector<std::string>>();
    std::vector<std::string> files;
    for (const Json& part : j.at("parts")) {
      files.push_back(part.at("file"));
      JobPart& read = job.parts.emplace_back();
      read_value(part.at("samples").at(0), read.begin);
      read_value(part.at("samples").at(1), read.end);
      read.file = (fs::path(folder) / files.back()).string();
    }
    if (job.parts.empty()) throw InputError(path + ": is damaged: it has no parts");
    if (const std::string fault = fault_of(job, files); !fault.empty()) throw InputError(path + ": is damaged: " + fault);
    return job;
  } catch (const Json::exception& e) {
    throw InputError(path + ": is damaged: " + e.what());
  } catch (const std::range_error& e) {
    throw InputError(path + ": is damaged: " + e.what());
  }
}

std::string job_mismatch(const Job& found, const Job& asked) {
  std::string reason = film_mismatch(found.wanted, asked.wanted);
  if (reason.empty() && found.wanted.identity.device != asked.wanted.identity.device)
    reason = "its device is '" + found.wanted.identity.device + "', not '" + asked.wanted.identity.device + "'";
  if (reason.empty() && found.wanted.samples_total != asked.wanted.samples_total)
    reason = "it has " + std::to_string(found.wanted.samples_total) + " samples, not " + std::to_string(asked.wanted.samples_total);
  return reason;
}

PartReport examine_part(const Job& job, const JobPart& part) {
  if (!fs::exists(part.file)) return {PartState::Missing, "it is not there"};
  FilmRecord found;
  try {
    found = read_film(part.file);
  } catch (const InputError& e) {
    return {PartState::Damaged, without_name(e.what(), part.file)};
  }
  std::string reason = foreign(found, job);
  if (!reason.empty()) return {PartState::Foreign, reason};
  if (found.sample_begin == part.begin && found.sample_end == part.end) return {PartState::Done, {}};
  reason = "it holds the samples " + range_text(found.sample_begin, found.sample_end);
  const bool begun = found.sample_begin == part.begin && found.sample_end < part.end;
  return {begun ? PartState::Unfinished : PartState::Foreign, reason};
}

bool checkpoint_fits(const Job& job, const JobPart& part) {
  if (!fs::exists(checkpoint_of(part))) return false;
  try {
    const FilmRecord found = read_film(checkpoint_of(part));
    return foreign(found, job).empty() && found.sample_begin == part.begin && found.sample_end <= part.end;
  } catch (const InputError&) {
    return false;
  }
}

std::vector<std::string> part_arguments(const Job& job, const JobPart& part) {
  std::vector<std::string> words = {"render", job.scene};
  words.insert(words.end(), job.options.begin(), job.options.end());
  words.insert(words.end(), {"--samples", range_text(part.begin, part.end), "--expect-scene", job.wanted.identity.scene_hash});
  if (fs::exists(checkpoint_of(part))) words.push_back(checkpoint_fits(job, part) ? "--resume" : "--restart");
  words.insert(words.end(), {"-o", part.file});
  return words;
}

std::vector<std::string> merge_arguments(const Job& job, const std::string& output) {
  std::vector<std::string> words = {"merge", "-o", output};
  words.insert(words.end(), job.merge_options.begin(), job.merge_options.end());
  for (const JobPart& part : job.parts) words.push_back(part.file);
  return words;
}

std::string shell_line(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) {
    if (!line.empty()) line += ' ';
    if (!word.empty() && std::all_of(word.begin(), word.end(), is_plain)) {
      line += word;
      continue;
    }
    line += '\'';
    for (const char c : word) line += c == '\'' ? std::string("'\\''") : std::string(1, c);
    line += '\'';
  }
  return line;
}

}  // namespace stokes
