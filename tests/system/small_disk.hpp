// SmallDisk: a disk that a test can fill.
#pragma once

#include <sys/mount.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

namespace skerry::system_test {

// A tmpfs of a few MiB, that is there while the object lives.
class SmallDisk {
 public:
  static constexpr const char* kNeeds = "needs to mount a tmpfs: run as root";

  explicit SmallDisk(std::string folder, const std::string& options = "size=6m")
      : folder_(std::move(folder)) {
    std::filesystem::create_directory(folder_);
    is_there_ = ::mount("none", folder_.c_str(), "tmpfs", 0, options.c_str()) == 0;
  }
  ~SmallDisk() {
    if (is_there_) ::umount2(folder_.c_str(), MNT_DETACH);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

  bool is_there() const { return is_there_; }
  std::string path(const std::string& name) const { return folder_ + "/" + name; }
  // A file of somebody else's, which takes all the room there is; or none but its name.
  void fill() const {
    std::ofstream file(path("ballast"));
    while (file << std::string(4096, 'x') << std::flush) continue;
  }
  void take_a_name() const { std::ofstream(path("ballast")) << 'x'; }
  void make_room() const { std::filesystem::remove(path("ballast")); }

 private:
  std::string folder_;
  bool is_there_ = false;
};

}  // namespace skerry::system_test
