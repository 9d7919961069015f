#include "clients/recording/recording_output.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "protocol/recording/put_in_place.hpp"
#include "protocol/wire/printable_text.hpp"

namespace skerry::client {
namespace {

std::string already_there(const std::string& path) {
  return fmt::format("{} exists; give another name, or --force to replace it", printable(path));
}

}  // namespace

RecordingOutput::RecordingOutput(std::string path, bool replace)
    : path_(std::move(path)), part_(path_ + ".part-XXXXXX"), replace_(replace) {
  std::error_code error;
  if (std::filesystem::is_directory(path_, error)) fail(EISDIR);
  if (!replace_ && std::filesystem::exists(path_, error)) {
    throw std::runtime_error(already_there(path_));
  }
  file_ = ::mkostemp(part_.data(), O_CLOEXEC);
  if (file_ < 0) fail(errno);
  // mkostemp() makes it for its owner alone; others may read recordings as they may other files.
  const mode_t mask = ::umask(0);
  ::umask(mask);
  ::fchmod(file_, 0666 & ~mask);
}

RecordingOutput::~RecordingOutput() {
  if (file_ < 0) return;
  ::close(file_);
  ::unlink(part_.c_str());
}

void RecordingOutput::fail(int why) const {
  throw std::runtime_error(
      fmt::format("cannot write {}: {}", printable(path_), std::strerror(why)));
}

bool RecordingOutput::write(std::span<const std::uint8_t> bytes) {
  while (problem_ == 0 && !bytes.empty()) {
    const ssize_t written = ::write(file_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      problem_ = errno;
      break;
    }
    bytes_ += static_cast<std::uint64_t>(written);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return problem_ == 0;
}

recording::ByteSink RecordingOutput::sink() {
  return [this](std::span<const std::uint8_t> bytes) { return write(bytes); };
}

void RecordingOutput::commit() {
  if (problem_ != 0) fail(problem_);
  if (::close(std::exchange(file_, -1)) != 0) {
    const int why = errno;
    ::unlink(part_.c_str());
    fail(why);
  }
  // Without --force, what came to be there meanwhile is not overwritten.
  const int why = recording::put_in_place(part_, path_, replace_);
  if (why == 0) return;
  // It is whole, and may be the work of hours.
  const std::string lies = fmt::format("; what was written lies in {}", printable(part_));
  if (why == EEXIST) throw std::runtime_error(already_there(path_) + lies);
  throw std::runtime_error(
      fmt::format("cannot write {}: {}{}", printable(path_), std::strerror(why), lies));
}

}  // namespace skerry::client
