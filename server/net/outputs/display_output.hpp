// DisplayOutput: the sockets of an emulated radar.
#pragma once

#include <array>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "server/net/common/net_context.hpp"
#include "server/net/outputs/command_gate.hpp"
#include "server/net/outputs/datagram_pacer.hpp"
#include "server/net/outputs/output_conflicts.hpp"

namespace skerry::server {

// Sends what the emulation and the encoder of its spokes make, and hands it what displays send to
// it.  Its picture comes from views of its own on the radars: hidden ones that follow the shared
// view, or ones with controls of their own; their instrumented range is what the protocol's spokes
// span.
//
// On 127.0.0.0/8 all addresses are one interface, so a radar there hears of its groups only what
// comes from its own address: a display and its radar have the same.
//
// Nobody waits for it: what the socket does not take is dropped and counted, at most kPending
// datagrams wait for their time, and of commands a wake-up reads at most kReads, of which as many
// are looked at as the gate lets pass.  After a flood the socket rests until the next tick.
// Thread: constructed anywhere, then net-0.
class DisplayOutput final : private EmulationPort {
 public:
  static constexpr std::size_t kPending = 1024;
  static constexpr int kReads = 512;
  static constexpr std::size_t kLongestCommand = 2048;

  // `number`: of the output in the configuration, from 0; names its formats.
  // Error: std::runtime_error naming the output and the reason: no address, what the emulation has
  // to say.
  DisplayOutput(NetContext& context, const DisplayOutputConfig& config, std::size_t number);
  ~DisplayOutput() override;

  OutputClaim claim() const;
  // Once, before the radars start.  Error: the same: no such radar, an address or port that cannot
  // be had, no view left.
  void open();

  void start();  // net-0: from now on it is on the network
  void close();  // net-0
  // net-0, every 10 ms.
  void tick();

 private:
  // One range of the radar: its view and what is on its way.
  struct Range final : FeedReader {
    Range(DisplayOutput& owner, RangeChannel which, Duration burst)
        : output(owner), channel(which), pacer(burst) {}
    void on_sector() override { output.take_sectors(*this); }

    DisplayOutput& output;
    RangeChannel channel;
    std::uint32_t radar = 0;
    std::uint32_t shown = 0;       // the view whose spokes are sent
    std::uint32_t controlled = 0;  // the view whose controls are set: the shared one, or that
    std::string format;
    Ipv4Endpoint to;
    SpokeFeed* feed = nullptr;
    Cursor cursor;
    DatagramPacer pacer;
    struct Pending {
      DatagramPacer::SteadyTime leaves;
      EncodedSectorPtr sector;
      std::uint32_t index;  // of the datagram in it
    };
    std::deque<Pending> pending;
    double reach_m = 0.0, reach_before_m = 0.0;  // that the shown view was fitted to, and before
    int unfit = 0;                               // sectors running with another
  };
  struct Ear {
    UdpSocket socket;
    bool group = false;
    bool resting = false;  // after a flood
  };

  // EmulationPort.
  void send(const Ipv4Endpoint& to, std::span<const std::uint8_t> payload) override;
  wire::Reply change(RangeChannel channel, const wire::Set& set) override;
  wire::Settings settings(RangeChannel channel) const override;
  wire::OwnShip own_ship() const override;
  void count(std::string_view kind, std::string_view detail) override;

  [[noreturn]] void fail(const std::string& reason) const;
  void open_range(RangeChannel channel, const OutputSource& source);
  void follow_settings();
  void fit_range(Range& range);
  void fit_ranges();
  void hush();
  bool is_silent(const Range& range) const;
  bool is_unfit(Range& range, const EncodedSector& sector);
  const Range& range_of(RangeChannel channel) const;
  void take_sectors(Range& range);
  void send_due();
  bool send_to(const Ipv4Endpoint& to, std::span<const std::uint8_t> payload);
  void listen(std::size_t ear);
  void read(std::size_t ear);
  bool is_for_us(const Ear& ear, const asio::ip::udp::endpoint& from) const;
  ScenarioTime now() const;

  NetContext& context_;
  const DisplayOutputConfig config_;
  std::string name_;
  asio::ip::address_v4 interface_;
  std::unique_ptr<RadarEmulation> emulation_;
  std::vector<std::unique_ptr<Range>> ranges_;
  UdpSocket socket_;
  asio::ip::udp::endpoint own_;  // where socket_ sends from
  std::vector<EmulationListen> wanted_;
  std::vector<Ear> ears_;
  Timer timer_;  // of what is pending
  CommandGate gate_;
  OutputPtr counters_;
  const std::chrono::steady_clock::time_point made_ = std::chrono::steady_clock::now();
  std::uint64_t settings_version_ = 0;
  std::uint64_t unsent_ = 0;
  Ipv4Endpoint display_;  // whose datagram is in hand; port 0: nobody's
  Ipv4Endpoint last_display_;
  std::array<std::uint8_t, kLongestCommand> buffer_{};
  bool closed_ = true;
};

}  // namespace skerry::server
