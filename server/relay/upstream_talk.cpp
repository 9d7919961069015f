#include "server/relay/upstream_talk.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <type_traits>
#include <utility>

#include "server/relay/upstream_link.hpp"

namespace skerry::server {
namespace {

constexpr std::size_t kMostCharts = 16;       // that wait
constexpr std::size_t kMostUnanswered = 512;  // orders
constexpr std::uint32_t kTruthHz = 4;
constexpr std::uint32_t kOwnShipHz = 10;  // consoles here may want as many

bool asks_for_chart(const wire::ClientMessage& message) {
  return message.has_get_coastline() || message.has_get_chart_objects();
}

}  // namespace

UpstreamTalk::UpstreamTalk(UpstreamHost& host, std::string token, SteadyTime now,
                           std::optional<std::uint32_t> thin)
    : host_(host),
      token_(std::move(token)),
      thin_(thin, now),
      now_(now),
      pinged_(now - kPingEvery),
      truth_refused_(now - kTruthRetry) {
  for (std::uint32_t radar = 0; radar < host.radar_count(); ++radar) {
    links_.push_back(std::make_unique<Link>(
        *this, ++last_id_, Purpose::shared,
        LineWish{.radar = radar, .own_ship_hz = kOwnShipHz, .thin = thin_.level()}));
  }
  host.meter().set_thin(thin_.level());
}

UpstreamTalk::~UpstreamTalk() = default;

UpstreamTalk::Link* UpstreamTalk::find(LineId id) {
  const auto found = std::find_if(links_.begin(), links_.end(),
                                  [&](const LinkPtr& link) { return link->id == id; });
  return found == links_.end() ? nullptr : found->get();
}

bool UpstreamTalk::is_there() const {
  const Link& first = *links_.front();
  return first.line && first.line->is_subscribed();
}

std::vector<UpstreamTalk::LineId> UpstreamTalk::to_begin(SteadyTime now) {
  now_ = now;
  std::vector<LineId> begin;
  for (const LinkPtr& link : links_) {
    if (link->under_way || now < link->next_try) continue;
    if (link.get() != &main() && !is_there()) continue;
    if (link.get() != &main() && !host_.is_relayed(link->wish.radar)) continue;
    link->under_way = true;
    begin.push_back(link->id);
  }
  return begin;
}

void UpstreamTalk::connected(LineId id, SteadyTime now) {
  now_ = now;
  if (Link* link = find(id)) {
    link->line.emplace(*link, link->wish, token_, host_.config().upstream);
    link->line->tick(now);
  }
}

void UpstreamTalk::take(LineId id, std::span<const std::uint8_t> bytes, SteadyTime now) {
  now_ = now;
  Link* link = find(id);
  if (link == nullptr || !link->line) return;
  const auto over = link->line->take(bytes, now);
  if (link->is_unwanted) return drop(id);
  if (over) end(*link, *over, now);
}

void UpstreamTalk::flush(LineId id, SteadyTime now) {
  now_ = now;
  Link* link = find(id);
  if (link != nullptr && link->line) link->line->flush();
}

Bytes UpstreamTalk::take_output(LineId id) {
  Link* link = find(id);
  return link == nullptr || !link->line ? Bytes() : link->line->take_output();
}

void UpstreamTalk::ended(LineId id, const std::string& why, SteadyTime now) {
  now_ = now;
  if (Link* link = find(id)) after_end(*link, {LineEnd::Kind::lost, why}, now);
}

void UpstreamTalk::end(Link& link, const LineEnd& why, SteadyTime now) {
  to_end_.push_back(link.id);
  after_end(link, why, now);
}

void UpstreamTalk::after_end(Link& link, const LineEnd& why, SteadyTime now) {
  if (link.line) {
    if (link.line->is_subscribed()) {
      link.short_lives = now - link.subscribed_at < kProven ? link.short_lives + 1 : 0;
    }
    link.line->flush();
    link.line->end(why.text);
    link.end_line();
  }
  // Its number may be somebody else's view by the time that the line is there again.
  if (link.view) host_.renumber_view(link.wish.radar, *link.view, std::nullopt);
  link.under_way = false;
  link.next_try = now + link.pause();
  ++link.failures;
  if (&link == &main()) return tell_gone(why, now);
  if (why.kind == LineEnd::Kind::no_view && link.what == Purpose::own_view) {
    link.wish.view = 0;
    link.wish.new_view = true;
    link.next_try = now;
  }
  if (link.opening) {
    link.refuse_opening(why.text);
    return drop(link.id);
  }
  if (link.what == Purpose::truth && why.kind == LineEnd::Kind::refused) {
    truth_refused_ = now;
    if (!std::exchange(truth_told_, true)) {
      spdlog::warn("relay: the exercise is not relayed: {}", why.text);
    }
    return drop(link.id);
  }
  if (why.kind != LineEnd::Kind::lost && link.failures == 1) {
    spdlog::warn("relay: radar {} view {}: {}", link.wish.radar, link.view.value_or(0), why.text);
  }
}

void UpstreamTalk::tell_gone(const LineEnd& why, SteadyTime now) {
  host_.set_gone(why.text);
  if (!gone_since_) gone_since_ = now;
  if (std::exchange(told_, why.text) == why.text) return;
  spdlog::warn("relay: {}; {}trying again at least every {} s", why.text,
               was_there_ ? "consoles stay, without a picture; " : "",
               std::chrono::duration_cast<std::chrono::seconds>(kLastRetry).count());
}

void UpstreamTalk::tell_back(SteadyTime now) {
  end_strays(now);
  host_.set_connected();
  const std::string& upstream = host_.config().upstream;
  if (was_there_ && gone_since_) {
    spdlog::info("relay: {} is back after {:.1f} s", upstream,
                 std::chrono::duration<double>(now - *gone_since_).count());
  } else {
    spdlog::info("relay: connected to {}", upstream);
  }
  was_there_ = true;
  gone_since_.reset();
  told_.clear();
  pinged_ = now - kPingEvery;
  for (const LinkPtr& link : links_) link->next_try = now;
}

void UpstreamTalk::end_strays(SteadyTime now) {
  std::vector<LineId> strays;
  for (const LinkPtr& link : links_) {
    if (link->is_stray()) strays.push_back(link->id);
  }
  for (const LineId id : strays) {
    if (Link* link = find(id)) {
      end(*link, {LineEnd::Kind::lost, "another run of the server than radar 0's"}, now);
    }
  }
}

void UpstreamTalk::drop(LineId id) {
  std::erase_if(links_, [&](const LinkPtr& link) {
    if (link->id != id) return false;
    link->refuse_opening("the view has ended meanwhile");
    if (link->line) link->line->end("the view has ended meanwhile");
    if (link->under_way) to_end_.push_back(id);
    return true;
  });
}

void UpstreamTalk::take_orders(SteadyTime now) {
  now_ = now;
  for (UpstreamOrder& order : host_.orders().take()) {
    std::visit(
        [&](auto& each) {
          if constexpr (std::is_same_v<std::decay_t<decltype(each)>, AskUp>) {
            carry_out(each, now);
          } else {
            carry_out(each);
          }
        },
        order);
  }
}

void UpstreamTalk::carry_out(AskUp& order, SteadyTime now) {
  if (asks_for_chart(order.message) && charts_.size() < kMostCharts) {
    charts_.push_back(std::move(order));
    return begin_chart(now);
  }
  if (!is_there()) {
    return order.answered(reply_of(wire::Reply::REFUSED, told_.empty() ? "no connection" : told_),
                          nullptr);
  }
  if (main().line->unanswered() >= kMostUnanswered || asks_for_chart(order.message)) {
    return order.answered(reply_of(wire::Reply::REFUSED, "too many requests at once; try again"),
                          nullptr);
  }
  main().line->ask(std::move(order.message), now, order.patience, std::move(order.answered),
                   std::move(order.late));
}

void UpstreamTalk::begin_chart(SteadyTime now) {
  while (!chart_asked_ && !charts_.empty()) {
    AskUp order = std::move(charts_.front());
    charts_.pop_front();
    if (!is_there()) {
      order.answered(reply_of(wire::Reply::REFUSED, told_), nullptr);
      continue;
    }
    chart_asked_ = true;
    main().line->ask(std::move(order.message), now, order.patience,
                     [this, answered = std::move(order.answered)](const auto& reply, auto* told) {
                       chart_asked_ = false;
                       answered(reply, told);
                     });
  }
}

void UpstreamTalk::carry_out(OpenUp& order) {
  auto link = std::make_unique<Link>(
      *this, ++last_id_, Purpose::own_view,
      LineWish{
          .radar = order.radar, .view = order.like_there, .new_view = true, .thin = thin_.level()});
  link->opening = std::move(order);
  link->open_until = now_ + kOpenPatience;
  links_.push_back(std::move(link));
}

void UpstreamTalk::carry_out(const CloseUp& order) {
  for (const LinkPtr& link : links_) {
    if (link->what != Purpose::own_view || link->wish.radar != order.radar ||
        link->view != order.view) {
      continue;
    }
    return drop(link->id);
  }
}

void UpstreamTalk::tick(SteadyTime now) {
  now_ = now;
  std::vector<LineId> ids;
  for (const LinkPtr& link : links_) ids.push_back(link->id);
  for (const LineId id : ids) {
    Link* link = find(id);
    if (link == nullptr) continue;
    if (link->opening && now > link->open_until) {
      link->refuse_opening(
          fmt::format("{} has not opened a view in time; try again", host_.config().upstream));
      drop(id);
      continue;
    }
    link->count(now);
    if (!link->line) continue;
    const auto over = link->line->tick(now);
    link = find(id);
    if (over && link != nullptr) end(*link, *over, now);
  }
  begin_chart(now);
  ping(now);
  look_at_truth(now);
  look_at_thin(now);
  host_.done().tell_late(now);
}

void UpstreamTalk::ping(SteadyTime now) {
  if (!is_there() || !has_identity_ || now - pinged_ < kPingEvery) return;
  pinged_ = now;
  wire::ClientMessage message;
  message.mutable_get_hops();
  main().line->ask(std::move(message), now, kOpenPatience,
                   [this, now](const auto& reply, auto* told) {
                     if (reply.code() != wire::Reply::OK) return;
                     host_.meter().round_trip(now_ - now);
                     if (told != nullptr && told->has_hops())
                       host_.meter().set_before(told->hops());
                   });
}

void UpstreamTalk::look_at_truth(SteadyTime now) {
  const auto link = std::find_if(links_.begin(), links_.end(),
                                 [](const LinkPtr& each) { return each->what == Purpose::truth; });
  const bool wanted = is_there() && host_.wants_truth(now);
  if (link != links_.end()) {
    if (!wanted) drop((*link)->id);
  } else if (wanted && now - truth_refused_ >= kTruthRetry) {
    links_.push_back(
        std::make_unique<Link>(*this, ++last_id_, Purpose::truth,
                               LineWish{.radar = 0, .spokes = false, .exercise_hz = kTruthHz}));
  }
}

void UpstreamTalk::look_at_thin(SteadyTime now) {
  ThinChoice::Came came;
  for (const LinkPtr& link : links_) {
    const ThinChoice::Came of_link = std::exchange(link->came, {});
    came.spokes += of_link.spokes;
    came.lost += of_link.lost;
    came.bytes += of_link.bytes;
    came.made += of_link.made;
    came.took += of_link.took;
  }
  // A playback's pace is its own.
  if (host_.playback() != nullptr) came.took = Duration{0};
  const std::uint32_t before = thin_.level();
  if (!is_there() || !thin_.look(came, now)) return;
  spdlog::info("relay: {}: thin spokes of level {}, {} before",
               thin_.level() > before ? "the link carries less than there is"
                                      : "the link has carried all for a while",
               thin_.level(), before);
  host_.meter().set_thin(thin_.level());
  for (const LinkPtr& link : links_) {
    if (link->wish.spokes) link->change_thin(thin_.level());
  }
}

void UpstreamTalk::stop() {
  host_.orders().close();
  const std::string why = "this relay ends";
  for (UpstreamOrder& order : host_.orders().take()) {
    if (auto* ask = std::get_if<AskUp>(&order)) {
      ask->answered(reply_of(wire::Reply::REFUSED, why), nullptr);
    } else if (auto* open = std::get_if<OpenUp>(&order)) {
      open->later(Failure<std::string>{why});
    }
  }
  for (const LinkPtr& link : links_) {
    link->refuse_opening(why);
    if (link->line) link->line->end(why);
  }
  for (const AskUp& chart : std::exchange(charts_, {})) {
    chart.answered(reply_of(wire::Reply::REFUSED, why), nullptr);
  }
}

}  // namespace skerry::server
