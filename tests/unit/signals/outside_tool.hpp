// Programs of others that read what we wrote.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

namespace skerry::client::testing_signals {

inline bool is_installed(const std::string& program) {
  return std::system(("command -v " + program + " > /dev/null 2>&1").c_str()) == 0;
}

struct ToolOutput {
  int code = -1;
  std::vector<std::uint8_t> out;
  std::string text() const { return {out.begin(), out.end()}; }
};

inline ToolOutput run_tool(const std::string& command) {
  ToolOutput result;
  std::FILE* pipe = ::popen(command.c_str(), "r");
  if (!pipe) return result;
  std::vector<std::uint8_t> block(1 << 16);
  while (const std::size_t n = std::fread(block.data(), 1, block.size(), pipe)) {
    result.out.insert(result.out.end(), block.begin(),
                      block.begin() + static_cast<std::ptrdiff_t>(n));
  }
  const int status = ::pclose(pipe);
  result.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return result;
}

// A folder of its own, removed with what is in it.
class Folder {
 public:
  Folder() : path_(testing::TempDir() + "skerry_signals_XXXXXX") {
    made_ = ::mkdtemp(path_.data());
  }
  ~Folder() {
    std::error_code ignored;
    if (made_) std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string operator/(const std::string& file) const { return path_ + "/" + file; }

 private:
  std::string path_;
  bool made_ = false;
};

inline std::string text_of_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace skerry::client::testing_signals
