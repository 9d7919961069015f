// The targets that a recording's lists tell: what was known aboard.
#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "protocol/recording/reader.hpp"
#include "protocol/wire/targets.pb.h"
#include "server/track_tool/track_writer.hpp"

namespace skerry::server {

// Rows of recorded lists.  A target is as the set told it: what is being acquired has neither
// course nor CPA.  One that is lost has one row `lost`; test targets have none.  A plotter that
// began anew counts from 1 again: its numbers follow the largest before.  Courses are over ground
// as long as the set was stabilised so.
class RecordedTracks {
 public:
  explicit RecordedTracks(TableWriter& table) : table_(table) {}
  // Numbers must be in range (bring_into_range()).  `time`: of the item.
  void add(UtcTime time, const wire::TargetList& list);

  std::uint64_t lists() const { return lists_; }
  std::size_t targets() const { return lost_.size(); }

 private:
  TableWriter& table_;
  std::uint64_t lists_ = 0, plots_ = 0;
  std::uint32_t base_ = 0, greatest_ = 0;
  std::map<std::uint32_t, bool> lost_;  // all that had a row, and whether it was the last one
};

struct RecordedChoice {
  std::optional<std::uint32_t> radar, view;  // without: the first that has lists
};
recording::Topic chosen_lists(const recording::RecordingReader& reader,
                              const RecordedChoice& choice);

struct ListsTaken {
  std::uint64_t lists = 0;
  std::uint64_t refused = 0;  // messages that are no list
  std::uint64_t chunks = 0;   // damaged, passed over
  std::size_t targets = 0;
  bool by_water = false;  // some list's courses are through water
};
// Error of both: std::runtime_error that names the file: it has none (of that radar and view).
ListsTaken write_recorded(const recording::RecordingReader& reader, const recording::Topic& topic,
                          TableWriter& table);

}  // namespace skerry::server
