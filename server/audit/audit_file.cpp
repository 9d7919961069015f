#include "server/audit/audit_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace skerry::server {
namespace {

constexpr const char* kNoEntry =
    "its end is no entry of an audit file; give another file, and keep this one (`skerry audit "
    "verify` says more)";

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& why) {
  throw std::runtime_error(fmt::format("--audit: {}: {}", file.string(), why));
}

}  // namespace

AuditFile::AuditFile(std::filesystem::path path, Kind kind) : path_(std::move(path)) {
  constexpr mode_t kMode = 0640;
  descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, kMode);
  if (descriptor_ < 0) refuse(path_, fmt::format("cannot be opened: {}", std::strerror(errno)));
  try {
    look_at_end(kind);
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

AuditFile::~AuditFile() { ::close(descriptor_); }

void AuditFile::look_at_end(Kind kind) {
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
    refuse(path_, "another server writes to it; give each its own file");
  }
  struct stat about {};
  if (::fstat(descriptor_, &about) != 0 || !S_ISREG(about.st_mode)) refuse(path_, "is no file");
  const auto size = static_cast<std::uint64_t>(about.st_size);
  if (kind == Kind::next_only && size > 0) {
    refuse(path_, "stands where the next file should be, and is not empty; move it away");
  }
  const std::string tail = read_tail(size, std::min<std::uint64_t>(size, 2 * kMostAuditLine));
  const std::size_t end = tail.rfind('\n') + 1;  // 0: there is no line
  size_ = size - (tail.size() - end);
  bytes_cut_ = size - size_;
  if (bytes_cut_ > kMostAuditLine) refuse(path_, kNoEntry);
  if (end > 0) {
    const std::size_t begin = end > 1 ? tail.rfind('\n', end - 2) + 1 : 0;
    const auto head = read_audit_head(std::string_view(tail).substr(begin, end - 1 - begin));
    if (!head) refuse(path_, kNoEntry);
    head_ = *head;
  } else if (size > 0) {
    // The first entry was being written.
    constexpr std::string_view kBegin = "{\"n\":";
    if (!kBegin.starts_with(tail.substr(0, kBegin.size()))) refuse(path_, kNoEntry);
    size_ = 0;
    bytes_cut_ = size;
  }
  if (bytes_cut_ > 0 && !cut()) {
    refuse(path_, fmt::format("cannot be cut: {}", std::strerror(errno)));
  }
}

std::string AuditFile::read_tail(std::uint64_t size, std::uint64_t bytes) const {
  std::string tail(static_cast<std::size_t>(bytes), '\0');
  const ssize_t got =
      ::pread(descriptor_, tail.data(), tail.size(), static_cast<off_t>(size - bytes));
  if (got != static_cast<ssize_t>(bytes)) {
    refuse(path_, fmt::format("cannot be read: {}", std::strerror(errno)));
  }
  return tail;
}

bool AuditFile::is_in_place() const {
  struct stat mine {
  }, there{};
  return ::fstat(descriptor_, &mine) == 0 && ::stat(path_.c_str(), &there) == 0 &&
         mine.st_dev == there.st_dev && mine.st_ino == there.st_ino;
}

bool AuditFile::cut() {
  const int why = errno;
  if (::ftruncate(descriptor_, static_cast<off_t>(size_)) != 0) return false;
  errno = why;
  return true;
}

bool AuditFile::append(std::string_view lines) {
  if (has_rest_ && !cut()) return false;
  has_rest_ = false;
  std::size_t done = 0;
  while (done < lines.size()) {
    const ssize_t wrote = ::write(descriptor_, lines.data() + done, lines.size() - done);
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote <= 0) break;
    done += static_cast<std::size_t>(wrote);
  }
  if (done < lines.size() || ::fdatasync(descriptor_) != 0) {
    const int why = errno;
    has_rest_ = !cut();
    errno = why;
    return false;
  }
  size_ += lines.size();
  return true;
}

}  // namespace skerry::server
