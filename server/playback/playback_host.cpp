#include "server/playback/playback_host.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <utility>
#include <vector>

#include "protocol/wire/radar.pb.h"
#include "protocol/wire/schema.hpp"
#include "protocol/wire/spoke_message.hpp"
#include "server/core/process_memory.hpp"
#include "server/playback/play_request.hpp"
#include "server/relayed/relayed_exercise.hpp"
#include "server/relayed/sendable_text.hpp"
#include "server/relayed/values_in_range.hpp"

namespace skerry::server {
namespace {

constexpr std::size_t kMostMarks = 1000;
constexpr std::ptrdiff_t kMarksTold = 100;                         // as exercise.proto says
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
    : RelayedHost(views_of(radars)),
      reader_(std::move(reader)),
      radars_(std::move(radars)),
      server_(std::move(server)),
      current_timestamps_(options.current_timestamps),
      player_(reader_, radars_, views_, state_, options) {
  const auto exercises = summary().items.find({recording::Kind::exercise});
  holds_truth_ = (exercises != summary().items.end() && exercises->second > 0) ||
                 !exercise_of_traffic(traffic(), 0.0).ships().empty();
}

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
      "a recording is played: what was recorded cannot be changed; play, pause, seek, rate "
      "and steps are asked for with Playback (skerry play, the console's bar)");
}

std::optional<std::string> PlaybackHost::drive(std::uint32_t, const OwnShipFix&) {
  return "a recording is played: her own ship sails as recorded";
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
  {
    // Of two orders at once the one that comes last is the one that is told.
    const std::lock_guard lock(mutex_);
    player_.order(*order);
    last_by_ = origin;
    ++orders_;
  }
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
    // Trainees have this too: what happened in the exercise is for instructors.
    if (!mark.kind.empty()) continue;
    if (static_cast<std::size_t>(state.marks_size()) == kMostMarks) break;
    wire::PlaybackState::Mark& said = *state.add_marks();
    said.set_position_s(std::clamp(seconds(mark.time), 0.0, seconds(about.end)));
    said.set_name(sendable(mark.name, kLongestMark));
  }
  state.set_current_timestamps(current_timestamps_);
  state.set_problem(problem(standing.problem));
  state.set_truth(holds_truth_);
  const std::lock_guard lock(mutex_);
  state.set_last_by(last_by_);
  state.set_orders(orders_);
  return state;
}

std::optional<wire::ExerciseState> PlaybackHost::exercise_state() const {
  if (!holds_truth_) return std::nullopt;
  const UtcTime now = place();
  auto state = state_.exercise(now);
  if (!state) {
    state = exercise_of_traffic(traffic(), in_seconds(now - summary().begin));
    tell_marks_until(now, *state);
  }
  for (const recording::Mark& mark : summary().marks) {
    if (static_cast<std::size_t>(state->played_marks_size()) == kMostMarks) break;
    *state->add_played_marks() = played_mark(mark);
  }
  return state;
}

wire::PlayedMark PlaybackHost::played_mark(const recording::Mark& mark) const {
  wire::PlayedMark told;
  const recording::Summary& about = summary();
  told.set_position_s(in_seconds(std::clamp(mark.time, about.begin, about.end) - about.begin));
  told.set_text(sendable(mark.name, kLongestText));
  told.set_kind(mark.kind.empty() ? "mark" : sendable(mark.kind, kLongestMark));
  return told;
}

void PlaybackHost::tell_marks_until(UtcTime now, wire::ExerciseState& state) const {
  const auto& marks = summary().marks;
  const auto later =
      std::upper_bound(marks.begin(), marks.end(), now,
                       [](UtcTime at, const recording::Mark& mark) { return at < mark.time; });
  const auto until = later - marks.begin();
  for (auto i = std::max<std::ptrdiff_t>(0, until - kMarksTold); i < until; ++i) {
    const wire::PlayedMark mark = played_mark(marks[static_cast<std::size_t>(i)]);
    wire::ExerciseMark& told = *state.add_marks();
    told.set_exercise_s(mark.position_s());
    told.set_text(mark.text());
    told.set_kind(mark.kind());
  }
}

void PlaybackHost::find_coastline(const wire::GetCoastline& place, CoastlineDone done) {
  coastline_ ? coastline_(place, std::move(done)) : done(NoChart::none_here);
}

void PlaybackHost::find_chart_objects(const wire::GetChartObjects& place, ChartObjectsDone done) {
  chart_objects_ ? chart_objects_(place, std::move(done)) : done(NoChart::none_here);
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
