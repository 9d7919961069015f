// UpstreamHost: another server's radars in place of own ones, so that this server is a relay.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "server/relay/con_sharing.hpp"
#include "server/relay/hop_meter.hpp"
#include "server/relay/passed_log.hpp"
#include "server/relay/upstream_orders.hpp"
#include "server/relayed/relayed_host.hpp"

namespace skerry::server {

// What consoles here see of the other server, and what they ask of it.  Spokes have the numbers
// that they have there.  An UpstreamTalk, on a thread of its own, tells it what comes and takes its
// orders.  Construct; hand the host to a NetServer, which adds its formats; then begin the talk.
// Thread: as RadarHost, but for what stands under "the talk's thread".
class UpstreamHost final : public RelayedHost, private PlaybackPort {
 public:
  struct Config {
    std::string upstream;  // "host:port"
    std::string server;    // what Hello says of this one
    std::string identity;  // of this one
    std::string format;    // in which spokes come: the native one's name
  };
  // `hello`: the other server's.  Error: std::runtime_error if it cannot be relayed.
  UpstreamHost(const wire::Hello& hello, Config config);

  // Before the NetServer is made.
  void set_recording(RecordingPort* recorder) { recording_ = recorder; }
  RecordingPort* recording() override { return recording_; }
  void set_targets(TargetPort* plotters) { plotters_ = plotters; }
  TargetPort* targets() override { return plotters_; }
  void set_audit(AuditPort* audit) { done_.set_audit(audit); }
  PlaybackPort* playback() override { return is_playback_ ? this : nullptr; }

  wire::Hello hello() const override;
  std::optional<OpenedView> open_view_or_ask(std::uint32_t radar, std::uint32_t like,
                                             const std::function<void(VideoChannel&)>& prepare,
                                             const ViewOpened& later) override;
  void close_view(std::uint32_t radar, std::uint32_t view) override;
  std::optional<wire::Reply> apply_or_ask(const wire::Set& set, const std::string& origin,
                                          const Answered& later) override;
  void leave(const std::string& origin) override;
  wire::OwnShip own_ship(std::uint32_t radar) const override;
  // Its clocks go on between what is told of them.
  wire::World world() const override;
  // Truth, from the first call on as long as it is asked for, if the other server lets this one.
  std::optional<wire::ExerciseState> exercise_state() const override;
  std::vector<TrafficItem> traffic() const override;
  void find_coastline(const wire::GetCoastline& place, CoastlineDone done) override;
  bool has_chart() const override;
  void find_chart_objects(const wire::GetChartObjects& place, ChartObjectsDone done) override;
  wire::Status status() const override;
  std::vector<wire::HopStatus> hops() const override;

  // --- the talk's thread

  UpstreamOrders& orders() { return orders_; }
  HopMeter& meter() { return meter_; }
  const Config& config() const { return config_; }
  // Of each connection that is to bring view 0.  Error: why it is not wanted.
  std::optional<std::string> take_hello(const wire::Hello& told);
  // Whether the other server still has that radar.
  bool is_relayed(std::uint32_t radar) const;
  void set_connected();
  void set_gone(const std::string& why);
  // A message that came for that view, by its number here.
  void take(std::uint32_t radar, std::uint32_t view, wire::ServerMessage& message);
  void publish(std::uint32_t radar, std::uint32_t view, const SpokeBatch::Spokes& spokes);
  // A view that the other server has opened by that number, like the one that is `like` here; gives
  // the number it has here.
  std::optional<std::uint32_t> add_view(std::uint32_t radar, std::uint32_t view, std::uint32_t like,
                                        const std::function<void(VideoChannel&)>& prepare);
  // It has been opened again there, by that number; or is not there now, until it has been.
  void renumber_view(std::uint32_t radar, std::uint32_t view, std::optional<std::uint32_t> there);
  PassedLog& done() { return done_; }
  // Whether somebody has wanted the exercise lately.
  bool wants_truth(SteadyTime now) const;

 private:
  wire::Reply change(const wire::Set& set, const std::string& origin) override;
  wire::RadarInfo info(std::uint32_t radar) const override;
  UtcTime place() const override;

  wire::Reply control(const wire::Playback& playback, const std::string& origin) override;
  std::optional<wire::Reply> control_or_ask(const wire::Playback& playback,
                                            const std::string& origin,
                                            const Answered& later) override;
  wire::PlaybackState state() const override;
  std::uint64_t version() const override { return playback_version_.load(); }

  // A view of this server alone, such as an output's.
  bool is_own_view(std::uint32_t radar, std::uint32_t view) const;
  std::string ship_of(std::uint32_t radar) const;
  std::optional<std::string> why_gone() const;
  // The view's number there; nothing: it is being opened again.  Under the mutex.
  std::optional<std::uint32_t> number_there(std::uint32_t radar, std::uint32_t view) const;
  // Sends it; what becomes of it is counted, and what is done kept with the audit.  `late`: as
  // UpstreamLine::ask() has it.  False: nobody takes it.
  bool ask(wire::ClientMessage message, PassedUp done,
           std::function<void(const wire::Reply&)> answered, AnsweredUp late = {});
  // The con of the ship, which nobody here has or which `origin` leaves.  Under the mutex.
  void give_back_con(const std::string& ship, const std::string& origin);

  const Config config_;
  const bool is_playback_;
  RecordingPort* recording_ = nullptr;
  TargetPort* plotters_ = nullptr;
  UpstreamOrders orders_;
  PassedLog done_;
  HopMeter meter_;
  std::atomic<std::uint64_t> playback_version_{1};
  mutable std::atomic<std::int64_t> truth_wanted_{0};  // steady, ns; 0: never
  std::string world_told_;                             // of the talk's thread

  mutable std::mutex mutex_;  // of what follows
  wire::Hello hello_;         // the other server's, the newest
  std::vector<wire::RadarInfo> radars_;
  std::vector<bool> relayed_;
  std::string changes_;              // of its radars, for people; empty: none
  std::optional<std::string> gone_;  // why nothing comes
  SteadyTime gone_at_{}, world_at_{};
  std::map<std::uint32_t, wire::OwnShip> own_ships_;
  std::optional<wire::ExerciseState> exercise_;
  wire::PlaybackState playback_;
  using ViewKey = std::pair<std::uint32_t, std::uint32_t>;       // radar, view here
  std::map<ViewKey, std::optional<std::uint32_t>> views_there_;  // nothing: no line has it now
  mutable ConSharing cons_;
};

}  // namespace skerry::server
