// StraightFilter: a target that keeps its course and speed, until it no longer does.
#pragma once

#include "server/plotter/motion/motion_model.hpp"

namespace skerry::server {

// Mixing models costs memory: what the manoeuvring ones know less well leaks into the steady one
// at every step, so it never knows a steady ship's velocity as well as a straight line through all
// its places would (facts of the standard ask for that after three minutes).  This filter is that
// line: one model, hardly any noise, nothing mixed in.  Beside it the ImmFilter says how well each
// measurement fitted if the target may manoeuvre; a cumulated sum of the difference (Page 1954,
// "Continuous Inspection Schemes") tells a manoeuvre from chance, and the line begins anew where
// the ImmFilter stands.
class StraightFilter {
 public:
  struct Rule {
    MotionModel model{.acceleration = 1e-5};
    // A manoeuvre is told when measurements have fitted the ImmFilter by so many bits better.
    double told_bits = 8.0;
    // A measurement counts for at most so much either way: one stray plot is no manoeuvre.
    double most_bits = 4.0;
  };

  StraightFilter() : StraightFilter(Rule{}) {}
  explicit StraightFilter(const Rule& rule) : rule_(rule) {}

  void start(const MotionState& state);
  void predict(double seconds);
  // `other_log2_density`: of the same measurement, by the ImmFilter.  True if a manoeuvre is told:
  // then start() it with what the ImmFilter knows.
  bool correct(const MeasuredPlace& measured, double other_log2_density);

  const MotionState& state() const { return state_; }
  double seconds() const { return seconds_; }   // since start()
  double doubt_bits() const { return doubt_; }  // 0 to told_bits

  template <typename Change>
  void change(Change&& change) {
    change(state_);
  }

 private:
  Rule rule_;
  MotionState state_;
  double seconds_ = 0.0, doubt_ = 0.0;
};

}  // namespace skerry::server
