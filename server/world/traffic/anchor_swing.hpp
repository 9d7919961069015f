// AnchorSwing: a ship at anchor, as wind and current lay her.
#pragma once

#include <cstdint>
#include <optional>

#include "protocol/quantity/geo_point.hpp"
#include "protocol/quantity/time.hpp"
#include "server/world/environment.hpp"

namespace skerry::server {

// What wind finds above the water, and current below it.
struct Windage {
  double length_m = 0.0, height_m = 0.0, draught_m = 0.0;
};

// She lies on a circle round her anchor, her bow to it.  Whither: with the sum of what wind and
// current do to a plate of her size; she gets there in some minutes, by first order.  In wind she
// sheers to and fro by 10 to 20 deg every 3 to 6 minutes, less in a light one; how far and how
// often is chance, from her seed.  Where nothing acts she stays.
// Source: none; the form is this project's choice.
class AnchorSwing {
 public:
  // `bow_deg`: where nothing acts.
  AnchorSwing(GeoPoint anchor, double radius_m, double bow_deg, Windage windage,
              std::uint64_t seed);

  // Lies as the environment would lay her at that time.
  void settle(const Environment& environment, double time_s);
  // Anchors anew, so that she lies there with that heading.
  void drop_anchor(GeoPoint ship, double bow_deg);
  // A tick that begins at that time.
  void step(const Environment& environment, double time_s, double tick_s);

  // From the anchor to the ship, true, and the place there.
  double bearing_deg(double time_s) const;
  GeoPoint place(double time_s) const;

 private:
  struct Pull {
    double sheer = 0.0;  // 0 .. 1, of her most
    double to_deg = 0.0;
  };
  std::optional<Pull> pull_of(const Environment& environment, double time_s) const;

  GeoPoint anchor_;
  double radius_m_;
  Windage windage_;
  double mean_deg_;
  double sheer_deg_, period_s_, phase_;  // phase in turns
  double sheer_ = 0.0;                   // of her most
};

}  // namespace skerry::server
