// PlaybackHost: a recording in place of radars; everything right of the rings is as with them.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "protocol/recording/reader.hpp"
#include "server/playback/player.hpp"
#include "server/playback/recorded_radars.hpp"
#include "server/relayed/relayed_host.hpp"

namespace skerry::server {

// Construct; hand the host to a NetServer, which adds its formats to the channels; start().
// A recording cannot be changed: a Set is refused unless it asks for values that already hold.  One
// exception: the instrumented range of a view that was opened here, which an output sets for
// itself.
class PlaybackHost final : public RelayedHost, private PlaybackPort {
 public:
  // `server`: what Hello says of it.
  // Error: std::runtime_error if there is nothing in it to play.
  PlaybackHost(recording::RecordingReader reader, const PlayerOptions& options, std::string server);
  ~PlaybackHost() override;

  void start() { player_.start(); }
  void stop() { player_.stop(); }
  // Makes coastlines for instructors, as RadarHost::find_coastline() does; without it there are
  // none.  Before the NetServer is made.
  using CoastlineMaker = std::function<void(const wire::GetCoastline&, CoastlineDone)>;
  void set_coastline(CoastlineMaker maker) { coastline_ = std::move(maker); }
  using ChartObjectsMaker = std::function<void(const wire::GetChartObjects&, ChartObjectsDone)>;
  void set_chart_objects(ChartObjectsMaker maker) { chart_objects_ = std::move(maker); }
  // A playback can be recorded, too.  Before the NetServer is made.
  void set_recording(RecordingPort* port) { recording_ = port; }

  const recording::Summary& summary() const { return reader_.summary(); }
  const RecordedRadars& radars() const { return radars_; }
  // Whether there is anything in it that instructors can be told: states of the exercise, or at
  // least traffic.
  bool holds_truth() const { return holds_truth_; }

  wire::Hello hello() const override;
  RecordingPort* recording() override { return recording_; }
  PlaybackPort* playback() override { return this; }
  void set_targets(TargetPort* plotters) { plotters_ = plotters; }  // as set_recording()
  TargetPort* targets() override { return plotters_; }
  std::optional<std::string> drive(std::uint32_t radar, const OwnShipFix& fix) override;
  wire::Status status() const override;
  std::optional<wire::ExerciseState> exercise_state() const override;
  void find_coastline(const wire::GetCoastline& place, CoastlineDone done) override;
  bool has_chart() const override { return chart_objects_ != nullptr; }
  void find_chart_objects(const wire::GetChartObjects& place, ChartObjectsDone done) override;

 private:
  PlaybackHost(RecordedRadars radars, recording::RecordingReader&& reader,
               const PlayerOptions& options, std::string server);

  wire::Reply change(const wire::Set& set, const std::string& origin) override;
  wire::RadarInfo info(std::uint32_t radar) const override { return radars_.radars.at(radar).info; }
  UtcTime place() const override { return player_.standing().place; }
  std::optional<UtcTime> present_utc() const override { return player_.present_utc(); }

  wire::Reply control(const wire::Playback& playback, const std::string& origin) override;
  wire::PlaybackState state() const override;
  std::uint64_t version() const override { return player_.version(); }

  std::string problem(const std::string& playing) const;
  wire::PlayedMark played_mark(const recording::Mark& mark) const;
  // The newest, of a recording whose exercise is told by its traffic.
  void tell_marks_until(UtcTime now, wire::ExerciseState& state) const;

  const recording::RecordingReader reader_;
  const RecordedRadars radars_;
  const std::string server_;
  const bool current_timestamps_;
  RecordingPort* recording_ = nullptr;
  TargetPort* plotters_ = nullptr;
  CoastlineMaker coastline_;
  ChartObjectsMaker chart_objects_;
  bool holds_truth_ = false;
  // Of the last order that was obeyed.
  mutable std::mutex mutex_;
  std::string last_by_;
  std::uint64_t orders_ = 0;
  Player player_;  // last: plays into what stands above
};

}  // namespace skerry::server
