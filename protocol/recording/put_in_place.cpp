#include "protocol/recording/put_in_place.hpp"

#include <fcntl.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstdio>

namespace skerry::recording {
namespace {

bool unable(int why) { return why == EINVAL || why == ENOSYS || why == EPERM || why == EOPNOTSUPP; }

}  // namespace

int put_in_place(const std::string& part, const std::string& place, bool replace) {
  if (!replace) {
    if (::renameat2(AT_FDCWD, part.c_str(), AT_FDCWD, place.c_str(), RENAME_NOREPLACE) == 0) {
      return 0;
    }
    if (!unable(errno)) return errno;
    // A link that leads nowhere is there too.
    struct stat status {};
    if (::lstat(place.c_str(), &status) == 0) return EEXIST;
    if (errno != ENOENT) return errno;
  }
  return std::rename(part.c_str(), place.c_str()) == 0 ? 0 : errno;
}

}  // namespace skerry::recording
