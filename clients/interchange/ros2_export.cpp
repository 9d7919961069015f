#include "clients/interchange/ros2_export.hpp"

#include <fmt/format.h>

#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "clients/interchange/interchange_file.hpp"
#include "clients/interchange/ros2_messages.hpp"
#include "protocol/quantity/angle.hpp"
#include "protocol/wire/own_ship.pb.h"

namespace skerry::client {
namespace {

using recording::Item;
using recording::Kind;
using recording::RecordingError;
using recording::RecordingReader;

constexpr std::size_t kSectorSpokes = 32;

recording::ChannelText channel_of(std::string topic, const ros2::Definition& definition) {
  return {std::move(topic), "cdr", definition.name, "ros2msg", definition.text};
}

// Whether `next` follows `last` in one sector.
bool follows(const SpokeHeader& last, const SpokeHeader& next) {
  return next.geometry.spokes_per_turn == last.geometry.spokes_per_turn &&
         next.geometry.cells == last.geometry.cells && next.cell_size() == last.cell_size() &&
         next.index == (last.index + 1) % last.geometry.spokes_per_turn && next.utc >= last.utc &&
         next.utc - last.utc < std::chrono::seconds(1);
}

class Ros2File {
 public:
  Ros2File(recording::ByteSink sink, std::uint32_t radar)
      : file_(std::move(sink), "ros2"),
        frame_(fmt::format("radar_{}", radar)),
        sectors_(file_.add_channel(
            channel_of(fmt::format("/{}/sectors", frame_), ros2::radar_sector()))),
        position_(file_.add_channel(
            channel_of(fmt::format("/{}/position", frame_), ros2::nav_sat_fix()))),
        transforms_(file_.add_channel(channel_of("/tf", ros2::transforms()))) {}

  void add(Spoke spoke) {
    if (spoke.header.index == 0) note_turn(spoke.header.utc);
    const bool fits = !spokes_.empty() && spokes_.size() < kSectorSpokes &&
                      follows(spokes_.back().header, spoke.header);
    if (!fits) end_sector();
    spokes_.push_back(std::move(spoke));
    ++counts_.spokes;
  }

  void add(const Item& item) {
    wire::OwnShip ship;
    if (!ship.ParseFromArray(item.bytes.data(), static_cast<int>(item.bytes.size()))) return;
    if (!ship.no_position()) {
      encode(ros2::NavSatFix{{item.time, frame_}, ship.latitude_deg(), ship.longitude_deg()},
             bytes_);
      file_.add(position_, item.time, bytes_);
      ++counts_.fixes;
    }
    if (ship.no_heading()) return;
    const double yaw = std::numbers::pi / 2.0 - ship.heading_deg() * kRadiansPerDegree;
    encode(ros2::Yaw{{item.time, frame_ + "_enu"}, frame_, yaw}, bytes_);
    file_.add(transforms_, item.time, bytes_);
    ++counts_.headings;
  }

  bool finish() {
    end_sector();
    return file_.finish();
  }
  const Ros2Counts& counts() const { return counts_; }

 private:
  void note_turn(UtcTime bow) {
    if (bow_ && bow > *bow_ && bow - *bow_ < std::chrono::minutes(1)) {
      turn_s_ = in_seconds(bow - *bow_);
    }
    bow_ = bow;
  }

  void end_sector() {
    if (spokes_.empty()) return;
    const SpokeHeader& first = spokes_.front().header;
    const SpokeHeader& last = spokes_.back().header;
    const double cell = first.cell_size().in_metres();
    ros2::RadarSector sector;
    sector.header = {first.utc, frame_};
    sector.angle_increment = -kRadiansPerTurn / first.geometry.spokes_per_turn;
    sector.angle_start = first.index * sector.angle_increment;
    if (spokes_.size() > 1) {
      sector.time_increment_s =
          in_seconds(last.utc - first.utc) / static_cast<double>(spokes_.size() - 1);
    }
    sector.scan_time_s = turn_s_.value_or(sector.time_increment_s * first.geometry.spokes_per_turn);
    sector.range_min_m = 0.5 * cell;
    sector.range_max_m = (first.geometry.cells - 0.5) * cell;
    for (const Spoke& spoke : spokes_) sector.rays.emplace_back(spoke.cells);
    encode(sector, bytes_);
    file_.add(sectors_, first.utc, bytes_);
    ++counts_.sectors;
    spokes_.clear();
  }

  InterchangeFile file_;
  std::string frame_;
  std::uint16_t sectors_, position_, transforms_;  // channels
  std::vector<Spoke> spokes_;                      // of the sector at hand
  std::optional<UtcTime> bow_;                     // when the antenna last pointed there
  std::optional<double> turn_s_;                   // how long the last turn took
  Bytes bytes_;
  Ros2Counts counts_;
};

}  // namespace

Result<Ros2Counts, RecordingError> write_ros2(const RecordingReader& reader,
                                              const RecordedPart& part, recording::ByteSink sink,
                                              const RecordingReader::Progress& progress) {
  Ros2File file(std::move(sink), part.radar);
  auto ships = reader.items({{Kind::own_ship, part.radar, 0}});
  if (part.from) ships.seek(*part.from);
  std::optional<Item> ship = ships.next();
  const auto read = each_spoke(
      reader, part,
      [&](Spoke spoke) {
        for (; ship && ship->time <= spoke.header.utc; ship = ships.next()) file.add(*ship);
        file.add(std::move(spoke));
      },
      progress);
  if (!read) return Failure{read.error()};
  if (!file.finish()) {
    return Failure{RecordingError{reader.summary().file, 0, "the output took not all of it"}};
  }
  Ros2Counts counts = file.counts();
  counts.not_read = read->not_read;
  return counts;
}

}  // namespace skerry::client
