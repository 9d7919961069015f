// FakeDisplayPort: a radar and a network for emulations under test: a Set changes the Settings as
// the server does it, and what is sent is kept.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/wire/wire_error.hpp"
#include "server/displays/radar_emulation.hpp"

namespace skerry::server {

struct SentDatagram {
  Ipv4Endpoint to;
  Bytes payload;
};

// Addresses from which displays of these makers send commands.
inline constexpr Ipv4Endpoint kGarminDisplay{ipv4(172, 16, 6, 37), 50101};
inline constexpr Ipv4Endpoint kQuantumDisplay{ipv4(198, 18, 3, 108), 2575};

// Applies what is present, as the server does; values are not checked.
inline void apply_set(const wire::Set& set, wire::Settings& settings) {
#define SKERRY_TAKE(field) \
  if (set.has_##field()) settings.set_##field(set.field())
  SKERRY_TAKE(range_nm);
  SKERRY_TAKE(gain);
  SKERRY_TAKE(sea);
  SKERRY_TAKE(rain);
  SKERRY_TAKE(sea_auto);
  SKERRY_TAKE(interference_rejection);
  SKERRY_TAKE(echo_stretch);
  SKERRY_TAKE(integration);
  SKERRY_TAKE(gain_auto);
  SKERRY_TAKE(side_lobe_suppression);
  SKERRY_TAKE(side_lobe_auto);
  SKERRY_TAKE(noise_rejection);
  SKERRY_TAKE(target_separation);
  SKERRY_TAKE(target_boost);
  SKERRY_TAKE(doppler);
  SKERRY_TAKE(doppler_threshold_mps);
  SKERRY_TAKE(mode);
  SKERRY_TAKE(instrumented_range_m);
  SKERRY_TAKE(rotation_rpm);
  SKERRY_TAKE(bearing_alignment_deg);
  SKERRY_TAKE(antenna_height_m);
#undef SKERRY_TAKE
  if (set.has_transmit()) settings.set_standby(!set.transmit());
  if (set.has_blanked_sectors()) *settings.mutable_blanked_sectors() = set.blanked_sectors();
}

class FakeDisplayPort : public EmulationPort {
 public:
  // `one_radar`: both channels show one radar, so that what is of the radar is of both.
  explicit FakeDisplayPort(bool one_radar = true) : one_radar_(one_radar) {
    for (wire::Settings& each : settings_) {
      each.set_range_nm(6.0);
      each.set_gain(50.0);
      each.set_standby(true);
      each.set_rotation_rpm(24.0);
      each.set_antenna_height_m(15.0);
      each.set_doppler_threshold_mps(1.0);
    }
    own_ship_.set_heading_deg(123.4);
    own_ship_.set_course_over_ground_deg(126.7);
    own_ship_.set_speed_over_ground_kn(10.0);
  }

  void send(const Ipv4Endpoint& to, std::span<const std::uint8_t> payload) override {
    sent.push_back({to, {payload.begin(), payload.end()}});
  }
  wire::Reply change(RangeChannel channel, const wire::Set& set) override {
    wire::Reply reply;
    changes.push_back(set);
    if (!refusal.empty()) {
      reply.set_code(wire::Reply::REFUSED);
      reply.set_text(refusal);
      return reply;
    }
    apply_set(set, at(channel));
    if (one_radar_) share(at(channel));
    if (on_change) on_change(channel);
    return reply;
  }
  wire::Settings settings(RangeChannel channel) const override {
    return settings_[static_cast<std::size_t>(channel)];
  }
  wire::OwnShip own_ship() const override { return own_ship_; }
  void count(std::string_view kind, std::string_view detail) override {
    ++counts[std::string(kind)];
    last_detail = detail;
  }

  // For what others change.
  wire::Settings& at(RangeChannel channel) { return settings_[static_cast<std::size_t>(channel)]; }
  wire::OwnShip& ship() { return own_ship_; }

  // The payloads sent to `to` since the last take().
  std::vector<Bytes> take(const Ipv4Endpoint& to) {
    std::vector<Bytes> payloads;
    std::vector<SentDatagram> others;
    for (SentDatagram& each : sent) {
      if (each.to == to) {
        payloads.push_back(std::move(each.payload));
      } else {
        others.push_back(std::move(each));
      }
    }
    sent = std::move(others);
    return payloads;
  }

  std::vector<SentDatagram> sent;
  std::vector<wire::Set> changes;
  std::map<std::string, std::uint64_t> counts;
  std::string last_detail;
  std::string refusal;  // not empty: every change is refused with it
  std::function<void(RangeChannel)> on_change;

 private:
  void share(const wire::Settings& changed) {
    for (wire::Settings& each : settings_) {
      each.set_standby(changed.standby());
      each.set_rotation_rpm(changed.rotation_rpm());
      each.set_bearing_alignment_deg(changed.bearing_alignment_deg());
      each.set_antenna_height_m(changed.antenna_height_m());
      const wire::BlankedSectors sectors = changed.blanked_sectors();
      *each.mutable_blanked_sectors() = sectors;
    }
  }

  bool one_radar_;
  std::array<wire::Settings, 2> settings_;
  wire::OwnShip own_ship_;
};

}  // namespace skerry::server
