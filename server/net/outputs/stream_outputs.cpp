#include "server/net/outputs/stream_outputs.hpp"

#include <fmt/format.h>

#include <optional>
#include <stdexcept>
#include <variant>

#include "server/net/common/encoders.hpp"
#include "server/net/common/tcp_peer.hpp"

namespace skerry::server {
namespace {

std::optional<std::string> outside(const char* what, std::uint64_t value, std::uint64_t least,
                                   std::uint64_t most) {
  if (value == 0 || (value >= least && value <= most)) return std::nullopt;
  return fmt::format("{} {} is not 0 (as the radar has them) or {} to {}", what, value, least,
                     most);
}

std::optional<std::string> fault_of(const NativeShape& shape) {
  if (auto fault = outside("spokes", shape.turn_spokes, ScanGeometry::kMinSpokes,
                           ScanGeometry::kMaxSpokes)) {
    return fault;
  }
  if (auto fault =
          outside("cells", shape.cells, ScanGeometry::kMinCells, ScanGeometry::kMaxCells)) {
    return fault;
  }
  if (shape.bits == 0 || shape.bits == 4 || shape.bits == 8) return std::nullopt;
  return fmt::format("{} bits are not 4 or 8", shape.bits);
}

std::optional<std::string> fault_of(const Cat240StreamShape& shape) {
  if (auto fault = outside("spokes", shape.turn_spokes, 1, 8192)) return fault;
  if (auto fault = outside("cells", shape.cells, 1, 8192)) return fault;
  if (shape.records < 1 || shape.records > 64) {
    return fmt::format("{} records to a datagram are not 1 to 64", shape.records);
  }
  return std::nullopt;
}

// What goes into one datagram of CAT240, if that is left to the server.
std::size_t longest_block(const UdpDestination& to) {
  if (to.max_datagram != 0) return to.max_datagram;
  error_code error;
  const auto address = asio::ip::make_address(to.address, error);
  return !error && is_loopback(address) ? kMaxDatagram : kDefaultDatagram;
}

SectorEncoder encoder_of(const StreamOutputConfig& config) {
  if (const auto* native = std::get_if<NativeShape>(&config.shape)) return native_encoder(*native);
  Cat240StreamShape shape = std::get<Cat240StreamShape>(config.shape);
  shape.max_datagram = longest_block(config.to);
  return cat240_encoder(shape);
}

}  // namespace

UdpStream open_stream(NetContext& context, const StreamOutputConfig& config, std::size_t number) {
  const bool native = std::holds_alternative<NativeShape>(config.shape);
  const std::string name = fmt::format("stream {} ({})", number + 1, native ? "native" : "cat240");
  const auto fail = [&](const std::string& reason) {
    throw std::runtime_error(name + ": " + reason);
  };
  const auto fault = std::visit([](const auto& shape) { return fault_of(shape); }, config.shape);
  if (fault) fail(*fault);
  const VideoChannelPtr shared = context.host.find_channel(config.to.radar, 0);
  if (shared == nullptr) {
    fail(fmt::format("there is no radar {}; there are {}, counted from 0", config.to.radar,
                     context.host.radar_count()));
  }
  UdpStream stream{
      .cut = native ? UdpStream::Cut::native : UdpStream::Cut::cat240, .format = name, .view = 0};
  if (!config.own_view) {
    shared->add_format(name, encoder_of(config));
    return stream;
  }
  const auto view = context.host.open_view(config.to.radar, 0, false, [&](VideoChannel& channel) {
    channel.add_format(kNativeFormat, native_encoder());  // as it is looked at and recorded
    channel.add_format(name, encoder_of(config));
  });
  if (!view) {
    fail(fmt::format("radar {} has as many views as it may; leave out an output", config.to.radar));
  }
  stream.view = *view;
  return stream;
}

}  // namespace skerry::server
