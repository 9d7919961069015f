// What of a log is not used, counted by kind.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace skerry::server {

enum class LeftOut : std::uint8_t {
  // Lines.
  no_sentence,     // text without a sentence
  too_long,        // beyond the longest line, or the longest sentence
  cut_short,       // no checksum at its end, a TAG block that does not end
  bad_checksum,    // or characters that a sentence may not have
  bad_row,         // of a table: a column is missing or cannot be read
  other_sentence,  // neither VDM nor VDO
  // Messages.
  incomplete,    // a part of it is missing
  malformed,     // too short for its kind, or no six-bit text
  unknown_type,  // a kind of message without a ship's place or name
  bad_mmsi,      // not that of a ship
  base_station,
  aid,       // to navigation
  distress,  // AIS-SART, man overboard, EPIRB
  aircraft,
  // Fixes.
  no_position,  // "not available"
  no_time,
  out_of_time,  // before --from or after --until
  out_of_area,
  time_back,  // not a second later than the ship's fix before
  jump,       // no ship is so fast
  single,     // the only fix within the longest gap
  too_many,   // of a ship beyond the most that are followed
};
inline constexpr std::size_t kLeftOutKinds = 22;

// For people: "wrong checksum".
std::string_view name_of(LeftOut kind);

class LeftOutCounts {
 public:
  void add(LeftOut kind, std::uint64_t count = 1) {
    counts_[static_cast<std::size_t>(kind)] += count;
  }
  std::uint64_t of(LeftOut kind) const { return counts_[static_cast<std::size_t>(kind)]; }
  std::uint64_t all() const;

 private:
  std::array<std::uint64_t, kLeftOutKinds> counts_ = {};
};

}  // namespace skerry::server
