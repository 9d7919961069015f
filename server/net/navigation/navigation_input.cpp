#include "server/net/navigation/navigation_input.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <stdexcept>

#include "protocol/nmea/udp450.hpp"
#include "protocol/wire/host_and_port.hpp"
#include "server/navigation/con_orders.hpp"
#include "server/net/common/net_clock.hpp"
#include "server/net/common/output_socket.hpp"
#include "server/net/common/tcp_peer.hpp"

namespace skerry::server {
namespace {

using std::chrono::steady_clock;

// Between two lines about jumps in the log.
constexpr std::chrono::seconds kJumpPause{1};

[[noreturn]] void fail_input(const NavigationInputConfig& config, const std::string& reason) {
  throw std::runtime_error(fmt::format("NMEA input of radar {} at {}: {}", config.radar,
                                       host_and_port(config.address, config.port), reason));
}

asio::ip::network_v4 network_of(const NavigationInputConfig& config, const std::string& text) {
  error_code error;
  const auto network = text.find('/') == std::string::npos
                           ? asio::ip::network_v4(asio::ip::make_address_v4(text, error), 32)
                           : asio::ip::make_network_v4(text, error);
  if (error) {
    fail_input(config, fmt::format("the source \"{}\" is no IPv4 address or network", text));
  }
  return network;
}

}  // namespace

NavigationInput::NavigationInput(NetContext& context, const NavigationInputConfig& config)
    : context_(context),
      config_(config),
      listener_(RadarHost::kDriveTimeout),
      socket_(context.io),
      timer_(context.io) {
  if (context.host.find_channel(config.radar, 0) == nullptr) {
    fail_input(config, fmt::format("there is no such radar; there are {}, counted from 0",
                                   context.host.radar_count()));
  }
  if (config.max_connections < 1 || config.max_connections > kMostNavigationConnections) {
    fail_input(config, fmt::format("{} connections are not 1 to {}", config.max_connections,
                                   kMostNavigationConnections));
  }
  for (const std::string& source : config.sources) sources_.push_back(network_of(config, source));
  open();
  wire::OutputStatus status;
  status.set_name("nmea_input");
  status.set_radar(config.radar);
  status.set_address(host_and_port(config.address, port()));
  status.set_interface_address(config.interface_address);
  counters_ = context.outputs.add(std::move(status));
}

void NavigationInput::open() {
  error_code error;
  const auto address = asio::ip::make_address_v4(config_.address, error);
  if (error) fail_input(config_, "the address must be an IPv4 literal");
  if (config_.transport == NavigationTransport::tcp) {
    lines_server_ = std::make_unique<LineServer>(
        context_,
        ListenAddress{.protocol = "NMEA input",
                      .address = config_.address,
                      .port = config_.port,
                      .option = "the input's port"},
        config_.max_connections,
        LineServer::Handlers{
            .admits = [this](const asio::ip::address& from) { return admits(from); },
            .on_line =
                [this](std::string_view line, const std::string& peer) {
                  counters_->commands.fetch_add(1, std::memory_order_relaxed);
                  return take_line(line, peer);
                },
            .on_sent = {},
            .on_overlong = [this] { refuse("nmea input fault", "a line without an end"); }});
    return;
  }
  try {
    if (address.is_multicast()) {
      const auto interface = asio::ip::make_address_v4(config_.interface_address, error);
      if (error) fail_input(config_, "the interface must be given by its IPv4 address");
      socket_ = open_listening(context_.io, {{address.to_uint(), config_.port}}, interface);
    } else {
      socket_.open(asio::ip::udp::v4());
      socket_.bind({address, config_.port});
      socket_.non_blocking(true);
    }
  } catch (const boost::system::system_error& problem) {
    fail_input(config_, problem.code().message());
  } catch (const std::runtime_error& problem) {
    fail_input(config_, problem.what());
  }
}

std::uint16_t NavigationInput::port() const {
  return lines_server_ ? lines_server_->port() : socket_.local_endpoint().port();
}

void NavigationInput::start() {
  if (lines_server_) {
    lines_server_->start();
  } else {
    wait_for_datagrams();
  }
  tick();
}

void NavigationInput::close() {
  closed_ = true;
  timer_.cancel();
  if (lines_server_) lines_server_->close();
  error_code ignored;
  socket_.close(ignored);
}

void NavigationInput::tick() {
  lines_left_ = kLines;
  datagrams_left_ = kDatagrams;
  if (is_paused_) {
    is_paused_ = false;
    wait_for_datagrams();
  }
  if (is_driving_ && steady_clock::now() - last_fix_ > RadarHost::kDriveTimeout) {
    is_driving_ = false;
    spdlog::info("own ship of radar {}: nothing more comes in at {}; she goes her own way",
                 config_.radar, host_and_port(config_.address, port()));
  }
  timer_.expires_after(kWindow);
  timer_.async_wait([this](error_code error) {
    if (!error && !closed_) tick();
  });
}

void NavigationInput::wait_for_datagrams() {
  socket_.async_wait(UdpSocket::wait_read, [this](error_code error) {
    if (!error && !closed_) take_datagrams();
  });
}

void NavigationInput::take_datagrams() {
  // Others on this thread have their turn in between.
  constexpr int kAtOnce = 64;
  for (int i = 0; i < kAtOnce; ++i) {
    if (datagrams_left_ == 0) {
      is_paused_ = true;
      return;
    }
    asio::ip::udp::endpoint from;
    error_code error;
    const std::size_t size = socket_.receive_from(asio::buffer(buffer_), from, 0, error);
    if (error == asio::error::would_block) break;
    if (error) {
      context_.errors.add("nmea input receive", error.message());
      break;
    }
    --datagrams_left_;
    counters_->commands.fetch_add(1, std::memory_order_relaxed);
    if (!admits(from.address())) {
      refuse("nmea input source",
             fmt::format("{} is not among the sources of {}", from.address().to_string(),
                         host_and_port(config_.address, port())));
      continue;
    }
    take_datagram(std::string_view(buffer_.data(), size),
                  host_and_port(from.address().to_string(), from.port()));
  }
  wait_for_datagrams();
}

void NavigationInput::take_datagram(std::string_view bytes, const std::string& source) {
  const std::span raw(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  if (nmea::is_udp450(raw)) {
    const auto lines = nmea::decode_udp450(raw);
    if (!lines)
      return refuse("nmea input fault", fmt::format("{}: {}", source, lines.error().text));
    for (const nmea::TaggedLine& line : *lines) take_line(line.sentence, source);
    return;
  }
  while (!bytes.empty()) {
    const std::size_t end = std::min(bytes.find_first_of("\r\n"), bytes.size());
    if (end > 0) take_line(bytes.substr(0, end), source);
    bytes.remove_prefix(std::min(end + 1, bytes.size()));
  }
}

bool NavigationInput::take_line(std::string_view line, const std::string& source) {
  if (lines_left_ == 0) {
    counters_->commands_dropped.fetch_add(1, std::memory_order_relaxed);
    return false;
  }
  --lines_left_;
  const HeardLine heard = listener_.hear(line, scenario_time(steady_clock::now()));
  if (!heard.fault.empty()) {
    refuse("nmea input fault", fmt::format("{}: {}", source, heard.fault));
  } else if (heard.fix) {
    drive(heard, source);
  } else if (heard.command) {
    command(*heard.command, source);
  } else if (heard.alert_order) {
    order_alerts(*heard.alert_order, source);
  }
  return true;
}

void NavigationInput::command(const nmea::ConCommand& command, const std::string& source) {
  wire::Set set;
  set.set_radar(config_.radar);
  *set.mutable_con() = con_order_of(command);
  if (set.con().ByteSizeLong() == 0) return;
  const wire::Reply reply = context_.apply(set, "NMEA " + source);
  if (reply.code() != wire::Reply::OK) {
    return refuse("nmea input refused", fmt::format("{}: {}", source, reply.text()));
  }
  counters_->set_last_display(source);
}

void NavigationInput::order_alerts(wire::TargetOrder order, const std::string& source) {
  order.set_radar(config_.radar);
  const wire::Reply reply = context_.order(order, "NMEA " + source);
  if (reply.code() != wire::Reply::OK) {
    return refuse("nmea input refused", fmt::format("{}: {}", source, reply.text()));
  }
  counters_->set_last_display(source);
}

void NavigationInput::drive(const HeardLine& heard, const std::string& source) {
  if (const auto refusal = context_.host.drive(config_.radar, *heard.fix)) {
    return refuse("nmea input refused", fmt::format("{}: {}", source, *refusal));
  }
  const auto now = steady_clock::now();
  last_fix_ = now;
  if (!is_driving_) {
    is_driving_ = true;
    spdlog::info("own ship of radar {} is driven by {}", config_.radar, source);
  }
  counters_->set_last_display(source);
  if (!heard.jump_m) return;
  const std::string text = fmt::format("own ship of radar {} is put {:.0f} m away by {}",
                                       config_.radar, *heard.jump_m, source);
  context_.errors.add("nmea input jump", text);  // which tells the log of the first
  if (++jumps_ > 1 && now - jump_told_ < kJumpPause) return;
  jump_told_ = now;
  if (jumps_ > 1) spdlog::warn("{}", text);
}

void NavigationInput::refuse(std::string_view kind, const std::string& text) {
  counters_->commands_refused.fetch_add(1, std::memory_order_relaxed);
  context_.errors.add(kind, text);
}

bool NavigationInput::admits(const asio::ip::address& source) const {
  if (sources_.empty()) return is_loopback(source);
  if (!source.is_v4()) return false;
  const std::uint32_t address = source.to_v4().to_uint();
  return std::any_of(sources_.begin(), sources_.end(), [&](const asio::ip::network_v4& network) {
    return (address & network.netmask().to_uint()) == network.network().to_uint();
  });
}

}  // namespace skerry::server
