#include "server/net/http/http_session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "server/net/common/tcp_peer.hpp"
#include "server/net/http/audit_page.hpp"
#include "server/net/http/carried_token.hpp"
#include "server/net/http/controls_page.hpp"
#include "server/net/http/http_request.hpp"
#include "server/net/http/login_routes.hpp"
#include "server/net/http/metrics_page.hpp"
#include "server/net/http/setup_routes.hpp"
#include "server/net/http/signalk_route.hpp"
#include "server/net/http/ws_transport.hpp"
#include "server/net/native/native_session.hpp"
#include "server/net/signalk/signalk_delta_session.hpp"
#include "server/net/signalk/signalk_rest.hpp"
#include "server/net/signalk/signalk_spoke_session.hpp"

namespace skerry::server {
namespace {

constexpr std::uint32_t kMaxHeaderBytes = 8 * 1024;
constexpr std::uint64_t kMaxBodyBytes = SetupShelf::kMostBytes;
constexpr std::uint64_t kMaxOtherBodyBytes = 4 * 1024;  // of all but set-ups
constexpr std::size_t kFirstRead = 4096;
constexpr std::size_t kMostDiscarded = 256 * 1024;  // of what comes meanwhile
constexpr auto kSubprotocols = http::field::sec_websocket_protocol;
constexpr std::chrono::seconds kHandshakeTime{10};
constexpr std::chrono::seconds kClosingTime{2};  // for the client to close after the last answer

class HttpSession final : public Connection, public std::enable_shared_from_this<HttpSession> {
 public:
  HttpSession(NetContext& context, const WebFiles& files, SignalkSite* site, PeerStream stream,
              ConnectionSlotPtr slot)
      : context_(context),
        files_(files),
        site_(site),
        stream_(std::move(stream)),
        slot_(std::move(slot)) {}

  void start() {
    slot_->owner = weak_from_this();
    set_stream_options(stream_.socket());
    const PeerLimits& limits = context_.config.limits;
    wait(slot_->place() == Place::on_trial ? limits.trial_time : limits.silent_time);
  }
  void close() override {
    if (ws_ != nullptr) {
      beast::get_lowest_layer(*ws_).close();
    } else {
      stream_.close();
    }
  }
  void check(std::chrono::steady_clock::time_point now) override {
    if (!reading_ || now < read_until_) return;
    is_late_ = true;
    stream_.cancel();
  }

 private:
  using Request = HttpRequest;

  void wait(std::chrono::milliseconds time);  // for the first byte of a request
  void read();
  void end_of_time();
  void on_read(error_code error);
  void answer_unreadable(error_code error);
  std::optional<WebAnswer> refusal(const Request& request) const;
  WebAnswer answer(const Request& request) const;
  WebAnswer answer_ws(const Request& request) const;
  WebAnswer answer_controls(const Request& request) const;
  WebAnswer answer_status(const Request& request) const;
  WebAnswer answer_metrics(const Request& request) const;
  WebAnswer answer_audit(const Request& request) const;
  void upgrade(Request request, std::function<void()> accepted);
  void upgrade_native(Request request);
  // False if no WebSocket is there.
  bool upgrade_signalk(Request& request, std::string_view path);
  void send(const WebAnswer& answer, bool with_body, bool keep_alive);
  void on_sent(error_code error, bool keep_alive);
  void discard();

  // What is no file of the console.  The right that a route needs is "GET " and its path.
  struct Route {
    std::string_view path;
    WebAnswer (HttpSession::*answer)(const Request& request) const;
  };
  static const std::array<Route, 5> kRoutes;

