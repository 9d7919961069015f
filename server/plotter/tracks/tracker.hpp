// Tracker: plots in, tracks out, while the turn goes on.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "server/plotter/plots/plot.hpp"
#include "server/plotter/tracks/track.hpp"

namespace skerry::server {

// Where the antenna points, and own ship is, when it has swept as far as this.
struct AntennaPass {
  ScenarioTime time{};
  UtcTime utc{};
  GeoPoint own_ship;
  TrueBearing bearing;
};

// Knows nothing but plots and where the antenna has been.  The same calls give the same tracks, bit
// for bit, on every machine.
//
// Thread: one at a time.
class Tracker {
 public:
  struct Rule {
    std::uint32_t most_tracks = 200;  // 1 to 1000; tentative ones do not count
  };
  Tracker() : Tracker(Rule{}) {}
  // Errors: std::invalid_argument, says which value is out of its range.
  explicit Tracker(const Rule& rule);
  ~Tracker();

  // Plots that the antenna has passed, in any order; then how far it has swept.  At least 16 passes
  // a turn, clockwise.
  void add(const Plot& plot);
  void pass(const AntennaPass& antenna);

  // Tracked ones by number, each at the time of the last pass; and those lost since the last call.
  std::vector<Track> tracks() const;
  std::vector<Track> take_lost();

 private:
  class Book;
  std::unique_ptr<Book> book_;
};

}  // namespace skerry::server
