#include "server/replay/video_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <optional>
#include <span>
#include <stdexcept>

#include "protocol/recording/writer.hpp"
#include "protocol/wire/spoke_message.hpp"

namespace skerry::server {

class VideoFile::Impl {
 public:
  Impl(const std::string& path, const recording::RecordingReader& source, UtcTime zero)
      : path_(path),
        zero_(zero),
        file_(open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644)),
        others_(source.items(all_but_spokes(source))) {
    if (file_ < 0) fail();
    writer_.emplace([this](std::span<const std::uint8_t> bytes) { return write_all(bytes); },
                    recording::WriterOptions{});
    for (const recording::Attachment& document : source.summary().attachments) {
      writer_->attach(document);
    }
    other_ = others_.next();
    // Before any spoke, what is older than the recording: its Hello among it.
    add_others_until(source.summary().begin);
  }
  ~Impl() { close(file_); }

  void add(const Spoke& spoke) {
    const UtcTime time = zero_ + spoke.header.scenario_time.time_since_epoch();
    add_others_until(time);
    to_message(spoke, message_);
    bytes_ = message_.SerializeAsString();
    writer_->add({{recording::Kind::spoke, spoke.header.radar, spoke.header.view},
                  time,
                  {reinterpret_cast<const std::uint8_t*>(bytes_.data()), bytes_.size()}});
    check();
  }
  void finish() {
    while (other_) add_other();
    writer_->finish();
    check();
  }

 private:
  static std::vector<recording::Topic> all_but_spokes(const recording::RecordingReader& source) {
    std::vector<recording::Topic> topics;
    for (const auto& [topic, count] : source.summary().items) {
      if (topic.kind != recording::Kind::spoke) topics.push_back(topic);
    }
    return topics;
  }
  void add_other() {
    writer_->add(*other_);
    other_ = others_.next();
  }
  void add_others_until(UtcTime time) {
    while (other_ && other_->time <= time) add_other();
  }
  bool write_all(std::span<const std::uint8_t> bytes) {
    while (!bytes.empty()) {
      const ssize_t wrote = write(file_, bytes.data(), bytes.size());
      if (wrote < 0 && errno == EINTR) continue;
      if (wrote < 0) return false;
      bytes = bytes.subspan(static_cast<std::size_t>(wrote));
    }
    return true;
  }
  void check() {
    if (writer_->counts().items_dropped > 0) fail();
  }
  [[noreturn]] void fail() {
    throw std::runtime_error(fmt::format("{}: {}", path_, std::strerror(errno)));
  }

  std::string path_;
  UtcTime zero_;
  wire::Spoke message_;
  std::string bytes_;
  int file_;
  recording::ItemCursor others_;
  std::optional<recording::Item> other_;
  std::optional<recording::RecordingWriter> writer_;
};

VideoFile::VideoFile(const std::string& path, const recording::RecordingReader& source,
                     UtcTime zero)
    : impl_(std::make_unique<Impl>(path, source, zero)) {}
VideoFile::~VideoFile() = default;
void VideoFile::add(const Spoke& spoke) { impl_->add(spoke); }
void VideoFile::finish() { impl_->finish(); }

}  // namespace skerry::server
