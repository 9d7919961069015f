#include "server/app/playback_options.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cstdio>
#include <stdexcept>
#include <utility>

#include "protocol/recording/position.hpp"
#include "server/app/config.pb.h"
#include "server/app/version.hpp"
#include "server/playback/play_request.hpp"
#include "server/playback/playback_host.hpp"

namespace skerry::server {
namespace {

using recording::RecordingReader;

constexpr const char* kPlaybackGroup = "Playback";

// Says on standard error how far the search has come, by tenths.
class SearchTold {
 public:
  explicit SearchTold(const std::string& file) : file_(file) {}
  bool operator()(double share) {
    const int tenths = static_cast<int>(share * 10.0);
    if (tenths > tenths_) {
      tenths_ = tenths;
      std::fprintf(stderr, "%s: has no index; searched for what can be read: %d %%\n",
                   file_.c_str(), tenths * 10);
    }
    return true;
  }

 private:
  std::string file_;
  int tenths_ = 0;
};

// The place that `text` names, as a request of a client would.
UtcTime place_of(const std::string& text, const recording::Summary& summary) {
  const auto position = recording::parse_position(text);
  if (!position) throw std::runtime_error("--play-from: " + position.error());
  wire::Playback request;
  if (position->is_mark()) {
    request.set_mark(position->mark);
  } else {
    request.set_position_s(in_seconds(position->since_begin));
  }
  const auto order = play_order(request, summary);
  if (!order) throw std::runtime_error("--play-from: " + order.error().text());
  return *order->seek;
}

}  // namespace

void add_playback_options(CLI::App& cli, PlaybackOptions& options) {
  auto* play = cli.add_option("--play", options.file,
                              "play this recording in place of radars, to every output")
                   ->group(kPlaybackGroup);
  cli.add_option("--play-rate", options.rate, "times the recorded pace (1)")
      ->check(CLI::Range(kSlowestRate, kFastestRate))
      ->needs(play)
      ->group(kPlaybackGroup);
  cli.add_flag("--play-loop", options.loop, "from the begin again at the end")
      ->needs(play)
      ->group(kPlaybackGroup);
  cli.add_option("--play-from", options.from,
                 "begin there: seconds, minutes:seconds, hours:minutes:seconds or a mark's name")
      ->needs(play)
      ->group(kPlaybackGroup);
  cli.add_flag("--play-paused", options.paused, "stand there until told to play")
      ->needs(play)
      ->group(kPlaybackGroup);
  cli.add_flag("--current-timestamps", options.current_timestamps,
               "spokes and ships bear the time at which they are played, not their own")
      ->needs(play)
      ->group(kPlaybackGroup);
}

void apply_playback(const app::Playback& file, PlaybackOptions& options) {
  if (file.has_file()) options.file = file.file();
  if (file.has_rate()) options.rate = file.rate();
  if (file.has_loop()) options.loop = file.loop();
  if (file.has_from()) options.from = file.from();
  if (file.has_paused()) options.paused = file.paused();
  if (file.has_current_timestamps()) options.current_timestamps = file.current_timestamps();
}

std::unique_ptr<PlaybackHost> open_playback(const PlaybackOptions& options) {
  auto reader = RecordingReader::open(options.file, SearchTold(options.file));
  if (!reader) throw std::runtime_error(reader.error().to_string());
  PlayerOptions player{.playing = !options.paused,
                       .rate = options.rate,
                       .loop = options.loop,
                       .from = {},
                       .current_timestamps = options.current_timestamps};
  if (!options.from.empty()) player.from = place_of(options.from, reader->summary());
  return std::make_unique<PlaybackHost>(std::move(reader).value(), player, kServerName);
}

std::string description_of(const PlaybackHost& playback) {
  const recording::Summary& about = playback.summary();
  std::string text =
      fmt::format("{}: {} long, {} radar{}", about.file, place_text(about.end - about.begin),
                  playback.radar_count(), playback.radar_count() == 1 ? "" : "s");
  for (const RecordedRadar& radar : playback.radars().radars) {
    if (radar.recorded == radar.info.radar()) continue;
    text += fmt::format("; radar {} of the recording is radar {} here", radar.recorded,
                        radar.info.radar());
  }
  if (about.damage) text += "; damaged: " + about.damage->to_string();
  return text;
}

}  // namespace skerry::server
