#include "protocol/asterix/cat048.hpp"

#include <array>

#include "protocol/asterix/common_items.hpp"
#include "protocol/asterix/record_table.hpp"

namespace skerry::cat048 {
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

constexpr Quantity kRange{.unit = 1852.0 / 256};                          // 040
constexpr Quantity kPlane{.unit = 1852.0 / 128, .is_signed = true};       // 042
constexpr Quantity kRunLength{1, 360.0 / 8192, false, true};              // 130 PRL
constexpr Quantity kAmplitude{1, 1.0, true, true};                        // 130 PAM
constexpr Quantity kDeviation{1, 1852.0 / 128, false, true};              // 210 SIGX, SIGY
constexpr Quantity kSpeedDeviation{1, asterix::kSpeedUnit, false, true};  // 210 SIGV
constexpr Quantity kCourseDeviation{1, 360.0 / 4096, false, true};        // 210 SIGH

// 020.
constexpr unsigned kSimulated = 0x10, kTest = 0x80, kDetectionShift = 5;

void write_descriptor(Bytes& out, const Cat048Report& report) {
  const unsigned detection = static_cast<unsigned>(report.detection) << kDetectionShift;
  append_extended(out,
                  {detection | (report.is_simulated ? kSimulated : 0), report.is_test ? kTest : 0});
}

bool read_descriptor(const ItemOctets& item, Cat048Report& report) {
  report.detection = static_cast<Cat048Detection>(item.octet(0) >> kDetectionShift);
  report.is_simulated = (item.octet(0) & kSimulated) != 0;
  report.is_test = (item.octet(1) & kTest) != 0;
  return true;
}

// 130.
constexpr std::array<Shape, 7> kPlotParts = {fixed(1), fixed(1), fixed(1), fixed(1),
                                             fixed(1), fixed(1), fixed(1)};
constexpr std::size_t kRunLengthPart = 4, kAmplitudePart = 5;

void write_plot(Bytes& out, const Cat048Report& report) {
  asterix::PartWriter parts;
  Bytes length, amplitude;
  if (report.run_length_deg) append_quantities(length, {{kRunLength, *report.run_length_deg}});
  if (report.amplitude_dbm) append_quantities(amplitude, {{kAmplitude, *report.amplitude_dbm}});
  parts.add(kRunLengthPart, length);
  parts.add(kAmplitudePart, amplitude);
  if (!parts.is_empty()) parts.append_to(out);
}

bool read_plot(const ItemOctets& item, Cat048Report& report) {
  const auto length = item.parts[kRunLengthPart - 1], amplitude = item.parts[kAmplitudePart - 1];
  if (!length.empty()) report.run_length_deg = quantity_at(length, 0, kRunLength);
  if (!amplitude.empty()) report.amplitude_dbm = quantity_at(amplitude, 0, kAmplitude);
  return true;
}

// 170: the first octet, and the second.
constexpr unsigned kTentative = 0x80, kSensorsShift = 5, kSensors = 3, kDoubtful = 0x10,
                   kManoeuvring = 0x08, kEnded = 0x80, kGhost = 0x40;

void write_status(Bytes& out, const Cat048Report& report) {
  if (!report.status) return;
  const Cat048TrackStatus& status = *report.status;
  append_extended(
      out, {(status.is_tentative ? kTentative : 0) |
                static_cast<unsigned>(status.sensors) << kSensorsShift |
                (status.is_doubtful ? kDoubtful : 0) | (status.is_manoeuvring ? kManoeuvring : 0),
            (status.is_ended ? kEnded : 0) | (status.is_ghost ? kGhost : 0)});
}

bool read_status(const ItemOctets& item, Cat048Report& report) {
  const unsigned first = item.octet(0), second = item.octet(1);
  report.status =
      Cat048TrackStatus{.is_tentative = (first & kTentative) != 0,
                        .sensors = static_cast<Cat048Sensors>(first >> kSensorsShift & kSensors),
                        .is_doubtful = (first & kDoubtful) != 0,
                        .is_manoeuvring = (first & kManoeuvring) != 0,
                        .is_ended = (second & kEnded) != 0,
                        .is_ghost = (second & kGhost) != 0};
  return true;
}

void write_quality(Bytes& out, const Cat048Report& report) {
  if (!report.quality) return;
  append_quantities(out, {{kDeviation, report.quality->east_m},
                          {kDeviation, report.quality->north_m},
                          {kSpeedDeviation, report.quality->speed_mps},
                          {kCourseDeviation, report.quality->course_deg}});
}

bool read_quality(const ItemOctets& item, Cat048Report& report) {
  report.quality = Cat048Quality{
      quantity_at(item.octets, 0, kDeviation), quantity_at(item.octets, 1, kDeviation),
      quantity_at(item.octets, 2, kSpeedDeviation), quantity_at(item.octets, 3, kCourseDeviation)};
  return true;
}

constexpr std::array<Shape, 2> kDopplerParts = {fixed(2), repeated(6)};

using Row = asterix::ItemRow<Cat048Report>;
constexpr std::array<Row, 28> kRows = {{
    {"010", fixed(2),
     [](Bytes& out, const Cat048Report& report) { asterix::write_source(out, report.source); },
     [](const ItemOctets& item, Cat048Report& report) {
       report.source = asterix::read_source(item);
       return true;
     }},
    {"140", fixed(3),
     [](Bytes& out, const Cat048Report& report) {
       asterix::write_time_of_day(out, report.time_of_day);
     },
     [](const ItemOctets& item, Cat048Report& report) {
       return asterix::read_time_of_day(item, report.time_of_day);
     }},
    {"020", extended(), write_descriptor, read_descriptor},
    {"040", fixed(4),
     [](Bytes& out, const Cat048Report& report) {
       asterix::write_polar(out, report.measured, kRange);
     },
     [](const ItemOctets& item, Cat048Report& report) {
       report.measured = asterix::read_polar(item, kRange);
       return true;
     }},
    {"070", fixed(2)},
    {"090", fixed(2)},
    {"130", compound(kPlotParts), write_plot, read_plot},
    {"220", fixed(3)},
    {"240", fixed(6)},
    {"250", repeated(8)},
    {"161", fixed(2),
     [](Bytes& out, const Cat048Report& report) {
       asterix::write_track_number(out, report.track_number);
     },
     [](const ItemOctets& item, Cat048Report& report) {
       report.track_number = asterix::read_track_number(item);
       return true;
     }},
    {"042", fixed(4),
     [](Bytes& out, const Cat048Report& report) {
       asterix::write_plane(out, report.position, kPlane);
     },
     [](const ItemOctets& item, Cat048Report& report) {
       report.position = asterix::read_plane(item, kPlane);
       return true;
     }},
    {"200", fixed(4),
     [](Bytes& out, const Cat048Report& report) { asterix::write_velocity(out, report.velocity); },
     [](const ItemOctets& item, Cat048Report& report) {
       report.velocity = asterix::read_velocity(item);
       return true;
     }},
    {"170", extended(), write_status, read_status},
    {"210", fixed(4), write_quality, read_quality},
    {"030", extended()},
    {"080", fixed(2)},
    {"100", fixed(4)},
    {"110", fixed(2)},
    {"120", compound(kDopplerParts)},
    {"230", fixed(2)},
    {"260", fixed(7)},
    {"055", fixed(1)},
    {"050", fixed(2)},
    {"065", fixed(1)},
    {"060", fixed(2)},
    {"SP", asterix::lengthy()},
    {"RE", asterix::lengthy()},
}};

constexpr asterix::RecordTable<Cat048Report> kTable{48, "CAT048", kRows,
                                                    asterix::ItemSet<std::size_t>(std::size_t{1})};

}  // namespace
}  // namespace skerry::cat048

namespace skerry {

std::vector<Bytes> encode_cat048(std::span<const Cat048Report> reports, std::size_t most) {
  return asterix::encode_records(cat048::kTable, reports, most);
}

Result<std::vector<Cat048Report>, WireError> decode_cat048(std::span<const std::uint8_t> datagram) {
  return asterix::decode_records(cat048::kTable, datagram);
}

}  // namespace skerry
