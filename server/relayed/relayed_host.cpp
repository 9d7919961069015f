#include "server/relayed/relayed_host.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "protocol/wire/schema.hpp"
#include "protocol/wire/spoke_message.hpp"
#include "server/core/process_memory.hpp"

namespace skerry::server {
namespace {

// Whether nothing but the instrumented range of a view is to change.
bool is_reach_alone(wire::Set set) {
  if (!set.has_instrumented_range_m()) return false;
  set.clear_radar();
  set.clear_view();
  set.clear_instrumented_range_m();
  set.clear_instructor();
  return set.ByteSizeLong() == 0;
}

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

// Whether a Set asks for what is so already: displays say "transmit" to a radar that transmits,
// and set a control to what it is.  Locks, orders to the ship and the world always ask for a
// change.
bool is_so_already(const wire::Set& set, const wire::Settings& settings) {
  return is_same(set, settings);
}

}  // namespace

wire::Reply reply_of(wire::Reply::Code code, std::string text) {
  wire::Reply out;
  out.set_code(code);
  out.set_text(std::move(text));
  return out;
}

VideoChannelPtr RelayedHost::find_channel(std::uint32_t radar, std::uint32_t view) {
  if (radar >= views_.size() || !views_[radar]) return nullptr;
  const RelayedViewPtr found = views_[radar]->find(view);
  return found ? VideoChannelPtr(found, &found->channel) : nullptr;
}

std::optional<std::uint32_t> RelayedHost::open_view(
    std::uint32_t radar, std::uint32_t like, bool,
    const std::function<void(VideoChannel&)>& prepare) {
  const RelayedViewPtr opened = views_.at(radar)->open(like, prepare);
  views_version_.fetch_add(1);
  return opened ? std::optional(opened->number) : std::nullopt;
}

void RelayedHost::close_view(std::uint32_t radar, std::uint32_t view) {
  views_.at(radar)->close(view);
  views_version_.fetch_add(1);
}

std::vector<RadarHost::View> RelayedHost::views(std::uint32_t radar) {
  std::vector<View> out;
  const auto views = views_.at(radar)->get();
  for (const RelayedViewPtr& view : *views) {
    out.push_back({view->number, VideoChannelPtr(view, &view->channel)});
  }
  return out;
}

wire::Reply RelayedHost::apply(const wire::Set& set, const std::string& origin) {
  if (set.radar() >= views_.size() || !views_[set.radar()]) {
    return reply_of(wire::Reply::UNKNOWN, fmt::format("no radar {}; there are radars 0 to {}",
                                                      set.radar(), views_.size() - 1));
  }
  const RelayedViewPtr view = views_[set.radar()]->find(set.view());
  if (!view) {
    return reply_of(wire::Reply::UNKNOWN,
                    fmt::format("radar {} has no view {}", set.radar(), set.view()));
  }
  if (is_so_already(set, settings(set.radar(), set.view()))) return reply_of(wire::Reply::OK);
  if (!view->opened || !is_reach_alone(set)) return change(set, origin);
  const RangeScale scale =
      RangeScale::find(settings(set.radar(), set.view()).range_nm()).value_or(RangeScale{});
  const double scale_m = scale.length().in_metres(), range_m = set.instrumented_range_m();
  // Written so that a NaN fails.
  if (!(range_m == 0.0 ||
        (range_m >= kShortestReach * scale_m && range_m <= kLongestReach * scale_m))) {
    return reply_of(
        wire::Reply::OUT_OF_RANGE,
        fmt::format("instrumented range: {} m is out of range; allowed: 0, or {} to {} m", range_m,
                    kShortestReach * scale_m, kLongestReach * scale_m));
  }
  view->want_reach({range_m, scale});
  reach_version_.fetch_add(1, std::memory_order_relaxed);
  return reply_of(wire::Reply::OK);
}

wire::Settings RelayedHost::settings(std::uint32_t radar, std::uint32_t view) const {
  const RelayedViewList& views = *views_.at(radar);
  const RelayedViewPtr found = views.find(view);
  // One that has just ended: as the shared one.
  wire::Settings settings = state_.settings(radar, (found ? found : views.find(0))->source);
  settings.set_view(view);
  if (found) found->tell_reach(settings);
  return settings;
}

wire::OwnShip RelayedHost::own_ship(std::uint32_t radar) const {
  wire::OwnShip ship = state_.own_ship(radar, place(), present_utc());
  if (ship.name().empty()) ship.set_name(info(radar).own_ship());
  return ship;
}

std::uint64_t RelayedHost::settings_version() const {
  return state_.settings_version() + reach_version_.load(std::memory_order_relaxed);
}

void RelayedHost::tell_status(wire::Status& status) const {
  const auto up = std::chrono::steady_clock::now() - made_;
  status.set_uptime_s(std::chrono::duration<double>(up).count());
  status.set_resident_mib(resident_mib());
  *status.mutable_world() = world();
  for (std::uint32_t radar = 0; radar < views_.size(); ++radar) {
    if (!views_[radar]) continue;
    wire::RadarStatus& about = *status.add_radars();
    about.set_radar(radar);
    about.set_name(info(radar).name());
    *about.mutable_settings() = settings(radar, 0);
    *about.mutable_own_ship() = own_ship(radar);
    const auto views = views_[radar]->get();
    for (const RelayedViewPtr& view : *views) {
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
}

}  // namespace skerry::server
