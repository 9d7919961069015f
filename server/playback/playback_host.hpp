// PlaybackHost: a recording in place of radars; everything right of the rings is as with them.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "protocol/recording/reader.hpp"
#include "server/core/radar_host.hpp"
#include "server/playback/played_state.hpp"
#include "server/playback/played_view.hpp"
#include "server/playback/player.hpp"
#include "server/playback/recorded_radars.hpp"

namespace skerry::server {

// Construct; hand the host to a NetServer, which adds its formats to the channels; start().
// A recording cannot be changed: a Set is refused unless it asks for values that already hold.  One
// exception: the instrumented range of a view that was opened here, which an output sets for
// itself.
class PlaybackHost final : public RadarHost, private PlaybackPort {
 public:
  // `server`: what Hello says of it.
  // Error: std::runtime_error if there is nothing in it to play.
  PlaybackHost(recording::RecordingReader reader, const PlayerOptions& options, std::string server);
  ~PlaybackHost() override;

  void start() { player_.start(); }
  void stop() { player_.stop(); }
  // A playback can be recorded, too.  Before the NetServer is made.
  void set_recording(RecordingPort* port) { recording_ = port; }

  const recording::Summary& summary() const { return reader_.summary(); }
  const RecordedRadars& radars() const { return radars_; }

  wire::Hello hello() const override;
  std::uint32_t radar_count() const override { return static_cast<std::uint32_t>(views_.size()); }
  VideoChannelPtr find_channel(std::uint32_t radar, std::uint32_t view) override;
  std::optional<std::uint32_t> open_view(
      std::uint32_t radar, std::uint32_t like, bool follows,
      const std::function<void(VideoChannel&)>& prepare) override;
  void close_view(std::uint32_t radar, std::uint32_t view) override;
  std::vector<View> views(std::uint32_t radar) override;
  std::uint64_t views_version() const override { return views_version_.load(); }
  RecordingPort* recording() override { return recording_; }
  PlaybackPort* playback() override { return this; }
  wire::Reply apply(const wire::Set& set, const std::string& origin) override;
  std::vector<TrafficItem> traffic() const override;
  std::optional<std::string> drive(std::uint32_t radar, const OwnShipFix& fix) override;
  wire::Settings settings(std::uint32_t radar, std::uint32_t view) const override;
  wire::OwnShip own_ship(std::uint32_t radar) const override;
  wire::World world() const override { return state_.world(); }
  wire::Status status() const override;
  std::uint64_t settings_version() const override;
  std::uint64_t world_version() const override { return state_.world_version(); }

 private:
  wire::Reply control(const wire::Playback& playback, const std::string& origin) override;
  wire::PlaybackState state() const override;
  std::uint64_t version() const override { return player_.version(); }

  std::string problem(const std::string& playing) const;

  const recording::RecordingReader reader_;
  const RecordedRadars radars_;
  const std::string server_;
  const bool current_timestamps_;
  PlayedState state_;
  Player::RadarViews views_;
  std::atomic<std::uint64_t> reach_version_{0}, views_version_{1};
  RecordingPort* recording_ = nullptr;
  const std::chrono::steady_clock::time_point made_ = std::chrono::steady_clock::now();
  Player player_;  // last: plays into what stands above
};

}  // namespace skerry::server
