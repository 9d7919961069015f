// RecordingFolder: the folder a recorder writes into, its lock, and which files there are its own.
#pragma once

#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace skerry::server {

// An open file of the system's, closed at the end of its life.
class FileDescriptor {
 public:
  FileDescriptor() = default;
  explicit FileDescriptor(int number) : number_(number) {}
  ~FileDescriptor() { close(); }
  FileDescriptor(FileDescriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  FileDescriptor& operator=(FileDescriptor&& other) noexcept {
    if (this == &other) return *this;
    close();
    number_ = std::exchange(other.number_, -1);
    return *this;
  }

  bool is_open() const { return number_ >= 0; }
  int get() const { return number_; }
  void close() {
    if (number_ >= 0) ::close(std::exchange(number_, -1));
  }

 private:
  int number_ = -1;  // -1: none
};

// Bytes free for this process where a folder is, or would be made; nothing if the system does not
// say.  `folder` absolute.
std::optional<std::uint64_t> free_bytes_at(const std::string& folder);

// Whether an errno says that the disk, or somebody's share of it, is full.
bool is_want_of_room(int error);

// An operation on a file that failed, with the file's name.
class FolderError : public std::runtime_error {
 public:
  explicit FolderError(const std::string& text, bool for_want_of_room = false)
      : std::runtime_error(text), no_room(for_want_of_room) {}
  const bool no_room;  // try again when there is some
};

// Holds the lock `.skerry-recorder.lock` for as long as it lives: two recorders would remove each
// other's files.  `.skerry-recorder` lists the files made here, oldest first, one a line.
// Thread: one at a time; waits for the disk.
class RecordingFolder {
 public:
  // Makes the folder where it is not there.  `folder` absolute.
  // Error: FolderError if it cannot be made or written, or another recorder has it.
  explicit RecordingFolder(std::string folder);

  struct NewFile {
    FileDescriptor file;
    std::string name;  // without folder
  };
  // A file that was not there before: `name`, or, in a series, the next number from `number` on
  // that is free, which is put there.
  // Error: FolderError if it cannot be made; with `series` false, if there is one of that name.
  NewFile create(const std::string& name, std::uint32_t& number, bool series);

  // Removes files of the list, oldest first and never `present`, until all of the list have at most
  // `keep_bytes` together and none is older than `keep_time`; 0: whatever they have.
  // Returns the names removed.  A file that replaced a listed one is not removed.
  std::vector<std::string> remove_old(std::uint64_t keep_bytes, std::chrono::seconds keep_time,
                                      const std::string& present);

  // Whether the file that is open is still the one of that name here.
  bool has(const FileDescriptor& file, const std::string& name) const;
  // Bytes free for this process on the folder's disk; nothing if the system does not say.
  std::optional<std::uint64_t> free_bytes() const;
  // Writes the folder's names to the disk.
  void sync() const;

 private:
  // A line of the list: "NAME\tIDENTITY".
  struct Listed {
    std::string name;
    std::string identity;  // inode and time of birth
  };
  std::vector<Listed> read_list() const;
  void write_list(const std::vector<Listed>& files) const;
  void append_to_list(const Listed& file) const;

  std::string folder_;
  FileDescriptor directory_, lock_;
};

}  // namespace skerry::server
