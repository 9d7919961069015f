// PlayedCoast: the shore of a recorded exercise, for instructors who look at a playback.
#pragma once

#include <memory>

#include "server/app/chart_desk.hpp"
#include "server/app/exercise_files.hpp"
#include "server/playback/playback_host.hpp"
#include "server/radar/coast_service.hpp"

namespace skerry::server {

// Answers the playback's find_coastline() and find_chart_objects() from a thread of its own.
// Thread: that of main; start() before the network's, stop() after it has been told to end.
class PlayedCoast {
 public:
  // On the charts that the recording names, or those of `instead`, by the same order.  Where they
  // are not there any more, or others, on the world's shoreline, which is logged.  Nothing without
  // any, and for a recording in which there is nothing to tell instructors.
  // It must outlive what asks the playback.
  static std::unique_ptr<PlayedCoast> of(PlaybackHost& playback, const ChartFiles& instead);

  void start() { coast_.start(); }
  // No coastline is made after it.
  void stop() { coast_.stop(); }

 private:
  PlayedCoast(PlaybackHost& playback, std::unique_ptr<const echo::ChartSource> chart);

  CoastService coast_;
  ChartDesk chart_desk_{coast_};
};

}  // namespace skerry::server
