// A radar with the plainest of protocols: text in, text out.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "server/displays/radar_emulation.hpp"

namespace skerry::server {

struct TestRadarOptions {
  Ipv4Endpoint commands{ipv4(239, 255, 74, 40), 31940};  // a group
  Ipv4Endpoint reports{ipv4(239, 255, 74, 41), 31941};
  Ipv4Endpoint data{ipv4(239, 255, 74, 42), 31942};
  std::uint32_t spokes_per_datagram = 4;
  bool dual_range = false;
};

// Commands: "gain 40" sets the gain of range A, "b gain 40" of range B; anything else is counted.
// Reports: "here ADDRESS PORT" once, with the port of its unicast ear; "a gain 40 by ..." for every
// change; "a refused TEXT" where the host does not take it; "tick" every 50 ms.
// Picture: one datagram for every so many spokes: the first byte of each of their cells.
class TestRadar final : public RadarEmulation {
 public:
  explicit TestRadar(TestRadarOptions options) : options_(std::move(options)) {}

  std::vector<RangeChannel> channels() const override {
    if (options_.dual_range) return {RangeChannel::a, RangeChannel::b};
    return {RangeChannel::a};
  }
  std::vector<EmulationListen> listens() const override { return {{options_.commands}, {{0, 0}}}; }
  void begin(std::uint32_t address, std::span<const std::uint16_t> ports, ScenarioTime now,
             EmulationPort& port) override {
    ticked_ = now;
    say("here " + text_of({address, ports[1]}), port);
  }
  void on_time(ScenarioTime now, EmulationPort& port) override {
    if (now - ticked_ < std::chrono::milliseconds(50)) return;
    ticked_ = now;
    say("tick", port);
  }
  void on_datagram(std::size_t, const Ipv4Endpoint&, std::span<const std::uint8_t> payload,
                   ScenarioTime, EmulationPort& port) override {
    std::string text(payload.begin(), payload.end());
    RangeChannel channel = RangeChannel::a;
    if (text.starts_with("b ")) {
      channel = RangeChannel::b;
      text.erase(0, 2);
    }
    if (!text.starts_with("gain ")) {
      port.count("test command malformed", text.substr(0, 20));
      return;
    }
    wire::Set set;
    set.set_gain(std::stod(text.substr(5)));
    const wire::Reply reply = port.change(channel, set);
    if (reply.code() != wire::Reply::OK) say(letter(channel) + " refused " + reply.text(), port);
  }
  void on_settings(RangeChannel channel, ScenarioTime, EmulationPort& port) override {
    say(letter(channel) + " gain " +
            std::to_string(static_cast<int>(port.settings(channel).gain())),
        port);
  }
  SectorEncoder spoke_encoder(RangeChannel) const override {
    return [every = options_.spokes_per_datagram, held = Bytes()](const Sector& sector) mutable {
      auto out = std::make_shared<EncodedSector>();
      for (const SpokePtr& spoke : sector.spokes) {
        held.push_back(spoke->cells.front());
        if (held.size() < every) continue;
        out->bytes.insert(out->bytes.end(), held.begin(), held.end());
        out->spoke_ends.push_back(static_cast<std::uint32_t>(out->bytes.size()));
        held.clear();
      }
      return EncodedSectorPtr(std::move(out));
    };
  }
  Ipv4Endpoint data_address(RangeChannel channel) const override {
    Ipv4Endpoint to = options_.data;
    if (channel == RangeChannel::b) ++to.address;
    return to;
  }
  double instrumented_range_m(RangeChannel, const wire::Settings& settings) const override {
    return settings.range_nm() * 1852.0 * 1.5;
  }

 private:
  static std::string letter(RangeChannel channel) { return channel == RangeChannel::a ? "a" : "b"; }
  void say(const std::string& text, EmulationPort& port) const {
    port.send(options_.reports,
              std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
  }

  TestRadarOptions options_;
  ScenarioTime ticked_{};
};

}  // namespace skerry::server
