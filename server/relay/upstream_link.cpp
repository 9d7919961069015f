#include "server/relay/upstream_link.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>

#include "protocol/wire/schema.hpp"

namespace skerry::server {

std::optional<LineEnd> UpstreamTalk::Link::on_hello(const wire::Hello& hello, LineWish& wanted) {
  if (this == &talk_.main()) {
    if (auto why = talk_.host_.take_hello(hello)) {
      return LineEnd{LineEnd::Kind::refused, *std::move(why)};
    }
    talk_.has_identity_ = !hello.identity().empty();
  } else if (hello.identity() != talk_.main().greeted_by_) {
    return LineEnd{LineEnd::Kind::lost, "another run of the server than radar 0's"};
  }
  if (greeted_by_ != hello.identity()) number_anew();
  greeted_by_ = hello.identity();
  // A number may be somebody else's view by now.
  if (what == Purpose::own_view && view && (identity.empty() || identity != greeted_by_)) {
    wish.view = 0;
    wish.new_view = true;
  }
  wanted = wish;
  return std::nullopt;
}

std::uint32_t UpstreamTalk::Link::on_subscribed(std::uint32_t there) {
  failures = 0;
  subscribed_at = talk_.now_;
  if (this == &talk_.main()) talk_.tell_back(talk_.now_);
  joins_ = wish.thin != 0 || shift_ != 0;
  if (line->thin() != wish.thin) change_thin(wish.thin);
  if (what != Purpose::own_view) return 0;
  const bool is_new = wish.new_view;
  if (is_new) number_anew();
  wish.view = there;
  wish.new_view = false;
  identity = greeted_by_;
  if (opening) {
    view = talk_.host_.add_view(wish.radar, there, opening->like, opening->prepare);
    const OpenUp order = *std::exchange(opening, std::nullopt);
    if (!view) {
      order.later(Failure<std::string>{"this relay has as many views as it may"});
      is_unwanted = true;
      return there;
    }
    order.later(*view);
    return *view;
  }
  talk_.host_.renumber_view(wish.radar, *view, there);
  if (is_new) {
    line->ask(settings_again(), talk_.now_, kOpenPatience, [this](const auto& reply, auto*) {
      if (reply.code() == wire::Reply::OK) return;
      spdlog::warn("relay: view {} of radar {} has not its settings again: {}", *view, wish.radar,
                   reply.text());
    });
  }
  return *view;
}

// As they were when the view was there last.
wire::ClientMessage UpstreamTalk::Link::settings_again() const {
  const wire::Settings settings = talk_.host_.settings(wish.radar, *view);
  wire::ClientMessage message;
  wire::Set& set = *message.mutable_set();
  set.set_radar(wish.radar);
  set.set_view(wish.view);
  for (const wire::FieldDescriptor* control : wire::fields_of(*wire::Controls::descriptor())) {
    const auto& about = wire::control_of(*control);
    const auto value = wire::value_of(settings, *control);
    if (about.scope() == config::Control::VIEW && value) wire::put_value(set, *control, *value);
  }
  return message;
}

void UpstreamTalk::Link::on_spokes(SpokeBatch::Spokes spokes) {
  for (const SpokePtr& spoke : spokes.sector.spokes) losses_.take(spoke->header.sequence);
  const std::uint64_t first = spokes.sector.spokes.front()->header.sequence;
  if (std::exchange(joins_, false) && last_number_) shift_ = *last_number_ + 1 - first;
  if (shift_ != 0) spokes = renumbered(spokes, shift_);
  const SpokeHeader& last = spokes.sector.spokes.back()->header;
  last_number_ = last.sequence;
  note_pace(last.scenario_time);
  // A radar that has become another ship's is not shown to those who may see the former.
  if (!talk_.host_.is_relayed(wish.radar)) return;
  talk_.host_.publish(wish.radar, view.value_or(0), spokes);
}

void UpstreamTalk::Link::note_pace(ScenarioTime made) {
  const Paced before =
      std::exchange(paced_, Paced{talk_.now_, made}).value_or(Paced{talk_.now_, made});
  const Duration step = made - before.made;
  // Neither a gap nor another clock; and a pause, as in standby, is none of the link's.
  if (step <= Duration{0} || step > std::chrono::milliseconds(500)) return;
  came.made += step;
  came.took += talk_.now_ - before.came;
}

void UpstreamTalk::Link::on_news(wire::ServerMessage& message) {
  // What view 0 brings as well.
  const bool is_main = this == &talk_.main();
  if (what == Purpose::own_view && !message.has_settings()) return;
  if (what == Purpose::truth && !message.has_exercise()) return;
  if (!is_main && (message.has_world() || message.has_playback())) return;
  if (!is_main && !talk_.host_.is_relayed(wish.radar)) return;
  talk_.host_.take(wish.radar, view.value_or(0), message);
}

void UpstreamTalk::Link::count(SteadyTime now) {
  const std::uint64_t bytes = line ? line->bytes() : 0;
  // What comes late is taken back from the lost; what was told stays told.
  const std::uint64_t lost = std::max(losses_.lost(), lost_counted_);
  const ThinChoice::Came news{losses_.received() - received_counted_, lost - lost_counted_,
                              bytes - bytes_counted_};
  talk_.host_.meter().received(news.spokes, news.lost, news.bytes, now);
  came.spokes += news.spokes;
  came.lost += news.lost;
  came.bytes += news.bytes;
  received_counted_ = losses_.received();
  lost_counted_ = lost;
  bytes_counted_ = bytes;
}

void UpstreamTalk::Link::end_line() {
  count(talk_.now_);
  line.reset();
  bytes_counted_ = 0;
}

// Of another view, or another run of the server.
void UpstreamTalk::Link::number_anew() {
  count(talk_.now_);
  losses_ = LossCounter();
  received_counted_ = lost_counted_ = 0;
}

bool UpstreamTalk::Link::is_stray() const {
  return line && !greeted_by_.empty() && greeted_by_ != talk_.main().greeted_by_;
}

std::chrono::milliseconds UpstreamTalk::Link::pause() const {
  // The first that does not last may be a cut like any other.
  const unsigned in_vain = std::max(failures, short_lives > 0 ? short_lives - 1 : 0);
  const auto doubled = kFirstRetry * (1 << std::min(in_vain, 10u));
  return std::min<std::chrono::milliseconds>(doubled, kLastRetry);
}

void UpstreamTalk::Link::change_thin(std::uint32_t level) {
  wish.thin = level;
  if (!line || !line->is_subscribed()) return;
  line->change_thin(level, talk_.now_, kThinPatience, [this](const auto& reply, auto*) {
    if (reply.code() != wire::Reply::OK) {
      spdlog::warn("relay: radar {} view {}: no thin spokes: {}", wish.radar, view.value_or(0),
                   reply.text());
      return;
    }
    number_anew();
    joins_ = true;
  });
}

void UpstreamTalk::Link::refuse_opening(const std::string& why) {
  if (!opening) return;
  const OpenUp order = *std::exchange(opening, std::nullopt);
  order.later(Failure<std::string>{why});
}

}  // namespace skerry::server
