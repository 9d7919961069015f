// What a client of the native protocol subscribes to, and what is answered later.
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "protocol/thin/thin_shape.hpp"
#include "server/net/common/encoders.hpp"
#include "server/net/common/for_strangers.hpp"
#include "server/net/native/native_session.hpp"

namespace skerry::server {

void NativeSession::subscribe(std::uint32_t request, const wire::Subscribe& subscribe) {
  if (subscribe.own_ship_hz() > kOwnShipMostHz) {
    return reply(request, wire::Reply::OUT_OF_RANGE,
                 fmt::format("own_ship_hz: {} is out of range; allowed: {} to {}",
                             subscribe.own_ship_hz(), kOwnShipLeastHz, kOwnShipMostHz));
  }
  if (subscribe.exercise_hz() > kExerciseMostHz) {
    return reply(request, wire::Reply::OUT_OF_RANGE,
                 fmt::format("exercise_hz: {} is out of range; allowed: 0 to {}",
                             subscribe.exercise_hz(), kExerciseMostHz));
  }
  if (subscribe.targets_hz() > kTargetsMostHz) {
    return reply(request, wire::Reply::OUT_OF_RANGE,
                 fmt::format("targets_hz: {} is out of range; allowed: 0 to {}",
                             subscribe.targets_hz(), kTargetsMostHz));
  }
  if (subscribe.thin() > kThinLevels) {
    return reply(
        request, wire::Reply::OUT_OF_RANGE,
        fmt::format("thin: {} is out of range; allowed: 0 to {}", subscribe.thin(), kThinLevels));
  }
  if (context_.find_feed(subscribe.radar(), subscribe.view(), native_format(subscribe.thin())) ==
      nullptr) {
    return reply(
        request, wire::Reply::UNKNOWN,
        fmt::format("no radar {} with view {}; Hello lists the radars, view 0 is always there",
                    subscribe.radar(), subscribe.view()));
  }
  if (!subscribe.new_view()) return subscribe_to(request, subscribe, subscribe.view());
  answer_pending_ = true;
  const auto opened =
      context_.open_view(subscribe.radar(), subscribe.view(), slot_->peer(),
                         when_answered<RadarHost::OpenedView>(
                             [request, subscribe](NativeSession& self, const auto& view) {
                               self.subscribe_to(request, subscribe, view);
                             }));
  if (!opened) return;
  answer_pending_ = false;
  subscribe_to(request, subscribe, *opened);
}

void NativeSession::subscribe_to(std::uint32_t request, const wire::Subscribe& subscribe,
                                 const RadarHost::OpenedView& view) {
  if (!view) {
    context_.complain("view refused", client_->peer + ": " + view.error());
    return reply(request, wire::Reply::REFUSED, view.error());
  }
  SpokeFeed* const feed =
      context_.find_feed(subscribe.radar(), *view, native_format(subscribe.thin()));
  if (feed == nullptr) {
    return reply(request, wire::Reply::UNKNOWN,
                 fmt::format("view {} of radar {} has ended meanwhile", *view, subscribe.radar()));
  }
  unsubscribe();
  subscribed_ = asked_;
  feed_ = feed;
  takes_spokes_ = !subscribe.no_spokes();
  if (takes_spokes_) {
    cursor_ = feed_->add(*this);
  } else {
    feed_->add_listener(*this);
  }
  own_ship_hz_ = std::max(subscribe.own_ship_hz(), kOwnShipLeastHz);
  exercise_hz_ = subscribe.exercise_hz();
  targets_hz_ = subscribe.targets_hz();
  if (TargetPort* port = context_.host.targets(); port != nullptr && targets_hz_ > 0) {
    wanted_targets_ = port->want(subscribe.radar(), *view);
  }
  client_->radar.store(subscribe.radar(), std::memory_order_relaxed);
  client_->view.store(*view, std::memory_order_relaxed);
  spoke_buffer_ = takes_spokes_ ? context_.send_buffer_for(subscribe.radar(), subscribe.thin()) : 0;
  limit_send_buffer();
  reply(request, wire::Reply::OK, "", *view);
  RecordingNews::Frames recordings = context_.recording_frames();
  RecordingNews::Pair& recording = is_trusted() ? recordings.whole : recordings.for_strangers;
  news_ = {context_.settings_frame(subscribe.radar(), *view),
           context_.own_ship_frame(subscribe.radar()),
           context_.world_frame(),
           std::move(recording.recorder),
           std::move(recording.playback),
           exercise_hz_ > 0 ? context_.exercise_frame() : nullptr,
           targets_hz_ > 0 ? context_.targets_frame(subscribe.radar(), *view) : nullptr};
  spdlog::debug("{} {} subscribed to radar {} view {}", client_->transport, client_->peer,
                subscribe.radar(), *view);
}

template <typename Answer, typename Then>
std::function<void(Answer)> NativeSession::when_answered(Then then) {
  // Held: nothing is read meanwhile.
  return [self = shared_from_this(), then = std::move(then)](const Answer& answer) {
    self->answer_pending_ = false;
    // What it was granted nobody has.
    if (self->closed_) return self->context_.host.leave(self->origin());
    if (!self->failed_) then(*self, answer);
    self->process();
  };
}

void NativeSession::set(std::uint32_t request, const wire::Set& set) {
  const AuditedRequest audited(context_.config.audit, origin(), who_);
  answer_pending_ = true;
  auto answer = context_.apply_or_ask(
      set, origin(), when_answered<wire::Reply>([request](NativeSession& self, const auto& later) {
        self.reply(request, later);
        self.context_.tell_settings();
      }));
  if (!answer) return;
  answer_pending_ = false;
  reply(request, *std::move(answer));
  context_.tell_settings();
}

void NativeSession::control_playback(std::uint32_t request, const wire::Playback& playback) {
  PlaybackPort* port = context_.host.playback();
  if (port == nullptr) {
    return reply(request, wire::Reply::REFUSED,
                 "nothing is played back here; skerryd --play FILE does");
  }
  answer_pending_ = true;
  auto answer = port->control_or_ask(
      playback, origin(),
      [io = &context_.io,
       answered = when_answered<wire::Reply>([request](NativeSession& self, const auto& later) {
         self.reply(request, later);
       })](wire::Reply later) {
        asio::post(*io, [answered, later = std::move(later)] { answered(later); });
      });
  if (!answer) return;
  answer_pending_ = false;
  reply(request, *std::move(answer));
}

void NativeSession::get_hops(std::uint32_t request) {
  wire::ServerMessage message;
  for (wire::HopStatus& hop : context_.host.hops()) {
    if (!is_trusted()) leave_out_for_strangers(hop);
    *message.mutable_hops()->add_hops() = std::move(hop);
  }
  if (!message.has_hops()) message.mutable_hops();
  send(message);
  reply(request, wire::Reply::OK, "");
}

}  // namespace skerry::server
