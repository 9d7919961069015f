#include "protocol/asterix/cat062.hpp"

#include <array>

#include "protocol/asterix/common_items.hpp"
#include "protocol/asterix/record_table.hpp"

namespace skerry::cat062 {
namespace {

using asterix::append_extended;
using asterix::append_quantities;
using asterix::compound;
using asterix::extended;
using asterix::fixed;
using asterix::ItemOctets;
using asterix::Quantity;
using asterix::quantity_at;
using asterix::repeated;
using asterix::Shape;

constexpr unsigned kPlaceBits = 25;                        // 105
constexpr Quantity kPlane{3, 0.5, true};                   // 100, m
constexpr Quantity kVelocity{2, 0.25, true};               // 185, m/s
constexpr Quantity kAcceleration{1, 0.25, true, true};     // 210, m/s2
constexpr Quantity kAge{1, 0.25, false, true};             // 290, s
constexpr Quantity kDeviation{2, 0.5, false, true};        // 500 APC, m
constexpr Quantity kCovariance{2, 0.5, true, true};        // 500 COV, m
constexpr Quantity kSpeedDeviation{1, 0.25, false, true};  // 500 ATV, m/s

// 080: of the first four octets.
constexpr unsigned kMonosensor = 0x80, kTentative = 0x02;
constexpr unsigned kSimulated = 0x80, kEnded = 0x40, kNew = 0x20;
constexpr unsigned kAmalgamated = 0x80;
constexpr unsigned kCoasting = 0x80;

unsigned flag(bool is_set, unsigned bit) { return is_set ? bit : 0; }

void write_status(Bytes& out, const Cat062Report& report) {
  const Cat062TrackStatus& status = report.status;
  append_extended(out,
                  {flag(status.is_monosensor, kMonosensor) | flag(status.is_tentative, kTentative),
                   flag(status.is_simulated, kSimulated) | flag(status.is_ended, kEnded) |
                       flag(status.is_new, kNew),
                   flag(status.is_amalgamated, kAmalgamated), flag(status.is_coasting, kCoasting)});
}

bool read_status(const ItemOctets& item, Cat062Report& report) {
  report.status = {.is_monosensor = (item.octet(0) & kMonosensor) != 0,
                   .is_tentative = (item.octet(0) & kTentative) != 0,
                   .is_simulated = (item.octet(1) & kSimulated) != 0,
                   .is_ended = (item.octet(1) & kEnded) != 0,
                   .is_new = (item.octet(1) & kNew) != 0,
                   .is_amalgamated = (item.octet(2) & kAmalgamated) != 0,
                   .is_coasting = (item.octet(3) & kCoasting) != 0};
  return true;
}

// 200.
constexpr unsigned kTurnShift = 6, kSpeedShift = 4, kTwoBits = 3;

void write_movement(Bytes& out, const Cat062Report& report) {
  if (!report.movement) return;
  out.push_back(
      static_cast<std::uint8_t>(static_cast<unsigned>(report.movement->turn) << kTurnShift |
                                static_cast<unsigned>(report.movement->speed) << kSpeedShift));
}

bool read_movement(const ItemOctets& item, Cat062Report& report) {
  report.movement =
      Cat062Movement{static_cast<Cat062Turn>(item.octet(0) >> kTurnShift & kTwoBits),
                     static_cast<Cat062SpeedChange>(item.octet(0) >> kSpeedShift & kTwoBits)};
  return true;
}

// 290.
constexpr std::array<Shape, 10> kAgeParts = {fixed(1), fixed(1), fixed(1), fixed(1), fixed(2),
                                             fixed(1), fixed(1), fixed(1), fixed(1), fixed(1)};
constexpr std::size_t kTrackAge = 1, kPrimaryAge = 2;

// 500.
constexpr std::array<Shape, 8> kAccuracyParts = {fixed(4), fixed(2), fixed(4), fixed(1),
                                                 fixed(1), fixed(2), fixed(2), fixed(1)};
constexpr std::size_t kPositionPart = 1, kCovariancePart = 2, kVelocityPart = 6;

Bytes part_of(const std::optional<double>& value, const Quantity& quantity) {
  Bytes part;
  if (value) append_quantities(part, {{quantity, *value}});
  return part;
}

Bytes part_of(const std::optional<AsterixVector>& vector, const Quantity& quantity) {
  Bytes part;
  asterix::write_vector(part, vector, quantity);
  return part;
}

void read_part(const ItemOctets& item, std::size_t number, const Quantity& quantity,
               std::optional<double>& value) {
  const auto octets = item.parts[number - 1];
  if (!octets.empty()) value = quantity_at(octets, 0, quantity);
}

void read_part(const ItemOctets& item, std::size_t number, const Quantity& quantity,
               std::optional<AsterixVector>& vector) {
  const auto octets = item.parts[number - 1];
  if (!octets.empty()) vector = asterix::read_vector(octets, quantity);
}

void write_ages(Bytes& out, const Cat062Report& report) {
  asterix::PartWriter parts;
  parts.add(kTrackAge, part_of(report.track_age_s, kAge));
  parts.add(kPrimaryAge, part_of(report.primary_age_s, kAge));
  if (!parts.is_empty()) parts.append_to(out);
}

bool read_ages(const ItemOctets& item, Cat062Report& report) {
  read_part(item, kTrackAge, kAge, report.track_age_s);
  read_part(item, kPrimaryAge, kAge, report.primary_age_s);
  return true;
}

void write_accuracies(Bytes& out, const Cat062Report& report) {
  asterix::PartWriter parts;
  parts.add(kPositionPart, part_of(report.position_deviation, kDeviation));
  parts.add(kCovariancePart, part_of(report.position_covariance_m, kCovariance));
  parts.add(kVelocityPart, part_of(report.velocity_deviation, kSpeedDeviation));
  if (!parts.is_empty()) parts.append_to(out);
}

bool read_accuracies(const ItemOctets& item, Cat062Report& report) {
  read_part(item, kPositionPart, kDeviation, report.position_deviation);
  read_part(item, kCovariancePart, kCovariance, report.position_covariance_m);
  read_part(item, kVelocityPart, kSpeedDeviation, report.velocity_deviation);
  return true;
}

// Of items that are passed over.
constexpr std::array<Shape, 28> kAircraftParts = {
    fixed(3),   fixed(6),     fixed(2), fixed(2),    fixed(2), fixed(2), fixed(2),
    extended(), repeated(15), fixed(2), fixed(2),    fixed(7), fixed(2), fixed(2),
    fixed(2),   fixed(2),     fixed(2), fixed(2),    fixed(1), fixed(8), fixed(1),
    fixed(6),   fixed(2),     fixed(1), repeated(8), fixed(2), fixed(2), fixed(2)};
constexpr std::array<Shape, 31> kDataAgeParts = [] {
  std::array<Shape, 31> parts = {};
  for (Shape& part : parts) part = fixed(1);
  return parts;
}();
constexpr std::array<Shape, 18> kFlightPlanParts = {
    fixed(2), fixed(7), fixed(4),    fixed(1), fixed(4), fixed(1), fixed(4), fixed(4), fixed(3),
    fixed(2), fixed(2), repeated(4), fixed(6), fixed(1), fixed(7), fixed(7), fixed(2), fixed(7)};
constexpr std::array<Shape, 7> kMode5Parts = {fixed(1), fixed(4), fixed(6), fixed(2),
                                              fixed(2), fixed(1), fixed(1)};
constexpr std::array<Shape, 6> kMeasuredParts = {fixed(2), fixed(4), fixed(2),
                                                 fixed(2), fixed(2), fixed(1)};

using Row = asterix::ItemRow<Cat062Report>;
constexpr std::size_t kSourceItem = 1, kTrackNumberItem = 12, kStatusItem = 13;
constexpr std::array<Row, 35> kRows = {{
    {"010", fixed(2),
     [](Bytes& out, const Cat062Report& report) { asterix::write_source(out, report.source); },
     [](const ItemOctets& item, Cat062Report& report) {
       report.source = asterix::read_source(item);
       return true;
     }},
    {},
    {"015", fixed(1),
     [](Bytes& out, const Cat062Report& report) {
       if (report.service) out.push_back(*report.service);
     },
     [](const ItemOctets& item, Cat062Report& report) {
       report.service = item.octet(0);
       return true;
     }},
    {"070", fixed(3),
     [](Bytes& out, const Cat062Report& report) {
       asterix::write_time_of_day(out, report.time_of_day);
     },
     [](const ItemOctets& item, Cat062Report& report) {
       return asterix::read_time_of_day(item, report.time_of_day);
     }},
    {"105", fixed(8),
     [](Bytes& out, const Cat062Report& report) {
       asterix::write_place(out, report.place, kPlaceBits);
     },
     [](const ItemOctets& item, Cat062Report& report) {
       return asterix::read_place(item, report.place, kPlaceBits);
     }},
    {"100", fixed(6),
     [](Bytes& out, const Cat062Report& report) {
       asterix::write_plane(out, report.position, kPlane);
     },
     [](const ItemOctets& item, Cat062Report& report) {
       report.position = asterix::read_plane(item, kPlane);
       return true;
     }},
    {"185", fixed(4),
     [](Bytes& out, const Cat062Report& report) {
       asterix::write_vector(out, report.velocity, kVelocity);
     },
     [](const ItemOctets& item, Cat062Report& report) {
       report.velocity = asterix::read_vector(item.octets, kVelocity);
       return true;
     }},
    {"210", fixed(2),
     [](Bytes& out, const Cat062Report& report) {
       asterix::write_vector(out, report.acceleration, kAcceleration);
     },
     [](const ItemOctets& item, Cat062Report& report) {
       report.acceleration = asterix::read_vector(item.octets, kAcceleration);
       return true;
     }},
    {"060", fixed(2)},
    {"245", fixed(7)},
    {"380", compound(kAircraftParts)},
    {"040", fixed(2),
     [](Bytes& out, const Cat062Report& report) { append_big_endian(out, report.track_number, 2); },
     [](const ItemOctets& item, Cat062Report& report) {
       report.track_number = big_endian_at<std::uint16_t>(item.octets, 0);
       return true;
     }},
    {"080", extended(), write_status, read_status},
    {"290", compound(kAgeParts), write_ages, read_ages},
    {"200", fixed(1), write_movement, read_movement},
    {"295", compound(kDataAgeParts)},
    {"136", fixed(2)},
    {"130", fixed(2)},
    {"135", fixed(2)},
    {"220", fixed(2)},
    {"390", compound(kFlightPlanParts)},
    {"270", extended(),
     [](Bytes& out, const Cat062Report& report) { asterix::write_size(out, report.size); },
     [](const ItemOctets& item, Cat062Report& report) {
       report.size = asterix::read_size(item);
       return true;
     }},
    {"300", fixed(1)},
    {"110", compound(kMode5Parts)},
    {"120", fixed(2)},
    {"510", extended(3)},
    {"500", compound(kAccuracyParts), write_accuracies, read_accuracies},
    {"340", compound(kMeasuredParts)},
    {},
    {},
    {},
    {},
    {},
    {"RE", asterix::lengthy()},
    {"SP", asterix::lengthy()},
}};

constexpr asterix::RecordTable<Cat062Report> kTable{
    62, "CAT062", kRows, asterix::ItemSet<std::size_t>(kSourceItem, kTrackNumberItem, kStatusItem)};

}  // namespace
}  // namespace skerry::cat062

namespace skerry {

std::vector<Bytes> encode_cat062(std::span<const Cat062Report> reports, std::size_t most) {
  return asterix::encode_records(cat062::kTable, reports, most);
}

Result<std::vector<Cat062Report>, WireError> decode_cat062(std::span<const std::uint8_t> datagram) {
  return asterix::decode_records(cat062::kTable, datagram);
}

}  // namespace skerry
