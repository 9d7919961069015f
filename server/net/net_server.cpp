#include "server/net/net_server.hpp"

#include <google/protobuf/stubs/logging.h>
#include <pthread.h>
#include <spdlog/spdlog.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "server/net/common/encoders.hpp"
#include "server/net/common/listener.hpp"
#include "server/net/common/tcp_peer.hpp"
#include "server/net/common/tls_opening.hpp"
#include "server/net/http/http_session.hpp"
#include "server/net/http/web_answer.hpp"
#include "server/net/native/native_session.hpp"
#include "server/net/native/stream_transport.hpp"
#include "server/net/navigation/navigation_input.hpp"
#include "server/net/navigation/navigation_output.hpp"
#include "server/net/outputs/display_output.hpp"
#include "server/net/outputs/stream_outputs.hpp"
#include "server/net/outputs/target_output.hpp"
#include "server/net/outputs/udp_sender.hpp"
#include "server/net/signalk/signalk_service.hpp"

namespace skerry::server {
namespace {

constexpr std::chrono::milliseconds kSettingsPeriod{100};
static_assert(std::chrono::seconds(1) / kSettingsPeriod == kOwnShipMostHz);
constexpr int kSendBufferPeriods = 10;  // once a second
constexpr int kNiceness = -5;

}  // namespace

// All navigation outputs and inputs of the server.
// Thread: constructed anywhere, then net-0.
class NavigationPorts {
 public:
  // Opens what context.config names.  Error: as of its parts.
  explicit NavigationPorts(NetContext& context);

  void start();
  void close();

 private:
  std::vector<std::unique_ptr<NavigationOutput>> outputs_;
  std::vector<std::unique_ptr<NavigationInput>> inputs_;
};

NavigationPorts::NavigationPorts(NetContext& context) {
  for (const auto& config : context.config.navigation_outputs) {
    outputs_.push_back(std::make_unique<NavigationOutput>(context, config));
  }
  for (const auto& config : context.config.navigation_inputs) {
    inputs_.push_back(std::make_unique<NavigationInput>(context, config));
  }
}

void NavigationPorts::start() {
  for (const auto& output : outputs_) output->start();
  for (const auto& input : inputs_) input->start();
}

void NavigationPorts::close() {
  for (const auto& output : outputs_) output->close();
  for (const auto& input : inputs_) input->close();
}

// All emulated radars of the server.
// Thread: constructed anywhere, then net-0.
class DisplayOutputs {
 public:
  // The period of RadarEmulation::on_time().
  static constexpr std::chrono::milliseconds kTick{10};

  // Opens the outputs of context.config.displays.
  // Error: std::runtime_error naming the output and the reason, among them that two of them cannot
  // be on one host (output_conflicts.hpp).
  explicit DisplayOutputs(NetContext& context);

  void start();
  void close();

 private:
  void tick();

