#include "server/app/options/playback_options.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cstdint>
#include <cstdio>
#include <stdexcept>
#include <utility>

#include "protocol/recording/position.hpp"
#include "server/app/config.pb.h"
#include "server/app/options/field_options.hpp"
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

// Written so that a NaN fails, which CLI::Range lets pass.
double checked_rate(double rate) {
  if (rate >= kSlowestRate && rate <= kFastestRate) return rate;
  throw CLI::ValidationError(
      "--play-rate", fmt::format("{} is not in {} to {}", rate, kSlowestRate, kFastestRate));
}

}  // namespace

void add_playback_options(CLI::App& cli, app::Playback& line) {
  using app::Playback;
  FieldOptions add(cli, kPlaybackGroup);
  cli.add_option_function<std::string>(
         "--play", [&line](const std::string& file) { line.set_file(file); },
         "play this recording in place of radars, to every output")
      ->group(kPlaybackGroup);
  cli.add_option_function<double>(
         "--play-rate", [&line](double rate) { line.set_rate(checked_rate(rate)); },
         fmt::format("times the recorded pace, {} to {} (1)", kSlowestRate, kFastestRate))
      ->group(kPlaybackGroup);
  add.flag("--play-loop", line, &Playback::set_loop, "from the begin again at the end");
  add.text("--play-from", line, &Playback::mutable_from,
           "begin there: seconds, minutes:seconds, hours:minutes:seconds or a mark's name");
  add.flag("--play-paused", line, &Playback::set_paused, "stand there until told to play");
  add.flag("--current-timestamps", line, &Playback::set_current_timestamps,
           "spokes and ships bear the time at which they are played, not their own");
}

PlaybackOptions playback_options(const app::Playback& said) {
  PlaybackOptions options;
  options.file = said.file();
  if (said.has_rate()) options.rate = said.rate();
  options.loop = said.loop();
  options.from = said.from();
  options.paused = said.paused();
  options.current_timestamps = said.current_timestamps();
  return options;
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
