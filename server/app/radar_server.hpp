// RadarServer: one scenario with all its own ships and radars, running.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "echo/chart/chart_source.hpp"
#include "server/app/chart_desk.hpp"
#include "server/app/control/control_desk.hpp"
#include "server/app/fleet/fleet_port.hpp"
#include "server/app/load_watch.hpp"
#include "server/app/shore_thread.hpp"
#include "server/board/board_unit.hpp"
#include "server/core/paced_thread.hpp"
#include "server/core/radar_host.hpp"
#include "server/core/utc_clock.hpp"
#include "server/radar/radar_unit.hpp"
#include "server/radar/rain_ahead.hpp"
#include "server/replay/input_log.hpp"
#include "server/world/scenario.pb.h"
#include "server/world/timeline.hpp"

namespace skerry::server {

// Construct; hand the host to a NetServer, which adds its formats to the channels; start().
class RadarServer : public RadarHost {
 public:
  // Loads the coast around every radar, so that the first spoke shows it.  `documents`: what the
  // scenario and the charts are, for recordings.
  // Error: std::runtime_error if the chart cannot be read or the scenario's coast not be made.
  RadarServer(const scenario::Scenario& scenario, std::unique_ptr<const echo::ChartSource> chart,
              std::size_t workers, std::vector<ExerciseDocument> documents = {});
  ~RadarServer() override;

  // Names the rings of the boards in shared memory, of `bytes` of records each, after the port that
  // this host's clients know the server by.  Before start(); without, there are none.
  void name_shared_rings(std::uint16_t tcp_port, std::size_t bytes);

  // Sets the recorder.  Call it before start(); the recorder must live as long as this.
  void set_recording(RecordingPort* recorder) { recorder_ = recorder; }
  RecordingPort* recording() override { return recorder_; }
  void set_audit(AuditPort* audit) { desk_->set_audit(audit); }     // as set_recording()
  void set_targets(TargetPort* plotters) { plotters_ = plotters; }  // as set_recording()
  TargetPort* targets() override { return plotters_; }

  // Sets the fleet that runs this exercise with others.  As set_recording().  Orders that hold on
  // all hosts go there, and no radar makes spokes until make_spokes_until() says so.
  void set_fleet(FleetPort* fleet);
  // For the fleet, which makes ticks and gives orders.
  Timeline& timeline() { return timeline_; }
  ControlDesk& desk() { return *desk_; }
  std::size_t own_ship_of(std::uint32_t radar) const;
  void make_spokes_until(std::size_t own_ship, std::chrono::steady_clock::time_point end);
  // The exercise's time is `time` now, whatever it was till now.  After start(); boards go on.
  void set_time(Duration time);

  // Other clocks than this machine's, for tests; the steady one must be this machine's.
  // Before start().
  void set_clocks(ReadClocks clocks) { clocks_ = std::move(clocks); }

  // Scenario time 0 was `ago`, by default now.  An exercise that has run so long is taken up where
  // it is by now: ships have sailed as ordered, and spokes go on as radars on another host have
  // numbered them.  Land may be that of the start for the first second.
  // Requires ago >= 0.
  void start(Duration ago = {});
  void stop();

  // How far each radar has come.
  std::vector<RadarPace> pace() const;

  wire::Hello hello() const override;
  std::uint32_t radar_count() const override { return static_cast<std::uint32_t>(radars_.size()); }
  VideoChannelPtr find_channel(std::uint32_t radar, std::uint32_t view) override;
  std::optional<std::uint32_t> open_view(
      std::uint32_t radar, std::uint32_t like, bool follows,
      const std::function<void(VideoChannel&)>& prepare) override;
  void close_view(std::uint32_t radar, std::uint32_t view) override;
  std::vector<View> views(std::uint32_t radar) override;
  std::uint64_t views_version() const override { return views_version_.load(); }
  BoardPortPtr find_board(std::uint32_t radar) override;
  wire::Reply apply(const wire::Set& set, const std::string& origin) override;
  std::optional<wire::Reply> apply_or_ask(const wire::Set& set, const std::string& origin,
                                          const Answered& later) override;
  void leave(const std::string& origin) override;
  std::vector<TrafficItem> traffic() const override;
  const ExerciseInputs* exercise() const override { return &inputs_; }
  std::optional<wire::Fleet> fleet() const override;
  std::uint64_t fleet_version() const override { return fleet_ ? fleet_->version() : 0; }
  std::optional<std::string> drive(std::uint32_t radar, const OwnShipFix& fix) override;
  std::optional<wire::ExerciseState> exercise_state() const override;
  void find_coastline(const wire::GetCoastline& place, CoastlineDone done) override {
    chart_desk_.answer(place, std::move(done));
  }
  bool has_chart() const override { return true; }
  void find_chart_objects(const wire::GetChartObjects& place, ChartObjectsDone done) override {
    chart_desk_.answer(place, std::move(done));
  }
  wire::Settings settings(std::uint32_t radar, std::uint32_t view) const override;
  wire::OwnShip own_ship(std::uint32_t radar) const override;
  wire::Status status() const override;
  wire::World world() const override;
  // Also has the log told of changes that were held back: net-0 asks ten times a second.
  std::uint64_t settings_version() const override;
  std::uint64_t world_version() const override { return desk_->world_version(); }

 private:
  struct Mount;  // a radar on her ship
  // Now, and the world's tick that holds it; before start() its first.
  struct Instant {
    ScenarioTime time{};
    UtcTime utc{};
    WorldStatePtr state;
  };
  Instant instant() const;
  // Follows the system's clock, where it was set.
  void look_at_clock(ClockFollower& follower);
  void tell_clock(const UtcClock& clock);
  void mount_boards(const scenario::Scenario& scenario);
  // For a board: of a radar on the same ship as `of`, or nullptr.
  std::shared_ptr<echo::SweepEchoes> echoes_of(std::uint32_t radar, std::uint32_t of);
  bool is_shipmate(std::uint32_t radar, std::uint32_t of) const;
  std::string con_shown(std::uint32_t radar) const;
  RecordingPort* recorder_ = nullptr;
  TargetPort* plotters_ = nullptr;
  FleetPort* fleet_ = nullptr;
  std::string scenario_name_;
  mutable Timeline timeline_;  // to look at a tick is to make it
  ReadClocks clocks_ = read_clocks;
  Latest<Epoch> epoch_;  // none before start()
  // The same; as the system's clock has it, and as it is told where the exercise's time was
  // shifted.
  Latest<UtcClock> system_utc_, utc_;
  std::mutex utc_mutex_;                // one change at a time
  std::atomic<std::int64_t> shift_{0};  // of the epoch, ns (RadarUnit::shift_epoch)
  PacedThread clock_, load_;
  LoadWatch load_watch_;  // load's
  std::unique_ptr<CoastService> coast_;
  ChartDesk chart_desk_;
  Airwaves airwaves_;
  InputLog inputs_;
  ShoreThread shore_;
  RainAhead rain_;
  std::vector<std::unique_ptr<Mount>> radars_;
  std::atomic<std::uint64_t> views_version_{1};
  std::vector<std::shared_ptr<BoardUnit>> boards_;  // one of each radar
  std::unique_ptr<ControlDesk> desk_;
  const std::chrono::steady_clock::time_point made_ = std::chrono::steady_clock::now();
};

}  // namespace skerry::server
