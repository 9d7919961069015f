// RecordingOutput: a new recording that is whole or not there.
#pragma once

#include <cstdint>
#include <string>

#include "protocol/recording/writer.hpp"

namespace skerry::client {

// Writes into PATH.part-XXXXXX and puts it in place by commit().  Without commit() nothing is left;
// where only the name could not be given, the part stays and the error names it.
// Errors: std::runtime_error that names the file: `path` exists and `replace` is false, there is no
// such folder, the disk is full, ...
class RecordingOutput {
 public:
  RecordingOutput(std::string path, bool replace);
  ~RecordingOutput();
  RecordingOutput(const RecordingOutput&) = delete;
  RecordingOutput& operator=(const RecordingOutput&) = delete;

  // For a RecordingWriter that lives no longer; after an error it takes nothing more.
  recording::ByteSink sink();
  // Also throws what the sink could not do.  Requires the writer's finish().
  void commit();

  const std::string& path() const { return path_; }
  std::uint64_t bytes() const { return bytes_; }

 private:
  [[noreturn]] void fail(int why) const;
  bool write(std::span<const std::uint8_t> bytes);

  std::string path_, part_;
  bool replace_;
  int file_ = -1;
  int problem_ = 0;  // errno of the first write that failed
  std::uint64_t bytes_ = 0;
};

}  // namespace skerry::client
