// FleetHost: this server as one host of a fleet.
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "server/app/fleet/fleet_port.hpp"
#include "server/app/radar_server.hpp"
#include "server/core/paced_thread.hpp"
#include "server/fleet/member/member.hpp"

namespace skerry::server {

// Runs a RadarServer's exercise as the fleet's log says: orders of consoles go to the log and hold
// from their tick on, on all hosts; radars make spokes of the ships that this host holds.  While no
// host has the store, each goes on with its ships: it asks the others for that ("fleet-others").
class FleetHost final : public FleetPort, private fleet::Exercise {
 public:
  // An order that stands in the log and has not come back after so long is answered as not known.
  static constexpr std::chrono::seconds kAnswer{6};

  // `radars` must outlive it, and is not started yet.
  // Error: std::invalid_argument, a name of the plan is none.
  FleetHost(RadarServer& radars, fleet::MemberPlan plan);
  ~FleetHost() override { stop(); }

  void start();
  void stop();
  // Consoles of an earlier run of this host have no con any more.  Before there are new ones.
  void begin_anew();
  // The exercise's time, when radars may be started; why that will never be.
  std::optional<Duration> time() const { return member_.time(); }
  std::optional<std::string> ended() const { return member_.ended(); }
  std::string standing() const;  // for people

  void order(const wire::Set& set, const std::string& origin, const Answered& later) override;
  void leave(const std::string& origin) override;
  std::optional<std::string> refusal() const override;
  void ground(const wire::ExerciseOrder& order) override;
  std::string known_as(const std::string& origin) const override { return origin + at_host_; }
  std::string shown(const std::string& known_as) const override;
  wire::Fleet told() const override;
  std::uint64_t version() const override { return member_.view().version; }

 private:
  struct Pending {
    Answered later;
    fleet::HostTime until;
  };
  struct Kept {
    World world;
    ControlDesk::Kept desk;
  };

  void run_to(fleet::Tick tick) override;
  void give(const fleet::OrderSeen& order) override;
  void refused(const std::string& id, const std::string& text) override;
  void keep() override;
  void come_back(Back to) override;
  fleet::WorldDigest digest() const override;
  void hold(const std::vector<fleet::HostTime>& until) override;

  std::string new_id();
  // Given again until it holds.
  void leave_until_known(const std::string& bytes);
  void leave_again();
  void answer(const std::string& id, wire::Reply reply);
  void answer_late();
  void look_for_lost_hosts();
  void ask_others();

  RadarServer& radars_;
  const std::string host_, exercise_, at_host_, run_;
  const Kept beginning_;
  std::optional<Kept> kept_;  // the member's thread's, as is what follows
  std::set<std::string> seen_hosts_, lost_hosts_;
  std::uint64_t seen_version_ = 0;
  std::map<std::size_t, bool> held_;

  std::atomic<std::uint64_t> ids_{0};
  struct Leaving {
    std::string bytes;
    fleet::HostTime again;  // no sooner; HostTime::max(): it is under way
  };
  mutable std::mutex mutex_;
  std::map<std::string, Leaving> leaving_;             // by id
  std::map<std::string, Pending> pending_;             // by id
  std::map<std::uint32_t, fleet::HostTime> grounded_;  // own ships, told lately
  fleet::Member member_;                               // its threads use all of the above
  PacedThread others_;
};

}  // namespace skerry::server
