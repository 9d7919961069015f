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
#include "server/playback/recorded_values.hpp"
#include "server/playback/sendable_text.hpp"

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
        std::make_unique<PlayedViewList>(radar.views, radar.shared_view(), Player::kRingSectors));
  }
  return views;
}

wire::Reply reply(wire::Reply::Code code, std::string text = {}) {
  wire::Reply out;
  out.set_code(code);
  out.set_text(std::move(text));
  return out;
}

// Whether nothing but the instrumented range of a view is to change.
bool is_reach_alone(wire::Set set) {
  if (!set.has_instrumented_range_m()) return false;
  set.clear_radar();
  set.clear_view();
  set.clear_instrumented_range_m();
  set.clear_instructor();
  return set.ByteSizeLong() == 0;
}

std::string file_name(const std::string& path) { return path.substr(path.rfind('/') + 1); }

using wire::FieldDescriptor;
using wire::Message;

// Whether all that is present in `asked`, a Set or the controls it carries, is so.
bool is_same(const Message& asked, const wire::Settings& settings);

bool is_same(const Message& asked, const FieldDescriptor& field, const wire::Settings& settings) {
  if (field.message_type() == wire::Controls::descriptor()) {
    return is_same(asked.GetReflection()->GetMessage(asked, &field), settings);
  }
  const auto* const control = wire::Controls::descriptor()->FindFieldByName(field.name());
  if (control == nullptr || control->message_type() != nullptr) return false;
  return wire::value_of(asked, *control) == wire::value_of(settings, *control);
}

bool says_where_or_who(const FieldDescriptor& field) {
  return field.name() == "radar" || field.name() == "view" || field.name() == "instructor" ||
         field.name() == "token";
}

bool is_same(const Message& asked, const wire::Settings& settings) {
  if (!asked.GetReflection()->GetUnknownFields(asked).empty()) return false;
  std::vector<const FieldDescriptor*> present;
  asked.GetReflection()->ListFields(asked, &present);
  for (const FieldDescriptor* field : present) {
    if (!says_where_or_who(*field) && !is_same(asked, *field, settings)) return false;
  }
  return true;
}

// Whether a Set asks for what is so already.  Displays say "transmit" to a radar that transmits,
// and set a control to what it is: that is not refused by a playback.  Locks, orders to the ship
// and the world always ask for a change.
bool is_so_already(const wire::Set& set, const wire::Settings& settings) {
  return is_same(set, settings);
}

}  // namespace

PlaybackHost::PlaybackHost(recording::RecordingReader reader, const PlayerOptions& options,
                           std::string server)
    : reader_(std::move(reader)),
      radars_(radars_or_throw(reader_)),
      server_(std::move(server)),
      current_timestamps_(options.current_timestamps),
      views_(views_of(radars_)),
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

VideoChannelPtr PlaybackHost::find_channel(std::uint32_t radar, std::uint32_t view) {
  if (radar >= views_.size()) return nullptr;
  const PlayedViewPtr found = views_[radar]->find(view);
  return found ? VideoChannelPtr(found, &found->channel) : nullptr;
}

std::optional<std::uint32_t> PlaybackHost::open_view(
    std::uint32_t radar, std::uint32_t like, bool,
    const std::function<void(VideoChannel&)>& prepare) {
  const PlayedViewPtr opened = views_.at(radar)->open(like, prepare);
  views_version_.fetch_add(1);
  return opened ? std::optional(opened->number) : std::nullopt;
}

void PlaybackHost::close_view(std::uint32_t radar, std::uint32_t view) {
  views_.at(radar)->close(view);
  views_version_.fetch_add(1);
}

std::vector<RadarHost::View> PlaybackHost::views(std::uint32_t radar) {
  std::vector<View> out;
  const auto views = views_.at(radar)->get();
  for (const PlayedViewPtr& view : *views) {
    out.push_back({view->number, VideoChannelPtr(view, &view->channel)});
  }
  return out;
}

