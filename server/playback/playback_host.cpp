#include "server/playback/playback_host.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

#include "protocol/wire/radar.pb.h"
#include "protocol/wire/schema.hpp"
#include "protocol/wire/spoke_message.hpp"
#include "server/core/process_memory.hpp"
#include "server/playback/play_request.hpp"
#include "server/relay/sendable_text.hpp"
#include "server/relay/values_in_range.hpp"

namespace skerry::server {
namespace {

constexpr std::size_t kMostMarks = 1000;
constexpr std::size_t kLongestMark = 100, kLongestProblem = 1000;  // bytes

RecordedRadars radars_or_throw(const recording::RecordingReader& reader) {
  auto radars = radars_of(reader);
  if (!radars) throw std::runtime_error(radars.error());
  return std::move(radars).value();
}

Player::RadarViews views_of(const RecordedRadars& radars) {
  Player::RadarViews views;
  for (const RecordedRadar& radar : radars.radars) {
    views.push_back(
        std::make_unique<RelayedViewList>(radar.views, radar.shared_view(), Player::kRingSectors));
  }
  return views;
}

std::string file_name(const std::string& path) { return path.substr(path.rfind('/') + 1); }

}  // namespace

PlaybackHost::PlaybackHost(recording::RecordingReader reader, const PlayerOptions& options,
                           std::string server)
    : PlaybackHost(radars_or_throw(reader), std::move(reader), options, std::move(server)) {}

PlaybackHost::PlaybackHost(RecordedRadars radars, recording::RecordingReader&& reader,
                           const PlayerOptions& options, std::string server)
    : RelayHost(views_of(radars)),
      reader_(std::move(reader)),
      radars_(std::move(radars)),
      server_(std::move(server)),
      current_timestamps_(options.current_timestamps),
      player_(reader_, radars_, views_, state_, options) {}

PlaybackHost::~PlaybackHost() { stop(); }

wire::Hello PlaybackHost::hello() const {
  wire::Hello hello;
  hello.set_protocol_version(1);
  hello.set_server(server_);
  hello.set_scenario(radars_.scenario);
  for (const RecordedRadar& radar : radars_.radars) *hello.add_radars() = radar.info;
  for (const double nm : RangeScale::kNauticalMiles) hello.add_range_scales_nm(nm);
  hello.set_can_record(recording_ != nullptr);
  hello.set_playback(true);
  return hello;
}

wire::Reply PlaybackHost::change(const wire::Set&, const std::string& origin) {
  spdlog::debug("{}: a change of a playback was refused", origin);
  return reply_of(
      wire::Reply::REFUSED,
      "this is a playback: what was recorded cannot be changed; play, pause, seek, rate "
      "and steps are asked for with Playback (skerry play, the console's bar)");
}

std::optional<std::string> PlaybackHost::drive(std::uint32_t, const OwnShipFix&) {
  return "this is a playback: her own ship sails as recorded";
}

wire::Status PlaybackHost::status() const {
  wire::Status status;
  status.set_server(server_);
  status.set_scenario(radars_.scenario);
  status.set_scenario_s(in_seconds(place() - summary().begin));
  tell_status(status);
  *status.mutable_playback() = state();
  return status;
}

wire::Reply PlaybackHost::control(const wire::Playback& playback, const std::string& origin) {
  const auto order = play_order(playback, summary());
  if (!order) return order.error();
  player_.order(*order);
  const PlayerStanding now = player_.standing();
  spdlog::info("playback: {} at {}, rate {:g}{}{}, asked for by {}",
               now.playing ? "plays" : "stands", place_text(now.place - summary().begin), now.rate,
               now.loop ? ", in a loop" : "",
               order->steps == 0 ? "" : fmt::format(", {:+} turns", order->steps), origin);
  return reply_of(wire::Reply::OK);
}

wire::PlaybackState PlaybackHost::state() const {
  const PlayerStanding standing = player_.standing();
  const recording::Summary& about = summary();
  // Divided, so that 30 s are 30.
  const auto seconds = [&](UtcTime time) {
    return static_cast<double>((time - about.begin).count()) / 1e9;
  };
  wire::PlaybackState state;
  state.set_file(sendable(file_name(about.file), kLongestText));
  state.set_begin_utc_ns(static_cast<std::uint64_t>(about.begin.time_since_epoch().count()));
  state.set_length_s(seconds(about.end));
  state.set_position_s(seconds(standing.place));
  state.set_playing(standing.playing);
  state.set_rate(standing.rate);
  state.set_loop(standing.loop);
  for (const recording::Mark& mark : about.marks) {
    if (static_cast<std::size_t>(state.marks_size()) == kMostMarks) break;
    wire::PlaybackState::Mark& said = *state.add_marks();
    said.set_position_s(std::clamp(seconds(mark.time), 0.0, seconds(about.end)));
    said.set_name(sendable(mark.name, kLongestMark));
  }
  state.set_current_timestamps(current_timestamps_);
  state.set_problem(problem(standing.problem));
  return state;
}

std::string PlaybackHost::problem(const std::string& playing) const {
  std::string text;
  const auto add = [&text](const std::string& more) {
    if (!more.empty()) text += (text.empty() ? "" : "; ") + more;
  };
  if (summary().damage) add(summary().damage->to_string());
  add(radars_.problem);
  add(playing);
  return sendable(text, kLongestProblem);
}

}  // namespace skerry::server