  std::vector<std::unique_ptr<DisplayOutput>> outputs_;
  Timer timer_;
  std::chrono::steady_clock::time_point due_;
  bool closed_ = false;
};

DisplayOutputs::DisplayOutputs(NetContext& context) : timer_(context.io) {
  std::vector<OutputClaim> claims;
  for (const DisplayOutputConfig& config : context.config.displays) {
    outputs_.push_back(std::make_unique<DisplayOutput>(context, config, outputs_.size()));
    claims.push_back(outputs_.back()->claim());
  }
  if (const auto conflict = conflict_among(claims)) throw std::runtime_error(*conflict);
  for (const auto& output : outputs_) output->open();
}

void DisplayOutputs::start() {
  if (outputs_.empty()) return;
  for (const auto& output : outputs_) output->start();
  due_ = std::chrono::steady_clock::now();
  tick();
}

void DisplayOutputs::close() {
  closed_ = true;  // a tick may be on its way already
  timer_.cancel();
  for (const auto& output : outputs_) output->close();
}

void DisplayOutputs::tick() {
  due_ = std::max(due_ + kTick, std::chrono::steady_clock::now());
  timer_.expires_at(due_);
  timer_.async_wait([this](error_code error) {
    if (error || closed_) return;
    for (const auto& output : outputs_) output->tick();
    tick();
  });
}

class NetServer::Impl {
 public:
  Impl(RadarHost& host, NetConfig config, std::span<const WebFile> web_files)
      : context_(host, std::move(config)),
        files_(web_files, context_.config.web_root),
        tcp_(
            context_,
            {.protocol = "native TCP",
             .address = context_.config.bind,
             .port = context_.config.tcp_port,
             .option = "--tcp-port"},
            [this](TcpSocket socket, ConnectionSlotPtr slot) {
              open_native(std::move(socket), std::move(slot));
            },
            native_refusal),
        http_(
            context_,
            {.protocol = "HTTP",
             .address = context_.config.bind,
             .port = context_.config.http_port,
             .option = "--http-port"},
            [this](TcpSocket socket, ConnectionSlotPtr slot) {
              open_http(signalk_->first(), std::move(socket), std::move(slot));
            },
            http_refusal),
        tick_(context_.io) {
    // Text fields that are not UTF-8 make parsing fail; protobuf would also write every such
    // message of a stranger to the log.
    google::protobuf::SetLogHandler(nullptr);
    for (std::uint32_t radar = 0; radar < host.radar_count(); ++radar) {
      for (const RadarHost::View& view : host.views(radar)) {
        add_native_formats(*view.channel);
      }
    }
    for (std::size_t i = 0; i < context_.config.streams.size(); ++i) {
      senders_.push_back(open_stream(context_, i));
    }
    for (const TargetOutputConfig& output : context_.config.target_outputs) {
      target_outputs_.push_back(std::make_unique<TargetOutput>(context_, output));
    }
    displays_.emplace(context_);
    navigation_.emplace(context_);
    signalk_.emplace(context_, [this](SignalkSite& site, TcpSocket socket, ConnectionSlotPtr slot) {
      open_http(&site, std::move(socket), std::move(slot));
    });
  }

  void start() {
    tcp_.start();
    http_.start();
    signalk_->start();
    tick();
    asio::post(context_.io, [this] {
      if (closing_) return;
      for (const auto& sender : senders_) sender->start();
      displays_->start();
      navigation_->start();
    });
    thread_ = std::thread([this] {
      pthread_setname_np(pthread_self(), "net-0");
      run();
    });
    signalk_->advertise(http_port());
  }

  void stop() {
    if (stopped_) return;
    stopped_ = true;
    signalk_->end_advertising();
    asio::post(context_.io, [this] {
      closing_ = true;
      tcp_.close();
      http_.close();
      signalk_->close();
      tick_.cancel();
      context_.connections.close_all();
      for (const auto& sender : senders_) sender->close();
      for (const auto& output : target_outputs_) output->close();
      displays_->close();
      navigation_->close();
    });
    work_.reset();
    if (thread_.joinable()) {
      thread_.join();
    } else {
      run();  // never started
    }
  }

  void read_certificate() {
    asio::post(context_.io, [this] { context_.look_at_tls(TlsKeys::When::now); });
  }

  void log_addresses() const {
    const NetConfig& config = context_.config;
    spdlog::info("native TCP on {} port {}, HTTP and WebSocket on port {}", config.bind, tcp_port(),
                 http_port());
    error_code error;
    if (is_loopback(asio::ip::make_address(config.bind, error))) return;
    if (!config.exposure.empty()) spdlog::warn(config.exposure);
    if (context_.gate.is_closed()) {
      spdlog::info("other hosts need a token{}{}",
                   config.tokens.empty() ? "" : " of " + config.tokens,
                   config.users.empty() ? "" : ", or sign in as a user of " + config.users);
    } else if (config.control_token.empty()) {
      spdlog::info("other hosts may look but not control: no control token is configured");
    }
  }

  wire::Status status() const { return context_.status(); }
  std::uint64_t looks() const { return looks_.load(std::memory_order_relaxed); }
  std::uint16_t tcp_port() const { return tcp_.port(); }
  std::uint16_t http_port() const { return http_.port(); }
  std::vector<std::uint16_t> signalk_ports() const { return signalk_->further_ports(); }

