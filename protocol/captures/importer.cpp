#include "protocol/captures/importer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "protocol/captures/import_notes.hpp"
#include "protocol/recording/recording.pb.h"
#include "protocol/wire/radar.pb.h"

namespace skerry::captures {
namespace {

using recording::Item;
using recording::Kind;
using recording::RecordingError;
using recording::RecordingWriter;
using recording::Topic;

constexpr std::uint32_t kProtocolVersion = 1;
// Own ship moves on so often in the recording.
constexpr Duration kOwnShipEvery = std::chrono::seconds(1);

void add_message(RecordingWriter& writer, Topic topic, UtcTime time,
                 const google::protobuf::MessageLite& message) {
  const std::string bytes = message.SerializeAsString();
  writer.add(Item{topic,
                  std::max(time, UtcTime{}),
                  {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}});
}

void add_event(RecordingWriter& writer, UtcTime time, recording::Event::Kind kind,
               std::uint32_t radar, std::uint64_t count, const std::string& text) {
  recording::Event event;
  event.set_kind(kind);
  event.set_radar(radar);
  event.set_count(count);
  event.set_text(text);
  add_message(writer, {Kind::event, 0, 0}, time, event);
}

// The file's name without its folders; protobuf needs UTF-8, and file names may hold anything.
std::string label_of(const std::string& name) {
  std::string label = name.substr(name.find_last_of('/') + 1);
  for (char& c : label) {
    if (c < 0x20 || c > 0x7E) c = '?';
  }
  return label;
}

wire::Hello hello_of(const std::vector<SurveyedPicture>& pictures, const std::string& name) {
  wire::Hello hello;
  hello.set_protocol_version(kProtocolVersion);
  hello.set_server("skerry recording import");
  hello.set_scenario(name);
  for (const double nm : RangeScale::kNauticalMiles) hello.add_range_scales_nm(nm);
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const SurveyedPicture& picture = pictures[i];
    wire::RadarInfo& info = *hello.add_radars();
    info.set_radar(static_cast<std::uint32_t>(i));
    info.set_name(picture.name);
    info.set_own_ship("own ship");
    info.set_spokes_per_turn(picture.traits.spokes_per_turn);
    info.set_cells(std::clamp(picture.cells, ScanGeometry::kMinCells, ScanGeometry::kMaxCells));
    info.set_bits(picture.bits);
    info.set_rpm(picture.rpm);
    info.set_set(fmt::format("{}, captured", name_of(picture.traits.key.family)));
    info.set_band("X");
  }
  return hello;
}

// One picture on its way into the recording.
class RadarWriter {
 public:
  RadarWriter(std::uint32_t radar, const SurveyedPicture& picture, UtcTime begin,
              RecordingWriter& writer)
      : radar_(radar),
        picture_(picture),
        decoder_(make_picture(picture.traits)),
        fitter_(radar, picture.traits.turn, begin),
        writer_(writer) {}

  const PictureKey& key() const { return picture_.traits.key; }
  // The last that a spoke told.
  const std::optional<TrueBearing>& heading() const { return heading_; }
  const SurveyedPicture& picture() const { return picture_; }
  const FittedCounts& counts() const { return fitter_.counts(); }

  // Reports count from then on, also where no spokes come: in standby.
  void hear(const pcap::Datagram& datagram) {
    decoder_->hear(datagram);
    if (last_) write_settings(*last_, datagram.time);
  }

  void take(const pcap::Datagram& datagram, const ShipTrack& ship) {
    captured_.clear();
    if (decoder_->decode(datagram, captured_)) return;  // counted by the survey
    for (CapturedSpoke& each : captured_) {
      if (each.missing > 0) {
        add_event(writer_, each.time, recording::Event::GAP, radar_, each.missing,
                  fmt::format("{} spokes are not in the capture", each.missing));
      }
      if (each.heading) heading_ = each.heading;
      fitter_.take(std::move(each), ship, fitted_);
    }
    write_fitted();
  }

  void finish() {
    fitter_.finish(fitted_);
    write_fitted();
    if (counts().range_unknown > 0) {
      add_event(writer_, last_ ? last_->utc : UtcTime{}, recording::Event::OTHER, radar_,
                counts().range_unknown,
                "spokes that did not tell their range have that of their neighbours");
    }
  }

 private:
  void write_fitted() {
    for (const Spoke& spoke : fitted_) {
      write_settings(spoke.header, spoke.header.utc);
      writer_.add(spoke);
      last_ = spoke.header;
    }
    fitted_.clear();
  }

  void write_settings(const SpokeHeader& header, UtcTime time) {
    const wire::Settings settings = told_settings(*decoder_, radar_, header, picture_.rpm);
    std::string bytes = settings.SerializeAsString();
    if (bytes == written_) return;
    add_message(writer_, {Kind::settings, radar_, 0}, time, settings);
    written_ = std::move(bytes);
  }

