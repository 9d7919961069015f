// Target: one track from its first plot on: how it moves, and how often it was seen.
#pragma once

#include "server/plotter/motion/imm_filter.hpp"
#include "server/plotter/motion/straight_filter.hpp"
#include "server/plotter/plots/plot.hpp"
#include "server/plotter/tracks/signs.hpp"
#include "server/plotter/tracks/suspect_echoes.hpp"
#include "server/plotter/tracks/track.hpp"

namespace skerry::server {

// A plot in the plane.
struct PlacedPlot {
  Plot plot;
  MeasuredPlace measured;
  bool suspect = false;  // land, or an echo of an echo, to and fro
  bool lobe = false;     // another echo's doing, perhaps
  SuspectEchoes::Causes causes;
  bool on_old_ground = false;  // Target::is_on_old_ground()
  double choice = 1.0;         // plots near the target, this one included
};

class Target {
 public:
  // Seen for the first time.  `fastest_mps`: no target is faster.
  Target(const PlacedPlot& plot, double fastest_mps);

  // Where it is at this time by the best of what is known; and where its plot is expected, which
  // may turn away: within gate_m() of it, m, nearly always.
  PlanePoint place_at(ScenarioTime time) const;
  PlanePoint expected_at(ScenarioTime time) const;
  double gate_m(ScenarioTime time) const;
  // Its state goes on to this time, which is not before time().
  void go_on(ScenarioTime time);
  // How far the plot is from where the target is then, in its own noise's scale.
  Innovation off(const PlacedPlot& plot) const;
  // An echo stood there, by Plot::stood, before this target can have been so near.
  bool is_on_old_ground(const PlacedPlot& plot, double turn_s) const;
  // The plot is its echo, or it was looked for and not seen.  Bits that the plot speaks for a
  // target, against one of `false_per_m2` that are there by chance (Sittler's score).
  void see(const PlacedPlot& plot, double false_per_m2);
  void miss();
  // The plot is its echo and another target's, which are one: it was seen, and nobody knows where.
  // It goes on as it did.
  void share(const PlacedPlot& plot);
  // It may: it is under way, and that is known well enough to tell it from the other when they
  // part, and it has not for too long.
  bool may_share(ScenarioTime time) const;

  // The best of what is known: a straight line, unless it manoeuvres.
  const MotionState& state() const;
  bool keeps_course() const;
  ScenarioTime time() const { return time_; }
  ScenarioTime first_seen() const { return first_seen_; }
  ScenarioTime last_seen() const { return last_seen_; }
  PlanePoint first_place() const { return first_place_; }
  double age_s() const;  // from the first to the last plot
  double speed_sigma_mps() const;
  double score_bits() const { return score_bits_; }
  unsigned looks() const { return looks_; }  // of the last ten
  unsigned hits() const;
  unsigned misses_in_a_row() const { return misses_; }
  unsigned hits_ever() const { return hits_ever_; }
  // Share of its plots that were suspect, of the last ten or so; as lobes, of the same cause.
  double suspicion() const { return suspicion_; }
  const Signs& signs() const { return signs_; }
  double length_m() const { return length_m_; }
  double width_m() const { return width_m_; }

  template <typename Change>
  void change(Change&& change) {
    imm_.change(change);
    straight_.change(change);
  }
  void move_first_place(PlanePoint place) { first_place_ = place; }

  // Squared, of two degrees of freedom: steady targets stay below 13.8 in 99.9 % of turns; those
  // that begin a turn need more.  What is more likely there by chance is left out by its cost.
  static constexpr double kGate = 30.0;
  static constexpr double kSeen = 0.8;  // probability that a target is seen

 private:
  MeasuredPlace scaled(const PlacedPlot& plot) const;

  ImmFilter imm_;
  StraightFilter straight_;
  ScenarioTime time_{}, first_seen_{}, last_seen_{};
  PlanePoint first_place_;
  // What plots of it are off by, in terms of what they say: learnt.
  double noise_scale_ = 1.0;
  double plot_sigma_m_ = 30.0;    // of the last plot, the larger axis
  SuspectEchoes::Causes causes_;  // of its last plot that had any
  double score_bits_ = 0.0, suspicion_ = 0.0;
  Signs signs_;
  ScenarioTime shares_since_{};
  bool shares_ = false;  // its last plot
  unsigned looks_ = 1, misses_ = 0, hits_ever_ = 1;
  std::uint16_t seen_ = 1;  // a bit for each of the last ten looks, the lowest is the last
  double length_m_ = 0.0, width_m_ = 0.0;
};

}  // namespace skerry::server
