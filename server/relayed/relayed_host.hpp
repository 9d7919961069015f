// RelayedHost: what hosts have in common whose radars' spokes were made elsewhere: those of a
// recording, real ones on the network, and another server's.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/core/radar_host.hpp"
#include "server/relayed/relayed_state.hpp"
#include "server/relayed/relayed_view.hpp"

namespace skerry::server {

// The views of each radar and what is in force there.  Whoever has the spokes publishes them to the
// views and tells the state.
// Thread: as RadarHost.
class RelayedHost : public RadarHost {
 public:
  // By radar; nullptr where the number is a radar of another host.
  using RadarViews = std::vector<std::unique_ptr<RelayedViewList>>;

  std::uint32_t radar_count() const override { return static_cast<std::uint32_t>(views_.size()); }
  VideoChannelPtr find_channel(std::uint32_t radar, std::uint32_t view) override;
  std::optional<std::uint32_t> open_view(
      std::uint32_t radar, std::uint32_t like, bool follows,
      const std::function<void(VideoChannel&)>& prepare) override;
  void close_view(std::uint32_t radar, std::uint32_t view) override;
  std::vector<View> views(std::uint32_t radar) override;
  std::uint64_t views_version() const override { return views_version_.load(); }
  // What asks for nothing new is granted; the instrumented range of an opened view is changed;
  // change() decides on everything else.
  wire::Reply apply(const wire::Set& set, const std::string& origin) override;
  wire::Settings settings(std::uint32_t radar, std::uint32_t view) const override;
  wire::OwnShip own_ship(std::uint32_t radar) const override;
  wire::World world() const override { return state_.world(); }
  std::vector<TrafficItem> traffic() const override { return state_.traffic(place()); }
  std::uint64_t settings_version() const override;
  std::uint64_t world_version() const override { return state_.world_version(); }

 protected:
  explicit RelayedHost(RadarViews views) : views_(std::move(views)) {}

  // A change of the radar itself, which is there.
  virtual wire::Reply change(const wire::Set& set, const std::string& origin) = 0;
  virtual wire::RadarInfo info(std::uint32_t radar) const = 0;
  // The time of what is shown, and the one that ships are to bear, if another.
  virtual UtcTime place() const = 0;
  virtual std::optional<UtcTime> present_utc() const { return std::nullopt; }

  void views_changed() { views_version_.fetch_add(1); }

  // Adds uptime, memory, world and all radars.
  void tell_status(wire::Status& status) const;

  RadarViews views_;
  RelayedState state_;

 private:
  std::atomic<std::uint64_t> reach_version_{0}, views_version_{1};
  const std::chrono::steady_clock::time_point made_ = std::chrono::steady_clock::now();
};

wire::Reply reply_of(wire::Reply::Code code, std::string text = {});

}  // namespace skerry::server
