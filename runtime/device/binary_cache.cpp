// The cache's file format: a header with magic, key, length and checksum, then the bytes.
#include "device/binary_cache.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

namespace stokes {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kEntriesKept = 64;

struct CacheHeader {
  char magic[8];
  std::uint64_t key[2];
  std::uint64_t length;
  std::uint64_t checksum;
};

CacheHeader make_header(const std::string& key, std::string_view bytes) {
  CacheHeader header{};
  std::memcpy(header.magic, "STOKESB1", 8);
  header.key[0] = hash_text(key);
  header.key[1] = hash_text(key, 0x9e3779b97f4a7c15ull);
  header.length = bytes.size();
  header.checksum = hash_text(bytes);
  return header;
}

void remove_old_entries(const std::string& folder) {
  std::error_code ignored;
  std::vector<std::pair<fs::file_time_type, fs::path>> entries;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (entry.path().extension() == ".bin") entries.emplace_back(entry.last_write_time(ignored), entry.path());
  if (entries.size() <= kEntriesKept) return;
  std::sort(entries.rbegin(), entries.rend());
  for (std::size_t i = kEntriesKept; i < entries.size(); ++i) fs::remove(entries[i].second, ignored);
}

}  // namespace

std::uint64_t hash_text(std::string_view text, std::uint64_t state) {
  for (const unsigned char byte : text) state = (state ^ byte) * 0x100000001b3ull;
  return state;
}

std::string cache_folder() {
  const char* base = std::getenv("XDG_CACHE_HOME");
  if (base && base[0] == '/') return std::string(base) + "/stokes";
  const char* home = std::getenv("HOME");
  return home && home[0] ? std::string(home) + "/.cache/stokes" : "";
}

std::string cache_file(const std::string& folder, const std::string& key) {
  char name[40];
  const CacheHeader header = make_header(key, "");
  std::snprintf(name, sizeof name, "%016llx%016llx", static_cast<unsigned long long>(header.key[0]), static_cast<unsigned long long>(header.key[1]));
  return folder + "/" + name + ".bin";
}

std::string read_cached(const std::string& folder, const std::string& key) {
  if (folder.empty()) return "";
  std::ifstream stream(cache_file(folder, key), std::ios::binary);
  std::ostringstream contents;
  contents << stream.rdbuf();
  const std::string file = contents.str();
  if (!stream || file.size() < sizeof(CacheHeader)) return "";
  CacheHeader found;
  std::memcpy(&found, file.data(), sizeof found);
  const std::string bytes = file.substr(sizeof found);
  const CacheHeader expected = make_header(key, bytes);
  return std::memcmp(&found, &expected, sizeof found) == 0 ? bytes : "";
}

void write_cached(const std::string& folder, const std::string& key, std::string_view bytes) {
  if (folder.empty()) return;
  static std::atomic<unsigned> serial{0};
  std::error_code failure;
  fs::create_directories(folder, failure);
  if (failure) return;
  const std::string target = cache_file(folder, key);
  const std::string aside = target + "." + std::to_string(getpid()) + "." + std::to_string(serial++) + ".tmp";
  const CacheHeader header = make_header(key, bytes);
  std::ofstream stream(aside, std::ios::binary);
  stream.write(reinterpret_cast<const char*>(&header), sizeof header);
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  stream.close();
  if (stream) fs::rename(aside, target, failure);
  if (!stream || failure) fs::remove(aside, failure);
  remove_old_entries(folder);
}

}  // namespace stokes
