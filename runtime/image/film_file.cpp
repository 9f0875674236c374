// Films on disk. A record is self-contained and knows nothing of how its sums were made.
#include "image/film_file.h"

#include <array>
#include <bit>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <map>
#include <sstream>

#include "image/error.h"
#include "image/replace_file.h"

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
  double number(const std::string& key) const {
    try {
      return std::stod(text(key));
    } catch (const std::logic_error&) {
      throw InputError(path_ + ": is damaged: '" + key + "' is no number");
    }
  }
  std::uint64_t count(const std::string& key) const {
    try {
      return std::stoull(text(key));
    } catch (const std::logic_error&) {
      throw InputError(path_ + ": is damaged: '" + key + "' is no number");
    }
  }
  int integer(const std::string& key) const { return static_cast<int>(number(key)); }
  std::vector<std::pair<std::string, std::string>> notes;

 private:
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

FilmRecord parse_header(const Header& h) {
  FilmRecord r;
  r.identity = {h.text("version"), h.text("scene_hash"), h.text("scene"), h.text("device"), h.text("integrator"),
                static_cast<std::uint32_t>(h.count("seed"))};
  r.sample_begin = h.integer("sample_begin");
  r.sample_end = h.integer("sample_end");
  r.samples_total = h.integer("samples_total");
  r.render_seconds = h.number("render_seconds");
  r.rays = h.count("rays");
  r.shadow_rays = h.count("shadow_rays");
  r.scatterings = h.count("scatterings");
  r.paths = h.count("paths");
  r.notes = h.notes;
  Film& f = r.film;
  f.width = h.integer("width");
  f.height = h.integer("height");
  f.crop_x = h.integer("crop_x");
  f.crop_y = h.integer("crop_y");
  f.full_width = h.integer("full_width");
  f.full_height = h.integer("full_height");
  f.channels = static_cast<unsigned>(h.count("channels"));
  f.spectral_bins = h.integer("spectral_bins");
  f.spectral_begin = h.number("spectral_begin");
  f.spectral_end = h.number("spectral_end");
  f.quantum = h.number("quantum");
  f.depth_quantum = h.number("depth_quantum");
  f.stride = h.integer("stride");
  return r;
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
  FilmRecord record = parse_header(Header(path, bytes.substr(0, end + 1)));
  Film& film = record.film;
  const std::size_t words = static_cast<std::size_t>(film.width) * static_cast<std::size_t>(film.height) * static_cast<std::size_t>(film.stride);
  if (bytes.size() != end + 2 + words * sizeof(std::int64_t) + kTrailer) throw InputError(path + ": is damaged: its size does not fit its header");
  film.words.resize(words);
  std::memcpy(film.words.data(), bytes.data() + end + 2, words * sizeof(std::int64_t));
  return record;
}

bool holds_film(const std::string& path) {
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
  if (a.scene_hash != b.scene_hash) return "it belongs to another scene (hash " + a.scene_hash + ", not " + b.scene_hash + ")";
  if (a.seed != b.seed) return "its seed is " + std::to_string(a.seed) + ", not " + std::to_string(b.seed);
  const auto size = [](const Film& f) {
    return std::to_string(f.width) + "x" + std::to_string(f.height) + " at " + std::to_string(f.crop_x) + "," + std::to_string(f.crop_y);
  };
  if (size(found.film) != size(wanted.film)) return "its window is " + size(found.film) + ", not " + size(wanted.film);
  if (found.film.channels != wanted.film.channels) return "it holds other AOVs";
  if (!film_same_kind(found.film, wanted.film)) return "its film holds other channels or other units";
  return {};
}

}  // namespace stokes
