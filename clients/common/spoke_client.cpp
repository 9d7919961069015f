#include "clients/common/spoke_client.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <utility>

#include "clients/common/message_stream.hpp"
#include "protocol/wire/printable_text.hpp"
#include "protocol/wire/spoke_message.hpp"

namespace skerry::client {

class SpokeClient::Connection {
 public:
  Connection(const std::string& host, std::uint16_t port) : stream_(host, port) {}

  ClientResult<Done> open(const std::string& host, std::uint16_t port, Duration timeout);
  ClientResult<wire::Reply> subscribe(const wire::Subscribe& request, Duration timeout);
  ClientResult<std::optional<ClientEvent>> receive(Duration timeout);
  // Sends it and waits for its reply; `kind` names it.
  ClientResult<wire::Reply> ask(wire::ClientMessage message, const char* kind, Duration timeout);
  ClientResult<wire::Status> get_status(Duration timeout);
  ClientResult<wire::ClassList> order_class(const wire::ClassOrder& order, Duration timeout);

  const wire::Hello& hello() const { return hello_; }
  const std::string& name() const { return stream_.name(); }
  const LossCounter& losses() const { return losses_; }

 private:
  ClientResult<Done> send(wire::ClientMessage& message, Deadline deadline);
  // The OK reply to `request`, which was of that kind.
  ClientResult<wire::Reply> await_reply(std::uint32_t request, const char* kind, Deadline deadline);
  ClientResult<std::optional<ClientEvent>> as_event(wire::ServerMessage& message);
  ClientResult<Done> keep(wire::ServerMessage& message);

