// RadarEmulation: a radar of another maker as its displays meet it on the network: what it sends of
// itself, what it answers, and what a display's commands do.  No sockets, no clocks, no threads.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/quantity/time.hpp"
#include "protocol/wire/ipv4_endpoint.hpp"
#include "protocol/wire/radar.pb.h"
#include "server/core/video_channel.hpp"

namespace skerry::server {

// One range of a dual-range radar, A or B; most have A alone.  Which radar and view of the server
// it shows is the output's affair: the emulation leaves Set.radar and Set.view alone.
enum class RangeChannel : std::uint8_t { a = 0, b = 1 };

// The actions of an emulation on the server; each takes effect at once.
class EmulationPort {
 public:
  virtual ~EmulationPort() = default;
  virtual void send(const Ipv4Endpoint& to, std::span<const std::uint8_t> payload) = 0;
  // Applied before it returns; settings() already tells what came of it.
  virtual wire::Reply change(RangeChannel channel, const wire::Set& set) = 0;
  virtual wire::Settings settings(RangeChannel channel) const = 0;
  virtual wire::OwnShip own_ship() const = 0;
  // A datagram that was not understood or not obeyed, by kind ("navico truncated command").
  virtual void count(std::string_view kind, std::string_view detail) = 0;
};

// An address it listens on.  Multicast groups are joined on the output's interface.
struct EmulationListen {
  Ipv4Endpoint at;  // address 0: any address of the output's interface; port 0: any free port
};

// An emulation's ticks that were missed are made up for, as many as these; a longer pause is left
// out.
inline constexpr std::int64_t kMostTicksBehind = 20;

// All of it is called on net-0.
class RadarEmulation {
 public:
  virtual ~RadarEmulation() = default;

  virtual std::vector<RangeChannel> channels() const = 0;
  virtual std::vector<EmulationListen> listens() const = 0;
  // Told once before anything else: which port listens()[i] really got, and the interface's
  // address.
  virtual void begin(std::uint32_t interface_address, std::span<const std::uint16_t> ports,
                     ScenarioTime now, EmulationPort& port) = 0;
  // `now` is a steady clock's time; called every 10 ms, and sends what is due: late by at most
  // that.
  virtual void on_time(ScenarioTime now, EmulationPort& port) = 0;
  virtual void on_datagram(std::size_t listen, const Ipv4Endpoint& from,
                           std::span<const std::uint8_t> payload, ScenarioTime now,
                           EmulationPort& port) = 0;
  // Settings of a channel changed, by whomever.
  virtual void on_settings(RangeChannel channel, ScenarioTime now, EmulationPort& port) = 0;

  // Sectors into datagrams for data_address(): "spoke k" of an EncodedSector is datagram k, and a
  // sector may have none (several sectors to a frame).  Called on the radar's thread, one encoder
  // per channel; shares nothing with the rest of the emulation but what is immutable, since nearly
  // all that a spoke says stands in its header, and relaxed atomics (the display's range, the
  // antenna's angle).
  virtual SectorEncoder spoke_encoder(RangeChannel channel) const = 0;
  virtual Ipv4Endpoint data_address(RangeChannel channel) const = 0;
  // Whether displays are told that this range has a picture: if not, nothing of it may leave.
  virtual bool has_picture(RangeChannel) const { return true; }
  // The view's instrumented range for spokes of this channel at these settings, m.
  virtual double instrumented_range_m(RangeChannel channel,
                                      const wire::Settings& settings) const = 0;
};

// Two radars of one family on one host cannot share an identity, unless their interface addresses
// differ.
struct EmulationIdentity {
  std::string family;  // "Navico BR24"
  std::vector<Ipv4Endpoint> fixed_addresses;
};

}  // namespace skerry::server
