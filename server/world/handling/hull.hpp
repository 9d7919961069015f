// Hull: what the water, her rudder and her propeller do to a ship.
#pragma once

namespace skerry::server {

// Motion through the water, at the hull's own origin: midship, or her centre of gravity.
struct BodyMotion {
  double u = 0.0;     // m/s, ahead
  double v = 0.0;     // m/s, to starboard
  double r = 0.0;     // rad/s, bow to starboard
  double p = 0.0;     // rad/s, of roll
  double roll = 0.0;  // rad, starboard side down
};

// Their rates of change, of roll excepted: that one is p.
struct BodyChange {
  double u = 0.0, v = 0.0, r = 0.0, p = 0.0;
};

// What moves her: the rudder's angle, which turns her to starboard where positive, and the turns of
// her shaft a second, astern negative.
struct Actuators {
  double rudder_rad = 0.0;
  double shaft_rps = 0.0;
};

// Forces from outside: wind, waves, thrusters, banks.  N and Nm, axes as of BodyMotion.
struct Loads {
  double x = 0.0, y = 0.0, k = 0.0, n = 0.0;

  Loads& operator+=(const Loads& other) {
    x += other.x;
    y += other.y;
    k += other.k;
    n += other.n;
    return *this;
  }
};

inline constexpr double kSeaWater_kg_m3 = 1025.0;
inline constexpr double kGravity_mps2 = 9.80665;

// Immutable, and a pure function: the same bits on every machine (echo/kernel/exact_math.hpp).
// Outside the range in which its source holds (astern, at rest, adrift) a hull goes on smoothly
// by an extension of our own; each says where.  Finite for finite motion of up to 60 m/s.
class Hull {
 public:
  virtual ~Hull() = default;
  // `depth_m`: of the water, greater than her draught.
  virtual BodyChange change(const BodyMotion& motion, const Actuators& by, double depth_m,
                            const Loads& outside) const = 0;
  // The rate of change of the shaft's turns, 1/s^2, towards `ordered_rps`.
  virtual double shaft_change(const Actuators& by, double ordered_rps) const = 0;

  virtual double length_m() const = 0;
  virtual double draught_m() const = 0;
};

// The shaft's turns, 1/s, that hold a speed ahead or astern in calm, deep water; found by halving,
// for the hull's way grows with them.
double shaft_for(const Hull& hull, double speed_mps);

}  // namespace skerry::server
