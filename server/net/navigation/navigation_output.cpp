#include "server/net/navigation/navigation_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <stdexcept>

#include "protocol/wire/host_and_port.hpp"
#include "server/net/common/destination_socket.hpp"
#include "server/net/common/net_clock.hpp"
#include "server/net/common/output_socket.hpp"

namespace skerry::server {
namespace {

using std::chrono::steady_clock;

// The timer is never set nearer than this.
constexpr std::chrono::milliseconds kShortestWait{2};

[[noreturn]] void fail_output(const NavigationOutputConfig& config, const std::string& reason) {
  throw std::runtime_error(fmt::format("NMEA output of radar {} at {}: {}", config.radar,
                                       host_and_port(config.address, config.port), reason));
}

nmea::Udp450Group group_of(NavigationSentence sentence) {
  using enum NavigationSentence;
  switch (sentence) {
    case ttm:
    case tll:
    case ttd:
    case tlb:
    case alf:
    case alc:
    case alr:
    case vdm:
    case vdo:
      return nmea::Udp450Group::targets;
    case hdt:
    case ths:
    case rot:
      return nmea::Udp450Group::fast;
    case zda:
      return nmea::Udp450Group::time;
    default:
      return nmea::Udp450Group::navigation;
  }
}

asio::ip::udp::endpoint udp_endpoint_of(const Ipv4Endpoint& at) {
  return {asio::ip::address_v4(at.address), at.port};
}

// Lines that go together into datagrams.
std::vector<Bytes> packed(const std::vector<std::string>& lines) {
  std::vector<Bytes> datagrams;
  for (const std::string& line : lines) {
    if (datagrams.empty() || datagrams.back().size() + line.size() > nmea::kMostUdp450) {
      datagrams.emplace_back();
    }
    datagrams.back().insert(datagrams.back().end(), line.begin(), line.end());
  }
  return datagrams;
}

}  // namespace

class NavigationOutput::World final : public NavigationWorld {
 public:
  World(NetContext& context, std::uint32_t radar)
      : context_(context), host_(context.host), radar_(radar) {}
  wire::OwnShip own_ship() const override { return context_.sensed_own_ship(radar_); }
  wire::Settings settings() const override { return host_.settings(radar_, 0); }
  std::vector<TrafficItem> traffic() const override {
    std::vector<TrafficItem> all = host_.traffic();
    std::erase_if(all, [this](const TrafficItem& item) {
      return std::find(item.radars.begin(), item.radars.end(), radar_) != item.radars.end();
    });
    return all;
  }

  TargetListPtr targets() const override {
    TargetPort* port = host_.targets();
    return port == nullptr ? nullptr : port->targets(radar_, 0);
  }

