#include "server/net/net_server.hpp"

#include <google/protobuf/stubs/logging.h>
#include <pthread.h>
#include <spdlog/spdlog.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
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
#include "server/net/http/http_session.hpp"
#include "server/net/http/web_answer.hpp"
#include "server/net/native/byte_transport.hpp"
#include "server/net/native/native_session.hpp"
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

// The native protocol straight on TCP.
class TcpTransport final : public ByteTransport {
 public:
  explicit TcpTransport(TcpSocket socket) : socket_(std::move(socket)) {
    set_stream_options(socket_);
    error_code ignored;
    socket_.non_blocking(true,
                         ignored);  // for write_now(); asynchronous operations wait all the same
  }

  void read_some(std::span<std::uint8_t> into, Done done) override {
    socket_.async_read_some(asio::buffer(into.data(), into.size()), std::move(done));
  }
  void write(const std::vector<asio::const_buffer>& buffers, Done done) override {
    asio::async_write(socket_, buffers, std::move(done));
  }
  std::size_t write_now(const std::vector<asio::const_buffer>& buffers) override {
    error_code ignored;
    // send() is cheaper than sendmsg(), and most writes are of one sector.
    return buffers.size() == 1 ? socket_.write_some(buffers.front(), ignored)
                               : socket_.write_some(buffers, ignored);
  }
  void finish() override {
    error_code ignored;
    socket_.shutdown(asio::socket_base::shutdown_send, ignored);
  }
  void close() override {
    error_code ignored;
    socket_.close(ignored);
  }
  void limit_send_buffer(std::size_t bytes) override { set_send_buffer(socket_, bytes); }

  std::string name() const override { return "tcp"; }

 private:
  TcpSocket socket_;
};

std::unique_ptr<ByteTransport> make_tcp_transport(TcpSocket socket) {
  return std::make_unique<TcpTransport>(std::move(socket));
}

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
              NativeSession::begin(context_, make_tcp_transport(std::move(socket)),
                                   std::move(slot));
            },
            native_refusal),
        http_(
            context_,
            {.protocol = "HTTP",
             .address = context_.config.bind,
             .port = context_.config.http_port,
             .option = "--http-port"},
            [this](TcpSocket socket, ConnectionSlotPtr slot) {
              serve_http(signalk_->first(), std::move(socket), std::move(slot));
            },
            http_refusal),
        tick_(context_.io) {
    // Text fields that are not UTF-8 make parsing fail; protobuf would also write every such
    // message of a stranger to the log.
    google::protobuf::SetLogHandler(nullptr);
    for (std::uint32_t radar = 0; radar < host.radar_count(); ++radar) {
      for (const RadarHost::View& view : host.views(radar)) {
        view.channel->add_format(kNativeFormat, native_encoder());
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
      serve_http(&site, std::move(socket), std::move(slot));
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

  void log_addresses() const {
    const NetConfig& config = context_.config;
    spdlog::info("native TCP on {} port {}, HTTP and WebSocket on port {}", config.bind, tcp_port(),
                 http_port());
    error_code error;
    if (is_loopback(asio::ip::make_address(config.bind, error))) return;
    if (context_.gate.is_closed()) {
      spdlog::info("other hosts need a token{}{}",
                   config.tokens.empty() ? "" : " of " + config.tokens,
                   config.users.empty() ? "" : ", or sign in as a user of " + config.users);
    } else if (config.control_token.empty()) {
      spdlog::info("other hosts may look but not control: no control token is configured");
    }
  }

  wire::Status status() const { return context_.status(); }
  std::uint16_t tcp_port() const { return tcp_.port(); }
  std::uint16_t http_port() const { return http_.port(); }
  std::vector<std::uint16_t> signalk_ports() const { return signalk_->further_ports(); }

 private:
  void serve_http(SignalkSite* site, TcpSocket socket, ConnectionSlotPtr slot) {
    begin_http_session(context_, files_, site, std::move(socket), std::move(slot));
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
      context_.end_views(std::chrono::steady_clock::now());
      context_.tell_own_ships();
      for (const auto& output : target_outputs_) output->tick();
      if (++ticks_ % kSendBufferPeriods == 0) {
        context_.look_at_tokens();
        context_.tell_send_buffers();
      }
      tick();
    });
  }

  NetContext context_;
  asio::executor_work_guard<NetExecutor> work_{context_.io.get_executor()};
  WebFiles files_;
  Listener tcp_;
  Listener http_;
  Timer tick_;
  int ticks_ = 0;
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
wire::Status NetServer::status() const { return impl_->status(); }
std::uint16_t NetServer::tcp_port() const { return impl_->tcp_port(); }
std::uint16_t NetServer::http_port() const { return impl_->http_port(); }
std::vector<std::uint16_t> NetServer::signalk_ports() const { return impl_->signalk_ports(); }

}  // namespace skerry::server
