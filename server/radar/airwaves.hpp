// Airwaves: what every radar of the server has on the air, for the receivers of the others.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "echo/beacons/emitter_of.hpp"
#include "echo/scene/beacons.hpp"

namespace skerry::server {

// An emitter without its place: that of the own ship it stands on.
struct Emission {
  std::size_t own_ship = 0;
  bool transmits = false;
  echo::Emitter emitter;
  friend bool operator==(const Emission& a, const Emission& b) {
    return a.own_ship == b.own_ship && a.transmits == b.transmits &&
           a.emitter.pulse_s == b.emitter.pulse_s && a.emitter.prf_hz == b.emitter.prf_hz &&
           a.emitter.identity == b.emitter.identity && a.emitter.rpm == b.emitter.rpm &&
           a.emitter.bearing_deg == b.emitter.bearing_deg &&
           a.emitter.height_m == b.emitter.height_m;
  }
};
struct Emissions {
  std::uint64_t version = 0;  // +1 with every change
  std::vector<Emission> radars;
};
using EmissionsPtr = std::shared_ptr<const Emissions>;

// The pulse rate of every transmitter is off its set's by up to one in a hundred, which one by its
// identity: were two sets of one make to agree, each would stand in the other's picture as a ring.
inline constexpr echo::EmitterSpread kTransmitterSpread{0.01, 0.0};

// Thread: any.
class Airwaves {
 public:
  explicit Airwaves(std::size_t radars)
      : emissions_(std::make_shared<const Emissions>(Emissions{0, std::vector<Emission>(radars)})) {
  }

  // Never null; one entry per radar, and the same pointer while nothing has changed.
  EmissionsPtr get() const;
  // All transmissions including it; `changed` if that is a new version.
  struct Set {
    EmissionsPtr emissions;
    bool changed = false;
  };
  Set set(std::size_t radar, const Emission& emission);

 private:
  mutable std::mutex mutex_;
  EmissionsPtr emissions_;
};

}  // namespace skerry::server
