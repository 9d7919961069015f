// A host with one radar whose video shows a ship that comes nearer, made as fast as it is asked
// for.
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <utility>

#include "server/net/common/encoders.hpp"
#include "tests/unit/net/fake_host.hpp"
#include "tests/unit/plotter/made_spokes.hpp"

namespace skerry::server {

// The ship bears 90 deg, is 3000 m off at first and comes at 10 m/s; 60 turns a minute.  Own ship
// lies still.
class PlottedHost final : public FakeHost {
 public:
  static constexpr double kBearing_deg = 90.0, kFirst_m = 3000.0, kSpeed_mps = 10.0;

  PlottedHost() {
    video_.geometry = {512, 512, 8};
    video_.rpm = 60.0;
    video_.range_nm = 3.0;
    find_channel(0, 0)->add_format(kNativeFormat, native_encoder());
  }

  // What own ship's sensors say; not to be changed while another thread asks.
  bool gyro_lost = false;
  wire::OwnShip own_ship(std::uint32_t radar) const override {
    wire::OwnShip ship;
    ship.set_radar(radar);
    ship.set_latitude_deg(50.0);
    ship.set_longitude_deg(3.0);
    ship.set_no_heading(gyro_lost);
    const std::lock_guard lock(time_mutex_);
    ship.set_utc_ns(static_cast<std::uint64_t>(now_.time_since_epoch().count()));
    return ship;
  }

  // So many turns come again.
  void go_back(int turns) {
    next_ -= std::uint64_t{video_.geometry.spokes_per_turn} * static_cast<unsigned>(turns);
  }

  double range_m() const { return kFirst_m - kSpeed_mps * seconds_; }

  // A sixteenth of a turn, in all views.
  void sweep() {
    constexpr std::uint32_t kSpokes = 32;
    Sector sector;
    for (std::uint32_t i = 0; i < kSpokes; ++i, ++next_) {
      seconds_ = static_cast<double>(next_) / video_.geometry.spokes_per_turn;
      video_.echoes = {{.bearing_deg = kBearing_deg, .range_m = range_m(), .length_m = 60}};
      Spoke spoke = video_.spoke(next_);
      spoke.header.utc = begin_utc + spoke.header.scenario_time.time_since_epoch();
      {
        const std::lock_guard lock(time_mutex_);
        now_ = spoke.header.utc;
      }
      sector.spokes.push_back(std::make_shared<const Spoke>(std::move(spoke)));
    }
    for (const View& view : views(0)) view.channel->publish(sector);
  }
  void turn(int times = 1) {
    for (int i = 0; i < 16 * times; ++i) sweep();
  }
  // Scenario time of the newest spoke.
  std::chrono::nanoseconds swept() const {
    const std::lock_guard lock(time_mutex_);
    return now_ - begin_utc;
  }

 private:
  MadeRadar video_;
  std::uint64_t next_ = 0;
  double seconds_ = 0.0;
  mutable std::mutex time_mutex_;
  UtcTime now_ = begin_utc;
};

}  // namespace skerry::server
