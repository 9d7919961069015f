#include "clients/interchange/ros2_messages.hpp"

#include <bit>
#include <cmath>

namespace skerry::client::ros2 {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;  // ns

constexpr char kTime[] = "MSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n";
constexpr char kHeader[] = "MSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n";

// The types within follow the type itself, each after a line of 80 '='.
std::string joined(std::initializer_list<const char*> parts) {
  std::string text;
  for (const char* part : parts) {
    if (!text.empty()) text += std::string(80, '=') + "\n";
    text += part;
  }
  return text;
}

// Plain CDR version 1, little-endian: each number lies at a multiple of its size from the end of
// the four octets of encapsulation.
class CdrWriter {
 public:
  explicit CdrWriter(Bytes& out) : out_(out) { out_.assign({0x00, 0x01, 0x00, 0x00}); }

  void octet(std::uint8_t value) { out_.push_back(value); }
  void u16(std::uint16_t value) { number(value, 2); }
  void u32(std::uint32_t value) { number(value, 4); }
  void f32(double value) { number(std::bit_cast<std::uint32_t>(static_cast<float>(value)), 4); }
  void f64(double value) { number(std::bit_cast<std::uint64_t>(value), 8); }
  void text(const std::string& value) {
    u32(static_cast<std::uint32_t>(value.size() + 1));
    out_.insert(out_.end(), value.begin(), value.end());
    out_.push_back(0);
  }
  void seconds(std::int64_t ns) {  // Time and Duration have the same fields
    const std::int64_t whole = ns / kSecond - (ns % kSecond < 0 ? 1 : 0);
    u32(static_cast<std::uint32_t>(static_cast<std::int32_t>(whole)));
    u32(static_cast<std::uint32_t>(ns - whole * kSecond));
  }
  void header(const Header& header) {
    seconds(header.stamp.time_since_epoch().count());
    text(header.frame);
  }
  // A sequence of float32, one of each octet.
  void octets_as_floats(std::span<const std::uint8_t> values) {
    u32(static_cast<std::uint32_t>(values.size()));
    const std::size_t begin = out_.size();
    out_.resize(begin + 4 * values.size());
    std::uint8_t* to = out_.data() + begin;
    for (const std::uint8_t value : values) {
      const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(value));
      for (int i = 0; i < 4; ++i) *to++ = static_cast<std::uint8_t>(bits >> (8 * i));
    }
  }

 private:
  void number(std::uint64_t value, std::size_t size) {
    while ((out_.size() - 4) % size != 0) out_.push_back(0);
    for (std::size_t i = 0; i < size; ++i) {
      out_.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
    }
  }
  Bytes& out_;
};

std::int64_t ns_of(double seconds) { return std::llround(seconds * kSecond); }

}  // namespace

const Definition& radar_sector() {
  static const Definition definition{
      "marine_sensor_msgs/msg/RadarSector",
      joined({"std_msgs/Header header\n"
              "float32 angle_start\n"
              "float32 angle_increment\n"
              "builtin_interfaces/Duration time_increment\n"
              "builtin_interfaces/Duration scan_time\n"
              "float32 range_min\n"
              "float32 range_max\n"
              "marine_sensor_msgs/RadarEcho[] intensities\n",
              kHeader, kTime, "MSG: builtin_interfaces/Duration\nint32 sec\nuint32 nanosec\n",
              "MSG: marine_sensor_msgs/RadarEcho\nfloat32[] echoes\n"})};
  return definition;
}

const Definition& nav_sat_fix() {
  static const Definition definition{"sensor_msgs/msg/NavSatFix",
                                     joined({"uint8 COVARIANCE_TYPE_UNKNOWN=0\n"
                                             "uint8 COVARIANCE_TYPE_APPROXIMATED=1\n"
                                             "uint8 COVARIANCE_TYPE_DIAGONAL_KNOWN=2\n"
                                             "uint8 COVARIANCE_TYPE_KNOWN=3\n"
                                             "std_msgs/Header header\n"
                                             "sensor_msgs/NavSatStatus status\n"
                                             "float64 latitude\n"
                                             "float64 longitude\n"
                                             "float64 altitude\n"
                                             "float64[9] position_covariance\n"
                                             "uint8 position_covariance_type\n",
                                             kHeader, kTime,
                                             "MSG: sensor_msgs/NavSatStatus\n"
                                             "int8 STATUS_NO_FIX=-1\n"
                                             "int8 STATUS_FIX=0\n"
                                             "int8 STATUS_SBAS_FIX=1\n"
                                             "int8 STATUS_GBAS_FIX=2\n"
                                             "uint16 SERVICE_GPS=1\n"
                                             "uint16 SERVICE_GLONASS=2\n"
                                             "uint16 SERVICE_COMPASS=4\n"
                                             "uint16 SERVICE_GALILEO=8\n"
                                             "int8 status\n"
                                             "uint16 service\n"})};
  return definition;
}

const Definition& transforms() {
  static const Definition definition{
      "tf2_msgs/msg/TFMessage",
      joined({"geometry_msgs/TransformStamped[] transforms\n",
              "MSG: geometry_msgs/TransformStamped\n"
              "std_msgs/Header header\n"
              "string child_frame_id\n"
              "geometry_msgs/Transform transform\n",
              kHeader, kTime,
              "MSG: geometry_msgs/Transform\n"
              "geometry_msgs/Vector3 translation\n"
              "geometry_msgs/Quaternion rotation\n",
              "MSG: geometry_msgs/Vector3\nfloat64 x\nfloat64 y\nfloat64 z\n",
              "MSG: geometry_msgs/Quaternion\nfloat64 x\nfloat64 y\nfloat64 z\nfloat64 w\n"})};
  return definition;
}

void encode(const RadarSector& sector, Bytes& out) {
  CdrWriter cdr(out);
  cdr.header(sector.header);
  cdr.f32(sector.angle_start);
  cdr.f32(sector.angle_increment);
  cdr.seconds(ns_of(sector.time_increment_s));
  cdr.seconds(ns_of(sector.scan_time_s));
  cdr.f32(sector.range_min_m);
  cdr.f32(sector.range_max_m);
  cdr.u32(static_cast<std::uint32_t>(sector.rays.size()));
  for (const auto& ray : sector.rays) cdr.octets_as_floats(ray);
}

void encode(const NavSatFix& fix, Bytes& out) {
  CdrWriter cdr(out);
  cdr.header(fix.header);
  cdr.octet(0);  // STATUS_FIX
  cdr.u16(1);    // SERVICE_GPS
  cdr.f64(fix.latitude_deg);
  cdr.f64(fix.longitude_deg);
  cdr.f64(std::nan(""));  // as the definition asks where it is not known
  for (int i = 0; i < 9; ++i) cdr.f64(0.0);
  cdr.octet(0);  // COVARIANCE_TYPE_UNKNOWN
}

void encode(const Yaw& turn, Bytes& out) {
  CdrWriter cdr(out);
  cdr.u32(1);
  cdr.header(turn.header);
  cdr.text(turn.child);
  for (int i = 0; i < 3; ++i) cdr.f64(0.0);
  cdr.f64(0.0);
  cdr.f64(0.0);
  cdr.f64(std::sin(turn.yaw / 2.0));
  cdr.f64(std::cos(turn.yaw / 2.0));
}

}  // namespace skerry::client::ros2
