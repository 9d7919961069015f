// OutputFile: a file that is whole or not there.
#pragma once

#include <cstdint>
#include <cstdio>
#include <span>
#include <string>
#include <string_view>

namespace skerry::client {

// Removes what was written to `path`, if that is a regular file.
void remove_unfinished(const std::string& path);
// The error of a file: std::runtime_error "cannot write PATH: why".
[[noreturn]] void fail_writing(const std::string& path, const std::string& why);

// Errors: std::runtime_error as of fail_writing().  A file that was not closed is removed.
class OutputFile {
 public:
  explicit OutputFile(const std::string& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::span<const std::uint8_t> bytes);
  void write(std::string_view text);
  void close();
  std::uint64_t bytes() const { return bytes_; }

 private:
  std::string path_;
  std::FILE* file_ = nullptr;
  std::uint64_t bytes_ = 0;
};

}  // namespace skerry::client
