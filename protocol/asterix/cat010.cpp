#include "protocol/asterix/cat010.hpp"

#include <algorithm>
#include <array>

#include "protocol/asterix/common_items.hpp"
#include "protocol/asterix/record_table.hpp"

namespace skerry::cat010 {
namespace {

using asterix::append_extended;
using asterix::append_quantities;
using asterix::extended;
using asterix::fixed;
using asterix::ItemOctets;
using asterix::Quantity;
using asterix::quantity_at;
using asterix::repeated;

constexpr unsigned kPlaceBits = 31;                     // 041
constexpr Quantity kRange{2, 1.0};                      // 040, m
constexpr Quantity kPlane{2, 1.0, true};                // 042, m
constexpr Quantity kVelocity{2, 0.25, true};            // 202, m/s
constexpr Quantity kAcceleration{1, 0.25, true, true};  // 210, m/s2
constexpr Quantity kDeviation{1, 0.25, false, true};    // 500 DEVX, DEVY, m
constexpr Quantity kCovariance{2, 0.25, true, true};    // 500 COVXY, m

unsigned flag(bool is_set, unsigned bit) { return is_set ? bit : 0; }
bool is_target(const Cat010Report& report) { return report.kind == Cat010Kind::target; }

bool read_kind(const ItemOctets& item, Cat010Report& report) {
  report.kind = static_cast<Cat010Kind>(item.octet(0));
  return item.octet(0) >= 1 && item.octet(0) <= 4;
}

// 020: the first octet, and the second.
constexpr unsigned kSensorShift = 5, kSimulated = 0x80, kTest = 0x40;

void write_descriptor(Bytes& out, const Cat010Report& report) {
  append_extended(out, {static_cast<unsigned>(report.sensor) << kSensorShift,
                        flag(report.is_simulated, kSimulated) | flag(report.is_test, kTest)});
}

bool read_descriptor(const ItemOctets& item, Cat010Report& report) {
  report.sensor = static_cast<Cat010Sensor>(item.octet(0) >> kSensorShift);
  report.is_simulated = (item.octet(1) & kSimulated) != 0;
  report.is_test = (item.octet(1) & kTest) != 0;
  return true;
}

// 170: the first octet, and the third.
constexpr unsigned kTentative = 0x80, kEnded = 0x40, kExtrapolationShift = 4, kExtrapolation = 3,
                   kManoeuvring = 0x08, kSmoothed = 0x02, kGhost = 0x80;

void write_status(Bytes& out, const Cat010Report& report) {
  if (!report.status) return;
  const Cat010TrackStatus& status = *report.status;
  append_extended(
      out, {flag(status.is_tentative, kTentative) | flag(status.is_ended, kEnded) |
                static_cast<unsigned>(status.extrapolation) << kExtrapolationShift |
                flag(status.is_manoeuvring, kManoeuvring) | flag(status.is_smoothed, kSmoothed),
            0u, flag(status.is_ghost, kGhost)});
}

bool read_status(const ItemOctets& item, Cat010Report& report) {
  const unsigned first = item.octet(0);
  report.status = Cat010TrackStatus{.is_tentative = (first & kTentative) != 0,
                                    .is_ended = (first & kEnded) != 0,
                                    .extrapolation = static_cast<Cat010Extrapolation>(
                                        first >> kExtrapolationShift & kExtrapolation),
                                    .is_manoeuvring = (first & kManoeuvring) != 0,
                                    .is_smoothed = (first & kSmoothed) != 0,
                                    .is_ghost = (item.octet(2) & kGhost) != 0};
  return true;
}

// 550.
constexpr unsigned kReleaseShift = 6, kMostRelease = 3, kOverloaded = 0x20, kTimeInvalid = 0x10;

void write_system_status(Bytes& out, const Cat010Report& report) {
  if (!report.system_status) return;
  const Cat010SystemStatus& status = *report.system_status;
  out.push_back(static_cast<std::uint8_t>(
      std::min<unsigned>(status.release, kMostRelease) << kReleaseShift |
      flag(status.is_overloaded, kOverloaded) | flag(status.is_time_invalid, kTimeInvalid)));
}

bool read_system_status(const ItemOctets& item, Cat010Report& report) {
  const unsigned octet = item.octet(0);
  report.system_status =
      Cat010SystemStatus{.release = static_cast<std::uint8_t>(octet >> kReleaseShift),
                         .is_overloaded = (octet & kOverloaded) != 0,
                         .is_time_invalid = (octet & kTimeInvalid) != 0};
  return true;
}

void write_deviation(Bytes& out, const Cat010Report& report) {
  if (!report.deviation) return;
  append_quantities(out, {{kDeviation, report.deviation->east_m},
                          {kDeviation, report.deviation->north_m},
                          {kCovariance, report.deviation->covariance_m}});
}

bool read_deviation(const ItemOctets& item, Cat010Report& report) {
  report.deviation = Cat010Deviation{quantity_at(item.octets, 0, kDeviation),
                                     quantity_at(item.octets, 1, kDeviation),
                                     quantity_at(item.octets, 2, kCovariance)};
  return true;
}

using Row = asterix::ItemRow<Cat010Report>;
constexpr std::array<Row, 28> kRows = {{
    {"010", fixed(2),
     [](Bytes& out, const Cat010Report& report) { asterix::write_source(out, report.source); },
     [](const ItemOctets& item, Cat010Report& report) {
       report.source = asterix::read_source(item);
       return true;
     }},
    {"000", fixed(1),
     [](Bytes& out, const Cat010Report& report) {
       out.push_back(static_cast<std::uint8_t>(report.kind));
     },
     read_kind},
    {"020", extended(),
     [](Bytes& out, const Cat010Report& report) {
       if (is_target(report)) write_descriptor(out, report);
     },
     read_descriptor},
    {"140", fixed(3),
     [](Bytes& out, const Cat010Report& report) {
       asterix::write_time_of_day(out, report.time_of_day);
     },
     [](const ItemOctets& item, Cat010Report& report) {
       return asterix::read_time_of_day(item, report.time_of_day);
     }},
    {"041", fixed(8),
     [](Bytes& out, const Cat010Report& report) {
       asterix::write_place(out, report.place, kPlaceBits);
     },
     [](const ItemOctets& item, Cat010Report& report) {
       return asterix::read_place(item, report.place, kPlaceBits);
     }},
    {"040", fixed(4),
     [](Bytes& out, const Cat010Report& report) {
       asterix::write_polar(out, report.measured, kRange);
     },
     [](const ItemOctets& item, Cat010Report& report) {
       report.measured = asterix::read_polar(item, kRange);
       return true;
     }},
    {"042", fixed(4),
     [](Bytes& out, const Cat010Report& report) {
       asterix::write_plane(out, report.position, kPlane);
     },
     [](const ItemOctets& item, Cat010Report& report) {
       report.position = asterix::read_plane(item, kPlane);
       return true;
     }},
    {"200", fixed(4),
     [](Bytes& out, const Cat010Report& report) { asterix::write_velocity(out, report.velocity); },
     [](const ItemOctets& item, Cat010Report& report) {
       report.velocity = asterix::read_velocity(item);
       return true;
     }},
    {"202", fixed(4),
     [](Bytes& out, const Cat010Report& report) {
       asterix::write_vector(out, report.plane_velocity, kVelocity);
     },
     [](const ItemOctets& item, Cat010Report& report) {
       report.plane_velocity = asterix::read_vector(item.octets, kVelocity);
       return true;
     }},
    {"161", fixed(2),
     [](Bytes& out, const Cat010Report& report) {
       asterix::write_track_number(out, report.track_number);
     },
     [](const ItemOctets& item, Cat010Report& report) {
       report.track_number = asterix::read_track_number(item);
       return true;
     }},
    {"170", extended(), write_status, read_status},
    {"060", fixed(2)},
    {"220", fixed(3)},
    {"245", fixed(7)},
    {"250", repeated(8)},
    {"300", fixed(1)},
    {"090", fixed(2)},
    {"091", fixed(2)},
    {"270", extended(),
     [](Bytes& out, const Cat010Report& report) { asterix::write_size(out, report.size); },
     [](const ItemOctets& item, Cat010Report& report) {
       report.size = asterix::read_size(item);
       return true;
     }},
    {"550", fixed(1), write_system_status, read_system_status},
    {"310", fixed(1)},
    {"500", fixed(4), write_deviation, read_deviation},
    {"280", repeated(2)},
    {"131", fixed(1),
     [](Bytes& out, const Cat010Report& report) {
       if (report.amplitude) out.push_back(*report.amplitude);
     },
     [](const ItemOctets& item, Cat010Report& report) {
       report.amplitude = item.octet(0);
       return true;
     }},
    {"210", fixed(2),
     [](Bytes& out, const Cat010Report& report) {
       asterix::write_vector(out, report.acceleration, kAcceleration);
     },
     [](const ItemOctets& item, Cat010Report& report) {
       report.acceleration = asterix::read_vector(item.octets, kAcceleration);
       return true;
     }},
    {},
    {"SP", asterix::lengthy()},
    {"RE", asterix::lengthy()},
}};

constexpr std::size_t kSourceItem = 1, kKindItem = 2;
constexpr asterix::RecordTable<Cat010Report> kTable{
    10, "CAT010", kRows, asterix::ItemSet<std::size_t>(kSourceItem, kKindItem)};

// With the items that its kind may have.
Cat010Report as_sent(const Cat010Report& report) {
  if (!is_target(report)) {
    return {.source = report.source,
            .kind = report.kind,
            .time_of_day = report.time_of_day,
            .system_status = report.system_status};
  }
  Cat010Report sent = report;
  sent.system_status = {};
  return sent;
}

}  // namespace
}  // namespace skerry::cat010

namespace skerry {

std::vector<Bytes> encode_cat010(std::span<const Cat010Report> reports, std::size_t most) {
  std::vector<Cat010Report> sent;
  for (const Cat010Report& report : reports) sent.push_back(cat010::as_sent(report));
  return asterix::encode_records(cat010::kTable, std::span<const Cat010Report>(sent), most);
}

Result<std::vector<Cat010Report>, WireError> decode_cat010(std::span<const std::uint8_t> datagram) {
  return asterix::decode_records(cat010::kTable, datagram);
}

}  // namespace skerry
