// A plotter's lists as reports of ASTERIX.  Pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "protocol/asterix/cat010.hpp"
#include "protocol/asterix/cat048.hpp"
#include "protocol/asterix/cat062.hpp"
#include "protocol/wire/targets.pb.h"

namespace skerry::server {

// One target of a list, as it is to be told.
struct ReportedTrack {
  wire::Target target;
  unsigned number = 0;    // told for target.number
  bool is_new = false;    // not told before
  bool is_ended = false;  // told for the last time
};

// What receivers of the lists know.
class ToldTracks {
 public:
  // Numbers are 1 to `most`.  Greater ones wrap: after `most` comes 1 again; where that is told for
  // another target, the next free one is taken.  Requires 1 <= most.
  explicit ToldTracks(unsigned most) : most_(most) {}

  // The tracks of the next list, by number.  One that is lost, and one that the list does not have
  // any more, is told once more as ended, where it was; nothing of one that was not told before.
  std::vector<ReportedTrack> next(const wire::TargetList& list);

 private:
  struct Told {
    wire::Target target;  // as it was told last
    unsigned number = 0;
    bool is_ended = false;
  };
  unsigned free_number(std::uint32_t number) const;

  const unsigned most_;
  std::map<std::uint32_t, Told> told_;  // by target.number
};

// What is to be told at once.
struct ReportedTargets {
  AsterixSource source = {};
  // A target that was not seen for longer than this is extrapolated.
  double extrapolated_after_s = 5.0;
  const wire::TargetList* list = nullptr;  // that of the tracks; nullptr: no tracks
  std::span<const ReportedTrack> tracks = {};
  const wire::TargetPlots* plots = nullptr;  // nullptr: no plots
};

// The greatest track numbers.
inline constexpr unsigned kMostCat048Track = 4095, kMostCat062Track = 65'535,
                          kMostCat010Track = 4095;

// Plots, then tracks, both by range and bearing from the radar as it was then.  Velocities are
// told if they are over ground.
std::vector<Cat048Report> cat048_reports(const ReportedTargets& news);

// Tracks alone, but for test targets, which the category cannot mark.
std::vector<Cat062Report> cat062_reports(const ReportedTargets& news);

// As cat048_reports(), with places.  With a list come an update cycle, which so is a list and not a
// turn, and the state of the system.
std::vector<Cat010Report> cat010_reports(const ReportedTargets& news);

}  // namespace skerry::server
