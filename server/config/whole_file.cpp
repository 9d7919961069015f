#include "server/config/whole_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>

namespace skerry::server {
namespace {

namespace fs = std::filesystem;

std::runtime_error cannot(const char* what, const fs::path& file) {
  return std::runtime_error(fmt::format("cannot {} {}: {}", what, file.string(), strerror(errno)));
}

// An open file, closed at its end.
class OpenFile {
 public:
  OpenFile(const fs::path& file, int flags, mode_t mode)
      : number_(::open(file.c_str(), flags | O_CLOEXEC, mode)), file_(file) {
    if (number_ < 0) throw cannot("open", file);
  }
  ~OpenFile() { ::close(number_); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  void write_all(std::string_view text) {
    while (!text.empty()) {
      const ssize_t written = ::write(number_, text.data(), text.size());
      if (written < 0 && errno != EINTR) throw cannot("write", file_);
      if (written > 0) text.remove_prefix(static_cast<std::size_t>(written));
    }
    sync();
  }
  void sync() {
    if (::fsync(number_) != 0) throw cannot("write", file_);
  }
  void lock() {
    if (::flock(number_, LOCK_EX) != 0) throw cannot("lock", file_);
  }

 private:
  int number_;
  fs::path file_;
};

}  // namespace

void write_whole(const fs::path& file, std::string_view text, mode_t mode) {
  const fs::path part = file.string() + ".part";
  try {
    OpenFile(part, O_WRONLY | O_CREAT | O_TRUNC, mode).write_all(text);
    if (::rename(part.c_str(), file.c_str()) != 0) throw cannot("replace", file);
  } catch (...) {
    std::error_code ignored;
    fs::remove(part, ignored);
    throw;
  }
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  OpenFile(folder, O_RDONLY | O_DIRECTORY, 0).sync();
}

void while_locked(const fs::path& file, const std::function<void()>& change) {
  OpenFile lock(file.string() + ".lock", O_RDWR | O_CREAT, S_IRUSR | S_IWUSR);
  lock.lock();
  change();
}

}  // namespace skerry::server
