// LiveHost: real radars on the network in place of simulated ones.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "server/core/audit_port.hpp"
#include "server/live/live_radar.hpp"
#include "server/relayed/relayed_host.hpp"

namespace skerry::server {

// Its radars have the numbers that their sources say; other numbers are another host's.  Somebody
// else receives: they give it every datagram, and the time.
// A radar whose source has `commands` is told what a Set asks for, and kept on the air; what comes
// of it is seen when its reports say so.  The controls of others are not changed: a Set that asks
// for another value is refused, but for the instrumented range of a view that was opened here.
// Thread: take() and look() are one thread's, which gets the encoders' work too; the rest is any
// thread's.
class LiveHost final : public RelayedHost {
 public:
  // Spokes of a sector at most, as those of simulated radars.
  static constexpr std::size_t kMostSpokes = 16;

  // Requires sources of different radars.
  LiveHost(const std::vector<LiveSource>& sources, std::string server);

  bool wants_simulated(std::uint32_t radar) const { return of(radar).source.simulated; }
  bool has(std::uint32_t radar) const { return radar < views_.size() && views_[radar]; }

  // A datagram that came for a source, or the time; whether groups() is another now.
  bool take(std::size_t source, const pcap::Datagram& datagram);
  bool look(std::size_t source, UtcTime now);
  const LiveGroups& groups(std::size_t source) const { return inputs_[source]->radar.groups(); }

  // What is to be sent to the source's radar now, in this order: what was set, and that it is to
  // stay on the air.  Nothing without `commands`, or while it is not known where to.
  struct Orders {
    Ipv4Endpoint to;
    std::vector<Bytes> commands;
  };
  Orders take_orders(std::size_t source, UtcTime now);
  static constexpr std::size_t kMostOrders = 256;  // that wait; more are refused
  // `wake` is called whenever there is more to send.  Before any Set comes.
  void on_order(std::function<void()> wake) { wake_ = std::move(wake); }
  // What radars are asked for is kept there, too.  Before any Set comes.
  void set_audit(AuditPort* audit) { audit_ = audit; }

  // `add` gets the spokes of that radar, consecutive ones of one turn, before anybody else, and
  // whether their heading is known.  On the receiving thread; before any datagram comes.
  using Adding = std::function<void(std::vector<Spoke>& spokes, bool heading_known)>;
  void add_to_spokes(std::uint32_t radar, Adding add) { of(radar).add = std::move(add); }

  // Datagrams that nobody looked at, because there were too many.  Thread: any.
  void count_dropped(std::size_t source, std::uint64_t datagrams);

  wire::Hello hello() const override;
  std::optional<std::string> drive(std::uint32_t radar, const OwnShipFix& fix) override;
  wire::Status status() const override;

 private:
  struct Input {
    explicit Input(const LiveSource& wanted) : source(wanted), radar(wanted) {}
    const LiveSource source;
    LiveRadar radar;  // of the thread that takes
    Adding add;       // nothing: none
    UtcTime ship_told{}, kept_alive{};
    std::atomic<std::uint64_t> datagrams{0}, refused{0}, dropped{0}, others{0};
    std::atomic<bool> has_commands{false};  // it is known where to
    std::atomic<std::uint32_t> from{0};     // the radar's IPv4 address; 0: none found
    mutable std::mutex mutex;               // of what follows
    wire::RadarInfo info;
    std::optional<OwnShipFix> fix;  // not yet taken over
    std::vector<Bytes> orders;      // not yet sent
    navico::Model model = navico::Model::g4;
    std::chrono::steady_clock::time_point told{};  // the last line of the log about changes
    std::uint64_t untold = 0;                      // since
  };
  wire::Reply change(const wire::Set& set, const std::string& origin) override;
  wire::RadarInfo info(std::uint32_t radar) const override;
  UtcTime place() const override;

  Input& of(std::uint32_t radar) const;
  void give(Input& input, LiveRadar::News& news, UtcTime now);
  void publish(Input& input, std::vector<Spoke>& spokes);
  void tell_found(Input& input);
  void tell_ship(Input& input, UtcTime now);

  std::vector<std::unique_ptr<Input>> inputs_;
  const std::string server_;
  AuditPort* audit_ = nullptr;
  std::function<void()> wake_;
};

}  // namespace skerry::server
