#include "server/net/net_server.hpp"

#include <google/protobuf/stubs/logging.h>
#include <pthread.h>
#include <spdlog/spdlog.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <exception>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "server/net/common/encoders.hpp"
#include "server/net/common/listener.hpp"
#include "server/net/common/tcp_peer.hpp"
#include "server/net/http/http_session.hpp"
#include "server/net/native/native_session.hpp"
#include "server/net/native/tcp_transport.hpp"
#include "server/net/navigation/navigation_desk.hpp"
#include "server/net/outputs/display_desk.hpp"
#include "server/net/outputs/stream_outputs.hpp"
#include "server/net/outputs/udp_sender.hpp"
#include "server/net/signalk/signalk_service.hpp"

namespace skerry::server {
namespace {

constexpr std::chrono::milliseconds kSettingsPeriod{100};
constexpr int kOwnShipPeriods = 10;  // own ship once a second
constexpr int kNiceness = -5;

const UdpStream kNative{.cut = UdpStream::Cut::native, .format = kNativeFormat};
const UdpStream kCat240{.cut = UdpStream::Cut::cat240, .format = kCat240Format};
const UdpStream kSweeps{.cut = UdpStream::Cut::records, .format = kRecordsFormat};

void add_formats(RadarHost& host, Cat240Source source) {
  for (std::uint32_t radar = 0; radar < host.radar_count(); ++radar) {
    for (const RadarHost::View& view : host.views(radar)) {
      if (view.number != 0) {  // recorded
        view.channel->add_format(kNativeFormat, native_encoder());
        continue;
      }
      add_network_formats(
          *view.channel, {.sac = source.sac, .sic = static_cast<std::uint8_t>(source.sic + radar)});
    }
  }
}

}  // namespace

class NetServer::Impl {
 public:
  Impl(RadarHost& host, NetConfig config, std::span<const WebFile> web_files)
      : context_(host, std::move(config)),
        files_(web_files, context_.config.web_root),
        tcp_(context_,
             {.protocol = "native TCP",
              .address = context_.config.bind,
              .port = context_.config.tcp_port,
              .option = "--tcp-port"},
             [this](TcpSocket socket, ConnectionSlotPtr slot) {
               NativeSession::begin(context_, make_tcp_transport(std::move(socket)),
                                    std::move(slot));
             }),
        http_(context_,
              {.protocol = "HTTP",
               .address = context_.config.bind,
               .port = context_.config.http_port,
               .option = "--http-port"},
              [this](TcpSocket socket, ConnectionSlotPtr slot) {
                serve_http(signalk_->first(), std::move(socket), std::move(slot));
              }),
        tick_(context_.io) {
    // Text fields that are not UTF-8 make parsing fail; protobuf would also write every such
    // message of a stranger to the log.
    google::protobuf::SetLogHandler(nullptr);
    add_formats(host, context_.config.cat240_source);
    for (const UdpDestination& to : context_.config.udp) add_sender(to, kNative);
    for (const UdpDestination& to : context_.config.cat240) add_sender(to, kCat240);
    for (const UdpDestination& to : context_.config.sweeps) add_sender(to, kSweeps);
    for (std::size_t i = 0; i < context_.config.streams.size(); ++i) {
      const StreamOutputConfig& stream = context_.config.streams[i];
      add_sender(stream.to, open_stream(context_, stream, i));
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

  void add_sender(const UdpDestination& to, const UdpStream& stream) {
    auto sender = std::make_shared<UdpSender>(context_, to, stream);
    asio::post(context_.io, [this, sender] {
      if (closing_) return;
      sender->start();
      senders_.push_back(sender);
    });
  }

  void log_addresses() const {
    const NetConfig& config = context_.config;
    spdlog::info("native TCP on {} port {}, HTTP and WebSocket on port {}", config.bind, tcp_port(),
                 http_port());
    error_code error;
    if (!is_loopback(asio::ip::make_address(config.bind, error)) && config.control_token.empty()) {
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
      context_.end_views(std::chrono::steady_clock::now());
      if (++ticks_ % kOwnShipPeriods == 0) {
        context_.tell_own_ships();
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
  std::vector<std::shared_ptr<UdpSender>> senders_;
  std::optional<DisplayDesk> displays_;
  std::optional<NavigationDesk> navigation_;
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
void NetServer::add_udp_destination(const UdpDestination& destination) {
  impl_->add_sender(destination, kNative);
}
void NetServer::add_cat240_destination(const UdpDestination& destination) {
  impl_->add_sender(destination, kCat240);
}
void NetServer::add_sweeps_destination(const UdpDestination& destination) {
  impl_->add_sender(destination, kSweeps);
}

}  // namespace skerry::server
