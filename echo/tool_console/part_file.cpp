#include "echo/tool_console/part_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <system_error>

namespace skerry::echo {
namespace {

namespace fs = std::filesystem;

// Where a link leads, so that the link stays.
fs::path led_to(const fs::path& wanted) {
  std::error_code none;
  const fs::path there = fs::canonical(wanted, none);
  return none ? wanted : there;
}

bool is_plain_or_new(const fs::path& file) {
  std::error_code none;
  return !fs::exists(file, none) || fs::is_regular_file(file, none);
}

}  // namespace

PartFile::PartFile(const fs::path& wanted)
    : wanted_(led_to(wanted)),
      part_(is_plain_or_new(wanted_) ? fs::path(wanted_.string() + ".part") : wanted_),
      out_(std::fopen(part_.c_str(), "wb"), std::fclose) {
  if (!out_) fail();
}

PartFile::~PartFile() {
  out_.reset();
  std::error_code ignored;
  if (!whole_ && part_ != wanted_) fs::remove(part_, ignored);
}

void PartFile::write(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), out_.get()) != text.size()) fail();
}

void PartFile::finish() {
  if (std::fclose(out_.release()) != 0) fail();
  if (part_ != wanted_ && std::rename(part_.c_str(), wanted_.c_str()) != 0) fail();
  whole_ = true;
}

void PartFile::fail() const {
  throw std::runtime_error(
      fmt::format("cannot write {}: {}", wanted_.string(), std::strerror(errno)));
}

}  // namespace skerry::echo
