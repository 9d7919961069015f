#include "server/recorder/recording_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/statvfs.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <set>
#include <string_view>

#include "server/recorder/file_names.hpp"

namespace skerry::server {
namespace {

constexpr const char* kLockName = ".skerry-recorder.lock";
constexpr const char* kListName = ".skerry-recorder";
constexpr const char* kNewListName = ".skerry-recorder.new";
constexpr std::size_t kMaxList = 16u << 20;  // bytes read of a list
constexpr std::uint32_t kMaxNumber = 1'000'000;

[[noreturn]] void fail(const std::string& what, int error) {
  throw FolderError(what + ": " + std::strerror(error), is_want_of_room(error));
}

// A list may hold any name; only names that this recorder gives are taken.
bool is_recording_name(std::string_view line) {
  return line.size() > kFileEnding.size() && line.ends_with(kFileEnding) &&
         line.find('/') == std::string_view::npos && line.front() != '.';
}

// nullopt if the system does not say, or it is no plain file.
std::optional<struct statx> status_of(int directory, const std::string& name, int flags) {
  struct statx status {};
  if (::statx(directory, name.c_str(), AT_SYMLINK_NOFOLLOW | flags, STATX_BASIC_STATS | STATX_BTIME,
              &status) != 0 ||
      !S_ISREG(status.stx_mode)) {
    return std::nullopt;
  }
  return status;
}

// Tells a file from another that took its name.
std::string identity_of(const struct statx& status) {
  const bool has_birth = (status.stx_mask & STATX_BTIME) != 0;
  return fmt::format("{}:{}.{:09}", status.stx_ino, has_birth ? status.stx_btime.tv_sec : 0,
                     has_birth ? status.stx_btime.tv_nsec : 0);
}

std::uint64_t free_bytes_of(const struct statvfs& disk) {
  return std::uint64_t{disk.f_bavail} * disk.f_frsize;
}

bool write_all(int file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(file, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

}  // namespace

std::optional<std::uint64_t> free_bytes_at(const std::string& folder) {
  struct statvfs disk {};
  std::filesystem::path there = folder;
  while (::statvfs(there.c_str(), &disk) != 0) {
    if (errno != ENOENT || !there.has_relative_path()) return std::nullopt;
    there = there.parent_path();
  }
  return free_bytes_of(disk);
}

bool is_want_of_room(int error) { return error == ENOSPC || error == EDQUOT; }

RecordingFolder::RecordingFolder(std::string folder) : folder_(std::move(folder)) {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error) fail(folder_ + ": cannot be made", error.value());
  directory_ = FileDescriptor(::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!directory_.is_open()) fail(folder_ + ": cannot be opened", errno);
  lock_ = FileDescriptor(::openat(directory_.get(), kLockName,
                                  O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK, 0644));
  if (!lock_.is_open()) fail(folder_ + ": cannot be written", errno);
  if (::flock(lock_.get(), LOCK_EX | LOCK_NB) != 0) {
    if (errno == EWOULDBLOCK) {
      throw FolderError(folder_ +
                        ": another recorder writes here; give this one a folder of its own");
    }
    fail(folder_ + ": cannot be locked", errno);
  }
}

RecordingFolder::NewFile RecordingFolder::create(const std::string& name, std::uint32_t& number,
                                                 bool series) {
  for (; number <= kMaxNumber; ++number) {
    const std::string file = file_name(name, number);
    FileDescriptor made(::openat(directory_.get(), file.c_str(),
                                 O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0644));
    if (made.is_open()) {
      // One that is not in the list is never removed, which is no reason not to record.
      if (const auto status = status_of(made.get(), "", AT_EMPTY_PATH)) {
        append_to_list({file, identity_of(*status)});
      }
      return {std::move(made), file};
    }
    if (errno != EEXIST) fail(folder_ + "/" + file + ": cannot be made", errno);
    if (!series) {
      throw FolderError(folder_ + "/" + file +
                        ": is there already; nothing is overwritten, so choose another name");
    }
  }
  throw FolderError(fmt::format("{}: has {} files of the name {}", folder_, kMaxNumber, name));
}

std::vector<RecordingFolder::Listed> RecordingFolder::read_list() const {
  std::vector<Listed> files;
  FileDescriptor list(
      ::openat(directory_.get(), kListName, O_RDONLY | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK));
  std::string text;
  std::string buffer(64 << 10, '\0');
  while (list.is_open() && text.size() < kMaxList) {
    const ssize_t size = ::read(list.get(), buffer.data(), buffer.size());
    if (size <= 0) break;
    text.append(buffer, 0, static_cast<std::size_t>(size));
  }
  std::set<std::string> known;
  // A last line that was cut short is none.
  for (std::size_t begin = 0, end; (end = text.find('\n', begin)) != std::string::npos;
       begin = end + 1) {
    const std::string line = text.substr(begin, end - begin);
    const auto tab = line.find('\t');
    if (tab == std::string::npos || !is_recording_name(std::string_view(line).substr(0, tab))) {
      continue;
    }
    if (known.insert(line).second) files.push_back({line.substr(0, tab), line.substr(tab + 1)});
  }
  return files;
}

void RecordingFolder::append_to_list(const Listed& file) const {
  FileDescriptor list(::openat(directory_.get(), kListName,
                               O_WRONLY | O_CREAT | O_APPEND | O_NOFOLLOW | O_CLOEXEC, 0644));
  // The line break before it ends a line that a full disk cut short.
  if (list.is_open()) {
    static_cast<void>(write_all(list.get(), "\n" + file.name + "\t" + file.identity + "\n"));
  }
}

void RecordingFolder::write_list(const std::vector<Listed>& files) const {
  std::string text;
  for (const Listed& file : files) text += file.name + "\t" + file.identity + "\n";
  FileDescriptor list(::openat(directory_.get(), kNewListName,
                               O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0644));
  if (!list.is_open() || !write_all(list.get(), text)) {
    ::unlinkat(directory_.get(), kNewListName, 0);
    return;  // the old one still holds; names of removed files in it do no harm
  }
  ::fdatasync(list.get());
  ::renameat(directory_.get(), kNewListName, directory_.get(), kListName);
}

std::vector<std::string> RecordingFolder::remove_old(std::uint64_t keep_bytes,
                                                     std::chrono::seconds keep_time,
                                                     const std::string& present) {
  if (keep_bytes == 0 && keep_time.count() == 0) return {};
  struct Known {
    Listed listed;
    std::uint64_t bytes = 0;
    std::int64_t changed = 0;
  };
  std::vector<Known> files;
  std::uint64_t total = 0;
  for (Listed& listed : read_list()) {
    const auto status = status_of(directory_.get(), listed.name, 0);
    if (!status || identity_of(*status) != listed.identity) continue;
    files.push_back({std::move(listed), status->stx_size, status->stx_mtime.tv_sec});
    total += files.back().bytes;
  }
  std::vector<std::string> removed;
  std::vector<Listed> kept;
  const std::int64_t now = std::time(nullptr);
  for (const Known& file : files) {
    const std::string& name = file.listed.name;
    const bool too_much = keep_bytes > 0 && total > keep_bytes;
    const bool too_old = keep_time.count() > 0 && now - file.changed > keep_time.count();
    if (name != present && (too_much || too_old) &&
        ::unlinkat(directory_.get(), name.c_str(), 0) == 0) {
      total -= file.bytes;
      removed.push_back(name);
    } else {
      kept.push_back(file.listed);
    }
  }
  if (!removed.empty()) write_list(kept);
  return removed;
}

bool RecordingFolder::has(const FileDescriptor& file, const std::string& name) const {
  const auto open = status_of(file.get(), "", AT_EMPTY_PATH);
  const auto there = status_of(directory_.get(), name, 0);
  return open && there && open->stx_ino == there->stx_ino &&
         open->stx_dev_major == there->stx_dev_major && open->stx_dev_minor == there->stx_dev_minor;
}

std::optional<std::uint64_t> RecordingFolder::free_bytes() const {
  struct statvfs disk {};
  if (::fstatvfs(directory_.get(), &disk) != 0) return std::nullopt;
  return free_bytes_of(disk);
}

void RecordingFolder::sync() const { ::fsync(directory_.get()); }

}  // namespace skerry::server
