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
  double reach_m = 0.0;    // of the video: beyond, nothing can be seen
  double width_rad = 0.0;  // swept since the pass before; if the bearing has gone on by more than
                           // twice as much, spokes are missing
};

// Knows nothing but plots and where the antenna has been.  The same calls give the same tracks, bit
// for bit, on every machine.
//
// Thread: one at a time.
class Tracker {
 public:
  // What becomes a track by itself.
  enum class Acquire : std::uint8_t { none, moving, all };
  struct Rule {
    std::uint32_t most_tracks = 200;  // 1 to 1000; those that are not shown do not count
    Acquire acquire = Acquire::moving;
    double least_speed_kn = 2.0;   // of what moves, 0 to 20
    double fastest_kn = 75.0;      // 10 to 200
    double furthest_nm = 24.0;     // plots beyond are not used, 0.1 to 120
    double sure_bits = 20.0;       // that a target is none by chance, 3 to 24
    std::uint32_t least_hits = 4;  // before it is shown, 3 to 20
    // Errors that plots do not know of, standard deviations: of the bow's direction and the
    // antenna's, and of a hull that glints here and there.
    double bearing_sigma_deg = 0.15;  // 0 to 5
    double range_sigma_m = 6.0;       // 0 to 200
  };
  Tracker() : Tracker(Rule{}) {}
  // Errors: std::invalid_argument, says which value is out of its range.
  explicit Tracker(const Rule& rule);
  ~Tracker();
  Tracker(Tracker&&) noexcept;
  Tracker& operator=(Tracker&&) noexcept;

  // Plots that the antenna has passed, at most a minute ago, in any order; then how far it has
  // swept.  At least 16 passes a turn, clockwise.
  void add(const Plot& plot);
  void pass(const AntennaPass& antenna);

  // Tracked ones by number, each at the time of the last pass; and those lost since the last call.
  std::vector<PlottedTrack> tracks() const;
  std::vector<PlottedTrack> take_lost();

  // From now on; what is followed stays.  More than `most_tracks` that are shown stay shown.
  // Errors: as the constructor's; then nothing has changed.
  void change(const Rule& rule);
  // Where targets are acquired in another way than Rule::acquire has it, around own ship; the first
  // that a target is in counts.  From now on, for what is not yet shown.
  struct Area {
    double inner_m = 0.0, outer_m = 0.0;
    double from_deg = 0.0, to_deg = 0.0;  // true, [0, 360], clockwise; equal: all round
    Acquire acquire = Acquire::all;
  };
  void set_areas(std::vector<Area> areas);

  // What a mariner orders.  Acquires the echo nearest to a place, within `within_m`: its number, or
  // 0 if there is no echo.
  std::uint32_t acquire(GeoPoint place, double within_m);
  // True if there was such a track.
  bool cancel(std::uint32_t number);

  struct Counts {
    std::uint64_t plots = 0, paired = 0, begun = 0;
    std::uint64_t left_out = 0;  // no room for a new one
    std::uint64_t resets = 0;    // the time or own ship leapt: all began anew
    std::size_t followed = 0;    // now, tracked or not
  };
  Counts counts() const;

 private:
  class Book;
  std::unique_ptr<Book> book_;
};

}  // namespace skerry::server
