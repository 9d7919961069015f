#include "protocol/recording/input_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "protocol/wire/byte_order.hpp"

namespace skerry::recording {

Result<InputFile, RecordingError> InputFile::open(const std::string& path) {
  // Without O_NONBLOCK a pipe that nobody writes would hold us up.
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) {
    return Failure{RecordingError{path, 0, fmt::format("cannot be opened: {}", strerror(errno))}};
  }
  struct stat status {};
  if (::fstat(file, &status) != 0 || !S_ISREG(status.st_mode)) {
    ::close(file);
    return Failure{RecordingError{path, 0, "is no regular file, expected a recording"}};
  }
  return InputFile(path, file, static_cast<std::uint64_t>(status.st_size));
}

InputFile::InputFile(InputFile&& other) noexcept
    : path_(std::move(other.path_)), file_(std::exchange(other.file_, -1)), size_(other.size_) {}

InputFile::~InputFile() {
  if (file_ >= 0) ::close(file_);
}

std::size_t InputFile::read(std::uint64_t offset, std::span<std::uint8_t> out) const {
  std::size_t done = 0;
  while (done < out.size()) {
    const ssize_t got =
        ::pread(file_, out.data() + done, out.size() - done, static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    done += static_cast<std::size_t>(got);
  }
  return done;
}

bool InputFile::read_all(std::uint64_t offset, std::size_t size, Bytes& out) const {
  if (offset > size_ || size > size_ - offset) return false;
  out.resize(size);
  return read(offset, out) == size;
}

bool InputFile::read_all(std::uint64_t offset, std::span<std::uint8_t> out) const {
  return offset <= size_ && out.size() <= size_ - offset && read(offset, out) == out.size();
}

std::span<const std::uint8_t> FileWindow::at(std::uint64_t offset, std::size_t size) {
  const auto window = from(offset, size);
  return window.first(std::min(size, window.size()));
}

std::span<const std::uint8_t> FileWindow::from(std::uint64_t offset, std::size_t least) {
  least = std::min(least, kMaxWindow);
  if (offset < begin_ || offset + least > begin_ + bytes_.size()) {
    if (offset >= file_->size()) return {};
    const auto left = file_->size() - offset;
    bytes_.resize(static_cast<std::size_t>(std::min<std::uint64_t>(left, kMaxWindow)));
    begin_ = offset;
    bytes_.resize(file_->read(offset, bytes_));
    bytes_read_ += bytes_.size();
  }
  return std::span<const std::uint8_t>(bytes_).subspan(static_cast<std::size_t>(offset - begin_));
}

std::optional<RecordPlace> record_at(FileWindow& window, std::uint64_t offset, std::uint64_t end) {
  ByteReader head(window.at(offset, mcap::kRecordHead));
  RecordPlace place;
  place.op = static_cast<mcap::Op>(head.octet());
  place.length = head.little_endian<std::uint64_t>();
  place.offset = offset;
  place.content = offset + mcap::kRecordHead;
  if (head.truncated() || place.content > end || place.length > end - place.content) {
    return std::nullopt;
  }
  return place;
}

}  // namespace skerry::recording
