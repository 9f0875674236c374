// Built programs on disk, so that the second start of a scene needs no compiler. A cache that cannot be read or written is the
// same as an empty one: nothing here throws. Knows no OpenCL.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace stokes {

/// 64-bit FNV-1a over `text`, continued from `state`. For checksums and keys, not for adversaries.
std::uint64_t hash_text(std::string_view text, std::uint64_t state = 0xcbf29ce484222325ull);

/// The folder: $XDG_CACHE_HOME/stokes, else ~/.cache/stokes; empty when neither variable is set.
std::string cache_folder();

/// The bytes stored under `key`, or "" if there are none or the file is damaged in any way.
std::string read_cached(const std::string& folder, const std::string& key);

/// Stores `bytes` under `key`: written aside and renamed, so a reader sees a whole file or none. Old entries beyond the newest 64 go.
void write_cached(const std::string& folder, const std::string& key, std::string_view bytes);

/// The file that holds `key`, of any length.
std::string cache_file(const std::string& folder, const std::string& key);

}  // namespace stokes
