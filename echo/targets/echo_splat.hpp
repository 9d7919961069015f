// EchoSplat: lays points into spokes through the beam and the pulse.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "echo/kernel/shelf.hpp"
#include "echo/radar/antenna_pattern.hpp"
#include "echo/radar/radar_model.hpp"
#include "echo/radar/range_response.hpp"
#include "echo/scene/spoke_aim.hpp"
#include "echo/targets/far_lobes.hpp"
#include "echo/targets/point_echo.hpp"

namespace skerry::echo {

// Points of one sector, ready to be added to any of its spokes.
//
// A point fills cells about its range as pulse and receiver have it (range_response.hpp; less than
// a cell counts as one), each by its mean over the cell.  Points of one body add as voltages,
// bodies as powers.  Error: where points of one body share a cell that each fills in part, their
// interference weighs sqrt(f1 f2) instead of the common part; the mean over phases is exact. Shares
// below 1e-7 of a cell and points below 1e-4 of the noise are left out. Main lobe: the pattern
// between 512 places joined straight, 2e-5 of the axis's voltage.  Side lobes within 5 deg of the
// sector are laid spoke by spoke, points as powers and with the level of their body's middle; those
// farther off by FarLobes. Cost: linear in points; a spoke looks only at bodies within 5 deg of its
// sector. Held by EchoSplat.*.
class EchoSplat {
 public:
  explicit EchoSplat(const RadarModel& model);

  // Main lobe of `points`; `first`, `last`: aims of the sector's ends, less than half a turn apart.
  // Powers beyond kMaxPointPower are cut to it.  Thread: the radar's.
  void prepare(const std::vector<PointEcho>& points, const SpokeAim& first, const SpokeAim& last) {
    prepare(points, first, last, nullptr);
  }
  // And the side lobes of both, as far as they stand out there (a twentieth of the noise).  Of a
  // body in `points` that the beam may meet, `strong` is left out.
  void prepare(const std::vector<PointEcho>& points, const SpokeAim& first, const SpokeAim& last,
               const StrongEchoes& strong) {
    prepare(points, first, last, &strong);
  }

  // What was prepared is not added any more: its memory goes to whichever radar is next.  Not
  // needed.  Thread: the radar's.
  void release();

  // Adds to power[i] what cell i of that spoke gets.  Requires as many cells as the model's.
  // Thread: any, after prepare().
  void add(const SpokeAim& aim, std::span<float> power) const;
  // Each body by itself: its number, the first cell it may fill, and what those get.  For rows of
  // `cells` cells.  Thread: any, after prepare().
  using VisitBody =
      std::function<void(std::uint32_t body, std::uint32_t first, std::span<const float> cells)>;
  void each_body(const SpokeAim& aim, std::size_t cells, const VisitBody& visit) const;

 private:
  struct Point {
    std::uint32_t units;
    std::uint32_t cell, cells;  // the first, and how many
    std::uint32_t shares;       // square roots of their shares, from here on in Laid::shares
    float in_phase, quadrature;
  };
  struct Body {
    std::uint32_t begin, end;      // of Laid::points
    std::uint32_t middle, reach;   // bearings that see any of it
    std::uint32_t main_reach;      // and those that see any in the main lobe
    float power;                   // of all its points
    std::uint32_t cell, cell_end;  // cells it may fill
    std::uint32_t number;          // PointEcho::body
  };

  // The points of a sector.
  struct Laid {
    std::vector<PointEcho> near;
    std::vector<std::uint32_t> met;  // bodies of near that are in the sector's points
    std::vector<Point> points;
    std::vector<float> shares;
    std::vector<Body> bodies;
  };
  static Shelf<Laid>& shelf();

  void prepare(const std::vector<PointEcho>& points, const SpokeAim& first, const SpokeAim& last,
               const StrongEchoes* strong);
  void take_near_of(const StrongEchoes& strong, std::uint32_t middle, std::uint32_t reach);
  void lay_bodies();
  bool lay(const PointEcho& echo, Point& point);
  float voltage(std::uint32_t off_units) const;
  // False where the spoke does not see it.
  bool add_one(const Body& body, const SpokeAim& aim, std::span<float> power) const;
  void add_body(const Body& body, std::uint32_t axis_units, std::span<float> power) const;
  void add_power(const Point& point, float factor, std::span<float> power) const;

  RadarModel model_;
  std::shared_ptr<const AntennaPattern> pattern_;
  std::uint32_t null_units_;   // where the main lobe ends
  std::uint32_t lobes_units_;  // and the lobes that are laid spoke by spoke
  float to_place_;             // units off the axis -> place in main_lobe_
  float stands_out_;           // power that does in the highest side lobe
  std::shared_ptr<const RangeResponse> response_;
  std::shared_ptr<const std::vector<float>> main_lobe_;  // two-way voltage
  FarLobes far_;

  bool side_lobes_ = false;
  bool released_ = false;
  Laid laid_;
};

}  // namespace skerry::echo
