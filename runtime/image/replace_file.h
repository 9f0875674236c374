// Replaces a file as a whole or not at all. Knows nothing of what is written.
#pragma once
#include <functional>
#include <string>

namespace stokes {

/// Calls `write` with the name of a temporary file in the folder of `path`, syncs that file and renames it to `path`, so that a
/// reader sees the old file or the new one. Symbolic links are followed. `write` throws when it fails; then, and when syncing or
/// renaming fails, the temporary file is removed, the old file is intact, and OutputError names `path`. Temporary files that killed processes of this
/// machine left for the same path are removed.
void replace_file(const std::string& path, const std::function<void(const std::string& temporary)>& write);

/// Throws OutputError when `path` could not be replaced: its folder is missing or not writable, or it is no regular file. Called
/// before a long render.
void require_writable(const std::string& path);

/// Writes `bytes` to `path` by replace_file.
void write_bytes(const std::string& path, const std::string& bytes);

}  // namespace stokes
