// CorpusFolder: where a fuzz target's seeds are written.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

#include "protocol/wire/wire_error.hpp"

namespace skerry::fuzz {

class CorpusFolder {
 public:
  explicit CorpusFolder(std::filesystem::path folder) : folder_(std::move(folder)) {
    std::filesystem::create_directories(folder_);
  }
  void write(const std::string& name, const Bytes& bytes) const {
    std::ofstream out(folder_ / name, std::ios::binary);
    out.write(reinterpret_cast<const char*>(bytes.data()),
              static_cast<std::streamsize>(bytes.size()));
  }

 private:
  std::filesystem::path folder_;
};

}  // namespace skerry::fuzz
