// Runs a fuzz target's corpus, and seeded mutations of it, as tests, with any compiler.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

namespace fs = std::filesystem;
using Input = std::vector<std::uint8_t>;

constexpr std::size_t kMutations = 4000;
constexpr std::size_t kLongestInput = 1 << 16;

// Names the input at hand in case it ends the program.
char running[512];

void name_input(int signal) {
  (void)!write(STDERR_FILENO, running, std::char_traits<char>::length(running));
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

void run(const Input& input, const fs::path& file, std::size_t mutation) {
  std::snprintf(running, sizeof running, "fuzz: input is %s, mutation %zu\n",
                file.filename().c_str(), mutation);
  LLVMFuzzerTestOneInput(input.data(), input.size());
}

std::vector<std::pair<fs::path, Input>> corpus() {
  std::vector<std::pair<fs::path, Input>> files;
  for (const auto& entry : fs::directory_iterator(SKERRY_CORPUS)) {
    std::ifstream in(entry.path(), std::ios::binary);
    files.emplace_back(entry.path(), Input(std::istreambuf_iterator<char>(in), {}));
  }
  std::sort(files.begin(), files.end());
  return files;
}

// One change of the kinds libFuzzer makes; `other` is a second input to take from.
void mutate(Input& input, const Input& other, std::mt19937& random) {
  const auto below = [&](std::size_t count) { return count == 0 ? 0 : random() % count; };
  const auto at = [&](Input& bytes, std::size_t i) {
    return bytes.begin() + static_cast<std::ptrdiff_t>(i);
  };
  const std::size_t from = below(input.size());
  const std::size_t count = std::min(1 + below(16), input.size() - from);
  switch (below(7)) {
    case 0:
      if (!input.empty()) input[from] ^= static_cast<std::uint8_t>(1u << below(8));
      break;
    case 1:
      if (!input.empty()) {
        constexpr std::uint8_t kInteresting[] = {0x00, 0x01, 0x7F, 0x80, 0xFF, 0xFE, 0x10, 0x20};
        input[from] = kInteresting[below(std::size(kInteresting))];
      }
      break;
    case 2:
      input.insert(at(input, from), static_cast<std::uint8_t>(random()));
      break;
    case 3:
      input.erase(at(input, from), at(input, from + count));
      break;
    case 4: {
      const Input part(at(input, from), at(input, from + count));
      input.insert(at(input, below(input.size())), part.begin(), part.end());
      break;
    }
    case 5:
      input.resize(from);
      break;
    case 6: {
      const std::size_t start = below(other.size());
      input.insert(at(input, from), other.begin() + static_cast<std::ptrdiff_t>(start),
                   other.end());
      break;
    }
  }
  if (input.size() > kLongestInput) input.resize(kLongestInput);
}

TEST(FuzzCorpus, HoldsForEveryFileAndItsMutations) {
  std::signal(SIGABRT, name_input);
  std::signal(SIGSEGV, name_input);
  const auto files = corpus();
  ASSERT_FALSE(files.empty()) << "no corpus in " << SKERRY_CORPUS;
  std::mt19937 random(1);
  for (const auto& [path, input] : files) run(input, path, 0);
  run({}, "nothing", 0);
  for (std::size_t i = 1; i <= kMutations; ++i) {
    const auto& [path, original] = files[i % files.size()];
    Input input = original;
    for (std::size_t n = 1 + random() % 4; n > 0; --n) {
      mutate(input, files[random() % files.size()].second, random);
    }
    run(input, path, i);
  }
}

}  // namespace
