// RadarNumbers: which radar of which source is which radar of recordings joined together.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "protocol/recording/item.hpp"
#include "protocol/recording/reader.hpp"

namespace skerry::client {

// Thread: one at a time.
class RadarNumbers {
 public:
  // join_recordings() says the rule.
  explicit RadarNumbers(std::span<const recording::RecordingReader> sources);

  std::uint32_t of(std::size_t source, std::uint32_t radar) const;
  // The first source's, with the radars of all.
  const wire::Hello& hello() const { return hello_; }
  // "radar 0 of b.mcap is radar 1": those that changed.
  const std::vector<std::string>& changes() const { return changes_; }

  // An item with the radars in its topic and in its message renamed; bytes that do not change, or
  // cannot be read, stay as they are.  Valid until the next call.
  recording::Item renamed(std::size_t source, const recording::Item& item);

 private:
  void add(std::size_t source, const recording::RecordingReader& reader, bool follows);

  std::vector<std::map<std::uint32_t, std::uint32_t>> numbers_;  // by source
  std::map<std::uint32_t, wire::RadarInfo> taken_;               // by new number
  wire::Hello hello_;
  std::vector<std::string> changes_;
  std::string bytes_;
};

}  // namespace skerry::client