  NetContext& context_;
  const WebFiles& files_;
  SignalkSite* site_;
  PeerStream stream_;
  ConnectionSlotPtr slot_;
  bool reading_ = false, is_late_ = false;
  bool has_begun_ = false;   // the request that is being read
  bool has_served_ = false;  // a request; then a kept connection may end without a word
  std::chrono::steady_clock::time_point read_until_{};
  beast::flat_buffer buffer_{kMaxHeaderBytes + kMaxBodyBytes};
  std::optional<http::request_parser<http::string_body>> parser_;
  http::response<http::string_body> response_;
  std::unique_ptr<WsStream> ws_;  // during the handshake, when stream_ has moved into it
  Request upgrade_request_;
  std::array<char, 1024> discarded_;
  std::size_t discarded_bytes_ = 0;
};

const std::array<HttpSession::Route, 5> HttpSession::kRoutes = {
    {{"/ws", &HttpSession::answer_ws},
     {"/controls.json", &HttpSession::answer_controls},
     {"/status", &HttpSession::answer_status},
     {"/metrics", &HttpSession::answer_metrics},
     {"/audit", &HttpSession::answer_audit}}};

// Times of reading are check()'s: those of the stream would close it, and nothing could be said.
void HttpSession::wait(std::chrono::milliseconds time) {
  if (buffer_.size() > 0) return read();  // requests sent one behind the other
  has_begun_ = false;
  reading_ = true;
  read_until_ = std::chrono::steady_clock::now() + time;
  stream_.expires_never();
  stream_.async_read_some(buffer_.prepare(kFirstRead),
                          [self = shared_from_this()](error_code error, std::size_t size) {
                            self->reading_ = false;
                            if (std::exchange(self->is_late_, false)) return self->end_of_time();
                            if (error) return;
                            self->buffer_.commit(size);
                            self->read();
                          });
}

void HttpSession::read() {
  parser_.emplace();
  parser_->header_limit(kMaxHeaderBytes);
  parser_->body_limit(kMaxBodyBytes);
  has_begun_ = reading_ = true;
  read_until_ = std::chrono::steady_clock::now() + context_.config.limits.request_time;
  stream_.expires_never();
  http::async_read(stream_, buffer_, *parser_,
                   [self = shared_from_this()](error_code error, std::size_t) {
                     self->reading_ = false;
                     const bool is_late = std::exchange(self->is_late_, false);
                     if (is_late && error) return self->end_of_time();
                     self->on_read(error);
                   });
}

void HttpSession::end_of_time() {
  if (has_served_ && !has_begun_) return;  // as HTTP ends kept connections
  const PeerLimits& limits = context_.config.limits;
  const auto seconds = [](std::chrono::milliseconds time) {
    return std::chrono::duration<double>(time).count();
  };
  std::string text =
      has_begun_ ? fmt::format("408: a request must be whole within {} s of its first byte",
                               seconds(limits.request_time))
                 : fmt::format("408: no request came within {} s", seconds(limits.silent_time));
  context_.complain("http too slow", slot_->peer().text + ": " + text);
  send(web_error(408, std::move(text)), true, false);
}

void HttpSession::on_read(error_code error) {
  if (error) return answer_unreadable(error);
  has_served_ = true;
  Request request = parser_->release();
  if (context_.knows(slot_->peer(), token_of(request))) slot_->trust();
  if (auto refused = refusal(request)) {
    const std::string_view text = refused->body;
    context_.complain("http refused",
                      fmt::format("{}: {}", slot_->peer().text, text.substr(0, text.find('\n'))));
    return send(*refused, request.method() != http::verb::head, false);
  }
  std::string path = clean_path({request.target().data(), request.target().size()});
  if (request.body().size() > kMaxOtherBodyBytes && !is_setup_path(path)) {
    return send(web_error(413, "413: the request body is too long"), true, false);
  }
  const bool upgrades = websocket::is_upgrade(request);
  if (path == "/ws" && upgrades) return upgrade_native(std::move(request));
  const bool with_body = request.method() != http::verb::head;
  const auto method = request.method_string();
  const auto later = [self = shared_from_this(), with_body,
                      keep_alive = request.keep_alive()](const WebAnswer& answer) {
    self->send(answer, with_body, keep_alive && self->slot_->place() != Place::on_trial);
  };
  if (is_login_path(path) && (site_ != nullptr || !is_signalk_path(path))) {
    return answer_login(context_, slot_->peer(),
                        {.method = {method.data(), method.size()},
                         .path = std::move(path),
                         .body = std::move(request.body()),
                         .token = std::string(token_of(request)),
                         .by_cookie = request.count(http::field::authorization) == 0,
                         .signed_in = [self = shared_from_this()] { self->slot_->trust(); }},
                        later);
  }
  if (site_ != nullptr && is_signalk_path(path)) {
    if (upgrades && upgrade_signalk(request, path)) return;
    error_code unknown;
    const auto local = stream_.socket().local_endpoint(unknown);
    const SignalkAsked asked{.peer = slot_->peer(),
                             .token = std::string(token_of(request)),
                             .address = unknown ? "" : local.address().to_string()};
    return send(answer_signalk(context_, *site_, request, std::move(path), asked), with_body,
                request.keep_alive());
  }
  if (is_setup_path(path)) {
    return answer_setups(context_, slot_->peer(),
                         {.method = {method.data(), method.size()},
                          .path = std::move(path),
                          .body = std::move(request.body()),
                          .who = context_.who(slot_->peer(), token_of(request))},
                         later);
  }
  send(answer(request), with_body, request.keep_alive());
}

void HttpSession::answer_unreadable(error_code error) {
  if (error == http::error::header_limit || error == http::error::buffer_overflow) {
    send(web_error(431, "431: the request header is too long"), true, false);
  } else if (error == http::error::body_limit) {
    send(web_error(413, "413: the request body is too long"), true, false);
  } else if (error.category() == make_error_code(http::error::bad_method).category() &&
             error != http::error::end_of_stream && error != http::error::partial_message) {
    context_.errors.add("http malformed request", slot_->peer().text + ": " + error.message());
    send(web_error(400, "400: not an HTTP request: " + error.message()), true, false);
  }
  // Otherwise the client has gone or was too slow, and with this the last owner lets go.
}

std::optional<WebAnswer> HttpSession::refusal(const Request& request) const {
  // Who is on trial may sign in, as that shows who she is.
  const auto signs_in = [&] {
    return request.method() == http::verb::post &&
           is_login_path(clean_path({request.target().data(), request.target().size()}));
  };
  if (slot_->place() == Place::refused || (slot_->place() == Place::on_trial && !signs_in())) {
    return web_error(503, "503: " + slot_->reason());
  }
  if (auto refused = refusal_of(request, context_.config, context_.sisters())) return refused;
  const TcpPeer& peer = slot_->peer();
  if (!context_.tls || peer.is_secure || peer.on_own_host) return std::nullopt;
  return to_secure(request);
}

WebAnswer HttpSession::answer(const Request& request) const {
  if (!only_reads(request)) {
    return web_error(405, "405: only GET and HEAD are served here");
  }
  const std::string_view target(request.target().data(), request.target().size());
  const std::string path = clean_path(target);
  const auto route = std::find_if(kRoutes.begin(), kRoutes.end(),
                                  [&](const Route& each) { return each.path == path; });
  const bool is_file = route == kRoutes.end();
  const Who who = context_.who(slot_->peer(), token_of(request));
  if (const auto refused = why_not(who, "GET " + (is_file ? std::string("/") : path))) {
    context_.refuse("HTTP " + slot_->peer().text, text_of(who), *refused);
    return web_error(who.role ? 403 : 401, fmt::format("{}: {}", who.role ? 403 : 401, *refused));
  }
  if (!is_file) return (this->*route->answer)(request);
  WebAnswer file = files_.get(target);
  file.sisters = context_.sisters();
  return file;
}

WebAnswer HttpSession::answer_ws(const Request&) const {
  return web_error(426, "426: /ws is a WebSocket");
}

WebAnswer HttpSession::answer_controls(const Request&) const {
  return {.mime = "application/json", .body = controls_page()};
}

WebAnswer HttpSession::answer_status(const Request&) const {
  return json_answer(slot_->is_trusted() ? context_.status() : context_.status_for_strangers());
}

WebAnswer HttpSession::answer_metrics(const Request& request) const {
  const MetricsFormat format = metrics_format(headers_of(request, http::field::accept));
  return {.mime = std::string(metrics_mime(format)),
          .body = metrics_page(context_.status(), context_.clients.totals(), format),
          .vary = "Accept"};
}

WebAnswer HttpSession::answer_audit(const Request& request) const {
  return audit_page(context_.config.audit, {request.target().data(), request.target().size()});
}

bool HttpSession::upgrade_signalk(Request& request, std::string_view path) {
  const auto wanted = signalk_stream(*site_, path);
  if (!wanted) return false;
  const StreamRight right(context_, slot_->peer(), std::string(token_of(request)),
                          site_->radars().front().number);
  if (const auto refused = right.refusal_of("signalk.stream")) {
    send(web_error(401, "401: " + *refused), true, false);
    return true;
  }
  const SignalkDeltaSession::Client client{
      .query = std::string(request.target().data(), request.target().size()), .right = right};
  upgrade(std::move(request), [self = shared_from_this(), wanted, client] {
    if (wanted->spokes != nullptr) {
      SignalkSpokeSession::begin(self->context_, *self->site_, wanted->spokes->number,
                                 std::move(self->ws_), std::move(self->slot_), client.right);
    } else {
      SignalkDeltaSession::begin(self->context_, *self->site_, std::move(self->ws_),
                                 std::move(self->slot_), client);
    }
  });
  return true;
}

void HttpSession::upgrade_native(Request request) {
  const auto offered = offered_subprotocols(headers_of(request, kSubprotocols));
  std::string token = offered.token.empty() ? std::string(token_of(request)) : offered.token;
  if (context_.knows(slot_->peer(), token)) slot_->trust();
  upgrade(std::move(request), [self = shared_from_this(), token = std::move(token)] {
    NativeSession::begin(self->context_, make_ws_transport(std::move(self->ws_)),
                         std::move(self->slot_), token);
  });
}

void HttpSession::upgrade(Request request, std::function<void()> accepted) {
  stream_.expires_never();  // the WebSocket has its own time limits
  ws_ = std::make_unique<WsStream>(std::move(stream_));
  ws_->set_option(
      websocket::stream_base::timeout{kHandshakeTime, websocket::stream_base::none(), false});
  const bool is_skerry = offered_subprotocols(headers_of(request, kSubprotocols)).skerry;
  ws_->set_option(
      websocket::stream_base::decorator([is_skerry](websocket::response_type& response) {
        response.set(http::field::server, "skerryd");
        if (!is_skerry) return;
        response.set(kSubprotocols, beast::string_view(kSubprotocol.data(), kSubprotocol.size()));
      }));
  upgrade_request_ = std::move(request);
  ws_->async_accept(upgrade_request_,
                    [self = shared_from_this(), accepted = std::move(accepted)](error_code error) {
                      if (!error) return accepted();
                      self->context_.errors.add("websocket handshake", error.message());
                    });
}

void HttpSession::send(const WebAnswer& answer, bool with_body, bool keep_alive) {
  response_ = response_of(answer, with_body, keep_alive);
  stream_.expires_after(context_.config.http_timeout);
  http::async_write(stream_, response_,
                    [self = shared_from_this(), keep_alive](error_code error, std::size_t) {
                      self->on_sent(error, keep_alive);
                    });
}

void HttpSession::on_sent(error_code error, bool keep_alive) {
  if (error) return;
  if (keep_alive) return wait(context_.config.http_timeout);
  stream_.expires_after(kClosingTime);
  stream_.finish();
  discard();
}

// Closing with bytes unread would reset the connection, and the client might never see the answer.
void HttpSession::discard() {
  stream_.async_read_some(asio::buffer(discarded_),
                          [self = shared_from_this()](error_code error, std::size_t size) {
                            self->discarded_bytes_ += size;
                            if (!error && self->discarded_bytes_ < kMostDiscarded) self->discard();
                          });
}

}  // namespace

void begin_http_session(NetContext& context, const WebFiles& files, SignalkSite* site,
                        PeerStream stream, ConnectionSlotPtr slot) {
  std::make_shared<HttpSession>(context, files, site, std::move(stream), std::move(slot))->start();
}

}  // namespace skerry::server