wire::Reply PlaybackHost::apply(const wire::Set& set, const std::string& origin) {
  if (set.radar() >= views_.size()) {
    return reply(wire::Reply::UNKNOWN, fmt::format("no radar {}; there are radars 0 to {}",
                                                   set.radar(), views_.size() - 1));
  }
  const PlayedViewPtr view = views_[set.radar()]->find(set.view());
  if (!view) {
    return reply(wire::Reply::UNKNOWN,
                 fmt::format("radar {} has no view {}", set.radar(), set.view()));
  }
  if (is_so_already(set, settings(set.radar(), set.view()))) return reply(wire::Reply::OK);
  if (!view->opened || !is_reach_alone(set)) {
    spdlog::debug("{}: a change of a playback was refused", origin);
    return reply(wire::Reply::REFUSED,
                 "this is a playback: what was recorded cannot be changed; play, pause, seek, rate "
                 "and steps are asked for with Playback (skerry play, the console's bar)");
  }
  const RangeScale scale =
      RangeScale::find(settings(set.radar(), set.view()).range_nm()).value_or(RangeScale{});
  const double scale_m = scale.length().in_metres(), range_m = set.instrumented_range_m();
  // Written so that a NaN fails.
  if (!(range_m == 0.0 ||
        (range_m >= kShortestReach * scale_m && range_m <= kLongestReach * scale_m))) {
    return reply(wire::Reply::OUT_OF_RANGE,
                 fmt::format("instrumented range: {} m is out of range; allowed: 0, or {} to {} m",
                             range_m, kShortestReach * scale_m, kLongestReach * scale_m));
  }
  view->want_reach({range_m, scale});
  reach_version_.fetch_add(1, std::memory_order_relaxed);
  return reply(wire::Reply::OK);
}

std::vector<TrafficItem> PlaybackHost::traffic() const {
  return state_.traffic(player_.standing().place);
}

std::optional<std::string> PlaybackHost::drive(std::uint32_t, const OwnShipFix&) {
  return "this is a playback: her own ship sails as recorded";
}

wire::Settings PlaybackHost::settings(std::uint32_t radar, std::uint32_t view) const {
  const PlayedViewPtr found = views_.at(radar)->find(view);
  // One that has just ended: as the shared one.
  wire::Settings settings =
      state_.settings(radar, found ? found->source : radars_.radars[radar].shared_view());
  settings.set_view(view);
  if (found) found->tell_reach(settings);
  return settings;
}

wire::OwnShip PlaybackHost::own_ship(std::uint32_t radar) const {
  wire::OwnShip ship = state_.own_ship(radar, player_.standing().place, player_.present_utc());
  if (ship.name().empty()) ship.set_name(radars_.radars.at(radar).info.own_ship());
  return ship;
}

std::uint64_t PlaybackHost::settings_version() const {
  return state_.settings_version() + reach_version_.load(std::memory_order_relaxed);
}

wire::Status PlaybackHost::status() const {
  const PlayerStanding standing = player_.standing();
  wire::Status status;
  status.set_server(server_);
  status.set_scenario(radars_.scenario);
  status.set_scenario_s(in_seconds(standing.place - summary().begin));
  const auto up = std::chrono::steady_clock::now() - made_;
  status.set_uptime_s(std::chrono::duration<double>(up).count());
  status.set_resident_mib(resident_mib());
  *status.mutable_world() = world();
  for (std::uint32_t radar = 0; radar < views_.size(); ++radar) {
    wire::RadarStatus& about = *status.add_radars();
    about.set_radar(radar);
    about.set_name(radars_.radars[radar].info.name());
    *about.mutable_settings() = settings(radar, 0);
    *about.mutable_own_ship() = own_ship(radar);
    const auto views = views_[radar]->get();
    for (const PlayedViewPtr& view : *views) {
      for (const auto& [format, spokes] : view->channel.spokes_encoded()) {
        (*about.mutable_encodes())[format] += spokes;
      }
      if (view->number == 0) {
        about.set_spokes(view->spokes());
        about.set_scan(view->scan());
      } else {
        *about.add_views() = settings(radar, view->number);
      }
    }
  }
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
  return reply(wire::Reply::OK);
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
