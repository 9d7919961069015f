// What a recording is made of: items, each with a topic and a time.
#pragma once

#include <compare>
#include <cstdint>
#include <span>
#include <string>

#include "protocol/quantity/time.hpp"

namespace skerry::recording {

// Of an item; in brackets the message its bytes are.
enum class Kind : std::uint8_t {
  hello,     // wire::Hello; the first item of a file
  spoke,     // wire::Spoke; also where the file packs many into one message
  settings,  // wire::Settings, of a radar and view
  own_ship,  // wire::OwnShip, of a radar
  world,     // wire::World
  traffic,   // recording::Traffic
  event,     // recording::Event
  log,       // recording::Log
  input,     // recording::Input, what an exercise was given; all radars' in one order
};
inline constexpr std::size_t kKinds = 9;

struct Topic {
  Kind kind = Kind::event;
  std::uint32_t radar = 0;  // of spoke, settings, own_ship; else 0
  std::uint32_t view = 0;   // of spoke, settings; else 0
  friend constexpr auto operator<=>(const Topic&, const Topic&) = default;
};

// What a reader gives lies between 1970 and here, in 2223: some 38 years can be added to it without
// an overflow.  A file may say more, which becomes this.
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

// What is wrong with a file, and where.
struct RecordingError {
  std::string file;          // as it was given
  std::uint64_t offset = 0;  // byte in the file
  std::string text;          // what was wrong, what was expected

  // "FILE: byte 4711: ..."
  std::string to_string() const;
};

}  // namespace skerry::recording
