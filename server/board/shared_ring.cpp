#include "server/board/shared_ring.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

namespace skerry::server {
namespace {

constexpr mode_t kOwnerAlone = 0600;

Failure<std::string> refused(const std::string& name, const std::string& why) {
  return Failure{fmt::format("no shared memory {}: {}", name, why)};
}

// A descriptor that is closed unless it is kept.
class File {
 public:
  explicit File(int descriptor) : descriptor_(descriptor) {}
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  ~File() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  int get() const { return descriptor_; }
  int keep() { return std::exchange(descriptor_, -1); }

 private:
  int descriptor_;
};

// Unlinks what a dead server has left; empty, or why not.
std::string remove_stale(const std::string& name) {
  const File old(::shm_open(name.c_str(), O_RDWR | O_CLOEXEC, 0));
  if (old.get() < 0) return errno == ENOENT ? "" : std::strerror(errno);
  if (::flock(old.get(), LOCK_EX | LOCK_NB) != 0) {
    return errno == EWOULDBLOCK ? "another server of this host uses it" : std::strerror(errno);
  }
  ::shm_unlink(name.c_str());
  return {};
}

}  // namespace

Result<SharedRing, std::string> SharedRing::create(const std::string& name, std::size_t capacity) {
  const std::size_t size = board::ring_bytes(std::clamp(capacity, kMinBytes, kMaxBytes));
  if (const std::string why = remove_stale(name); !why.empty()) return refused(name, why);
  File file(::shm_open(name.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, kOwnerAlone));
  if (file.get() < 0) return refused(name, std::strerror(errno));
  const auto give_up = [&](int error) {
    ::shm_unlink(name.c_str());
    return refused(name, fmt::format("{} bytes: {}", size, std::strerror(error)));
  };
  if (::flock(file.get(), LOCK_EX | LOCK_NB) != 0) return give_up(errno);
  if (const int error = ::posix_fallocate(file.get(), 0, static_cast<off_t>(size)); error != 0) {
    return give_up(error);
  }
  void* const address = ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, file.get(), 0);
  if (address == MAP_FAILED) return give_up(errno);
  return SharedRing(name, file.keep(), {static_cast<std::uint8_t*>(address), size});
}

SharedRing::SharedRing(std::string name, int file, std::span<std::uint8_t> memory)
    : name_(std::move(name)), file_(file), memory_(memory) {
  writer_.emplace(memory_);
}

SharedRing::SharedRing(SharedRing&& other) noexcept
    : name_(std::move(other.name_)),
      file_(std::exchange(other.file_, -1)),
      memory_(std::exchange(other.memory_, {})),
      writer_(std::exchange(other.writer_, std::nullopt)) {}

SharedRing::~SharedRing() {
  if (file_ < 0) return;
  writer_->close();
  ::munmap(memory_.data(), memory_.size());
  ::shm_unlink(name_.c_str());
  ::close(file_);
}

}  // namespace skerry::server
