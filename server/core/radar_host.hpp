// RadarHost: all that the network needs to know of the rest of the server.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "protocol/quantity/result.hpp"
#include "protocol/wire/radar.pb.h"
#include "server/core/answered.hpp"
#include "server/core/board_port.hpp"
#include "server/core/chart_answer.hpp"
#include "server/core/exercise_inputs.hpp"
#include "server/core/recording_port.hpp"
#include "server/core/target_port.hpp"
#include "server/core/traffic.hpp"
#include "server/core/video_channel.hpp"

namespace skerry::server {

using VideoChannelPtr = std::shared_ptr<VideoChannel>;

// Implemented in server/app.  Thread: every function may be called from any thread and returns at
// once; none waits for a radar, a disk or a client.
class RadarHost {
 public:
  virtual ~RadarHost() = default;

  virtual wire::Hello hello() const = 0;
  virtual std::uint32_t radar_count() const = 0;

  // The spokes of a view of a radar; nullptr if there is none.  View 0 is always there, others from
  // open_view() to close_view(); nothing comes any more from one that has been closed.
  virtual VideoChannelPtr find_channel(std::uint32_t radar, std::uint32_t view) = 0;

  // A further view with the settings of view `like`; `prepare` adds its formats before any video
  // comes.  Nothing if the radar has as many as it may.  Requires a radar and view that are there.
  // One that follows has at all times the controls of `like`, except for its instrumented range.
  virtual std::optional<std::uint32_t> open_view(
      std::uint32_t radar, std::uint32_t like, bool follows,
      const std::function<void(VideoChannel&)>& prepare) = 0;
  // The same of a view that follows nothing, for who can wait: nothing is returned where another
  // server is asked, and `later` is then called once with its answer, from any thread.
  // Error: why there is none, for people.
  using OpenedView = Result<std::uint32_t, std::string>;
  using ViewOpened = std::function<void(OpenedView)>;
  virtual std::optional<OpenedView> open_view_or_ask(
      std::uint32_t radar, std::uint32_t like, const std::function<void(VideoChannel&)>& prepare,
      const ViewOpened& /*later*/) {
    if (const auto view = open_view(radar, like, false, prepare)) return OpenedView(*view);
    return OpenedView(Failure{"radar " + std::to_string(radar) +
                              " has as many views as it may; close another console or share a "
                              "view"});
  }
  // No effect on view 0.
  virtual void close_view(std::uint32_t radar, std::uint32_t view) = 0;

  // The views of a radar as of now, view 0 first; those of outputs, which no console has, too.
  // Requires a radar that is there.
  struct View {
    std::uint32_t number = 0;
    VideoChannelPtr channel;
  };
  virtual std::vector<View> views(std::uint32_t radar) = 0;
  // Has grown once views() of any radar is another; a number that has come back is another view.
  virtual std::uint64_t views_version() const = 0;

  // The interface board of a radar; nullptr if it has none, or there is no such radar.
  virtual BoardPortPtr find_board(std::uint32_t /*radar*/) { return nullptr; }

  // Set while the server is put together, before net-0 runs; nullptr if it cannot record, or
  // nothing is played back.
  virtual RecordingPort* recording() { return nullptr; }
  virtual PlaybackPort* playback() { return nullptr; }
  // The plotters of its views; nullptr if there are none.  Set as the recorder is.
  virtual TargetPort* targets() { return nullptr; }
  // The inputs of the exercise; nullptr if there is none (a playback).
  virtual const ExerciseInputs* exercise() const { return nullptr; }

  // Checks all of `set` and applies all or nothing; the reply says which value was out of range, or
  // which control the instructor has locked.  What changed goes to the log with `origin`: who
  // asked, as an operator would name them ("console 127.0.0.1:50714", "Navico display 192.0.2.7").
  virtual wire::Reply apply(const wire::Set& set, const std::string& origin) = 0;

  // The same for who can wait: nothing is returned where another server decides, and `later` is
  // then called once with its answer, from any thread.
  virtual std::optional<wire::Reply> apply_or_ask(const wire::Set& set, const std::string& origin,
                                                  const Answered& /*later*/) {
    return apply(set, origin);
  }

  // The connection that was `origin` has ended: a con that it had is free again.
  virtual void leave(const std::string& /*origin*/) {}

  // All ships and marks of the world as of now, own ships too, as tracking and AIS know them.
  virtual std::vector<TrafficItem> traffic() const { return {}; }
  // An own ship whose motion comes from an outside simulator: her state as of now.  She goes back
  // to her own motion kDriveTimeout after the last.  Error: why it is refused.
  static constexpr std::chrono::seconds kDriveTimeout{10};
  virtual std::optional<std::string> drive(std::uint32_t /*radar*/, const OwnShipFix& /*fix*/) {
    return "this server's own ships cannot be driven from outside";
  }

  // The exercise as it really is, for instructors; nothing if there is none (a playback).
  virtual std::optional<wire::ExerciseState> exercise_state() const { return std::nullopt; }
  // The shore about a place, made on a thread of its own; `done` is called once, from there or at
  // once, with the reason if there is none.  Radius within its range.
  using CoastlineDone = std::function<void(ChartAnswer<wire::Coastline>)>;
  virtual void find_coastline(const wire::GetCoastline& /*place*/, CoastlineDone done) {
    done(NoChart::none_here);
  }
  // The same of what consoles draw of the chart; only if has_chart().
  using ChartObjectsDone = std::function<void(ChartAnswer<wire::ChartObjects>)>;
  virtual bool has_chart() const { return false; }
  virtual void find_chart_objects(const wire::GetChartObjects& /*place*/, ChartObjectsDone done) {
    done(NoChart::none_here);
  }

  // Require a radar and view that find_channel() knows.
  virtual wire::Settings settings(std::uint32_t radar, std::uint32_t view) const = 0;
  virtual wire::OwnShip own_ship(std::uint32_t radar) const = 0;
  virtual wire::World world() const = 0;
  // How a relay is connected to the servers before it, the nearest first; none: it is no relay.
  virtual std::vector<wire::HopStatus> hops() const { return {}; }
  // The hosts that run the exercise together; nothing: this one runs it alone.
  virtual std::optional<wire::Fleet> fleet() const { return std::nullopt; }
  // Grows whenever fleet() has changed but for how long ago hosts were heard.
  virtual std::uint64_t fleet_version() const { return 0; }
  // One entry per radar; server/net adds the clients and its errors.
  virtual wire::Status status() const = 0;

  // Grows whenever the settings of any view change, so that consoles can be told.
  virtual std::uint64_t settings_version() const = 0;
  // The same of world().
  virtual std::uint64_t world_version() const = 0;
};

}  // namespace skerry::server
