// What a client of the native protocol asks for beside spokes and settings.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <string_view>
#include <utility>

#include "protocol/wire/schema.hpp"
#include "server/core/chart_texts.hpp"
#include "server/net/common/access_policy.hpp"
#include "server/net/native/native_session.hpp"

namespace skerry::server {
namespace {

// What is wrong with a request for a piece of the chart, all of whose fields are numbers.
std::optional<std::string> refusal_of(const google::protobuf::Message& place, const char* what) {
  for (const wire::FieldDescriptor* field : wire::fields_of(*place.GetDescriptor())) {
    const double value = place.GetReflection()->GetDouble(place, field);
    if (wire::is_allowed(*field, value)) continue;
    return fmt::format("{}: {} {} is out of range; allowed: {}", what, wire::spoken_name(*field),
                       value, wire::allowed_by(wire::rule_of(*field)));
  }
  return std::nullopt;
}

// Whether it would change something, and so costs of the peer's budget.
bool is_change(const wire::ClientMessage& message) {
  switch (message.kind_case()) {
    case wire::ClientMessage::kSet:
    case wire::ClientMessage::kTargetOrder:
    case wire::ClientMessage::kRecord:
    case wire::ClientMessage::kPlayback:
      return true;
    case wire::ClientMessage::kSubscribe:
      return message.subscribe().new_view();
    case wire::ClientMessage::kClassOrder:
      return message.class_order().order_case() != wire::ClassOrder::ORDER_NOT_SET;
    default:
      return false;
  }
}

}  // namespace

template <typename Chart, typename Put>
void NativeSession::tell_chart(std::uint32_t request, ChartAnswer<Chart> chart, const Put& put) {
  if (!chart) {
    reply(request, wire::Reply::REFUSED,
          std::string(chart.why() == NoChart::busy ? kChartBusy : kNoChartHere));
  } else {
    wire::ServerMessage message;
    put(message, std::move(*chart));
    send(message);
    reply(request, wire::Reply::OK, "");
  }
  pump();
}

void NativeSession::get_coastline(std::uint32_t request, const wire::GetCoastline& place) {
  if (auto wrong = refusal_of(place, "coastline")) {
    return reply(request, wire::Reply::OUT_OF_RANGE, *std::move(wrong));
  }
  if (std::exchange(coastline_asked_, true)) {
    return reply(request, wire::Reply::REFUSED, std::string(kCoastlineAsked));
  }
  context_.host.find_coastline(place, [self = weak_from_this(), io = &context_.io,
                                       request](ChartAnswer<wire::Coastline> coastline) {
    asio::post(*io, [self, request, coastline = std::move(coastline)]() mutable {
      const auto session = self.lock();
      if (session == nullptr || session->closed_) return;
      session->coastline_asked_ = false;
      session->tell_chart(request, std::move(coastline), [](auto& message, auto&& told) {
        *message.mutable_coastline() = std::forward<decltype(told)>(told);
      });
    });
  });
}

void NativeSession::get_chart_objects(std::uint32_t request, const wire::GetChartObjects& place) {
  if (auto wrong = refusal_of(place, "chart objects")) {
    return reply(request, wire::Reply::OUT_OF_RANGE, *std::move(wrong));
  }
  if (std::exchange(chart_asked_, true)) {
    return reply(request, wire::Reply::REFUSED, std::string(kChartObjectsAsked));
  }
  context_.host.find_chart_objects(place, [self = weak_from_this(), io = &context_.io,
                                           request](ChartAnswer<wire::ChartObjects> objects) {
    asio::post(*io, [self, request, objects = std::move(objects)]() mutable {
      const auto session = self.lock();
      if (session == nullptr || session->closed_) return;
      session->chart_asked_ = false;
      session->tell_chart(request, std::move(objects), [](auto& message, auto&& told) {
        *message.mutable_chart_objects() = std::forward<decltype(told)>(told);
      });
    });
  });
}

bool NativeSession::admits(const wire::ClientMessage& message) {
  asked_ = asked_by(message);
  const std::string& token = message.has_sign_in() ? message.sign_in().token() : asked_.token;
  if (!is_trusted() && context_.knows(slot_->peer(), token)) slot_->trust();
  // A password or code that is yet to be tried may show who she is.
  const bool shows_more = message.has_sign_in() && (!message.sign_in().password().empty() ||
                                                    !message.sign_in().class_code().empty());
  if (slot_->place() == Place::on_trial && !shows_more) {
    fail(wire::Reply::REFUSED, "refused", slot_->reason());
    return false;
  }
  const auto now = std::chrono::steady_clock::now();
  if (!is_change(message) || context_.changes.take(slot_->peer(), now)) return true;
  std::string refusal = context_.changes.refusal(slot_->peer());
  context_.complain("too many changes", client_->peer + ": " + refusal);
  reply(message.request(), wire::Reply::REFUSED, std::move(refusal));
  return false;
}

void NativeSession::check(std::chrono::steady_clock::time_point now) {
  if (closed_) return;
  const PeerLimits& limits = context_.config.limits;
  if (writing_ && !is_trusted() && now - write_began_ > limits.unread_time) {
    context_.complain(fmt::format("{} does not read", client_->transport),
                      fmt::format("{}: has taken nothing for {} s; closed", client_->peer,
                                  std::chrono::duration<double>(limits.unread_time).count()));
    return close();
  }
  if (failed_ || has_asked_) return;
  if (slot_->place() == Place::on_trial && now - began_ > limits.trial_time) {
    fail(wire::Reply::REFUSED, "refused", slot_->reason());
  } else if (now - began_ > limits.silent_time) {
    fail(wire::Reply::REFUSED, "is silent",
         fmt::format("nothing was asked for in {} s; connect when there is something to ask",
                     std::chrono::duration<double>(limits.silent_time).count()));
  } else {
    return;
  }
  pump();
}

void NativeSession::order_targets(std::uint32_t request, const wire::TargetOrder& order) {
  const AuditedRequest audited(context_.config.audit, origin(), who_);
  reply(request, context_.order(order, origin()));
}

void NativeSession::record(std::uint32_t request, const wire::Record& record) {
  RecordingPort* port = context_.host.recording();
  if (port == nullptr) return reply(request, wire::Reply::REFUSED, "this server does not record");
  reply(request, port->record(record, "console " + client_->peer));
}

void NativeSession::ask_board(const wire::ClientMessage& message) {
  const std::uint32_t request = message.request();
  BoardRequests::Answer answer;
  if (message.has_board_access()) {
    answer = boards_.access(message.board_access());
  } else if (message.has_board_stream()) {
    answer = boards_.stream(message.board_stream());
    streamed_.reset();
    if (boards_.streams()) {
      streamed_ = asked_;
      client_->radar.store(message.board_stream().radar(), std::memory_order_relaxed);
    }
    limit_send_buffer();
  } else if (message.has_board_fifo()) {
    answer = boards_.read_fifo(message.board_fifo());
  } else {
    answer = boards_.open_ring(message.board_ring());
  }
  if (answer.first) send(*answer.first);
  if (!audited_.empty() && answer.first && answer.first->has_board()) {
    const auto& results = answer.first->board().results();
    const auto failed = std::count_if(results.begin(), results.end(), [](const auto& each) {
      return each.error() != wire::BOARD_OK;
    });
    if (failed > 0) audited_ += fmt::format(" ({} of {} failed)", failed, results.size());
  }
  reply(request, answer.reply.code(), answer.reply.text());
}

}  // namespace skerry::server
