// Tracker::Book: all targets that are followed, and the plots that have no target yet.
#pragma once

#include <deque>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "protocol/quantity/speed.hpp"
#include "server/plotter/tracks/false_plots.hpp"
#include "server/plotter/tracks/ground_plane.hpp"
#include "server/plotter/tracks/look.hpp"
#include "server/plotter/tracks/lost_targets.hpp"
#include "server/plotter/tracks/own_motion.hpp"
#include "server/plotter/tracks/suspect_echoes.hpp"
#include "server/plotter/tracks/target.hpp"
#include "server/plotter/tracks/tracker.hpp"

namespace skerry::server {

// Within [-180, 180).
inline double wrapped_deg(double degrees) {
  while (degrees >= 180.0) degrees -= 360.0;
  while (degrees < -180.0) degrees += 360.0;
  return degrees;
}

class Tracker::Book {
 public:
  explicit Book(const Rule& rule) : rule_(rule) {}

  void add(const Plot& plot);
  void pass(const AntennaPass& antenna);
  std::vector<PlottedTrack> tracks() const;
  std::vector<PlottedTrack> take_lost();
  std::uint32_t acquire(GeoPoint place, double within_m);
  bool cancel(std::uint32_t number);
  void change(const Rule& rule) { rule_ = rule; }
  void set_areas(std::vector<Area> areas) { areas_ = std::move(areas); }
  Counts counts() const;

 private:
  static constexpr std::size_t kMostFollowed = 2000, kMostPlots = 4000, kMostLost = 1000;
  static constexpr std::size_t kMostExtended = 500;
  static constexpr double kMostSuspicion = 0.3;

  struct Followed {
    Target target;
    Look look;
    std::uint32_t number = 0;  // 0: not shown
    bool by_hand = false, refused = false, gone = false;
    double false_per_m2 = 1e-7;  // where it is
    unsigned as_one = 0;         // looks running at which it was where another is
    unsigned as_echo = 0;        // and at which it was where another's echo is
  };
  struct Extended {
    PlanePoint place;
    ScenarioTime time{};
  };
  struct Open {
    PlacedPlot placed;
    bool taken = false;
  };
  // Of a target, at the last step of the antenna.
  struct Sight {
    PlanePoint place;
    double gate_m = 0.0;
    double off_deg = 0.0;
  };
  // A target or a plot of a step, to be found by place.
  struct Placed {
    double east_m, north_m, gate_m;
    std::size_t index;
  };
  using ByEast = std::vector<Placed>;  // rising by east, then by index
  static ByEast::const_iterator first_from(const ByEast& list, double east_m);
  // Who is in a set; to clear it costs nothing.
  class Marks {
   public:
    void clear(std::size_t size);
    bool put(std::size_t one);  // false if it was in it

   private:
    std::vector<std::uint32_t> marks_;
    std::uint32_t now_ = 0;
  };

  void begin(const AntennaPass& antenna);
  void lay_plane_anew(GeoPoint anchor);
  PlacedPlot place(const Plot& plot) const;
  void look_into(PlacedPlot& placed) const;
  double bearing_of(PlanePoint from_own) const;
  double off_deg(PlanePoint place) const;

  // One step of the antenna: who has been passed, whose plot is whose, which plots are new.
  void step();
  Sight look_for(Followed& followed);
  void sort_by_east();
  void resolve();
  struct Rivals {
    std::vector<std::size_t> targets, plots;  // rising; of each target all plots are there
  };
  bool find_rivals_of(std::size_t first, bool may_wait);
  void find_plots_near(const Sight& sight);
  void decide(const std::vector<std::size_t>& who, const std::vector<std::size_t>& plots);
  void take(Followed& followed, PlacedPlot& placed, double density, std::size_t choice);
  std::vector<std::size_t> shared_plots(const std::vector<std::size_t>& who,
                                        const std::vector<std::size_t>& plots,
                                        const std::vector<std::size_t>& pairs) const;
  bool may_be_merged_into(const Followed& followed, const PlacedPlot& plot) const;
  void judge(Followed& followed);
  bool are_one(const Target& a, const Target& b) const;
  void join_duplicates_of(std::size_t who);
  bool is_echo_of(const Target& echo, const Target& cause, double times) const;
  void leave_out_if_echoed(std::size_t who);
  void leave_out(Followed& followed);
  bool deserves_a_track(const Followed& followed) const;
  bool is_under_way(const Target& target) const;
  bool meets_demands(const Target& target, bool among_echoes) const;
  bool outweighs_land(const Target& target) const;
  bool is_among_echoes(const Target& target) const;
  bool is_inshore(const Target& target) const;
  Acquire acquired_at(PlanePoint place) const;
  bool may_be_a_lost_one(const Followed& followed) const;
  void show(Followed& followed);
  void begin_new_ones();
  bool belongs_to_a_known_one(const PlacedPlot& plot) const;
  void drop_gone_ones();
  void tell_lost(const Followed& followed);
  PlottedTrack track_of(const Followed& followed, TrackStatus status) const;

  Rule rule_;
  std::vector<Area> areas_;
  std::optional<GroundPlane> plane_;
  OwnMotion own_motion_;
  AntennaPass antenna_;       // the last one
  PlanePoint own_place_;      // then
  double north_deg_ = 0.0;    // true north there, in the plane
  double stepped_deg_ = 0.0;  // the antenna at the last step
  ScenarioTime stepped_{};    // when that was
  double turn_s_ = 2.5;       // of the antenna, as it has been turning lately
  double late_deg_ = 1.0;     // so far past a plot the antenna is when it is told
  bool gap_ = false;          // spokes are missing since the last step
  std::vector<Followed> followed_;
  std::vector<Sight> sights_;  // of followed_
  std::vector<Open> open_;
  std::deque<Extended> extended_;  // of the last turns
  ByEast targets_by_east_, plots_by_east_;
  Rivals rivals_;
  Marks known_targets_, known_plots_;
  std::vector<std::pair<double, std::size_t>> by_distance_;
  std::vector<std::size_t> waiting_, near_;  // near_: what find_plots_near() found
  std::vector<std::size_t> choices_;         // of followed_: how many plots, as rivals_ were found
  double widest_gate_m_ = 0.0;
  FalsePlots false_plots_;
  SuspectEchoes suspects_;
  LostTargets lost_targets_;
  std::vector<PlottedTrack> lost_;  // to be told
  std::uint32_t numbers_ = 0, shown_ = 0;
  Counts counts_;
};

}  // namespace skerry::server
