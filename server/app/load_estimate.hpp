// LoadEstimate: how much of this machine a scenario takes, found by a trial run.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "server/app/load_watch.hpp"

namespace skerry::server {

struct LoadEstimate {
  double cpu_s = 0.0;         // that this process took
  double ran_s = 0.0;         // in so many seconds
  std::uint64_t sectors = 0;  // that the antennas passed meanwhile
  std::uint64_t skipped = 0;  // of these, left out for want of time
  std::size_t cores = 1;      // that this process may use

  // Above it radars are likely to leave out sectors: the rest is for consoles, recordings, tracked
  // targets and other programs.
  static constexpr double kMostShare = 0.7;
  // Cores that would make all sectors, if those left out cost as much as the others.
  // Infinite if nothing was made.
  double needed_cores() const;
  bool is_too_much() const { return skipped > 0 || needed_cores() > kMostShare * double(cores); }
  // One line, for people.
  std::string text() const;
};

// Of what runs while `wait` waits for the time it is given; the first kBefore are not counted.
// pace: of its radars, the same every time.
constexpr std::chrono::milliseconds kBefore{1000}, kTrial{3000};
LoadEstimate estimate_load(const std::function<std::vector<RadarPace>()>& pace,
                           const std::function<void(std::chrono::milliseconds)>& wait);

}  // namespace skerry::server
