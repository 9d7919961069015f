#include "protocol/captures/exporter.hpp"

#include <fmt/format.h>

#include <array>

#include "protocol/asterix/cat240_stream.hpp"
#include "protocol/captures/navico_export.hpp"
#include "protocol/nmea/motion_sentences.hpp"
#include "protocol/nmea/position_sentences.hpp"
#include "protocol/wire/own_ship_place.hpp"
#include "protocol/wire/spoke_message.hpp"

namespace skerry::captures {
namespace {

using recording::Kind;
using recording::RecordingError;
using recording::Topic;

// Documentation addresses (RFC 5737): nobody's.
constexpr Ipv4Endpoint kSender{ipv4(192, 0, 2, 1), 8600};
constexpr Ipv4Endpoint kCat240Group{ipv4(239, 192, 43, 78), 8600};
constexpr Ipv4Endpoint kNmea{ipv4(192, 0, 2, 255), 10110};
constexpr std::uint64_t kLookEvery = 1024;  // items
constexpr Duration kNmeaEvery = std::chrono::seconds(1);

template <typename Message>
std::optional<Message> parsed(std::span<const std::uint8_t> bytes) {
  Message message;
  if (!message.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) return std::nullopt;
  return message;
}

// The two kinds of capture behind one door.
class SpokeSink {
 public:
  SpokeSink(const ExportOptions& options, pcap::PcapWriter& out) : out_(out) {
    if (options.format == ExportFormat::navico) {
      navico_.emplace(options.model, out);
    } else {
      Cat240StreamShape shape;
      shape.options.source.sic = static_cast<std::uint8_t>(options.radar);
      cat240_.emplace(shape);
    }
  }

  void set(const wire::Settings& settings) {
    if (navico_) navico_->set(settings);
  }
  void add(const Spoke& spoke) {
    if (navico_) return navico_->add(spoke);
    cat240_->add(spoke, [&](std::span<const std::uint8_t> datagram) {
      out_.add(spoke.header.utc, kSender, kCat240Group, datagram);
    });
  }
  void own_ship(const wire::OwnShip& ship, UtcTime time) {
    if (told_ && time - *told_ < kNmeaEvery && time >= *told_) return;
    told_ = time;
    nmea::Rmc rmc;
    rmc.utc = time;
    rmc.position = wire::place_known_of(ship);
    if (!rmc.position) rmc.mode = 'N';
    if (!ship.no_motion()) {
      rmc.speed_kn = ship.speed_over_ground_kn();
      rmc.course_deg = ship.course_over_ground_deg();
    }
    std::string text = nmea::encode(rmc);
    // Receivers ignore an RMC without a position.
    if (!rmc.position && !ship.no_motion()) {
      text += nmea::encode(nmea::Vtg{.course_deg = rmc.course_deg, .speed_kn = rmc.speed_kn});
    }
    if (!ship.no_heading()) text += nmea::encode(nmea::Hdt{ship.heading_deg()});
    out_.add(time, kSender, kNmea,
             {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  }
  void finish() {
    if (navico_) navico_->finish();
  }
  std::uint64_t cut() const { return navico_ ? navico_->cut() : 0; }

 private:
  pcap::PcapWriter& out_;
  std::optional<NavicoExport> navico_;
  std::optional<Cat240Stream> cat240_;
  std::optional<UtcTime> told_;
};

RecordingError no_picture(const recording::Summary& summary, const ExportOptions& options) {
  std::string there;
  for (const auto& [topic, count] : summary.items) {
    if (topic.kind != Kind::spoke) continue;
    there += fmt::format("{} radar {} view {}", there.empty() ? "" : ",", topic.radar, topic.view);
  }
  return {summary.file, 0,
          fmt::format("it has no spokes of radar {} view {}; there are{}", options.radar,
                      options.view, there.empty() ? " none of any" : there)};
}

}  // namespace

Result<ExportReport, RecordingError> export_capture(
    const recording::RecordingReader& reader, const ExportOptions& options, pcap::PcapWriter& out,
    const recording::RecordingReader::Progress& progress) {
  const recording::Summary& summary = reader.summary();
  const Topic spokes{Kind::spoke, options.radar, options.view};
  const Topic settings{Kind::settings, options.radar, options.view};
  const Topic own_ship{Kind::own_ship, options.radar, 0};
  if (!summary.items.contains(spokes)) return Failure{no_picture(summary, options)};

  const UtcTime begin = options.from.value_or(summary.begin);
  const UtcTime end = options.to.value_or(UtcTime::max());
  SpokeSink sink(options, out);
  ExportReport report;
  // The settings in force before the first spoke.
  if (const auto before = reader.last_before(settings, begin)) {
    if (const auto message = parsed<wire::Settings>(before->bytes)) sink.set(*message);
  }
  recording::ItemCursor cursor = reader.items({spokes, settings, own_ship});
  if (options.from) cursor.seek(begin);
  const double length = in_seconds(std::min(end, summary.end) - begin);
  std::uint64_t items = 0;
  while (const auto item = cursor.next()) {
    if (item->time >= end) break;
    if (progress && items++ % kLookEvery == 0) {
      const double share = length > 0.0 ? in_seconds(item->time - begin) / length : 0.0;
      if (!progress(share)) return Failure{RecordingError{summary.file, 0, "given up"}};
    }
    if (item->topic.kind == Kind::settings) {
      if (const auto message = parsed<wire::Settings>(item->bytes)) sink.set(*message);
    } else if (item->topic.kind == Kind::own_ship) {
      if (const auto message = parsed<wire::OwnShip>(item->bytes)) {
        sink.own_ship(*message, item->time);
      }
    } else {
      const auto message = parsed<wire::Spoke>(item->bytes);
      auto spoke =
          message ? from_message(*message) : Result<Spoke, WireError>(Failure{WireError{}});
      if (!spoke) {
        ++report.spokes_refused;
        continue;
      }
      spoke->header.utc = item->time;  // as all else, also where UTC of spokes steps
      sink.add(*spoke);
      ++report.spokes;
    }
  }
  sink.finish();
  report.spokes_cut = sink.cut();
  report.datagrams = out.datagrams();
  report.chunks_damaged = cursor.chunks_damaged();
  return report;
}

}  // namespace skerry::captures
