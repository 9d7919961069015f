#include "clients/interchange/foxglove_export.hpp"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "clients/interchange/foxglove.pb.h"
#include "clients/interchange/interchange_file.hpp"
#include "clients/interchange/ship_tracks.hpp"
#include "protocol/picture/picture_file.hpp"
#include "protocol/quantity/angle.hpp"
#include "protocol/recording/message_schema.hpp"

namespace skerry::client {
namespace {

using recording::Item;
using recording::Kind;
using recording::RecordingError;
using recording::RecordingReader;

template <typename Message>
recording::ChannelText channel_of(std::uint32_t radar, const char* name) {
  const auto& descriptor = *Message::descriptor();
  return {fmt::format("/radar_{}/{}", radar, name), "protobuf", descriptor.full_name(), "protobuf",
          recording::message_schema(descriptor)};
}

template <typename Message>
void set_time(Message& message, UtcTime time) {
  const std::int64_t ns = time.time_since_epoch().count();
  message.mutable_timestamp()->set_seconds(ns / 1'000'000'000);
  message.mutable_timestamp()->set_nanos(static_cast<std::int32_t>(ns % 1'000'000'000));
}

class FoxgloveFile {
 public:
  FoxgloveFile(recording::ByteSink sink, std::uint32_t radar)
      : file_(std::move(sink), ""),
        frame_(fmt::format("radar_{}", radar)),
        ppi_(file_.add_channel(channel_of<foxglove::CompressedImage>(radar, "ppi"))),
        position_(file_.add_channel(channel_of<foxglove::LocationFix>(radar, "position"))),
        ships_(file_.add_channel(channel_of<foxglove::GeoJSON>(radar, "ships"))),
        tracks_(radar) {}

  void add(const Item& item) {
    const int size = static_cast<int>(item.bytes.size());
    if (item.topic.kind == Kind::traffic) {
      recording::Traffic traffic;
      if (traffic.ParseFromArray(item.bytes.data(), size)) tracks_.add(traffic, item.time);
    } else if (item.topic.kind == Kind::own_ship) {
      wire::OwnShip ship;
      if (ship.ParseFromArray(item.bytes.data(), size)) add(ship, item.time);
    }
  }

  void add(const RecordedTurn& turn, const PpiOptions& options, UtcTime time) {
    const std::vector<std::uint8_t> png = encode_png(draw_ppi(turn.scan, options, turn.labels),
                                                     describe(turn.scan, turn.labels.radar));
    foxglove::CompressedImage image;
    set_time(image, time);
    image.set_frame_id(frame_);
    image.set_format("png");
    image.set_data(png.data(), png.size());
    file_.add(ppi_, time, image.SerializeAsString());
    ++counts_.pictures;
    if (tracks_.empty()) return;
    foxglove::GeoJSON ships;
    ships.set_geojson(tracks_.geojson(time));
    file_.add(ships_, time, ships.SerializeAsString());
    ++counts_.tracks;
  }

  bool finish() { return file_.finish(); }
  const FoxgloveCounts& counts() const { return counts_; }

 private:
  void add(const wire::OwnShip& ship, UtcTime time) {
    tracks_.add(ship, time);
    if (ship.no_position()) return;
    foxglove::LocationFix fix;
    set_time(fix, time);
    fix.set_frame_id(frame_);
    fix.set_latitude(ship.latitude_deg());
    fix.set_longitude(ship.longitude_deg());
    if (!ship.no_heading()) fix.set_heading(ship.heading_deg() * kRadiansPerDegree);
    file_.add(position_, time, fix.SerializeAsString());
    ++counts_.fixes;
  }

  InterchangeFile file_;
  std::string frame_;
  std::uint16_t ppi_, position_, ships_;  // channels
  ShipTracks tracks_;
  FoxgloveCounts counts_;
};

}  // namespace

Result<FoxgloveCounts, RecordingError> write_foxglove(const RecordingReader& reader,
                                                      const RecordedPart& part,
                                                      const PpiOptions& picture,
                                                      recording::ByteSink sink,
                                                      const RecordingReader::Progress& progress) {
  const auto failed = [&](std::string text) {
    return Failure{RecordingError{reader.summary().file, 0, std::move(text)}};
  };
  FoxgloveFile file(std::move(sink), part.radar);
  RecordedTurns turns(reader, part, progress);
  auto others = reader.items({{Kind::own_ship, part.radar, 0}, {Kind::traffic, 0, 0}});
  if (part.from) others.seek(*part.from);
  std::optional<Item> item = others.next();
  while (const auto turn = turns.next()) {
    const UtcTime time = turn->scan.newest()->header.utc;
    for (; item && item->time <= time; item = others.next()) file.add(*item);
    file.add(*turn, picture, time);
  }
  if (turns.given_up()) return failed("given up");
  if (file.counts().pictures == 0) return failed(no_spokes_text(reader.summary(), part));
  if (!file.finish()) return failed("the output took not all of it");
  FoxgloveCounts counts = file.counts();
  counts.not_read = turns.not_read();
  return counts;
}

}  // namespace skerry::client
