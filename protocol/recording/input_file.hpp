// InputFile: a file that is read in places, whatever others do to it meanwhile; and the records of
// MCAP in it, one after the other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "protocol/quantity/result.hpp"
#include "protocol/recording/item.hpp"
#include "protocol/recording/mcap_records.hpp"
#include "protocol/wire/wire_error.hpp"

namespace skerry::recording {

// Thread: any.
class InputFile {
 public:
  // Error: it cannot be opened, or is no regular file.
  static Result<InputFile, RecordingError> open(const std::string& path);
  InputFile(InputFile&& other) noexcept;
  InputFile& operator=(InputFile&&) = delete;
  ~InputFile();

  const std::string& path() const { return path_; }
  std::uint64_t size() const { return size_; }  // when it was opened
  // How many octets of `out` could be filled: fewer at the end, and where it cannot be read.
  std::size_t read(std::uint64_t offset, std::span<std::uint8_t> out) const;
  // All or nothing.
  bool read_all(std::uint64_t offset, std::size_t size, Bytes& out) const;
  bool read_all(std::uint64_t offset, std::span<std::uint8_t> out) const;

  RecordingError error(std::uint64_t offset, std::string text) const {
    return {path_, offset, std::move(text)};
  }

 private:
  InputFile(std::string path, int file, std::uint64_t size)
      : path_(std::move(path)), file_(file), size_(size) {}
  std::string path_;
  int file_ = -1;
  std::uint64_t size_ = 0;
};

// Octets from a place on, by a window that moves forward.  Thread: one at a time.
class FileWindow {
 public:
  explicit FileWindow(const InputFile& file) : file_(&file) {}
  // The `size` octets at `offset`, at most kMaxWindow; fewer at the file's end.  Valid until the
  // next call.
  std::span<const std::uint8_t> at(std::uint64_t offset, std::size_t size);
  // All that the window holds from `offset` on, and at least the `least` octets that at() gives:
  // whoever goes on by small steps reads each octet of the file about once.  Valid as of at().
  std::span<const std::uint8_t> from(std::uint64_t offset, std::size_t least);
  static constexpr std::size_t kMaxWindow = 256 << 10;
  std::uint64_t bytes_read() const { return bytes_read_; }  // of the file, until now

 private:
  const InputFile* file_;
  Bytes bytes_;
  std::uint64_t begin_ = 0;  // of the window in the file
  std::uint64_t bytes_read_ = 0;
};

// The place of a record.
struct RecordPlace {
  mcap::Op op{};
  std::uint64_t offset = 0;   // of its head
  std::uint64_t content = 0;  // of what follows it
  std::uint64_t length = 0;   // of that
  std::uint64_t end() const { return content + length; }
};
// The record at `offset` if it ends before `end`, whatever its kind.
std::optional<RecordPlace> record_at(FileWindow& window, std::uint64_t offset, std::uint64_t end);

}  // namespace skerry::recording
