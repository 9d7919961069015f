// FileCheck: whether a recording's file is whole, read by a process of its own.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace skerry::bench {

// Of the shared view of a radar in a file.
struct FileRun {
  std::uint64_t first = 0, last = 0;  // sequence numbers
  std::uint64_t missing = 0;          // between them
};

struct FileReport {
  std::string file;
  std::string damage;  // empty: it is whole
  std::map<std::uint32_t, FileRun> radars;
};

// Begins on construction, at the lowest priority, so that whoever waits for consoles goes on.
class FileCheck {
 public:
  // Error: std::runtime_error if there is no process to be had.
  explicit FileCheck(std::string file);
  ~FileCheck();  // ends the process
  FileCheck(const FileCheck&) = delete;
  FileCheck& operator=(const FileCheck&) = delete;

  // Nothing while it reads.  Once it has given a report, it is not called again.
  std::optional<FileReport> report();

 private:
  std::string file_, told_;
  pid_t pid_ = 0;
  int from_ = -1;
};

}  // namespace skerry::bench
