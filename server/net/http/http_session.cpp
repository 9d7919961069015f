#include "server/net/http/http_session.hpp"

#include <fmt/format.h>
#include <google/protobuf/util/json_util.h>

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "server/net/common/access_policy.hpp"
#include "server/net/common/net_clock.hpp"
#include "server/net/common/tcp_peer.hpp"
#include "server/net/http/controls_page.hpp"
#include "server/net/http/metrics_page.hpp"
#include "server/net/native/byte_transport.hpp"
#include "server/net/native/native_session.hpp"
#include "server/net/signalk/signalk_delta_session.hpp"
#include "server/net/signalk/signalk_rest.hpp"
#include "server/net/signalk/signalk_spoke_session.hpp"

namespace skerry::server {
namespace {

constexpr std::uint32_t kMaxHeaderBytes = 8 * 1024;
constexpr std::uint64_t kMaxBodyBytes = 4 * 1024;  // of changes by Signal K
constexpr std::chrono::seconds kHandshakeTime{10};
constexpr std::chrono::seconds kClosingTime{2};  // for the client to close after the last answer

std::optional<std::string_view> header_of(const http::request<http::string_body>& request,
                                          http::field field) {
  const auto found = request.find(field);
  if (found == request.end()) return std::nullopt;
  return std::string_view(found->value().data(), found->value().size());
}

// All of them as one, as they may be read.  Source: RFC 9110, 5.3.
std::string headers_of(const http::request<http::string_body>& request, http::field field) {
  std::string joined;
  const auto [begin, end] = request.equal_range(field);
  for (auto header = begin; header != end; ++header) {
    if (!joined.empty()) joined += ", ";
    joined.append(header->value().data(), header->value().size());
  }
  return joined;
}

// The native protocol in binary WebSocket messages, for browsers.
class WsTransport final : public ByteTransport {
 public:
  explicit WsTransport(std::unique_ptr<WsStream> stream)
      : stream_(std::move(stream)), peer_(peer_of(beast::get_lowest_layer(*stream_).socket())) {
    set_stream_options(beast::get_lowest_layer(*stream_).socket());
    beast::get_lowest_layer(*stream_).expires_never();
    stream_->binary(true);
    stream_->auto_fragment(false);  // a batch is one message: header and shared buffers, no copy
    stream_->read_message_max(0);   // read piecewise; FrameReader bounds what is kept
  }

  void read_some(std::span<std::uint8_t> into, Done done) override {
    stream_->async_read_some(
        asio::buffer(into.data(), into.size()),
        [stream = stream_.get(), done = std::move(done)](error_code error, std::size_t size) {
          if (!error && stream->got_text()) {
            error = make_error_code(boost::system::errc::bad_message);
          }
          done(error, size);
        });
  }
  void write(const std::vector<asio::const_buffer>& buffers, Done done) override {
    stream_->async_write(buffers, std::move(done));
  }
  void finish() override {
    // The owner's pending read keeps the stream until this is done or the connection closed.
    stream_->async_close(websocket::close_code::policy_error, [](error_code) {});
  }
  void close() override { beast::get_lowest_layer(*stream_).close(); }
  void limit_send_buffer(std::size_t bytes) override {
    set_send_buffer(beast::get_lowest_layer(*stream_).socket(), bytes);
  }

  std::string name() const override { return "websocket"; }
  std::string peer() const override { return peer_.text; }
  bool peer_is_loopback() const override { return peer_.is_loopback; }

 private:
  std::unique_ptr<WsStream> stream_;
  TcpPeer peer_;
};

// Requires a stream whose WebSocket handshake is done.
std::unique_ptr<ByteTransport> make_ws_transport(std::unique_ptr<WsStream> stream) {
  return std::make_unique<WsTransport>(std::move(stream));
}

class HttpSession final : public Connection, public std::enable_shared_from_this<HttpSession> {
 public:
  HttpSession(NetContext& context, const WebFiles& files, SignalkSite* site, TcpSocket socket,
              ConnectionSlotPtr slot)
      : context_(context),
        files_(files),
        site_(site),
        stream_(std::move(socket)),
        slot_(std::move(slot)) {}

  void start() {
    slot_->owner = weak_from_this();
    set_stream_options(stream_.socket());
    read();
  }
  void close() override {
    if (ws_ != nullptr) {
      beast::get_lowest_layer(*ws_).close();
    } else {
      stream_.close();
    }
  }

 private:
  using Request = http::request<http::string_body>;

  void read();
  void on_read(error_code error);
  void answer_unreadable(error_code error);
  std::optional<WebAnswer> refusal(const Request& request) const;
  WebAnswer answer(const Request& request) const;
  WebAnswer answer_ws(const Request& request) const;
  WebAnswer answer_controls(const Request& request) const;
  WebAnswer answer_status(const Request& request) const;
  WebAnswer answer_metrics(const Request& request) const;
  WebAnswer answer_signalk(const Request& request, std::string path);
  void upgrade(Request request, std::function<void()> accepted);
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
  static const std::array<Route, 4> kRoutes;