  std::uint32_t radar_;
  SurveyedPicture picture_;
  std::unique_ptr<PictureDecoder> decoder_;
  SpokeFitter fitter_;
  RecordingWriter& writer_;
  std::string written_;  // the settings last written
  std::vector<CapturedSpoke> captured_;
  std::vector<Spoke> fitted_;
  std::optional<SpokeHeader> last_;  // written
  std::optional<TrueBearing> heading_;
};

class Importer {
 public:
  Importer(const Surveyor& survey, const std::string& name, RecordingWriter& writer)
      : writer_(writer) {
    const auto pictures = survey.pictures();
    add_message(writer, {Kind::hello, 0, 0}, survey.begin(), hello_of(pictures, name));
    add_event(writer, survey.begin(), recording::Event::STARTED, 0, 0, "imported from " + name);
    for (std::size_t i = 0; i < pictures.size(); ++i) {
      radars_.push_back(std::make_unique<RadarWriter>(static_cast<std::uint32_t>(i), pictures[i],
                                                      survey.begin(), writer));
    }
  }

  void take(const pcap::Datagram& datagram) {
    if (const auto key = picture_of(datagram)) {
      for (const auto& radar : radars_) {
        if (radar->key() == *key) radar->take(datagram, ship_);
      }
      if (!ship_.known()) write_own_ship(datagram.time);
      return;
    }
    for (const auto& radar : radars_) radar->hear(datagram);
    if (ship_.hear(datagram)) write_own_ship(datagram.time);
  }

  ImportReport finish() {
    ImportReport report;
    for (const auto& radar : radars_) {
      radar->finish();
      report.radars.push_back({radar->picture(), radar->counts()});
    }
    return report;
  }

 private:
  void write_own_ship(UtcTime time) {
    if (ship_written_ && time - *ship_written_ < kOwnShipEvery && time >= *ship_written_) return;
    ship_written_ = time;
    for (std::uint32_t i = 0; i < radars_.size(); ++i) {
      wire::OwnShip ship = ship_.own_ship(i, time);
      if (const auto& heading = radars_[i]->heading(); heading && ship.no_heading()) {
        ship.set_heading_deg(heading->in_degrees());
        ship.set_no_heading(false);
      }
      add_message(writer_, {Kind::own_ship, i, 0}, time, ship);
    }
  }

  RecordingWriter& writer_;
  std::vector<std::unique_ptr<RadarWriter>> radars_;
  ShipTrack ship_;
  std::optional<UtcTime> ship_written_;
};

RecordingError nothing_found(const Surveyor& survey, const std::string& name,
                             const pcap::CaptureCounts& counts) {
  const std::string others = survey.others();
  return {name, 0,
          fmt::format("no picture of a radar in {} datagrams{}{}; expected frames of Navico (BR24, "
                      "3G, 4G, HALO), Garmin xHD, Raymarine Quantum or E-120, or ASTERIX CAT240",
                      counts.datagrams, others.empty() ? "" : ": ", others)};
}

}  // namespace

Result<ImportReport, RecordingError> import_capture(const CapturePass& pass,
                                                    const std::string& name,
                                                    RecordingWriter& writer,
                                                    const ImportProgress& progress) {
  const auto half = [&](double from) -> ImportProgress {
    if (!progress) return {};
    return [&progress, from](double share) { return progress(from + share / 2.0); };
  };
  Surveyor survey;
  const auto surveyed = pass([&](const pcap::Datagram& each) { survey.take(each); }, half(0.0));
  if (progress && !progress(0.5)) return Failure{RecordingError{name, 0, "given up"}};
  const auto pictures = survey.pictures();
  if (pictures.empty()) {
    if (!surveyed) {
      return Failure{RecordingError{name, surveyed.error().offset, surveyed.error().text}};
    }
    return Failure{nothing_found(survey, name, *surveyed)};
  }
  const std::string label = label_of(name);
  Importer importer(survey, label, writer);
  const auto counts = pass([&](const pcap::Datagram& each) { importer.take(each); }, half(0.5));
  ImportReport report = importer.finish();
  report.left_out = survey.left_out();
  if (counts) {
    report.capture = *counts;
  } else {
    report.damage = RecordingError{name, counts.error().offset, counts.error().text};
  }
  if (progress && !progress(1.0)) return Failure{RecordingError{name, 0, "given up"}};
  add_event(writer, survey.end(), recording::Event::STOPPED, 0, 0, "the capture ends");
  writer.attach(import_notes(report, label, std::max(survey.begin(), UtcTime{})));
  return report;
}

Result<ImportReport, RecordingError> import_capture_file(const std::string& path,
                                                         RecordingWriter& writer,
                                                         const ImportProgress& progress) {
  return import_capture(
      [&](const DatagramSink& sink, const ImportProgress& part) {
        return pcap::read_capture_file(path, sink, part);
      },
      path, writer, progress);
}

}  // namespace skerry::captures
