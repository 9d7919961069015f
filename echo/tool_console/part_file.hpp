// PartFile: a file that is there whole or not at all.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string_view>

namespace skerry::echo {

// Written beside the wanted one, as FILE.part, and takes its name when it is whole; removed else,
// so that what stood there stays.  What is no plain file (/dev/stdout, a pipe) is written itself.
class PartFile {
 public:
  // Errors, here and below: std::runtime_error, "cannot write FILE: the system's reason".
  explicit PartFile(const std::filesystem::path& wanted);
  ~PartFile();
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;

  void write(std::string_view text);
  void finish();

 private:
  [[noreturn]] void fail() const;

  std::filesystem::path wanted_, part_;  // the same if it is no plain file
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> out_;
  bool whole_ = false;
};

}  // namespace skerry::echo
