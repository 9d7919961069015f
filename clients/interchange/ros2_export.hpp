// Recordings for ROS 2: sectors of spokes, positions and headings with the definitions of ROS.
#pragma once

#include <cstdint>

#include "clients/recording/recorded_turns.hpp"
#include "protocol/recording/writer.hpp"

namespace skerry::client {

struct Ros2Counts {
  std::uint64_t spokes = 0;
  std::uint64_t sectors = 0;
  std::uint64_t fixes = 0;     // positions of own ship
  std::uint64_t headings = 0;  // of own ship
  NotRead not_read;
};

// A file of profile "ros2", as rosbag2 plays it.  Channels, N the radar:
//   /radar_N/sectors   marine_sensor_msgs/msg/RadarSector  up to 32 spokes that follow each other;
//                      intensities are the levels as recorded, 0 .. 255
//   /radar_N/position  sensor_msgs/msg/NavSatFix           each OwnShip message with a position
//   /tf                tf2_msgs/msg/TFMessage              each OwnShip message with a heading:
//                      radar_N_enu (x east, y north) -> radar_N (x over the bow, y to port)
// Sectors are in frame radar_N.  Errors: as of write_foxglove().
Result<Ros2Counts, recording::RecordingError> write_ros2(
    const recording::RecordingReader& reader, const RecordedPart& part, recording::ByteSink sink,
    const recording::RecordingReader::Progress& progress = {});

}  // namespace skerry::client
