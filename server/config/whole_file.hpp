// Files that are written whole or not at all, and by one program at a time.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <string_view>

namespace skerry::server {

// Writes `text` to a file beside and gives it the name of `file`, in place of what had it.  Both
// are on the disk before it returns.  `mode`: who may read it, as of open(2). Error:
// std::runtime_error naming the file and the system's reason; then `file` is as it was. Thread:
// any, one at a time for a file.
void write_whole(const std::filesystem::path& file, std::string_view text, mode_t mode);

// Runs `change` while no other program does so for the same file: under a lock on a file beside it,
// for the file itself is another one after each write_whole().
// Error: std::runtime_error as write_whole(); what `change` throws.
// Thread: any.
void while_locked(const std::filesystem::path& file, const std::function<void()>& change);

}  // namespace skerry::server
