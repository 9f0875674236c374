// Films on disk. A record is self-contained and knows nothing of how its sums were made.
#include "image/film_file.h"

#include <array>
#include <bit>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>

#include "image/error.h"
#include "image/replace_file.h"
#include "input/limits.h"
#include "layout.h"

namespace stokes {
namespace {

static_assert(std::endian::native == std::endian::little, "words are written as they lie in memory");

constexpr char kHead[] = "STOKES FILM 1\n";
constexpr char kMagic[] = "STKSFILM";
constexpr std::size_t kTrailer = 24;  // checksum, length, magic

/// Reads a header back: one "key value" a line, which is unescaped text without line breaks.
class Header {
 public:
  Header(const std::string& path, const std::string& text) : path_(path) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      const std::size_t space = line.find(' ');
      if (space == std::string::npos) continue;
      if (line.compare(0, space, "note") == 0) {
        const std::size_t equals = line.find('=');
        if (equals != std::string::npos) notes.emplace_back(line.substr(space + 1, equals - space - 1), line.substr(equals + 1));
      } else {
        values_[line.substr(0, space)] = line.substr(space + 1);
      }
    }
  }
  const std::string& text(const std::string& key) const {
    const auto found = values_.find(key);
    if (found == values_.end()) throw InputError(path_ + ": is damaged: its header has no '" + key + "'");
    return found->second;
  }
  /// Finite, and within [low, high].
  double number(const std::string& key, double low, double high) const { return parse<double>(key, low, high); }
  std::uint64_t count(const std::string& key, std::uint64_t high = std::numeric_limits<std::uint64_t>::max()) const {
    return parse<std::uint64_t>(key, 0, high);
  }
  int integer(const std::string& key, int low, int high) const { return parse<int>(key, low, high); }
  std::vector<std::pair<std::string, std::string>> notes;

 private:
  template <class Number>
  Number parse(const std::string& key, Number low, Number high) const {
    const std::string& digits = text(key);
    Number value{};
    const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || stop != digits.data() + digits.size()) throw InputError(path_ + ": is damaged: '" + key + "' is no number");
    if (!(value >= low && value <= high)) throw InputError(path_ + ": is damaged: '" + key + "' is out of range");
    return value;
  }
  std::string path_;
  std::map<std::string, std::string> values_;
};

std::string one_line(std::string text) {
  for (char& c : text)
    if (c == '\n' || c == '\r') c = ' ';
  return text;
}