  NetContext& context_;
  const WebFiles& files_;
  SignalkSite* site_;
  TcpStream stream_;
  ConnectionSlotPtr slot_;
  beast::flat_buffer buffer_{kMaxHeaderBytes + kMaxBodyBytes};
  std::optional<http::request_parser<http::string_body>> parser_;
  http::response<http::string_body> response_;
  std::unique_ptr<WsStream> ws_;  // during the handshake, when stream_ has moved into it
  Request upgrade_request_;
  std::array<char, 1024> discarded_;
};

const std::array<HttpSession::Route, 4> HttpSession::kRoutes = {
    {{"/ws", &HttpSession::answer_ws},
     {"/controls.json", &HttpSession::answer_controls},
     {"/status", &HttpSession::answer_status},
     {"/metrics", &HttpSession::answer_metrics}}};

void HttpSession::read() {
  parser_.emplace();
  parser_->header_limit(kMaxHeaderBytes);
  parser_->body_limit(kMaxBodyBytes);
  stream_.expires_after(context_.config.http_timeout);
  http::async_read(
      stream_, buffer_, *parser_,
      [self = shared_from_this()](error_code error, std::size_t) { self->on_read(error); });
}

void HttpSession::on_read(error_code error) {
  if (error) return answer_unreadable(error);
  Request request = parser_->release();
  if (auto refused = refusal(request)) {
    const std::string_view text = refused->body;
    context_.errors.add("http refused", fmt::format("{}: {}", peer_of(stream_.socket()).text,
                                                    text.substr(0, text.find('\n'))));
    return send(*refused, request.method() != http::verb::head, false);
  }
  std::string path = clean_path({request.target().data(), request.target().size()});
  const bool upgrades = websocket::is_upgrade(request);
  if (path == "/ws" && upgrades) {
    return upgrade(std::move(request), [self = shared_from_this()] {
      NativeSession::begin(self->context_, make_ws_transport(std::move(self->ws_)),
                           std::move(self->slot_));
    });
  }
  const bool with_body = request.method() != http::verb::head;
  if (site_ != nullptr && is_signalk_path(path)) {
    if (upgrades && upgrade_signalk(request, path)) return;
    return send(answer_signalk(request, std::move(path)), with_body, request.keep_alive());
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
    context_.errors.add("http malformed request",
                        peer_of(stream_.socket()).text + ": " + error.message());
    send(web_error(400, "400: not an HTTP request: " + error.message()), true, false);
  }
  // Otherwise the client has gone or was too slow, and with this the last owner lets go.
}

std::optional<WebAnswer> HttpSession::refusal(const Request& request) const {
  if (slot_->over_limit) {
    return web_error(503, fmt::format("503: all {} connections of this server are in use",
                                      context_.connections.limit()));
  }
  const auto host = header_of(request, http::field::host);
  if (!host || request.count(http::field::host) != 1) {
    return web_error(400, "400: a request needs one Host header");
  }
  error_code error;
  const auto bound = asio::ip::make_address(context_.config.bind, error);
  const HostPolicy policy{.allowed_hosts = context_.config.allowed_hosts,
                          .any_ip_literal = !error && !is_loopback(bound)};
  if (auto text = host_refusal(*host, policy)) return web_error(403, "403: " + *text);
  // Any page may send a request that only reads; the browser does not show it the answer.
  const bool reads = request.method() == http::verb::get || request.method() == http::verb::head;
  if (reads && !websocket::is_upgrade(request)) return std::nullopt;
  if (request.count(http::field::origin) > 1) return web_error(400, "400: more than one Origin");
  if (auto text = origin_refusal(header_of(request, http::field::origin), *host)) {
    return web_error(403, "403: " + *text);
  }
  return std::nullopt;
}

WebAnswer HttpSession::answer(const Request& request) const {
  if (request.method() != http::verb::get && request.method() != http::verb::head) {
    return web_error(405, "405: only GET and HEAD are served here");
  }
  const std::string_view target(request.target().data(), request.target().size());
  const std::string path = clean_path(target);
  const auto route = std::find_if(kRoutes.begin(), kRoutes.end(),
                                  [&](const Route& each) { return each.path == path; });
  const bool is_file = route == kRoutes.end();
  const auto token = token_of(header_of(request, http::field::authorization).value_or(""));
  const Who who = context_.gate.who(peer_of(stream_.socket()).is_loopback, token, utc_now());
  if (const auto refused = why_not(who, "GET " + (is_file ? std::string("/") : path))) {
    return web_error(who.role ? 403 : 401, fmt::format("{}: {}", who.role ? 403 : 401, *refused));
  }
  return is_file ? files_.get(target) : (this->*route->answer)(request);
}

WebAnswer HttpSession::answer_ws(const Request&) const {
  return web_error(426, "426: /ws is a WebSocket");
}

WebAnswer HttpSession::answer_controls(const Request&) const {
  return {.mime = "application/json", .body = controls_page()};
}

WebAnswer HttpSession::answer_status(const Request&) const {
  google::protobuf::util::JsonPrintOptions options;
  options.add_whitespace = true;
  options.always_print_primitive_fields = true;
  options.preserve_proto_field_names = true;
  WebAnswer json{.mime = "application/json"};
  const auto written =
      google::protobuf::util::MessageToJsonString(context_.status(), &json.body, options);
  if (!written.ok()) return web_error(500, "500: " + written.ToString());
  return json;
}

WebAnswer HttpSession::answer_metrics(const Request& request) const {
  const MetricsFormat format = metrics_format(headers_of(request, http::field::accept));
  return {.mime = std::string(metrics_mime(format)),
          .body = metrics_page(context_.status(), context_.clients.totals(), format),
          .vary = "Accept"};
}

WebAnswer HttpSession::answer_signalk(const Request& request, std::string path) {
  const NetConfig& config = context_.config;
  const TcpPeer peer = peer_of(stream_.socket());
  const auto token = token_of(header_of(request, http::field::authorization).value_or(""));
  const Who who = context_.gate.who(peer.is_loopback, token, utc_now());
  const auto method = request.method_string();
  const auto right = signalk_right({method.data(), method.size()}, path);
  error_code error;
  const auto local = stream_.socket().local_endpoint(error);
  SignalkRequest asked{
      .method = {method.data(), method.size()},
      .path = std::move(path),
      .body = request.body(),
      .authority = std::string(*header_of(request, http::field::host)),
      .address = error ? config.bind : local.address().to_string(),
      .origin = "Signal K display " + peer.text,
      .refusal = why_not(who, right, context_.ship_of(site_->radars().front().number)),
      .has_token = !token.empty() && who.role && who.more.empty(),
      .is_known = who.role.has_value()};
  WebAnswer answer = signalk_answer(*site_, config.signalk, context_.gate, asked);
  const bool reads = request.method() == http::verb::get || request.method() == http::verb::head;
  if (answer.status >= 400 && !reads) {
    context_.errors.add("signalk change refused", peer.text + ": " + answer.body);
  }
  return answer;
}

bool HttpSession::upgrade_signalk(Request& request, std::string_view path) {
  const auto wanted = signalk_stream(*site_, path);
  if (!wanted) return false;
  const StreamRight right(
      context_, peer_of(stream_.socket()).is_loopback,
      std::string(token_of(header_of(request, http::field::authorization).value_or(""))),
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

void HttpSession::upgrade(Request request, std::function<void()> accepted) {
  stream_.expires_never();  // the WebSocket has its own time limits
  ws_ = std::make_unique<WsStream>(std::move(stream_));
  ws_->set_option(
      websocket::stream_base::timeout{kHandshakeTime, websocket::stream_base::none(), false});
  ws_->set_option(websocket::stream_base::decorator(
      [](websocket::response_type& response) { response.set(http::field::server, "skerryd"); }));
  upgrade_request_ = std::move(request);
  ws_->async_accept(upgrade_request_,
                    [self = shared_from_this(), accepted = std::move(accepted)](error_code error) {
                      if (!error) return accepted();
                      self->context_.errors.add("websocket handshake", error.message());
                    });
}

void HttpSession::send(const WebAnswer& answer, bool with_body, bool keep_alive) {
  response_ = {};
  response_.version(11);
  response_.result(answer.status);
  response_.set(http::field::server, "skerryd");
  response_.set(http::field::content_type, answer.mime);
  response_.set(http::field::cache_control, "no-cache");
  response_.set("X-Content-Type-Options", "nosniff");
  if (!answer.vary.empty()) {
    response_.set(http::field::vary, beast::string_view(answer.vary.data(), answer.vary.size()));
  }
  if (!answer.location.empty()) response_.set(http::field::location, answer.location);
  if (answer.status == 405) response_.set(http::field::allow, "GET, HEAD");
  if (answer.status == 401) response_.set(http::field::www_authenticate, "Bearer");
  if (answer.status == 426) response_.set(http::field::upgrade, "websocket");
  response_.keep_alive(keep_alive);
  response_.content_length(answer.body.size());
  if (with_body) response_.body() = answer.body;
  stream_.expires_after(context_.config.http_timeout);
  http::async_write(stream_, response_,
                    [self = shared_from_this(), keep_alive](error_code error, std::size_t) {
                      self->on_sent(error, keep_alive);
                    });
}

void HttpSession::on_sent(error_code error, bool keep_alive) {
  if (error) return;
  if (keep_alive) return read();
  error_code ignored;
  stream_.socket().shutdown(asio::socket_base::shutdown_send, ignored);
  stream_.expires_after(kClosingTime);
  discard();
}

// Closing with bytes unread would reset the connection, and the client might never see the answer.
void HttpSession::discard() {
  stream_.async_read_some(asio::buffer(discarded_),
                          [self = shared_from_this()](error_code error, std::size_t) {
                            if (!error) self->discard();
                          });
}

}  // namespace

void begin_http_session(NetContext& context, const WebFiles& files, SignalkSite* site,
                        TcpSocket socket, ConnectionSlotPtr slot) {
  std::make_shared<HttpSession>(context, files, site, std::move(socket), std::move(slot))->start();
}

}  // namespace skerry::server
