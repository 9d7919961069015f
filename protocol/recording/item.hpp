// Items of a recording, each with a topic and a time.
#pragma once

#include <compare>
#include <cstdint>
#include <span>
#include <string>

#include "protocol/quantity/time.hpp"

namespace skerry::recording {

// topics.hpp has a row for each with its message.
enum class Kind : std::uint8_t {
  hello,  // the first item of a file
  spoke,  // also where the file packs many into one message
  settings,
  own_ship,
  world,
  traffic,
  event,
  log,
  input,     // what an exercise was given; those of all radars in one order
  exercise,  // the exercise as instructors are told it: truth
  targets,   // what a view's plotter has
  plots,     // and what it found in the video
  audit,     // who did what
};
inline constexpr std::size_t kKinds = 13;

struct Topic {
  Kind kind = Kind::event;
  std::uint32_t radar = 0;  // 0 where the kind's Scope has none
  std::uint32_t view = 0;   // the same
  friend constexpr auto operator<=>(const Topic&, const Topic&) = default;
};

// The latest time a reader gives, in 2223; the earliest is 1970.  Some 38 years can be added
// without overflow. A later time in a file becomes this.
inline constexpr UtcTime kLatestTime{Duration(8'000'000'000'000'000'000)};

// `bytes` are the protobuf message alone, without framing.
struct Item {
  Topic topic;
  UtcTime time{};  // of a spoke, its utc_ns; at most kLatestTime where it was read
  std::span<const std::uint8_t> bytes;
};

// Octets of an item: no message of the native protocol comes near.
inline constexpr std::size_t kMaxItem = 16 << 20;

// A small file inside the file: the scenario, the identity of the charts.
struct Attachment {
  std::string name;        // "scenario.yaml"
  std::string media_type;  // "application/yaml"
  UtcTime time{};
  std::string bytes;  // at most kMaxAttachment
};
inline constexpr std::size_t kMaxAttachment = 16 << 20;

// A fault of a file, and its place.
struct RecordingError {
  std::string file;          // as it was given
  std::uint64_t offset = 0;  // byte in the file
  std::string text;          // what was wrong, what was expected

  // "FILE: byte 4711: ..."
  std::string to_string() const { return file + ": byte " + std::to_string(offset) + ": " + text; }
};

}  // namespace skerry::recording
