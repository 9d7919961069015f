// Places of the truth and of tracks at any time, on one plane.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "echo/chart/local_plane.hpp"
#include "server/plotter/judge/truth_and_told.hpp"

namespace skerry::server {

// Place and motion on the plane of the scene, m and m/s.  The plane's north is true north at its
// anchor, and 0.1 deg off 5 km east of it at 60 N: less than what courses are judged to.
struct PlaneState {
  PlanePoint place, velocity_mps;
};

// A true course, deg, and a speed, kn, as m/s east and north.
PlanePoint velocity_of(double course_deg, double speed_kn);
// [0, 360); of no motion 0.
double course_of(PlanePoint velocity_mps);
// The smaller turn from b to a, deg, in [-180, 180).
double turn_between(double a_deg, double b_deg);

// The anchor of the scene's plane: where own ship began, or else the first target.
echo::LocalPlane plane_of(const Truth& truth);

// The truth of one ship.
class TruthSeries {
 public:
  static constexpr double kMostGap_s = 30.0, kBeyond_s = 0.5, kBase_s = 5.0;

  // Sorts by time and drops points at a time that was there already, and what is not finite.
  TruthSeries(std::span<const TruthPoint> points, const echo::LocalPlane& plane,
              double beyond_s = kBeyond_s);

  bool empty() const { return points_.empty(); }
  double first_s() const { return points_.front().utc_s; }  // requires !empty()
  double last_s() const { return points_.back().utc_s; }    // likewise
  // Straight between two points no more than kMostGap_s apart, and as far as beyond_s before the
  // first and after the last.  Motion: as told at both points, else over kBase_s about the time.
  std::optional<PlaneState> at(double utc_s) const;
  // Does the ship keep course and speed from `window_s` before to as much after, as far as its
  // truth goes?  That is: its velocity stays within 0.3 m/s or 5 % of what it is, the greater.
  bool is_steady(double utc_s, double window_s) const;

 private:
  struct Point {
    double utc_s;
    PlanePoint place;
    std::optional<PlanePoint> velocity_mps;
  };
  std::size_t after(double utc_s) const;
  PlanePoint place_between(std::size_t index, double utc_s) const;
  std::vector<Point> points_;
  double beyond_s_;
};

// One track as a display shows it: from when it was told, never before.
class ToldSeries {
 public:
  // Sorts by time; of points at one time the last stays.  Drops what is not finite.
  ToldSeries(std::span<const ToldPoint> points, const echo::LocalPlane& plane);

  struct Shown {
    PlaneState state;  // moved on from when it was told, by its own motion
    bool has_motion = false;
    const ToldPoint* told = nullptr;
  };
  // What was told last, if that was no longer ago than `hold_s` and the track is tracked.
  std::optional<Shown> at(double utc_s, double hold_s) const;
  const std::vector<ToldPoint>& points() const { return points_; }
  PlanePoint place(std::size_t index) const { return places_[index]; }

 private:
  std::vector<ToldPoint> points_;
  std::vector<PlanePoint> places_;
};

// The closest point of approach of who is at `place` from own ship and moves relative to it, if
// both keep on.  Time is negative once it has passed; there is none below 0.05 m/s, and the range
// is then the present one.
struct PassingForecast {
  double range_m = 0.0;
  std::optional<double> time_s = {};
};
PassingForecast forecast_passing(PlanePoint place, PlanePoint velocity_mps);

}  // namespace skerry::server