  MessageStream stream_;
  std::deque<ClientEvent> waiting_;
  std::uint32_t request_ = 0;
  std::uint32_t status_request_ = 0;  // the Status says all that its OK reply could
  wire::Hello hello_;
  LossCounter losses_;
};

ClientResult<Done> SpokeClient::Connection::open(const std::string& host, std::uint16_t port,
                                                 Duration timeout) {
  auto hello = stream_.open(host, port, timeout);
  if (!hello) return Failure{hello.error()};
  hello_ = std::move(hello).value();
  return Done{};
}

// Empty for a message without an event: a later kind that this library does not know, a Hello, or
// the end of a status request.
ClientResult<std::optional<ClientEvent>> SpokeClient::Connection::as_event(
    wire::ServerMessage& message) {
  using Event = std::optional<ClientEvent>;
  switch (message.kind_case()) {
    case wire::ServerMessage::kSpoke: {
      auto spoke = from_message(message.spoke());
      if (!spoke) {
        return stream_.end(ClientErrorKind::malformed,
                           fmt::format("{} sent a bad spoke: {}, {}", name(),
                                       name_of(spoke.error().kind), printable(spoke.error().text)));
      }
      return Event(std::move(spoke).value());
    }
    case wire::ServerMessage::kSettings:
      return Event(std::move(*message.mutable_settings()));
    case wire::ServerMessage::kOwnShip:
      return Event(std::move(*message.mutable_own_ship()));
    case wire::ServerMessage::kWorld:
      return Event(std::move(*message.mutable_world()));
    case wire::ServerMessage::kStatus:
      return Event(std::move(*message.mutable_status()));
    case wire::ServerMessage::kRecorder:
      return Event(std::move(*message.mutable_recorder()));
    case wire::ServerMessage::kPlayback:
      return Event(std::move(*message.mutable_playback()));
    case wire::ServerMessage::kExercise:
      return Event(std::move(*message.mutable_exercise()));
    case wire::ServerMessage::kTargets:
      return Event(std::move(*message.mutable_targets()));
    case wire::ServerMessage::kReply: {
      const wire::Reply& reply = message.reply();
      if (reply.code() == wire::Reply::OK && reply.request() == status_request_) return Event{};
      return Event(std::move(*message.mutable_reply()));
    }
    case wire::ServerMessage::kHello:
      hello_ = message.hello();
      return Event{};
    case wire::ServerMessage::kFleet:
      *hello_.mutable_fleet() = message.fleet();
      return Event{};
    case wire::ServerMessage::kBoard:  // BoardClient asks for these
    case wire::ServerMessage::kBoardRecords:
    case wire::ServerMessage::kCoastline:  // this client asks for none
    case wire::ServerMessage::kChartObjects:
    case wire::ServerMessage::kClasses:  // order_class() waits for it
    case wire::ServerMessage::kHops:     // relays ask for these
    case wire::ServerMessage::kThinSpokes:
    case wire::ServerMessage::KIND_NOT_SET:
      return Event{};
  }
  return Event{};
}

ClientResult<Done> SpokeClient::Connection::keep(wire::ServerMessage& message) {
  auto event = as_event(message);
  if (!event) return Failure{event.error()};
  if (*event) {
    if (waiting_.size() == kMaxWaiting) waiting_.pop_front();
    waiting_.push_back(std::move(**event));
  }
  return Done{};
}

ClientResult<std::optional<ClientEvent>> SpokeClient::Connection::receive(Duration timeout) {
  std::optional<ClientEvent> event;
  if (!waiting_.empty()) {
    event = std::move(waiting_.front());
    waiting_.pop_front();
  }
  const Deadline deadline = deadline_after(timeout);
  while (!event) {
    auto message = stream_.next(deadline);
    if (!message) return Failure{message.error()};
    if (!*message) return event;
    auto converted = as_event(**message);
    if (!converted) return converted;
    event = std::move(converted).value();
    if (!event && is_past(deadline)) return event;
  }
  if (const auto* spoke = std::get_if<Spoke>(&*event)) losses_.take(spoke->header.sequence);
  return event;
}

ClientResult<Done> SpokeClient::Connection::send(wire::ClientMessage& message, Deadline deadline) {
  message.set_request(++request_);
  return stream_.send(message, deadline);
}

ClientResult<wire::Reply> SpokeClient::Connection::await_reply(std::uint32_t request,
                                                               const char* kind,
                                                               Deadline deadline) {
  for (;;) {
    auto message = stream_.next(deadline);
    if (!message) return Failure{message.error()};
    if (!*message) return stream_.no_answer(kind);
    if ((*message)->has_reply() && (*message)->reply().request() == request) {
      const wire::Reply& reply = (*message)->reply();
      if (reply.code() == wire::Reply::OK) return reply;
      return stream_.rejected(reply);
    }
    if (auto kept = keep(**message); !kept) return Failure{kept.error()};
    if (is_past(deadline)) return stream_.no_answer(kind);
  }
}

ClientResult<wire::Reply> SpokeClient::Connection::subscribe(const wire::Subscribe& request,
                                                             Duration timeout) {
  const Deadline deadline = deadline_after(timeout);
  wire::ClientMessage message;
  *message.mutable_subscribe() = request;
  if (auto sent = send(message, deadline); !sent) return Failure{sent.error()};
  auto reply = await_reply(message.request(), "subscribe", deadline);
  if (!reply) return reply;
  std::erase_if(waiting_, [](const ClientEvent& event) {
    return !std::holds_alternative<wire::Reply>(event);  // came before: of the old subscription
  });
  losses_ = LossCounter();
  return reply;
}

ClientResult<wire::Reply> SpokeClient::Connection::ask(wire::ClientMessage message,
                                                       const char* kind, Duration timeout) {
  const Deadline deadline = deadline_after(timeout);
  if (auto sent = send(message, deadline); !sent) return Failure{sent.error()};
  return await_reply(message.request(), kind, deadline);
}

ClientResult<wire::Status> SpokeClient::Connection::get_status(Duration timeout) {
  const Deadline deadline = deadline_after(timeout);
  wire::ClientMessage request;
  request.mutable_get_status();
  if (auto sent = send(request, deadline); !sent) return Failure{sent.error()};
  status_request_ = request.request();
  for (;;) {
    auto message = stream_.next(deadline);
    if (!message) return Failure{message.error()};
    if (!*message) return stream_.no_answer("status");
    if ((*message)->has_status()) return std::move(*(*message)->mutable_status());
    if ((*message)->has_reply() && (*message)->reply().request() == status_request_ &&
        (*message)->reply().code() != wire::Reply::OK) {
      return stream_.rejected((*message)->reply());
    }
    if (auto kept = keep(**message); !kept) return Failure{kept.error()};
    if (is_past(deadline)) return stream_.no_answer("status");
  }
}

ClientResult<wire::ClassList> SpokeClient::Connection::order_class(const wire::ClassOrder& order,
                                                                   Duration timeout) {
  const Deadline deadline = deadline_after(timeout);
  wire::ClientMessage request;
  *request.mutable_class_order() = order;
  if (auto sent = send(request, deadline); !sent) return Failure{sent.error()};
  wire::ClassList list;
  for (;;) {
    auto message = stream_.next(deadline);
    if (!message) return Failure{message.error()};
    if (!*message) return stream_.no_answer("class_order");
    if ((*message)->has_classes()) list = (*message)->classes();
    if ((*message)->has_reply() && (*message)->reply().request() == request.request()) {
      const wire::Reply& reply = (*message)->reply();
      if (reply.code() == wire::Reply::OK) return list;
      return stream_.rejected(reply);
    }
    if (auto kept = keep(**message); !kept) return Failure{kept.error()};
    if (is_past(deadline)) return stream_.no_answer("class_order");
  }
}

ClientResult<SpokeClient> SpokeClient::connect(const std::string& host, std::uint16_t port,
                                               Duration timeout) {
  auto connection = std::make_unique<Connection>(host, port);
  if (auto opened = connection->open(host, port, timeout); !opened) return Failure{opened.error()};
  return SpokeClient(std::move(connection));
}

SpokeClient::SpokeClient(std::unique_ptr<Connection> connection)
    : connection_(std::move(connection)) {}
SpokeClient::SpokeClient(SpokeClient&&) noexcept = default;
SpokeClient& SpokeClient::operator=(SpokeClient&&) noexcept = default;
SpokeClient::~SpokeClient() = default;

const wire::Hello& SpokeClient::hello() const { return connection_->hello(); }
const std::string& SpokeClient::name() const { return connection_->name(); }
const LossCounter& SpokeClient::losses() const { return connection_->losses(); }

ClientResult<wire::Reply> SpokeClient::sign_in(const std::string& token, Duration timeout) {
  wire::ClientMessage message;
  message.mutable_sign_in()->set_token(token);
  return connection_->ask(std::move(message), "sign_in", timeout);
}
ClientResult<wire::Reply> SpokeClient::sign_in(const wire::SignIn& who, Duration timeout) {
  if (who.token().empty() && !hello().has_classes()) {
    return Failure{ClientError{ClientErrorKind::rejected,
                               name() + " knows nobody by a password: it is an older server"}};
  }
  wire::ClientMessage message;
  *message.mutable_sign_in() = who;
  return connection_->ask(std::move(message), "sign_in", timeout);
}
ClientResult<wire::ClassList> SpokeClient::order_class(const wire::ClassOrder& order,
                                                       Duration timeout) {
  if (!hello().has_classes()) {
    return Failure{ClientError{ClientErrorKind::rejected, name() + " has no class codes"}};
  }
  return connection_->order_class(order, timeout);
}
ClientResult<Done> SpokeClient::subscribe(std::uint32_t radar, std::uint32_t view,
                                          Duration timeout) {
  wire::Subscribe request;
  request.set_radar(radar);
  request.set_view(view);
  const auto reply = connection_->subscribe(request, timeout);
  if (!reply) return Failure{reply.error()};
  return Done{};
}
ClientResult<std::uint32_t> SpokeClient::subscribe_new_view(std::uint32_t radar, std::uint32_t like,
                                                            Duration timeout,
                                                            const std::string& token) {
  wire::Subscribe request;
  request.set_radar(radar);
  request.set_view(like);
  request.set_new_view(true);
  request.set_token(token);
  const auto reply = connection_->subscribe(request, timeout);
  if (!reply) return Failure{reply.error()};
  return reply->view();
}
ClientResult<Done> SpokeClient::watch_exercise(std::uint32_t times_a_second, Duration timeout,
                                               const std::string& token) {
  wire::Subscribe request;
  request.set_exercise_hz(times_a_second);
  request.set_no_spokes(true);
  request.set_token(token);
  const auto reply = connection_->subscribe(request, timeout);
  if (!reply) return Failure{reply.error()};
  return Done{};
}
ClientResult<Done> SpokeClient::watch_targets(std::uint32_t radar, std::uint32_t view,
                                              std::uint32_t times_a_second, Duration timeout) {
  wire::Subscribe request;
  request.set_radar(radar);
  request.set_view(view);
  request.set_targets_hz(times_a_second);
  request.set_no_spokes(true);
  const auto reply = connection_->subscribe(request, timeout);
  if (!reply) return Failure{reply.error()};
  return Done{};
}
ClientResult<std::optional<ClientEvent>> SpokeClient::receive(Duration timeout) {
  return connection_->receive(timeout);
}
ClientResult<wire::Reply> SpokeClient::set(const wire::Set& request, Duration timeout) {
  wire::ClientMessage message;
  *message.mutable_set() = request;
  return connection_->ask(std::move(message), "set", timeout);
}
ClientResult<wire::Reply> SpokeClient::order_targets(const wire::TargetOrder& order,
                                                     Duration timeout) {
  wire::ClientMessage message;
  *message.mutable_target_order() = order;
  return connection_->ask(std::move(message), "target_order", timeout);
}
ClientResult<wire::Reply> SpokeClient::record(const wire::Record& request, Duration timeout) {
  if (!hello().can_record()) {
    return Failure{ClientError{ClientErrorKind::rejected, name() + " cannot record"}};
  }
  wire::ClientMessage message;
  *message.mutable_record() = request;
  return connection_->ask(std::move(message), "record", timeout);
}
ClientResult<wire::Reply> SpokeClient::playback(const wire::Playback& request, Duration timeout) {
  if (!hello().playback()) {
    return Failure{
        ClientError{ClientErrorKind::rejected, name() + " plays no recording: its radars run"}};
  }
  wire::ClientMessage message;
  *message.mutable_playback() = request;
  return connection_->ask(std::move(message), "playback", timeout);
}
ClientResult<wire::Status> SpokeClient::get_status(Duration timeout) {
  return connection_->get_status(timeout);
}

}  // namespace skerry::client