std::string exact(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

std::string header_text(const FilmRecord& r) {
  std::ostringstream out;
  const Film& f = r.film;
  out << kHead << "version " << one_line(r.identity.version) << "\nscene_hash " << r.identity.scene_hash << "\nscene "
      << one_line(r.identity.scene) << "\ndevice " << one_line(r.identity.device) << "\nintegrator " << one_line(r.identity.integrator)
      << "\nseed " << r.identity.seed << "\nsample_begin " << r.sample_begin << "\nsample_end " << r.sample_end << "\nsamples_total "
      << r.samples_total << "\nrender_seconds " << exact(r.render_seconds) << "\nrays " << r.rays << "\nshadow_rays " << r.shadow_rays
      << "\nscatterings " << r.scatterings << "\npaths " << r.paths << "\nwidth " << f.width << "\nheight " << f.height << "\ncrop_x "
      << f.crop_x << "\ncrop_y " << f.crop_y << "\nfull_width " << f.full_width << "\nfull_height " << f.full_height << "\nchannels "
      << f.channels << "\nspectral_bins " << f.spectral_bins << "\nspectral_begin " << exact(f.spectral_begin) << "\nspectral_end "
      << exact(f.spectral_end) << "\nquantum " << exact(f.quantum) << "\ndepth_quantum " << exact(f.depth_quantum) << "\nstride "
      << f.stride << "\n";
  for (const auto& [name, value] : r.notes) out << "note " << one_line(name) << "=" << one_line(value) << "\n";
  out << "\n";
  return out.str();
}

constexpr int kMaxSide = 1 << 20, kMaxSamples = std::numeric_limits<int>::max(), kMaxBins = 10'000;
constexpr unsigned kKnownChannels = FILM_ALBEDO | FILM_NORMAL | FILM_DEPTH | FILM_FLUORESCENCE | FILM_FLUORESCENT_BINS;

/// What the window, the channels and the words say of each other.
void check_film(const std::string& path, const Film& f) {
  const auto damaged = [&](const char* what) { throw InputError(path + ": is damaged: " + what); };
  if (f.crop_x > f.full_width - f.width || f.crop_y > f.full_height - f.height) damaged("its window lies outside its image");
  if (f.channels & ~kKnownChannels) damaged("it has unknown channels");
  if (f.spectral_bins > 0 && !(f.spectral_begin < f.spectral_end)) damaged("its spectral bins are empty");
  if ((f.channels & FILM_FLUORESCENT_BINS) && (!(f.channels & FILM_FLUORESCENCE) || f.spectral_bins == 0)) damaged("its channels need others");
  if (f.stride != make_film(1, 1, 0, 0, 1, 1, f.channels, f.spectral_bins, 0, 0, 1, 1).stride) damaged("its words do not fit its channels");
}

/// No pixel has a negative number of samples, valid or invalid.
bool counts_are_sound(const Film& film) {
  constexpr std::size_t kValid = 10, kInvalid = 11;  // words of a pixel, see layout.h
  for (std::size_t i = 0; i < film.words.size(); i += static_cast<std::size_t>(film.stride))
    if (film.words[i + kValid] < 0 || film.words[i + kInvalid] < 0) return false;
  return true;
}

FilmRecord parse_header(const std::string& path, const Header& h) {
  FilmRecord r;
  r.identity = {h.text("version"), h.text("scene_hash"), h.text("scene"), h.text("device"), h.text("integrator"),
                static_cast<std::uint32_t>(h.count("seed", std::numeric_limits<std::uint32_t>::max()))};
  r.samples_total = h.integer("samples_total", 0, kMaxSamples);
  r.sample_end = h.integer("sample_end", 0, r.samples_total);
  r.sample_begin = h.integer("sample_begin", 0, r.sample_end);
  r.render_seconds = h.number("render_seconds", 0, 1e12);
  r.rays = h.count("rays");
  r.shadow_rays = h.count("shadow_rays");
  r.scatterings = h.count("scatterings");
  r.paths = h.count("paths");
  r.notes = h.notes;
  Film& f = r.film;
  f.full_width = h.integer("full_width", 1, kMaxSide);
  f.full_height = h.integer("full_height", 1, kMaxSide);
  f.width = h.integer("width", 1, f.full_width);
  f.height = h.integer("height", 1, f.full_height);
  f.crop_x = h.integer("crop_x", 0, f.full_width);
  f.crop_y = h.integer("crop_y", 0, f.full_height);
  f.channels = static_cast<unsigned>(h.count("channels", std::numeric_limits<unsigned>::max()));
  f.spectral_bins = h.integer("spectral_bins", 0, kMaxBins);
  f.spectral_begin = h.number("spectral_begin", 0, 1e6);
  f.spectral_end = h.number("spectral_end", 0, 1e6);
  f.quantum = h.number("quantum", std::numeric_limits<double>::min(), 1e30);
  f.depth_quantum = h.number("depth_quantum", std::numeric_limits<double>::min(), 1e30);
  f.stride = h.integer("stride", FILM_BASE_WORDS, std::numeric_limits<int>::max());
  check_film(path, f);
  return r;
}

std::string note_of(const FilmRecord& record, const char* wanted) {
  for (const auto& [name, value] : record.notes)
    if (name == wanted) return value;
  return {};
}

std::uint64_t word_at(const std::string& bytes, std::size_t at) {
  std::uint64_t word = 0;
  std::memcpy(&word, bytes.data() + at, sizeof word);
  return word;
}

void append_word(std::string& bytes, std::uint64_t word) {
  char raw[sizeof word];
  std::memcpy(raw, &word, sizeof word);
  bytes.append(raw, sizeof word);
}

/// The record's bytes from the end of the file, checked against their own length and checksum.
std::string read_record(const std::string& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) throw InputError(path + ": is no regular file");
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file) throw InputError(path + ": cannot be opened");
  const std::uint64_t size = static_cast<std::uint64_t>(file.tellg());
  std::string trailer(kTrailer, '\0');
  if (size >= kTrailer) {
    file.seekg(static_cast<std::streamoff>(size - kTrailer));
    file.read(trailer.data(), kTrailer);
  }
  if (size < kTrailer || trailer.compare(16, 8, kMagic) != 0) {
    std::string head(sizeof kHead - 1, '\0');
    file.clear();
    file.seekg(0);
    file.read(head.data(), static_cast<std::streamsize>(head.size()));
    if (head.compare(0, 11, kHead, 11) == 0) throw InputError(path + ": is damaged: it is cut short");
    throw InputError(path + ": holds no film (it is not a part or checkpoint, or it was cut short)");
  }
  const std::uint64_t length = word_at(trailer, 8);
  if (length < kTrailer || length > size) throw InputError(path + ": is damaged: it is cut short");
  require_memory({}, 2 * length, path);  // as bytes, and as a film
  std::string record(length, '\0');
  file.seekg(static_cast<std::streamoff>(size - length));
  file.read(record.data(), static_cast<std::streamsize>(length));
  if (!file) throw InputError(path + ": cannot be read");
  if (fnv1a(record.data(), record.size() - kTrailer) != word_at(record, record.size() - kTrailer))
    throw InputError(path + ": is damaged: its checksum is wrong");
  return record;
}

}  // namespace

