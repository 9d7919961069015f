// SeriesCheck: whether the files of a series are whole and nothing is missing between them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "tests/bench/soak/file_check.hpp"

namespace skerry::bench {

// In the order of their names, which is that of time.
std::vector<std::filesystem::path> recordings_in(const std::string& folder);

// The files of a folder as a recorder completes them, one after the other.  Thread: one.
class SeriesCheck {
 public:
  explicit SeriesCheck(std::string folder) : folder_(std::move(folder)) {}

  // Takes up the next file, if none is being read; the newest only once the recorder is `done`.
  void look(bool done);
  // The rest of them.  Requires a recorder that is done.
  // Error: std::runtime_error if that takes more than two minutes.
  void finish();

  std::uint64_t files() const { return files_; }
  std::uint64_t spokes() const { return spokes_; }
  std::uint64_t missing() const { return missing_; }  // in files and between them
  const std::vector<std::string>& damaged() const { return damaged_; }

 private:
  void take(const FileReport& report);

  const std::string folder_;
  std::set<std::string> seen_;
  std::optional<FileCheck> running_;
  std::map<std::uint32_t, std::uint64_t> last_;  // sequence, by radar
  std::uint64_t files_ = 0, spokes_ = 0, missing_ = 0;
  std::vector<std::string> damaged_;
};

}  // namespace skerry::bench
