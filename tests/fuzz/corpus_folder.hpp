// The folder for the seeds of a fuzz target.
#pragma once

#include <cstdio>
#include <cstdlib>
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

// The one argument of a program that writes seeds, the folder of all corpora; ends one that has
// none.
inline std::filesystem::path corpora(int argc, char** argv) {
  if (argc == 2) return argv[1];
  std::fprintf(stderr, "usage: %s <tests/fuzz/corpus>\n", argv[0]);
  std::exit(2);
}

}  // namespace skerry::fuzz
