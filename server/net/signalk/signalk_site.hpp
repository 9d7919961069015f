// SignalkSite: one own ship and her radars, as a Signal K server offers them.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/signalk/documents.hpp"
#include "protocol/signalk/target.hpp"
#include "server/net/common/net_context.hpp"
#include "server/net/signalk/signalk_controls.hpp"

namespace skerry::server {

// The result of a request: an HTTP status and its reason.
struct SignalkOutcome {
  unsigned status = 200;
  std::string message = "OK";
  std::optional<std::uint32_t> target = {};  // that was acquired
};

// Told to send what is new.  Thread: net-0.
class SignalkListener {
 public:
  virtual ~SignalkListener() = default;
  virtual void on_tick(std::chrono::steady_clock::time_point now) = 0;
};

// Displays see and change the default view of each radar, as consoles that share it do.
// Thread: net-0.
class SignalkSite {
 public:
  using Values = std::map<std::string, std::shared_ptr<const signalk::Json>>;

  // The ship that carries `radar`.  Error: std::runtime_error if there is no such radar.
  SignalkSite(NetContext& context, std::uint32_t radar);

  struct Mounted {
    std::uint32_t number = 0;  // in the server
    signalk::Radar radar;      // without an address
    SectorPlaces sectors;
    // Its plotter runs while somebody asks for targets, or hears the stream.
    std::shared_ptr<const void> wanted_targets = {};
    std::chrono::steady_clock::time_point targets_asked{};
  };
  std::vector<Mounted>& radars() { return radars_; }
  // Finds it by its id; "_default" is the first.  nullptr if there is none.
  Mounted* find(std::string_view id);

  const std::string& server() const { return server_; }
  signalk::OwnShip own_ship() const;
  signalk::ControlStates states(Mounted& radar) const;
  // As the plotter of the radar's shared view has them; test targets are left out.  Begins to look
  // for targets if nobody did.
  std::vector<signalk::Json> targets(Mounted& radar);
  // Ships and boats with a number within VHF range, nearest first, at most kMostVessels, as AIS
  // tells of them; and what the first radar's plotter tracks besides.
  static constexpr std::size_t kMostVessels = 300;
  std::vector<signalk::OtherVessel> vessels();

  // `body` as signalk::read_change() takes it.  `origin` is for the log.
  SignalkOutcome set_control(Mounted& radar, std::string_view key, const signalk::Json& body,
                             const std::string& origin);
  // {"gain": body, ...}: stops at the first that is refused.
  SignalkOutcome set_controls(Mounted& radar, const signalk::Json& bodies,
                              const std::string& origin);
  // {"bearing": rad, "distance": m}
  SignalkOutcome acquire(Mounted& radar, const signalk::Json& body, const std::string& origin);
  SignalkOutcome drop(Mounted& radar, std::string_view number, const std::string& origin);

  // All that the delta stream can say, by path; a value that did not change is the same object.
  const Values& values() const { return values_; }
  // A pure function of the path: what the control at its end is.
  static const signalk::ControlDefinition* definition_at(std::string_view path);

  void enter(std::weak_ptr<SignalkListener> listener);
  // Call it every 100 ms.
  void tick(std::chrono::steady_clock::time_point now);

 private:
  std::vector<TrafficItem> others() const;  // all but her
  TargetListPtr target_list(Mounted& radar);
  std::vector<signalk::OtherVessel> ais_vessels() const;
  SignalkOutcome order_targets(Mounted& radar, const wire::TargetOrder& order,
                               const std::string& origin);
  void put_targets(Mounted& radar, Values& fresh);
  void refresh();
  void put(Values& fresh, const std::string& path, signalk::Json value) const;

  NetContext& context_;
  std::string server_;
  std::uint32_t first_radar_;
  std::vector<Mounted> radars_;
  std::vector<std::weak_ptr<SignalkListener>> listeners_;
  Values values_;
  std::chrono::steady_clock::time_point targets_due_{};
  std::uint32_t refreshes_ = 0;
};

}  // namespace skerry::server
