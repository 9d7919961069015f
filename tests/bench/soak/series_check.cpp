#include "tests/bench/soak/series_check.hpp"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <utility>

namespace skerry::bench {

namespace fs = std::filesystem;

std::vector<fs::path> recordings_in(const std::string& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".mcap") files.push_back(entry.path());
  }
  // "T.mcap", "T-002.mcap" ... "T-1000.mcap": a later file's name is longer, or behind in letters.
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    const std::string first = a.string(), second = b.string();
    return std::pair(first.size(), first) < std::pair(second.size(), second);
  });
  return files;
}

void SeriesCheck::look(bool done) {
  if (running_) {
    const auto report = running_->report();
    if (!report) return;
    running_.reset();
    take(*report);
  }
  auto files = recordings_in(folder_);
  if (!done && !files.empty()) files.pop_back();
  for (const fs::path& file : files) {
    if (!seen_.insert(file.string()).second) continue;
    running_.emplace(file.string());
    return;
  }
}

void SeriesCheck::finish() {
  const auto until = std::chrono::steady_clock::now() + std::chrono::minutes(2);
  do {
    look(true);
    if (!running_) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  } while (std::chrono::steady_clock::now() < until);
  throw std::runtime_error("the recording could not be read in two minutes");
}

void SeriesCheck::take(const FileReport& report) {
  ++files_;
  if (!report.damage.empty()) damaged_.push_back(report.file + ": " + report.damage);
  for (const auto& [radar, run] : report.radars) {
    spokes_ += run.last - run.first + 1 - run.missing;
    missing_ += run.missing;
    if (const auto before = last_.find(radar); before != last_.end()) {
      missing_ += run.first - before->second - 1;
    }
    last_[radar] = run.last;
  }
}

}  // namespace skerry::bench
