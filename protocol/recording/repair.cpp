#include "protocol/recording/repair.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <optional>

#include "protocol/recording/compression.hpp"
#include "protocol/recording/item_cursor.hpp"
#include "protocol/recording/open_recording.hpp"
#include "protocol/recording/put_in_place.hpp"
#include "protocol/recording/writer.hpp"

namespace skerry::recording {
namespace {

RecordingError error_of(const std::string& path, std::string_view what) {
  return {path, 0, fmt::format("{}: {}", what, strerror(errno))};
}

// A file beside its place, which it takes when it is whole; before that it goes.
class NewFile {
 public:
  explicit NewFile(std::string place)
      : place_(std::move(place)),
        path_(fmt::format("{}.{}.part", place_, getpid())),
        file_(::open(path_.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0644)) {}
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;
  ~NewFile() {
    if (file_ < 0) return;
    ::close(file_);
    if (!whole_) ::unlink(path_.c_str());
  }

  bool is_open() const { return file_ >= 0; }
  bool write(std::span<const std::uint8_t> bytes) {
    while (!bytes.empty()) {
      const ssize_t done = ::write(file_, bytes.data(), bytes.size());
      if (done < 0 && errno == EINTR) continue;
      if (done <= 0) return false;
      bytes = bytes.subspan(static_cast<std::size_t>(done));
    }
    return true;
  }
  // Fails if its place is taken, or the disk fails.
  std::optional<RecordingError> put_in_place() {
    if (::fsync(file_) != 0) return error_of(place_, "cannot be written");
    // From here on it stays, whatever its name.
    whole_ = true;
    errno = recording::put_in_place(path_, place_, false);
    if (errno == 0) return std::nullopt;
    RecordingError error = error_of(place_, "cannot be put in place");
    error.text += fmt::format("; what was made lies in {}", path_);
    return error;
  }

 private:
  std::string place_;
  std::string path_;
  int file_ = -1;
  bool whole_ = false;
};

WriterOptions options_of(const Summary& summary) {
  WriterOptions options;
  options.compression =
      compression_of_mcap_name(summary.compression == "none" ? "" : summary.compression)
          .value_or(Compression::lz4);
  options.compact = summary.compact;
  return options;
}

// Copies all items.  False: given up.
bool copy(ItemCursor::Impl& from, const Summary& summary, RecordingWriter& to,
          const RecordingReader::Progress& progress) {
  const double length = std::max(in_seconds(summary.end - summary.begin), 1e-9);
  std::uint64_t copied = 0;
  while (const auto item = from.next()) {
    to.add(*item);
    if (progress && ++copied % 4096 == 0 &&
        !progress(std::clamp(in_seconds(item->time - summary.begin) / length, 0.0, 1.0))) {
      return false;
    }
  }
  return true;
}

}  // namespace

Result<RepairReport, RecordingError> repair(const std::string& from, const std::string& to,
                                            const RecordingReader::Progress& progress) {
  const auto recording = open_recording(from, progress);
  if (!recording) return Failure{recording.error()};
  const Summary& summary = (*recording)->summary;
  if (::access(to.c_str(), F_OK) == 0) return Failure{RecordingError{to, 0, "exists already"}};
  NewFile file(to);
  if (!file.is_open()) return Failure{error_of(to, "cannot be made")};

  std::optional<RecordingError> write_error;
  RecordingWriter writer(
      [&](std::span<const std::uint8_t> bytes) {
        if (!write_error && !file.write(bytes)) write_error = error_of(to, "cannot be written");
        return !write_error;
      },
      options_of(summary));
  ItemCursor::Impl cursor(*recording, {});
  if (!copy(cursor, summary, writer, progress)) {
    return Failure{RecordingError{from, 0, "given up"}};
  }
  for (const Attachment& attachment : summary.attachments) writer.attach(attachment);
  writer.finish();
  if (write_error) return Failure{*write_error};

  const FileIndex& index = (*recording)->index;
  RepairReport report;
  report.items = writer.counts().items;
  report.chunks_damaged = index.chunks_unreadable + cursor.chunks_damaged();
  report.chunks_kept =
      index.chunks.size() - std::min<std::uint64_t>(cursor.chunks_damaged(), index.chunks.size());
  report.bytes_left_out = index.bytes_unreadable + cursor.bytes_damaged();
  report.was_whole = !summary.damage && cursor.chunks_damaged() == 0;
  if (report.items == 0 && !report.was_whole) {
    return Failure{summary.damage ? *summary.damage : *cursor.damage()};
  }
  if (auto error = file.put_in_place()) return Failure{*std::move(error)};
  return report;
}

}  // namespace skerry::recording