 private:
  const NetContext& context_;
  RadarHost& host_;
  std::uint32_t radar_;
};

NavigationOutput::NavigationOutput(NetContext& context, const NavigationOutputConfig& config)
    : context_(context),
      config_(config),
      world_(std::make_shared<const World>(context, config.radar)),
      talker_(config.plan),
      encoder_(config.source),
      socket_(context.io),
      timer_(context.io) {
  if (context.host.find_channel(config.radar, 0) == nullptr) {
    fail_output(config, fmt::format("there is no such radar; there are {}, counted from 0",
                                    context.host.radar_count()));
  }
  if (const auto fault = fault_in(config.plan)) fail_output(config, *fault);
  for (const TrafficItem& other : world_->traffic()) {
    if (config.plan.own_mmsi == 0 || other.mmsi != config.plan.own_mmsi) continue;
    fail_output(
        config,
        fmt::format("own_mmsi {} is also that of {}: they would be one vessel to every receiver; "
                    "give another number, or leave it out and own ship has one of her own",
                    other.mmsi, other.name.empty() ? "a target" : '"' + other.name + '"'));
  }
  if (config.multicast_ttl < 0 || config.multicast_ttl > 255) {
    fail_output(config, fmt::format("multicast TTL {} is not 0 to 255", config.multicast_ttl));
  }
  if (!nmea::is_udp450_source(config.source)) {
    fail_output(config, fmt::format("the source \"{}\" is not two capital letters and four digits",
                                    config.source));
  }
  if (config.max_connections < 1 || config.max_connections > kMostNavigationConnections) {
    fail_output(config, fmt::format("{} connections are not 1 to {}", config.max_connections,
                                    kMostNavigationConnections));
  }
  open();
  wire::OutputStatus status;
  status.set_name(config.transport == NavigationTransport::tcp      ? "nmea_tcp"
                  : config.transport == NavigationTransport::iec450 ? "nmea_450"
                                                                    : "nmea_udp");
  status.set_radar(config.radar);
  status.set_address(address());
  status.set_interface_address(config.interface_address);
  counters_ = context.outputs.add(std::move(status));
}

void NavigationOutput::open() {
  const bool to_groups =
      config_.transport == NavigationTransport::iec450 && config_.address.empty();
  error_code error;
  const auto address =
      asio::ip::make_address_v4(to_groups ? "239.192.0.1" : config_.address, error);
  if (error) fail_output(config_, "the address must be an IPv4 literal");
  if (config_.transport == NavigationTransport::tcp) {
    lines_ = std::make_unique<LineServer>(
        context_,
        ListenAddress{.protocol = "NMEA output",
                      .address = config_.address,
                      .port = config_.port,
                      .option = "the output's port"},
        config_.max_connections,
        LineServer::Handlers{.admits = {},
                             .on_line = {},
                             .on_sent =
                                 [this](std::size_t lines, std::size_t bytes, bool sent) {
                                   auto& counter =
                                       sent ? counters_->reports : counters_->datagrams_unsent;
                                   counter.fetch_add(lines, std::memory_order_relaxed);
                                   if (sent)
                                     counters_->bytes.fetch_add(bytes, std::memory_order_relaxed);
                                 },
                             .on_overlong = {}});
    return;
  }
  if (!to_groups) {
    if (config_.port == 0) fail_output(config_, "the port must be 1 to 65535");
    endpoint_ = {address, config_.port};
  }
  try {
    if (address.is_multicast()) {
      const auto from = asio::ip::make_address_v4(config_.interface_address, error);
      if (error) fail_output(config_, "the interface must be given by its IPv4 address");
      socket_ = open_sending(context_.io, from, config_.multicast_ttl);
    } else {
      socket_.open(asio::ip::udp::v4());
      socket_.set_option(asio::socket_base::broadcast(config_.broadcast));
      // Asks the system whether it may be sent there; a network that is down may come up later.
      socket_.connect(*endpoint_, error);
      if (error == asio::error::access_denied) {
        fail_output(config_, "that is a broadcast address; allow it with `broadcast`");
      }
    }
  } catch (const boost::system::system_error& problem) {
    fail_output(config_, problem.code().message());
  } catch (const std::runtime_error& problem) {
    fail_output(config_, problem.what());
  }
}

std::string NavigationOutput::address() const {
  if (lines_) return host_and_port(config_.address, lines_->port());
  if (!endpoint_) return "239.192.0.x";
  return host_and_port(config_.address, config_.port);
}

void NavigationOutput::start() {
  if (TargetPort* port = context_.host.targets(); port != nullptr && needs_plotter(config_.plan)) {
    wanted_targets_ = port->want(config_.radar, 0);
  }
  if (lines_) lines_->start();
  tick();
}

void NavigationOutput::close() {
  closed_ = true;
  timer_.cancel();
  if (lines_) lines_->close();
  error_code ignored;
  socket_.close(ignored);
}

void NavigationOutput::tick() {
  if (closed_) return;
  for (const NavigationMessage& message :
       talker_.due(scenario_time(steady_clock::now()), *world_)) {
    send(message);
  }
  const auto due = steady_clock::time_point(
      std::chrono::duration_cast<steady_clock::duration>(talker_.next_due().time_since_epoch()));
  timer_.expires_at(std::clamp(due, steady_clock::now() + kShortestWait,
                               steady_clock::now() + kLongestNavigationPeriod));
  timer_.async_wait([this](error_code error) {
    if (!error) tick();
  });
}

void NavigationOutput::send(const NavigationMessage& message) {
  if (lines_) return lines_->send(message.lines);
  const auto to = endpoint_for(message.sentence);
  const std::vector<Bytes> datagrams = config_.transport == NavigationTransport::iec450
                                           ? encoder_.encode(message.lines)
                                           : packed(message.lines);
  for (const Bytes& datagram : datagrams) send_datagram(to, datagram);
}

asio::ip::udp::endpoint NavigationOutput::endpoint_for(NavigationSentence sentence) const {
  return endpoint_ ? *endpoint_ : udp_endpoint_of(nmea::address_of(group_of(sentence)));
}

void NavigationOutput::send_datagram(const asio::ip::udp::endpoint& to,
                                     std::span<const std::uint8_t> bytes) {
  const int error = send_at_once(socket_, to, bytes);
  if (error == 0) {
    counters_->reports.fetch_add(1, std::memory_order_relaxed);
    counters_->bytes.fetch_add(bytes.size(), std::memory_order_relaxed);
    return;
  }
  counters_->datagrams_unsent.fetch_add(1, std::memory_order_relaxed);
  if (error == ECONNREFUSED) return;  // nobody listens there, or not yet
  context_.errors.add("nmea send", fmt::format("{}: {}", address(), std::strerror(error)));
}

}  // namespace skerry::server
