// Files that are written whole or not at all.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string_view>

namespace skerry::server {

// Writes `text` to a file beside and gives it the name of `file`, in place of what had it.  Both
// are on the disk before it returns.  `mode`: who may read it, as of open(2). Error:
// std::runtime_error naming the file and the system's reason; then `file` is as it was. Thread:
// any, one at a time for a file.
void write_whole(const std::filesystem::path& file, std::string_view text, mode_t mode);

}  // namespace skerry::server
