#include "tests/bench/soak/process_figures.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace skerry::bench {

ProcessFigures figures_of(pid_t pid) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path("/proc") / std::to_string(pid);
  ProcessFigures figures;
  std::ifstream status(folder / "status");
  for (std::string line; std::getline(status, line);) {
    const auto number = [&](const char* name) {
      const std::string key = std::string(name) + ":";
      return line.starts_with(key) ? std::stod(line.substr(key.size())) : 0.0;
    };
    figures.resident_mib += number("VmRSS") / 1024.0;
    figures.heap_mib += number("RssAnon") / 1024.0;
    figures.threads += static_cast<int>(number("Threads"));
  }
  std::error_code error;
  fs::directory_iterator descriptors(folder / "fd", error);
  if (!error)
    figures.descriptors = static_cast<int>(std::distance(begin(descriptors), end(descriptors)));
  return figures;
}

}  // namespace skerry::bench
