#include "server/track_tool/spoke_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <span>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "protocol/captures/importer.hpp"
#include "protocol/recording/position.hpp"
#include "protocol/recording/writer.hpp"
#include "protocol/wire/printable_text.hpp"
#include "protocol/wire/spoke_message.hpp"
#include "server/playback/play_request.hpp"

namespace skerry::server {
namespace {

using recording::Kind;
using recording::RecordingReader;

constexpr std::uint64_t kLookEvery = 1024;  // items between two looks at how far it is
constexpr const char* kReading = "reading the spokes";

[[noreturn]] void fail(const std::string& file, const std::string& why) {
  throw std::runtime_error(fmt::format("{}: {}", file, why));
}

// A file of our own, gone with this object.
class ImportedFile {
 public:
  ImportedFile() {
    std::error_code none;
    const auto folder = std::filesystem::temp_directory_path(none);
    if (none) fail("the system's temporary folder (TMPDIR)", none.message());
    path_ = (folder / "skerry_track_XXXXXX").string();
    const int file = ::mkstemp(path_.data());
    if (file < 0) fail(path_, fmt::format("cannot be made: {}", std::strerror(errno)));
    ::close(file);
  }
  ~ImportedFile() { ::unlink(path_.c_str()); }
  ImportedFile(const ImportedFile&) = delete;
  ImportedFile& operator=(const ImportedFile&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

bool begins_as_recording(const std::string& file) {
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) fail(file, "is a folder; expected a file");
  std::ifstream in(file, std::ios::binary);
  if (!in) fail(file, std::strerror(errno));
  std::array<char, 5> magic{};
  in.read(magic.data(), magic.size());
  return in && magic == std::array<char, 5>{'\x89', 'M', 'C', 'A', 'P'};
}

std::string views_text(const recording::Summary& summary) {
  std::string text;
  for (const auto& [topic, count] : summary.items) {
    if (topic.kind != Kind::spoke || count == 0) continue;
    text += fmt::format("{} radar {} view {}", text.empty() ? "" : ",", topic.radar, topic.view);
  }
  return text;
}

}  // namespace

SpokeFile::SpokeFile(const std::string& path, const ReadProgress& progress) : path_(path) {
  if (begins_as_recording(path) || path.ends_with(".mcap")) {
    open_recording(path, progress);
  } else {
    open_capture(progress);
  }
}

void SpokeFile::open_recording(const std::string& path, const ReadProgress& progress) {
  auto opened = RecordingReader::open(path, [&](double share) {
    if (progress) progress(share, "searching the file");
    return true;
  });
  if (!opened) throw std::runtime_error(printable(opened.error().to_string(), 2000));
  reader_.emplace(std::move(*opened));
  if (const auto& damage = reader_->summary().damage) {
    warnings_.push_back(
        fmt::format("{}; what can be read is used", printable(damage->to_string(), 2000)));
  }
}

void SpokeFile::open_capture(const ReadProgress& progress) {
  const ImportedFile imported;
  std::ofstream out(imported.path(), std::ios::binary);
  recording::RecordingWriter writer(
      [&](std::span<const std::uint8_t> bytes) {
        out.write(reinterpret_cast<const char*>(bytes.data()),
                  static_cast<std::streamsize>(bytes.size()));
        return out.good();
      },
      {});
  const auto report = captures::import_capture_file(path_, writer, [&](double share) {
    if (progress) progress(share, "reading the capture");
    return true;
  });
  if (!report) {
    throw std::runtime_error(fmt::format(
        "{}\nExpected a recording (.mcap), or a capture: pcap or pcapng, packed by gzip "
        "or not.",
        printable(report.error().to_string(), 2000)));
  }
  const bool whole = writer.finish();
  out.close();
  if (!whole || !out) fail(imported.path(), "there is no room for what the capture holds");
  if (report->damage) {
    warnings_.push_back(
        fmt::format("{}; what is before it is used", printable(report->damage->to_string(), 2000)));
  }
  open_recording(imported.path(), {});
}

SpokeFile::View SpokeFile::chosen(const SpokeChoice& choice) const {
  const recording::Summary& summary = reader_->summary();
  for (const auto& [topic, count] : summary.items) {  // in the order of radars and views
    if (topic.kind != Kind::spoke || count == 0) continue;
    if (choice.radar.value_or(topic.radar) == topic.radar &&
        choice.view.value_or(topic.view) == topic.view) {
      return {topic.radar, topic.view};
    }
  }
  const std::string there = views_text(summary);
  if (there.empty()) fail(path_, "it has no spokes");
  fail(path_, fmt::format("it has no spokes of{}{}; there are those of{}",
                          choice.radar ? fmt::format(" radar {}", *choice.radar) : "",
                          choice.view ? fmt::format(" view {}", *choice.view) : "", there));
}

wire::Hello SpokeFile::hello(std::uint32_t radar) const {
  wire::Hello hello = reader_->hello().value_or(wire::Hello());
  auto* radars = hello.mutable_radars();
  radars->erase(std::remove_if(radars->begin(), radars->end(),
                               [&](const auto& info) { return info.radar() != radar; }),
                radars->end());
  return hello;
}

double SpokeFile::beam_deg(std::uint32_t radar) const {
  const wire::Hello hello = this->hello(radar);
  return hello.radars().empty() ? 0.0 : hello.radars(0).beam_width_deg();
}

UtcTime SpokeFile::position(const std::string& text, const char* option) const {
  const auto wrong = [&](std::string_view why) {
    throw std::runtime_error(fmt::format("{}: {}", option, printable(why)));
  };
  const auto asked = recording::parse_position(text);
  if (!asked) wrong(asked.error());
  wire::Playback request;
  if (asked->is_mark()) {
    request.set_mark(asked->mark);
  } else {
    request.set_position_s(in_seconds(asked->since_begin));
  }
  const auto order = play_order(request, reader_->summary());
  if (!order) wrong(order.error().text());
  return *order->seek;
}

SpokesTaken SpokeFile::each_spoke(const SpokeChoice& choice,
                                  const std::function<void(const Spoke&)>& take,
                                  const ReadProgress& progress) const {
  const recording::Summary& summary = reader_->summary();
  const View view = chosen(choice);
  const UtcTime from = choice.from.empty() ? summary.begin : position(choice.from, "--from");
  std::optional<UtcTime> until;
  if (!choice.until.empty()) until = position(choice.until, "--until");
  if (until && *until <= from) throw std::runtime_error("--until: it is not behind --from");
  recording::ItemCursor cursor = reader_->items({{Kind::spoke, view.radar, view.view}});
  if (!choice.from.empty()) cursor.seek(from);

  const double length_s = in_seconds(until.value_or(summary.end) - from);
  SpokesTaken taken;
  wire::Spoke message;
  std::uint64_t items = 0;
  while (const auto item = cursor.next()) {
    if (until && item->time >= *until) break;
    if (progress && items++ % kLookEvery == 0 && length_s > 0.0) {
      progress(std::clamp(in_seconds(item->time - from) / length_s, 0.0, 1.0), kReading);
    }
    if (!message.ParseFromArray(item->bytes.data(), static_cast<int>(item->bytes.size()))) {
      ++taken.refused;
    } else if (const auto spoke = from_message(message)) {
      ++taken.spokes;
      take(*spoke);
    } else {
      ++taken.refused;
    }
  }
  taken.chunks = cursor.chunks_damaged();
  if (taken.spokes == 0) {
    fail(path_,
         fmt::format("there is no spoke of radar {} view {} in that part{}", view.radar, view.view,
                     taken.chunks + taken.refused > 0 ? " that can be read" : ""));
  }
  return taken;
}

}  // namespace skerry::server
