#include "clients/signals/output_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "protocol/wire/printable_text.hpp"

namespace skerry::client {

void remove_unfinished(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_regular_file(path, ignored)) std::filesystem::remove(path, ignored);
}

void fail_writing(const std::string& path, const std::string& why) {
  throw std::runtime_error(fmt::format("cannot write {}: {}", printable(path), printable(why)));
}

OutputFile::OutputFile(const std::string& path)
    : path_(path), file_(std::fopen(path.c_str(), "wb")) {
  if (!file_) fail_writing(path_, std::strerror(errno));
}

OutputFile::~OutputFile() {
  if (!file_) return;
  std::fclose(file_);
  remove_unfinished(path_);
}

void OutputFile::write(std::span<const std::uint8_t> bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) {
    fail_writing(path_, std::strerror(errno));
  }
  bytes_ += bytes.size();
}

void OutputFile::write(std::string_view text) {
  write({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

void OutputFile::close() {
  if (std::fclose(std::exchange(file_, nullptr)) == 0) return;
  const int why = errno;
  remove_unfinished(path_);
  fail_writing(path_, std::strerror(why));
}

}  // namespace skerry::client