std::uint64_t fnv1a(const void* data, std::size_t bytes, std::uint64_t start) {
  const unsigned char* p = static_cast<const unsigned char*>(data);
  std::uint64_t hash = start;
  for (std::size_t i = 0; i < bytes; i++) hash = (hash ^ p[i]) * 0x100000001b3u;
  return hash;
}

std::string encode_film(const FilmRecord& record) {
  std::string bytes = header_text(record);
  bytes.append(reinterpret_cast<const char*>(record.film.words.data()), record.film.words.size() * sizeof(std::int64_t));
  append_word(bytes, fnv1a(bytes.data(), bytes.size()));
  append_word(bytes, bytes.size() + 16);
  bytes.append(kMagic, 8);
  return bytes;
}

void write_film(const std::string& path, const FilmRecord& record) { write_bytes(path, encode_film(record)); }

FilmRecord read_film(const std::string& path) {
  const std::string bytes = read_record(path);
  if (bytes.compare(0, sizeof kHead - 1, kHead) != 0) throw InputError(path + ": is of another version of the film format");
  const std::size_t end = bytes.find("\n\n");
  if (end == std::string::npos) throw InputError(path + ": is damaged: its header has no end");
  FilmRecord record = parse_header(path, Header(path, bytes.substr(0, end + 1)));
  Film& film = record.film;
  // Within 2^20 * 2^20 * 2^15: no overflow.
  const std::size_t words = static_cast<std::size_t>(film.width) * static_cast<std::size_t>(film.height) * static_cast<std::size_t>(film.stride);
  if (bytes.size() < end + 2 + kTrailer || bytes.size() - end - 2 - kTrailer != words * sizeof(std::int64_t)) throw InputError(path + ": is damaged: its size does not fit its header");
  film.words.resize(words);
  std::memcpy(film.words.data(), bytes.data() + end + 2, words * sizeof(std::int64_t));
  if (!counts_are_sound(film)) throw InputError(path + ": is damaged: a pixel has fewer samples than none");
  return record;
}

bool holds_film(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return false;
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file || file.tellg() < static_cast<std::streamoff>(kTrailer)) return false;
  file.seekg(-8, std::ios::end);
  char magic[8];
  file.read(magic, 8);
  return file && std::memcmp(magic, kMagic, 8) == 0;
}

std::string film_mismatch(const FilmRecord& found, const FilmRecord& wanted) {
  const FilmIdentity &a = found.identity, &b = wanted.identity;
  if (a.version != b.version) return "it was made by version " + a.version + ", not " + b.version;
  if (a.seed != b.seed) return "its seed is " + std::to_string(a.seed) + ", not " + std::to_string(b.seed);
  const auto size = [](const Film& f) {
    return std::to_string(f.width) + "x" + std::to_string(f.height) + " at " + std::to_string(f.crop_x) + "," + std::to_string(f.crop_y);
  };
  if (size(found.film) != size(wanted.film)) return "its window is " + size(found.film) + ", not " + size(wanted.film);
  if (found.film.channels != wanted.film.channels) return "it holds other AOVs";
  const auto bins = [](const Film& f) { return std::to_string(f.spectral_bins) + " of " + exact(f.spectral_begin) + " to " + exact(f.spectral_end) + " nm"; };
  if (bins(found.film) != bins(wanted.film)) return "its spectral bins are " + bins(found.film) + ", not " + bins(wanted.film);
  // Where one of the two does not say, as manifests of jobs, the scene's hash does.
  if (!a.integrator.empty() && !b.integrator.empty() && a.integrator != b.integrator) return "its integrator is " + a.integrator + ", not " + b.integrator;
  for (const auto& [name, label] : {std::pair("stokes:mode", "its mode is "), std::pair("stokes:wavelengths_per_path", "its wavelengths per path are ")}) {
    const std::string mine = note_of(found, name), theirs = note_of(wanted, name);
    if (!mine.empty() && !theirs.empty() && mine != theirs) return label + mine + ", not " + theirs;
  }
  if (a.scene_hash != b.scene_hash) return "it belongs to another scene, or to other settings of it (hash " + a.scene_hash + ", not " + b.scene_hash + ")";
  if (!film_same_kind(found.film, wanted.film)) return "its film holds other channels or other units";
  return {};
}

}  // namespace stokes
