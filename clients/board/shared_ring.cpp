#include "clients/board/shared_ring.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string_view>

#include "protocol/wire/printable_text.hpp"

namespace skerry::client {
namespace {

constexpr std::string_view kPrefix = "/skerry-board-";
constexpr std::size_t kLongestRingName = 64;

bool is_ring_name(std::string_view name) {
  const auto allowed = [](char c) { return (c >= '0' && c <= '9') || c == '-'; };
  return name.size() > kPrefix.size() && name.size() <= kLongestRingName &&
         name.starts_with(kPrefix) &&
         std::all_of(name.begin() + kPrefix.size(), name.end(), allowed);
}

struct File {
  int descriptor = -1;
  ~File() {
    if (descriptor >= 0) ::close(descriptor);
  }
};

}  // namespace

void SharedRing::Unmap::operator()(const std::uint8_t* memory) const {
  ::munmap(const_cast<std::uint8_t*>(memory), size);
}

ClientResult<SharedRing> SharedRing::open(const std::string& name, std::uint64_t bytes) {
  if (!is_ring_name(name)) {
    return failure(ClientErrorKind::malformed,
                   fmt::format("the server names '{}' as its ring in shared memory; expected {} "
                               "and digits",
                               printable(name, kLongestRingName), kPrefix));
  }
  if (bytes <= board::kRingHeader || bytes > kMaxRingBytes) {
    return failure(ClientErrorKind::malformed,
                   fmt::format("the server says that its ring has {} bytes; expected {} to {}",
                               bytes, board::kRingHeader + 1, kMaxRingBytes));
  }
  const auto refused = [&](const std::string& why) {
    return failure(ClientErrorKind::unreachable,
                   fmt::format("cannot map the shared memory {}: {}", name, why));
  };
  const File file{::shm_open(name.c_str(), O_RDONLY | O_CLOEXEC, 0)};
  if (file.descriptor < 0) return refused(std::strerror(errno));
  struct stat found {};
  if (::fstat(file.descriptor, &found) != 0) return refused(std::strerror(errno));
  if (found.st_uid != ::geteuid() && found.st_uid != 0) {
    return refused(fmt::format("it belongs to user {}", found.st_uid));
  }
  if (found.st_size < 0 || static_cast<std::uint64_t>(found.st_size) < bytes) {
    return refused(fmt::format("it has {} bytes of the {} the server said", found.st_size, bytes));
  }
  void* const address = ::mmap(nullptr, bytes, PROT_READ, MAP_SHARED, file.descriptor, 0);
  if (address == MAP_FAILED) return refused(std::strerror(errno));
  Memory memory(static_cast<const std::uint8_t*>(address), Unmap{bytes});
  auto reader = board::SweepRingReader::open({memory.get(), bytes});
  if (!reader) {
    return failure(
        ClientErrorKind::malformed,
        fmt::format("the shared memory {} is no ring of a version this library knows", name));
  }
  return SharedRing(std::move(memory), std::move(*reader));
}

}  // namespace skerry::client