 private:
  // The server speaks first, so that the own host's clients are not waited for: they are plain.
  void open_native(TcpSocket socket, ConnectionSlotPtr slot) {
    if (context_.tls && !slot->peer().on_own_host) {
      return open_connection(context_, std::move(socket), std::move(slot), native_opening_);
    }
    begin_native(PeerStream(std::move(socket)), std::move(slot));
  }
  void begin_native(PeerStream stream, ConnectionSlotPtr slot) {
    NativeSession::begin(context_, make_stream_transport(std::move(stream)), std::move(slot));
  }
  // In the clear, for a client that does not know of TLS.
  void refuse_native(PeerStream stream, const ConnectionSlotPtr& slot) {
    context_.complain("native TCP in the clear", slot->peer().text);
    error_code ignored;
    stream.socket().write_some(
        asio::buffer(native_refusal("this server takes other hosts' connections by TLS alone: "
                                    "connect to tls://HOST, with the server's authority.pem")),
        ignored);
    stream.finish();
  }

  void open_http(SignalkSite* site, TcpSocket socket, ConnectionSlotPtr slot) {
    const auto begin = [this, site](PeerStream stream, ConnectionSlotPtr taken) {
      begin_http_session(context_, files_, site, std::move(stream), std::move(taken));
    };
    if (!context_.tls) return begin(PeerStream(std::move(socket)), std::move(slot));
    open_connection(context_, std::move(socket), std::move(slot),
                    {.protocol = "HTTP",
                     .secure = begin,
                     .plain = begin,
                     .patience = context_.config.limits.silent_time});
  }

  void run() {
    // Displays are sent their datagrams at the antenna's pace: before other programs where the
    // system lets it, and after the radars' threads.
    ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), kNiceness);
    try {
      context_.io.run();
    } catch (const std::exception& error) {
      spdlog::critical("the network thread ends: {}", error.what());
      std::terminate();
    }
  }

  void tick() {
    tick_.expires_after(kSettingsPeriod);
    tick_.async_wait([this](error_code error) {
      if (error || closing_) return;
      context_.tell_settings();
      context_.tell_recordings(std::chrono::steady_clock::now());
      signalk_->tick(std::chrono::steady_clock::now());
      context_.connections.check_all(std::chrono::steady_clock::now());
      context_.end_certificates();
      context_.end_views(std::chrono::steady_clock::now());
      context_.tell_own_ships();
      for (const auto& output : target_outputs_) output->tick();
      if (looks_.fetch_add(1, std::memory_order_relaxed) % kSendBufferPeriods == 0) {
        context_.look_at_tokens();
        context_.look_at_tls();
        context_.tell_send_buffers();
      }
      tick();
    });
  }

  NetContext context_;
  asio::executor_work_guard<NetExecutor> work_{context_.io.get_executor()};
  WebFiles files_;
  const OpeningTo native_opening_{
      .protocol = "native TCP",
      .secure = [this](auto stream,
                       auto slot) { begin_native(std::move(stream), std::move(slot)); },
      .plain = [this](auto stream, auto slot) { refuse_native(std::move(stream), slot); },
      .silent = [this](auto stream, auto slot) { refuse_native(std::move(stream), slot); },
      .patience = context_.config.limits.opening_time};
  Listener tcp_;
  Listener http_;
  Timer tick_;
  std::atomic<std::uint64_t> looks_{0};
  std::vector<std::unique_ptr<UdpSender>> senders_;
  std::vector<std::unique_ptr<TargetOutput>> target_outputs_;
  std::optional<DisplayOutputs> displays_;
  std::optional<NavigationPorts> navigation_;
  std::optional<SignalkService> signalk_;
  std::thread thread_;
  bool closing_ = false;  // net-0
  bool stopped_ = false;  // the owner's thread
};

NetServer::NetServer(RadarHost& host, NetConfig config, std::span<const WebFile> web_files)
    : impl_(std::make_unique<Impl>(host, std::move(config), web_files)) {}
NetServer::~NetServer() { stop(); }

void NetServer::start() {
  impl_->start();
  impl_->log_addresses();
}
void NetServer::stop() { impl_->stop(); }
void NetServer::read_certificate() { impl_->read_certificate(); }
std::uint64_t NetServer::looks() const { return impl_->looks(); }
wire::Status NetServer::status() const { return impl_->status(); }
std::uint16_t NetServer::tcp_port() const { return impl_->tcp_port(); }
std::uint16_t NetServer::http_port() const { return impl_->http_port(); }
std::vector<std::uint16_t> NetServer::signalk_ports() const { return impl_->signalk_ports(); }

}  // namespace skerry::server
