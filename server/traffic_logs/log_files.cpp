#include "server/traffic_logs/log_files.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "protocol/nmea/udp450.hpp"
#include "protocol/pcap/capture_reader.hpp"
#include "protocol/pcap/capture_stream.hpp"
#include "server/traffic_logs/csv_log.hpp"
#include "server/traffic_logs/line_splitter.hpp"
#include "server/traffic_logs/nmea_log.hpp"

namespace skerry::server {
namespace {

constexpr std::size_t kChunk = 64 << 10;

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

bool is_capture(std::string_view begin) {
  static constexpr std::array<std::string_view, 5> kMagic = {"\xD4\xC3\xB2\xA1", "\xA1\xB2\xC3\xD4",
                                                             "\x4D\x3C\xB2\xA1", "\xA1\xB2\x3C\x4D",
                                                             "\x0A\x0D\x0D\x0A"};
  for (const std::string_view magic : kMagic) {
    if (begin.starts_with(magic)) return true;
  }
  return false;
}

// A datagram of radar video may begin as a sentence does.
bool is_text(std::string_view text) {
  text = text.substr(0, text.find_first_of("\r\n"));
  return !text.empty() && std::string_view("!$\\").find(text[0]) != std::string_view::npos &&
         std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c <= '~'; });
}

std::string_view text_of(std::span<const std::uint8_t> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

Result<LogFileRead, std::string> read_capture_log(const std::string& path, TrackBook& book,
                                                  const std::function<void(double)>& progress) {
  LogFileRead read{.form = LogForm::capture};
  NmeaLog log(book);
  const auto counts = pcap::read_capture_file(
      path,
      [&](const pcap::Datagram& datagram) {
        std::string_view text = text_of(datagram.payload);
        if (nmea::is_udp450(datagram.payload)) {
          text.remove_prefix(nmea::kUdp450Header.size());
        } else if (!is_text(text)) {
          return;
        }
        ++read.lines;
        const auto line = [&](std::string_view each) { log.take(each, datagram.time); };
        LineSplitter lines(NmeaLog::kLongestLine);
        lines.feed(text, line, [&] { book.left_out().add(LeftOut::too_long); });
        lines.finish(line);
      },
      [&](double share) {
        if (progress) progress(share);
        return true;
      });
  log.finish();
  read.used = log.sentences();
  if (!counts) return Failure{counts.error().text};
  return read;
}

// A text: its first line says what it is.
class TextLog {
 public:
  explicit TextLog(TrackBook& book) : book_(book), nmea_(book) {}

  void feed(std::string_view bytes) {
    lines_.feed(
        bytes, [&](std::string_view line) { take(line); },
        [&] {
          ++read_.lines;
          book_.left_out().add(LeftOut::too_long);
        });
  }
  Result<LogFileRead, std::string> finish() {
    lines_.finish([&](std::string_view line) { take(line); });
    nmea_.finish();
    if (fault_) return Failure{*fault_};
    read_.form = csv_ ? LogForm::csv : LogForm::nmea;
    read_.used = csv_ ? csv_->rows() : nmea_.sentences();
    return read_;
  }
  bool failed() const { return fault_.has_value(); }

 private:
  void take(std::string_view line) {
    if (fault_) return;
    if (read_.lines++ == 0 && CsvLog::is_header(line)) {
      auto opened = CsvLog::open(line, book_);
      if (opened) {
        csv_.emplace(std::move(opened).value());
      } else {
        fault_ = opened.error();
      }
    } else if (csv_) {
      csv_->take(line);
    } else {
      nmea_.take(line);
    }
  }

  TrackBook& book_;
  LineSplitter lines_{CsvLog::kLongestRow};
  NmeaLog nmea_;
  std::optional<CsvLog> csv_;
  std::optional<std::string> fault_;
  LogFileRead read_;
};

}  // namespace

Result<LogFileRead, std::string> read_log_file(const std::string& path, TrackBook& book,
                                               const std::function<void(double)>& progress) {
  pcap::CaptureStream stream(path, [&](double share) {
    if (progress) progress(share);
    return true;
  });
  if (!stream.problem().empty()) return Failure{stream.problem()};
  const File file(stream.release(), &std::fclose);
  if (!file) return Failure{std::string("there is no memory to read it")};
  std::vector<char> chunk(kChunk);
  TextLog log(book);
  bool first = true;
  for (;;) {
    const std::size_t count = std::fread(chunk.data(), 1, chunk.size(), file.get());
    const std::string_view bytes(chunk.data(), count);
    if (first && is_capture(bytes)) return read_capture_log(path, book, progress);
    first = false;
    log.feed(bytes);
    if (count < chunk.size() || log.failed()) break;
  }
  auto read = log.finish();
  if (!stream.problem().empty()) return Failure{stream.problem()};
  return read;
}

}  // namespace skerry::server
