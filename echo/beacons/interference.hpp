// Interference: other radars' pulses in the own receiver.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "echo/beacons/listening.hpp"
#include "echo/beacons/pulse_train.hpp"
#include "echo/radar/antenna_pattern.hpp"

namespace skerry::echo {

// Power of an emitter's pulse behind the own receiver's filter, against one that passes whole:
// nothing is lost within the band; beyond its edge the spectrum of a rectangular pulse falls as
// 1 / (1 + (pi tau df)^2); a filter narrower than the pulse's spectrum takes (B tau)^2.  0 for
// another band (kOtherBand off).
double frequency_coupling(const Emitter& emitter, double own_frequency_hz, double bandwidth_hz);
inline constexpr double kOtherBand = 0.5e9;  // Hz

// One-way power of an emitter's beam, 1 on the axis: the main lobe of the cosine taper, then side
// lobes a beam wide, each of them as high as the emitter's level.
// Error: main lobe 1e-3 of the axis against beam.hpp; held by
// Interference.TheEmittersBeamIsACosineTapersAndSideLobesAtItsLevel.
float emitter_beam(std::uint32_t off_units, double beam_width_deg, float side_lobe);

// Each own pulse opens a window of the range scale; what another radar's pulses put into it lies at
// c/2 times their delay: at the same range from pulse to pulse where both PRF agree (rings), moving
// by (c/2)(T2 - T1) where they do not (spirals).  Strength is one-way, R^-2, through both antennas'
// patterns as they turn and the frequency's loss.  Long range scales hold most of it.
// Timing is exact (PulseTrain): Interference.LiesWherePulsesCountedOneByOneFall,
// ...IsTheSameAfterThirtyDays.  Own pulses are those of PulseTrain(prf, model.radar).
// Source: SOURCES.md "Artefacts".  Error: a spoke shows the pulses fired in its own time, so that
// at fewer pulses than spokes some spokes have none.
class Interference {
 public:
  // The most that one sector gets; beyond that, later emitters of the scene are left out.
  static constexpr std::size_t kMostDots = 32768;
  // Part of a pulse that land between lets through, by choice: a sharp ridge costs 30 dB.
  static constexpr double kBehindLand = 1e-3;

  // Range, bearing and propagation are worked out at multiples of this after the scene's time, and
  // go on straight until the next: 0.1 m off at 125 m and 20 m/s.  Held by
  // Interference.FollowsAShipThatSailsByHalfHerWay.
  static constexpr double kFixEvery = 0.25;  // seconds

  explicit Interference(const RadarModel& model);

  // `first`, `last`: numbers of the sector's spokes from the antenna's start.
  void prepare(const Listening& at, std::uint64_t first, std::uint64_t last);
  bool any() const { return !dots_.empty(); }
  // Thread: any, after prepare().
  void add(const AntennaPattern& pattern, const SpokeAim& aim, std::span<float> power) const;

 private:
  struct Dot {
    std::uint32_t bearing_units;  // of the emitter
    float power;                  // on the own axis, over noise
    float from_cell, cells;
    std::uint32_t spoke;  // of the sector
  };
  struct OwnPulse {
    std::int64_t at_ps;   // after the sector's beginning
    std::uint32_t spoke;  // of the sector
  };
  struct Station {
    PulseTrain train;
    double power_1m;  // both on their axes, over noise, at 1 m: falls as R^-2
    double turn_per_ps;
    float side_lobe, cells;
    // At the latest fix (kFixEvery).
    Polar place = {};
    double range_rate = 0.0;  // m/s
    double units_rate = 0.0;  // of the bearing, per second
    double power = 0.0;       // both on their axes
  };
  // The state for which stations were fixed.
  struct Fix {
    ScenarioTime time{};
    PlanePoint own_ship, own_velocity;
    std::int64_t step = 0;  // of kFixEvery, after the scene's time
    friend bool operator==(const Fix&, const Fix&) = default;
  };
  void know_stations(const Listening& at);
  void fix_stations(const Listening& at);
  void list_own_pulses(const RadarModel& model, std::uint64_t first, std::uint64_t last);
  void hear(const Listening& at, const Emitter& emitter, const Station& station);
  void sort_by_spoke(std::size_t spokes);

  std::int64_t own_period_ps_;
  ScenarioTime begins_{};
  std::uint64_t first_ = 0;
  std::vector<Emitter> known_;  // that stations_ are of
  std::vector<Station> stations_;
  Fix fix_;
  double since_fix_ = 0.0;  // seconds, at the sector's middle
  std::vector<OwnPulse> pulses_;
  std::vector<Dot> made_, dots_;       // as made; by spoke
  std::vector<std::uint32_t> starts_;  // dots_ of spoke k are [starts_[k], starts_[k + 1])
};

}  // namespace skerry::echo
