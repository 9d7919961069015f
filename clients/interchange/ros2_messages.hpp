// The messages of ROS 2 that exports hold: their definitions, and their bytes in CDR.
// Sources: marine_sensor_msgs 2.1.0 (RadarSector.msg, RadarEcho.msg); common_interfaces (humble):
// sensor_msgs/NavSatFix, std_msgs/Header; tf2_msgs/TFMessage; OMG DDS-XTypes 1.3 clause 7.4.3
// (XCDR1).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "protocol/quantity/time.hpp"
#include "protocol/wire/wire_error.hpp"

namespace skerry::client::ros2 {

// A type's name in ROS 2, and its definition with those of the types within it, as rosbag2 stores
// it.
struct Definition {
  std::string name;  // "marine_sensor_msgs/msg/RadarSector"
  std::string text;
};
const Definition& radar_sector();
const Definition& nav_sat_fix();
const Definition& transforms();

struct Header {
  UtcTime stamp{};
  std::string frame;
};

// Angles in rad, counterclockwise seen from above, 0 over the bow; ranges in m; times in s.
struct RadarSector {
  Header header;  // when the first ray was received
  double angle_start = 0.0, angle_increment = 0.0;
  double time_increment_s = 0.0, scan_time_s = 0.0;
  double range_min_m = 0.0, range_max_m = 0.0;  // of the first and last sample's middle
  std::vector<std::span<const std::uint8_t>> rays;
};
// Latitude and longitude in degrees; altitude and covariance are not known.
struct NavSatFix {
  Header header;
  double latitude_deg = 0.0, longitude_deg = 0.0;
};
// A turn about the vertical by `yaw` rad, counterclockwise, from the header's frame to `child`.
struct Yaw {
  Header header;
  std::string child;
  double yaw = 0.0;
};

// Each replaces what is in `out`, which keeps its room.
void encode(const RadarSector& sector, Bytes& out);
void encode(const NavSatFix& fix, Bytes& out);
// As a TFMessage of one transform.
void encode(const Yaw& turn, Bytes& out);

}  // namespace skerry::client::ros2
