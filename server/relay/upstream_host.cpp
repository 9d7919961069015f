#include "server/relay/upstream_host.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "protocol/wire/schema.hpp"
#include "server/core/chart_texts.hpp"
#include "server/relay/radars_told.hpp"
#include "server/relayed/sendable_text.hpp"

namespace skerry::server {
namespace {

constexpr std::size_t kRelayRing = 4096;  // sectors, which are as large as they came
// Numbers that the other server would give after years.
constexpr std::uint32_t kFirstOwnView = 65'000;
constexpr std::chrono::seconds kChartPatience{30};
const std::string kOpenedAgain =
    "the view is being opened again at the server behind this relay; try again in a moment";

RelayedHost::RadarViews views_for(const std::vector<wire::RadarInfo>& radars) {
  constexpr double kHeldSeconds = 0.5, kHeaderBytes = 100.0;
  constexpr double kLeastHeld = 256.0 * 1024, kMostHeld = 8.0 * 1024 * 1024;
  RelayedHost::RadarViews views;
  for (const wire::RadarInfo& radar : radars) {
    views.push_back(std::make_unique<RelayedViewList>(std::vector<std::uint32_t>{0}, 0, kRelayRing,
                                                      kFirstOwnView));
    const double rate = radar.spokes_per_turn() * radar.rpm() / 60.0 *
                        (radar.cells() * radar.bits() / 8.0 + kHeaderBytes);
    views.back()->hold(
        static_cast<std::size_t>(std::clamp(rate * kHeldSeconds, kLeastHeld, kMostHeld)));
  }
  return views;
}

const wire::Hello& relayable(const wire::Hello& hello, const UpstreamHost::Config& config) {
  if (const auto why = why_not_relayed(hello, config.identity, config.upstream)) {
    throw std::runtime_error("--relay: " + *why);
  }
  return hello;
}

// The answer to who does not wait for one.
Answered told_in_log(const std::string& upstream, const std::string& origin) {
  return [upstream, origin](const wire::Reply& reply) {
    if (reply.code() == wire::Reply::OK) return;
    spdlog::info("{} has refused {}: {}", upstream, origin, reply.text());
  };
}

// A newer server may know them, and this one does not know whose right they are.
template <typename Message>
bool has_unknown_fields(Message message) {
  const std::size_t size = message.ByteSizeLong();
  message.DiscardUnknownFields();
  return message.ByteSizeLong() != size;
}

// A reply that came without a chart.  One of this relay itself, which answers no request of the
// other server's, means that it could not be asked in time.
NoChart why_no_chart(const wire::Reply& reply) {
  const bool is_own = reply.request() == 0;
  const bool is_busy = reply.text() == kChartBusy || reply.text() == kCoastlineAsked ||
                       reply.text() == kChartObjectsAsked;
  return is_own || is_busy ? NoChart::busy : NoChart::none_here;
}

wire::Reply refusal_of_unknown() {
  return reply_of(wire::Reply::UNKNOWN,
                  "it has a field that this relay does not know; ask the other server itself");
}

}  // namespace

UpstreamHost::UpstreamHost(const wire::Hello& hello, Config config)
    : RelayedHost(views_for(radars_of(relayable(hello, config)))),
      config_(std::move(config)),
      is_playback_(hello.playback()),
      done_(config_.upstream),
      meter_(config_.upstream, std::chrono::steady_clock::now()),
      hello_(hello),
      radars_(radars_of(hello)),
      relayed_(radars_.size(), true),
      gone_(fmt::format("no connection to {} yet", config_.upstream)) {}

UtcTime UpstreamHost::place() const {
  return std::chrono::time_point_cast<Duration>(std::chrono::system_clock::now());
}

wire::RadarInfo UpstreamHost::info(std::uint32_t radar) const {
  const std::lock_guard lock(mutex_);
  return radars_.at(radar);
}

std::string UpstreamHost::ship_of(std::uint32_t radar) const {
  const std::lock_guard lock(mutex_);
  return radars_.at(radar).own_ship();
}

std::optional<std::string> UpstreamHost::why_gone() const {
  const std::lock_guard lock(mutex_);
  return gone_;
}

bool UpstreamHost::is_own_view(std::uint32_t radar, std::uint32_t view) const {
  const RelayedViewPtr found = views_.at(radar)->find(view);
  return found && found->opened;
}

wire::Hello UpstreamHost::hello() const {
  wire::Hello hello;
  hello.set_protocol_version(1);
  hello.set_server(config_.server);
  for (const double nm : RangeScale::kNauticalMiles) hello.add_range_scales_nm(nm);
  const std::lock_guard lock(mutex_);
  hello.set_scenario(sendable(hello_.scenario(), 256));
  for (const wire::RadarInfo& radar : radars_) *hello.add_radars() = radar;
  wire::Hop& nearest = *hello.add_relays();
  nearest.set_identity(sendable(hello_.identity(), 64));
  nearest.set_server(sendable(hello_.server(), 64));
  for (const wire::Hop& hop : hello_.relays()) {
    wire::Hop& further = *hello.add_relays();
    further.set_identity(sendable(hop.identity(), 64));
    further.set_server(sendable(hop.server(), 64));
  }
  return hello;
}

std::optional<RadarHost::OpenedView> UpstreamHost::open_view_or_ask(
    std::uint32_t radar, std::uint32_t like, const std::function<void(VideoChannel&)>& prepare,
    const ViewOpened& later) {
  if (auto gone = why_gone()) return OpenedView(Failure{*std::move(gone)});
  OpenUp order{.radar = radar, .like = like, .prepare = prepare, .later = later};
  {
    const std::lock_guard lock(mutex_);
    const auto there = number_there(radar, like);
    if (!there) return OpenedView(Failure<std::string>{kOpenedAgain});
    order.like_there = *there;
  }
  if (orders_.add(std::move(order))) return std::nullopt;
  return OpenedView(Failure<std::string>{"too many requests at once; try again"});
}

void UpstreamHost::close_view(std::uint32_t radar, std::uint32_t view) {
  {
    const std::lock_guard lock(mutex_);
    if (views_there_.erase({radar, view}) == 0) return RelayedHost::close_view(radar, view);
  }
  views_.at(radar)->take_away(view);
  state_.forget(radar, view);
  views_changed();
  orders_.add(CloseUp{radar, view});
}

wire::OwnShip UpstreamHost::own_ship(std::uint32_t radar) const {
  const std::lock_guard lock(mutex_);
  wire::OwnShip ship;
  const auto told = own_ships_.find(radar);
  if (told != own_ships_.end()) ship = told->second;
  ship.set_radar(radar);
  if (ship.name().empty()) ship.set_name(radars_.at(radar).own_ship());
  if (ship.has_con()) {
    cons_.tell(radars_.at(radar).own_ship(), hello_.you(), std::chrono::steady_clock::now(),
               *ship.mutable_con());
  }
  if (told != own_ships_.end() && !gone_ && relayed_[radar]) return ship;
  // Nobody is to steer by what is old.
  ship.set_no_position(true);
  ship.set_no_motion(true);
  ship.set_no_heading(true);
  if (gone_ || !relayed_[radar]) {
    ship.set_text(sendable("No picture: " + gone_.value_or("this radar is no longer there"), 256));
    ship.set_texts(ship.texts() + 1);
  }
  return ship;
}

wire::Status UpstreamHost::status() const {
  wire::Status status;
  status.set_server(config_.server);
  {
    const std::lock_guard lock(mutex_);
    status.set_scenario(sendable(hello_.scenario(), 256));
  }
  tell_status(status);
  status.set_scenario_s(status.world().scenario_s());
  return status;
}

std::vector<wire::HopStatus> UpstreamHost::hops() const {
  return meter_.tell(std::chrono::steady_clock::now());
}

// --- what is asked of the other server

std::optional<std::uint32_t> UpstreamHost::number_there(std::uint32_t radar,
                                                        std::uint32_t view) const {
  const auto there = views_there_.find({radar, view});
  if (there != views_there_.end()) return there->second;
  // An output's view shows the shared one.  Any other is just being added.
  return view == 0 || is_own_view(radar, view) ? std::optional(0u) : std::nullopt;
}

bool UpstreamHost::ask(wire::ClientMessage message, PassedUp done,
                       std::function<void(const wire::Reply&)> answered, AnsweredUp late) {
  meter_.asked();
  done.who = done_.who_at(done.origin);
  spdlog::debug("{} asks {} for {}", done.origin, config_.upstream, done.what);
  auto tell = [this, done = std::move(done), answered = std::move(answered)](
                  const wire::Reply& reply, wire::ServerMessage*) {
    if (reply.code() == wire::Reply::OK) {
      done_.tell(done, std::chrono::steady_clock::now());
    } else {
      meter_.refused();
    }
    answered(reply);
  };
  return orders_.add(
      AskUp{.message = std::move(message), .answered = std::move(tell), .late = std::move(late)});
}

std::optional<wire::Reply> UpstreamHost::apply_or_ask(const wire::Set& set,
                                                      const std::string& origin,
                                                      const Answered& later) {
  if (has_unknown_fields(set)) return refusal_of_unknown();
  // What names nothing that is here, and what concerns this server's own views, is answered here.
  if (find_channel(set.radar(), set.view()) == nullptr || is_own_view(set.radar(), set.view())) {
    return apply(set, origin);
  }
  if (auto gone = why_gone()) return reply_of(wire::Reply::REFUSED, *std::move(gone));
  const std::string ship = ship_of(set.radar());
  wire::ClientMessage message;
  *message.mutable_set() = set;
  message.mutable_set()->clear_token();
  {
    const std::lock_guard lock(mutex_);
    const auto there = number_there(set.radar(), set.view());
    if (!there) return reply_of(wire::Reply::REFUSED, kOpenedAgain);
    message.mutable_set()->set_view(*there);
    if (!relayed_[set.radar()]) {
      return reply_of(wire::Reply::REFUSED,
                      fmt::format("{} has no longer that radar", config_.upstream));
    }
    if (auto held = cons_.refusal(ship, set, origin)) {
      return reply_of(wire::Reply::REFUSED, *std::move(held));
    }
    cons_.asked(ship, set, origin);
  }
  const auto answered = [this, set, ship, origin](const wire::Reply& reply) {
    if (!set.has_con()) return;
    const std::lock_guard lock(mutex_);
    if (cons_.answered(ship, set, origin, reply.code() == wire::Reply::OK,
                       std::chrono::steady_clock::now())) {
      give_back_con(ship, origin);
    }
  };
  AnsweredUp late;
  if (set.con().take()) {
    late = [this, ship, origin](const wire::Reply& reply, wire::ServerMessage*) {
      if (reply.code() != wire::Reply::OK) return;
      const std::lock_guard lock(mutex_);
      if (cons_.granted_late(ship)) give_back_con(ship, origin);
    };
  }
  const bool taken = ask(
      message, {message.set().ShortDebugString(), origin, {}, knob_of(set)},
      [answered, later](const wire::Reply& reply) {
        answered(reply);
        later(reply_of(reply.code(), sendable(reply.text(), 1000)));
      },
      std::move(late));
  if (taken) return std::nullopt;
  answered(reply_of(wire::Reply::REFUSED));
  return reply_of(wire::Reply::REFUSED, "too many requests at once; try again");
}

// For those who cannot wait: emulated displays, Signal K.  What can be told without the other
// server is; what that refuses is in the log and counted.
wire::Reply UpstreamHost::change(const wire::Set& set, const std::string& origin) {
  const wire::Settings now = settings(set.radar(), set.view());
  std::vector<const wire::FieldDescriptor*> given;
  set.GetReflection()->ListFields(set, &given);
  for (const wire::FieldDescriptor* field : given) {
    const auto& locked = now.locked();
    if (!set.instructor() &&
        std::find(locked.begin(), locked.end(), field->name()) != locked.end()) {
      return reply_of(wire::Reply::REFUSED,
                      fmt::format("{}: locked by the instructor", wire::spoken_name(*field)));
    }
    const auto* control = wire::Controls::descriptor()->FindFieldByName(field->name());
    if (control == nullptr || control->message_type() != nullptr) continue;
    const auto value = wire::value_of(set, *control);
    if (!value || wire::is_allowed(*control, *value)) continue;
    return reply_of(wire::Reply::OUT_OF_RANGE,
                    fmt::format("{}: {} is out of range; allowed: {}", wire::spoken_name(*control),
                                *value, wire::allowed_by(wire::rule_of(*control))));
  }
  wire::Set wanted = set;
  if (is_own_view(set.radar(), set.view())) wanted.set_view(0);
  auto answer = apply_or_ask(wanted, origin, told_in_log(config_.upstream, origin));
  return answer ? *std::move(answer) : reply_of(wire::Reply::OK);
}

void UpstreamHost::leave(const std::string& origin) {
  const std::lock_guard lock(mutex_);
  for (const std::string& ship : cons_.leave(origin)) give_back_con(ship, origin);
}

void UpstreamHost::give_back_con(const std::string& ship, const std::string& origin) {
  const auto radar = std::find_if(radars_.begin(), radars_.end(),
                                  [&](const auto& each) { return each.own_ship() == ship; });
  if (radar == radars_.end() || gone_) return;
  wire::ClientMessage message;
  message.mutable_set()->set_radar(radar->radar());
  message.mutable_set()->mutable_con()->set_release(true);
  ask(message, {message.set().ShortDebugString(), origin, {}, {}}, [](const wire::Reply&) {});
}

wire::Reply UpstreamHost::control(const wire::Playback& playback, const std::string& origin) {
  auto answer = control_or_ask(playback, origin, told_in_log(config_.upstream, origin));
  return answer ? *std::move(answer) : reply_of(wire::Reply::OK);
}

std::optional<wire::Reply> UpstreamHost::control_or_ask(const wire::Playback& playback,
                                                        const std::string& origin,
                                                        const Answered& later) {
  if (has_unknown_fields(playback)) return refusal_of_unknown();
  if (auto gone = why_gone()) return reply_of(wire::Reply::REFUSED, *std::move(gone));
  wire::ClientMessage message;
  *message.mutable_playback() = playback;
  message.mutable_playback()->clear_token();
  const bool taken =
      ask(message, {"playback { " + message.playback().ShortDebugString() + " }", origin, {}, {}},
          [later](const wire::Reply& reply) {
            later(reply_of(reply.code(), sendable(reply.text(), 1000)));
          });
  if (taken) return std::nullopt;
  return reply_of(wire::Reply::REFUSED, "too many requests at once; try again");
}

bool UpstreamHost::has_chart() const {
  const std::lock_guard lock(mutex_);
  return hello_.has_chart();
}

void UpstreamHost::find_coastline(const wire::GetCoastline& place, CoastlineDone done) {
  if (why_gone()) return done(NoChart::busy);
  AskUp order{
      .message = {}, .patience = kChartPatience, .answered = [done](const auto& reply, auto* told) {
        if (told != nullptr && told->has_coastline()) {
          return done(std::move(*told->mutable_coastline()));
        }
        done(why_no_chart(reply));
      }};
  *order.message.mutable_get_coastline() = place;
  if (!orders_.add(std::move(order))) done(NoChart::busy);
}

void UpstreamHost::find_chart_objects(const wire::GetChartObjects& place, ChartObjectsDone done) {
  if (why_gone()) return done(NoChart::busy);
  AskUp order{
      .message = {}, .patience = kChartPatience, .answered = [done](const auto& reply, auto* told) {
        if (told != nullptr && told->has_chart_objects()) {
          return done(std::move(*told->mutable_chart_objects()));
        }
        done(why_no_chart(reply));
      }};
  *order.message.mutable_get_chart_objects() = place;
  if (!orders_.add(std::move(order))) done(NoChart::busy);
}

}  // namespace skerry::server
