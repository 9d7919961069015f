#include "server/net/signalk/signalk_delta_session.hpp"

#include <utility>
#include <vector>

#include "server/net/common/net_clock.hpp"
#include "server/net/common/tcp_peer.hpp"

namespace skerry::server {
namespace {

using signalk::Json;

constexpr std::string_view kSource = "skerry";

}  // namespace

void SignalkDeltaSession::begin(NetContext& context, SignalkSite& site,
                                std::unique_ptr<WsStream> stream, ConnectionSlotPtr slot,
                                const Client& client) {
  const auto session = std::make_shared<SignalkDeltaSession>(context, site, std::move(stream),
                                                             std::move(slot), client);
  session->start();
  site.enter(session);
}

SignalkDeltaSession::SignalkDeltaSession(NetContext& context, SignalkSite& site,
                                         std::unique_ptr<WsStream> stream, ConnectionSlotPtr slot,
                                         const Client& client)
    : context_(context),
      site_(site),
      stream_(std::move(stream)),
      slot_(std::move(slot)),
      right_(client.right) {
  client_ = context.clients.add("signalk deltas", slot_->peer().text);
  if (client.query.find("subscribe=none") == std::string::npos) {
    subscriptions_.subscribe("*", signalk::Subscriptions::kUsualPeriod);
  }
  if (client.query.find("subscribe=all") != std::string::npos) {
    of_others_.subscribe("*", signalk::Subscriptions::kUsualPeriod);
  }
}

void SignalkDeltaSession::start() {
  slot_->owner = weak_from_this();
  PeerStream& tcp = beast::get_lowest_layer(*stream_);
  set_stream_options(tcp.socket());
  tcp.expires_never();
  stream_->text(true);
  stream_->read_message_max(kLongestRequest);
  send(signalk::hello_document(site_.server(), utc_now()));
  read();
}

void SignalkDeltaSession::close() {
  if (closed_) return;
  closed_ = true;
  beast::get_lowest_layer(*stream_).close();
}

void SignalkDeltaSession::check(std::chrono::steady_clock::time_point now) {
  if (closed_ || queue_.empty() || slot_->is_trusted()) return;
  if (now - write_began_ <= context_.config.limits.unread_time) return;
  context_.complain("signalk does not read", client_->peer + ": closed");
  close();
}

void SignalkDeltaSession::read() {
  if (closed_ || reading_ || queue_.size() >= kMostQueued) return;
  reading_ = true;
  stream_->async_read(request_, [self = shared_from_this()](error_code error, std::size_t) {
    self->reading_ = false;
    self->on_read(error);
  });
}

void SignalkDeltaSession::on_read(error_code error) {
  if (error) {
    if (error == websocket::error::message_too_big || error == websocket::error::buffer_overflow) {
      context_.errors.add("signalk request too long", client_->peer);
    }
    return close();
  }
  const std::string text(static_cast<const char*>(request_.data().data()), request_.size());
  request_.consume(request_.size());
  handle(text);
  read();
}

void SignalkDeltaSession::handle(const std::string& text) {
  const auto request = signalk::read_stream_request(text);
  if (!request) {
    context_.errors.add("signalk malformed request", client_->peer + ": " + request.error());
    return;
  }
  for (const auto& path : request->unsubscribe) {
    subscriptions_.unsubscribe(path.pattern);
  }
  for (const auto& path : request->subscribe) {
    subscriptions_.subscribe(path.pattern, path.period);
  }
  for (const auto& path : request->unsubscribe_others) of_others_.unsubscribe(path.pattern);
  for (const auto& path : request->subscribe_others) {
    of_others_.subscribe(path.pattern, path.period);
    others_due_ = {};
  }
  if (of_others_.empty()) others_sent_.clear();
  if (!request->unsubscribe.empty()) {
    std::erase_if(sent_, [this](const auto& each) { return !subscriptions_.wants(each.first); });
  }
  if (!request->put_path.empty()) {
    set_control(*request, request->token);
  }
  if (!request->subscribe.empty() && queue_.size() < 4) {
    send_news(std::chrono::steady_clock::now());
  }
}

void SignalkDeltaSession::set_control(const signalk::StreamRequest& request,
                                      const std::string& token) {
  SignalkOutcome outcome{404, "no control of that path"};
  const std::string origin = "Signal K display " + client_->peer;
  const std::string who = right_.who(token);
  const AuditedRequest audited(context_.config.audit, origin, who);
  const bool is_in_budget = context_.changes.take(slot_->peer(), std::chrono::steady_clock::now());
  if (!is_in_budget) {
    outcome = {429, context_.changes.refusal(slot_->peer())};
    context_.complain("too many changes", client_->peer + ": " + outcome.message);
  } else if (auto refused = right_.refusal_of("signalk.change", token)) {
    context_.refuse(origin, who, *refused);
    outcome = {403, *std::move(refused)};
  } else if (const auto* definition = SignalkSite::definition_at(request.put_path)) {
    const std::string_view path = request.put_path;
    constexpr std::size_t kBehindRadars = 7;  // "radars."
    const auto id = path.substr(kBehindRadars, path.find('.', kBehindRadars) - kBehindRadars);
    if (SignalkSite::Mounted* radar = site_.find(id)) {
      outcome = site_.set_control(*radar, definition->key, request.put_value, origin);
    }
  }
  if (outcome.status >= 400) {
    context_.errors.add("signalk change refused", client_->peer + ": " + outcome.message);
  }
  if (request.request_id.empty()) return;
  Json reply = signalk::reply_document(outcome.status, outcome.message);
  reply["requestId"] = request.request_id;
  send(reply);
}

void SignalkDeltaSession::on_tick(std::chrono::steady_clock::time_point now) {
  if (closed_) return;
  if (right_.has_ended()) {
    context_.errors.add("no longer allowed", client_->peer);
    return close();
  }
  if (!queue_.empty()) return;
  send_news(now);
  send_others(now);
}

// Once a second, as an AIS receiver hears no more often: of each vessel what is not as it was last
// told.  Who has gone is told no more.
void SignalkDeltaSession::send_others(std::chrono::steady_clock::time_point now) {
  if (of_others_.empty() || now < others_due_) return;
  others_due_ = now + signalk::Subscriptions::kUsualPeriod;
  std::map<std::string, std::map<std::string, Json>> told;
  for (const signalk::OtherVessel& vessel : site_.vessels()) {
    std::map<std::string, Json>& mine = told[vessel.key];
    const auto known = others_sent_.find(vessel.key);
    Json values = Json::array();
    for (auto& [path, value] : signalk::other_vessel_values(vessel)) {
      if (!path.empty() && !of_others_.wants(path)) continue;
      const bool is_new = known == others_sent_.end() || !known->second.contains(path) ||
                          known->second.at(path) != value;
      if (is_new) values.push_back(Json{{"path", path}, {"value", value}});
      mine.emplace(path, std::move(value));
    }
    if (values.empty()) continue;
    send(signalk::delta_document(kSource, utc_now(), std::move(values), Json::array(),
                                 "vessels." + vessel.key));
  }
  others_sent_ = std::move(told);
}

void SignalkDeltaSession::send_news(std::chrono::steady_clock::time_point now) {
  Json meta = Json::array(), values = Json::array();
  for (const auto& [path, value] : site_.values()) {
    const auto period = subscriptions_.period_of(path);
    if (!period) continue;
    const auto known = sent_.find(path);
    const bool is_new = known == sent_.end();
    // A tick that comes a little early is the one that was meant.
    constexpr std::chrono::milliseconds kSlack{50};
    if (!is_new && (known->second.value == value || now - known->second.at + kSlack < *period)) {
      continue;
    }
    if (is_new) {
      if (const auto* definition = SignalkSite::definition_at(path)) {
        meta.push_back(Json{{"path", path}, {"value", signalk::definition_document(*definition)}});
      }
    }
    values.push_back(Json{{"path", path}, {"value", *value}});
    sent_[path] = {value, now};
  }
  for (auto known = sent_.begin(); known != sent_.end();) {
    if (site_.values().contains(known->first)) {
      ++known;
      continue;
    }
    values.push_back(Json{{"path", known->first}, {"value", nullptr}});
    known = sent_.erase(known);
  }
  if (!meta.empty()) {
    send(signalk::delta_document(kSource, utc_now(), Json::array(), std::move(meta)));
  }
  if (!values.empty()) {
    send(signalk::delta_document(kSource, utc_now(), std::move(values), Json::array()));
  }
}

void SignalkDeltaSession::send(const Json& document) {
  queue_.push_back(signalk::text_of(document));
  if (queue_.size() == 1) write();
}

void SignalkDeltaSession::write() {
  write_began_ = std::chrono::steady_clock::now();
  stream_->async_write(asio::buffer(queue_.front()),
                       [self = shared_from_this()](error_code error, std::size_t size) {
                         self->client_->bytes_sent.fetch_add(size, std::memory_order_relaxed);
                         if (error) return self->close();
                         self->queue_.pop_front();
                         if (!self->queue_.empty()) self->write();
                         self->read();
                       });
}

}  // namespace skerry::server
