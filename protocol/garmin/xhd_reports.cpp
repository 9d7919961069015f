#include "protocol/garmin/xhd_reports.hpp"

#include "protocol/wire/byte_order.hpp"

namespace skerry::garmin {
namespace {

// clang-format off
constexpr std::array<ReportSlot, 85> kSlots = {{
    {0x995, 4, 0, 10, 96},
    {0x996, 4, 1, 10, 5909},
    {0x994, 4, 9, 10, 0},
    {0x91c, 1, 2, 50, 0},
    {0x91e, 4, 3, 50, 1852},
    {0x91f, 4, 4, 50, 926},
    {0x992, 1, 42, 50, 3},
    {0x993, 4, 43, 50, 0},
    {0x918, 1, 44, 50, 2},
    {0x99c, 1, 45, 50, 1},
    {0x99d, 1, 46, 50, 0},
    {0x99e, 1, 47, 50, 0},
    {0x916, 1, 48, 50, 0},
    {0x93f, 1, 5, 200, 1},
    {0x940, 4, 6, 200, 5440},
    {0x941, 4, 7, 200, 4294961856},
    {0x942, 1, 8, 200, 0},
    {0x944, 2, 12, 200, 60},
    {0x943, 2, 13, 200, 300},
    {0x9a3, 2, 14, 200, 124},
    {0x9a4, 2, 15, 200, 78},
    {0x9a5, 1, 16, 200, 1},
    {0x9a6, 2, 17, 200, 3345},
    {0x9a7, 2, 18, 200, 0},
    {0x9a8, 2, 22, 200, 3200},
    {0x9a9, 2, 23, 200, 3000},
    {0x9aa, 4, 24, 200, 117589},
    {0x9ab, 4, 25, 200, 117560},
    {0x9ac, 4, 26, 200, 18385},
    {0x948, 2, 27, 200, 7491},
    {0x99f, 4, 28, 200, 88896},
    {0x9a0, 4, 32, 200, 6000},
    {0x9a1, 4, 33, 200, 1440},
    {0x9a2, 1, 34, 200, 0},
    {0x950, 2, 35, 200, 46},
    {0x920, 1, 36, 200, 1},
    {0x921, 2, 37, 200, 5020},
    {0x922, 2, 38, 200, 3900},
    {0x923, 1, 55, 200, 0},
    {0x92c, 1, 56, 200, 1},
    {0x91a, 1, 57, 200, 0},
    {0x92d, 1, 58, 200, 0},
    {0x955, 1, 62, 200, 0},
    {0x9af, 4, 63, 200, 19720},
    {0x9b0, 4, 64, 200, 4915},
    {0x928, 2, 65, 200, 3500},
    {0x929, 2, 66, 200, 1500},
    {0x92b, 2, 67, 200, 6500},
    {0x92a, 2, 68, 200, 5000},
    {0x958, 2, 72, 200, 5000},
    {0x957, 2, 73, 200, 5000},
    {0x951, 1, 74, 200, 2},
    {0x952, 1, 75, 200, 0},
    {0x953, 1, 76, 200, 0},
    {0x91b, 1, 77, 200, 0},
    {0x913, 1, 78, 200, 0},
    {0x932, 1, 82, 200, 0},
    {0x911, 1, 83, 200, 1},
    {0x912, 1, 84, 200, 0},
    {0x924, 1, 138, 200, 0},
    {0x925, 2, 155, 200, 5600},
    {0x91d, 1, 156, 200, 1},
    {0x914, 1, 157, 200, 8},
    {0x933, 1, 158, 200, 0},
    {0x935, 1, 162, 200, 2},
    {0x934, 2, 163, 200, 3200},
    {0x939, 1, 164, 200, 0},
    {0x93a, 2, 165, 200, 8700},
    {0x959, 2, 166, 200, 10000},
    {0x93b, 1, 167, 200, 2},
    {0x926, 1, 168, 200, 2},
    {0x927, 2, 172, 200, 5000},
    {0x956, 1, 173, 200, 1},
    {0x915, 1, 174, 200, 8},
    {0x936, 1, 175, 200, 0},
    {0x938, 1, 176, 200, 2},
    {0x937, 2, 177, 200, 5000},
    {0x93c, 1, 178, 200, 0},
    {0x93d, 2, 182, 200, 5000},
    {0x95a, 2, 183, 200, 5000},
    {0x93e, 1, 184, 200, 0},
    {0x917, 4, 185, 200, 2400},
    {0x919, 1, 186, 200, 1},
    {0x930, 4, 187, 200, 0},
    {0x931, 4, 188, 200, 0},
}};
// clang-format on

constexpr std::array<std::uint8_t, 48> kAbilities = {
    0x01, 0x00, 0x30, 0x00, 0x9d, 0x00, 0x0a, 0x00, 0xdf, 0xfe, 0xff, 0xff, 0xff, 0xff,
    0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xfd, 0xff, 0xff, 0x07};

constexpr std::array<std::uint8_t, 26> kHeartbeat = {
    0x02, 0x00, 0xd0, 0x06, 0x00, 0x05, 0x02, 0x01, 0x01, 0x00, 0x00, 0x00, 0x01,
    0x00, 0x02, 0x00, 0xa0, 0x0a, 0xd4, 0x08, 0x01, 0x04, 0x00, 0x00, 0x00, 0x00};
constexpr std::size_t kHeartbeatCount = 22;

}  // namespace

std::span<const ReportSlot> report_slots() { return kSlots; }

Bytes encode_abilities() { return encode_packet(kAbilitiesType, kAbilities); }

Bytes encode_ranges() {
  Bytes payload;
  append_little_endian(payload, 1, 2);
  append_little_endian(payload, 8 + 4 * kRanges.size(), 2);  // of the payload
  append_little_endian(payload, kRanges.size(), 4);
  for (const std::uint32_t range : kRanges) append_little_endian(payload, range, 4);
  return encode_packet(kRangesType, payload);
}

Bytes encode_heartbeat(std::uint16_t count) {
  auto payload = kHeartbeat;
  put_little_endian(payload, kHeartbeatCount, count, 2);
  return encode_packet(static_cast<std::uint32_t>(Type::heartbeat), payload);
}

}  // namespace skerry::garmin
