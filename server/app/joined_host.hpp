// JoinedHost: simulated radars and real ones as the radars of one server.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "server/core/radar_host.hpp"
#include "server/live/added_echoes.hpp"
#include "server/live/live_host.hpp"

namespace skerry::server {

// A real radar takes the place of the simulated one of its number, which goes to standby, or has
// the number after the last.  Of a source that wants it, the simulated radar stays on the air
// instead and is laid over the real one's picture; its range follows, and whoever drives the real
// one's own ship drives the simulated one's.  The world and its ships are the simulation's; a ship
// all of whose radars are real is no ship of it any more. An exercise with real radars is recorded
// as video: there is nothing to make it again from. Thread: as RadarHost.
class JoinedHost final : public RadarHost {
 public:
  // Both must outlive it.
  // Error: std::runtime_error if the numbers have gaps, or there is nothing to lay over.
  JoinedHost(RadarHost& simulated, LiveHost& live);

  // Before the NetServer is made.
  void set_recording(RecordingPort* recorder) { recorder_ = recorder; }
  RecordingPort* recording() override { return recorder_; }
  void set_targets(TargetPort* plotters) { plotters_ = plotters; }  // as set_recording()
  TargetPort* targets() override { return plotters_; }

  wire::Hello hello() const override;
  std::uint32_t radar_count() const override { return count_; }
  VideoChannelPtr find_channel(std::uint32_t radar, std::uint32_t view) override;
  std::optional<std::uint32_t> open_view(
      std::uint32_t radar, std::uint32_t like, bool follows,
      const std::function<void(VideoChannel&)>& prepare) override;
  void close_view(std::uint32_t radar, std::uint32_t view) override;
  std::vector<View> views(std::uint32_t radar) override;
  std::uint64_t views_version() const override;
  BoardPortPtr find_board(std::uint32_t radar) override;
  wire::Reply apply(const wire::Set& set, const std::string& origin) override;
  void leave(const std::string& origin) override { simulated_.leave(origin); }
  std::vector<TrafficItem> traffic() const override;
  std::optional<std::string> drive(std::uint32_t radar, const OwnShipFix& fix) override;
  wire::Settings settings(std::uint32_t radar, std::uint32_t view) const override;
  wire::OwnShip own_ship(std::uint32_t radar) const override;
  wire::World world() const override { return simulated_.world(); }
  std::optional<wire::ExerciseState> exercise_state() const override {
    return simulated_.exercise_state();
  }
  void find_coastline(const wire::GetCoastline& place, CoastlineDone done) override {
    simulated_.find_coastline(place, std::move(done));
  }
  bool has_chart() const override { return simulated_.has_chart(); }
  void find_chart_objects(const wire::GetChartObjects& place, ChartObjectsDone done) override {
    simulated_.find_chart_objects(place, std::move(done));
  }
  wire::Status status() const override;
  std::uint64_t settings_version() const override;
  std::uint64_t world_version() const override { return simulated_.world_version(); }

 private:
  // A simulated radar that is laid over a real one.
  struct Overlay {
    Overlay() = default;
    std::uint32_t radar = 0;
    AddedEchoes echoes;
    double range_nm = 0.0;                // that the simulation was asked for
    VideoChannelPtr channel;              // of a view of its own
    FormatRing::Registration registered;  // ends before the channel does
  };
  RadarHost& of(std::uint32_t radar) const;
  void lay_over(std::uint32_t radar);
  void follow_range(Overlay& overlay, const SpokeHeader& real);

  RadarHost& simulated_;
  LiveHost& live_;
  std::uint32_t count_;
  std::vector<std::unique_ptr<Overlay>> overlays_;
  RecordingPort* recorder_ = nullptr;
  TargetPort* plotters_ = nullptr;
};

}  // namespace skerry::server
