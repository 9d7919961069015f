#include "server/net/outputs/stream_outputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <variant>

#include "server/net/common/destination_socket.hpp"
#include "server/net/common/encoders.hpp"

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

SectorEncoder encoder_of(const StreamOutputConfig& config) {
  if (const auto* native = std::get_if<NativeShape>(&config.shape)) return native_encoder(*native);
  Cat240StreamShape shape = std::get<Cat240StreamShape>(config.shape);
  shape.max_datagram = longest_datagram(config.to);
  return cat240_encoder(shape);
}

UdpStream::Cut cut_of(const StreamOutputConfig& config) {
  if (std::holds_alternative<NativeShape>(config.shape)) return UdpStream::Cut::native;
  return std::holds_alternative<BoardRecords>(config.shape) ? UdpStream::Cut::records
                                                            : UdpStream::Cut::cat240;
}

bool have_equal_bytes(const StreamOutputConfig& a, const StreamOutputConfig& b) {
  return a.to.radar == b.to.radar && a.shape == b.shape && !a.own_view && !b.own_view &&
         longest_datagram(a.to) == longest_datagram(b.to);
}

// Adds the format of spokes to the view that the stream shows.
UdpStream spokes_of(NetContext& context, std::size_t number) {
  const auto& streams = context.config.streams;
  const StreamOutputConfig& config = streams[number];
  const auto* native = std::get_if<NativeShape>(&config.shape);
  const auto* cat240 = std::get_if<Cat240StreamShape>(&config.shape);
  UdpStream stream{.cut = cut_of(config), .format = {}, .view = 0};
  if (const auto fault = native != nullptr ? fault_of(*native) : fault_of(*cat240)) {
    fail_stream(config.to, stream, *fault);
  }
  const auto name = [&](std::size_t of) {
    return fmt::format("stream {} ({})", of + 1, native != nullptr ? "native" : "cat240");
  };
  const VideoChannelPtr shared = context.host.find_channel(config.to.radar, 0);
  if (config.own_view) {
    stream.format = name(number);
    const auto view = context.host.open_view(config.to.radar, 0, false, [&](VideoChannel& channel) {
      channel.add_format(kNativeFormat, native_encoder());  // for consoles and the recorder
      channel.add_format(stream.format, encoder_of(config));
    });
    if (!view) {
      fail_stream(config.to, stream, "the radar has as many views as it may; leave out an output");
    }
    stream.view = *view;
  } else if (native != nullptr && *native == NativeShape{}) {
    stream.format = kNativeFormat;
  } else {
    // Streams of equal bytes are encoded once.
    const auto equal = std::find_if(streams.begin(), streams.end(), [&](const auto& other) {
      return have_equal_bytes(other, config);
    });
    const auto first = static_cast<std::size_t>(equal - streams.begin());
    stream.format = name(first);
    if (first == number) shared->add_format(stream.format, encoder_of(config));
  }
  return stream;
}

}  // namespace

std::unique_ptr<UdpSender> open_stream(NetContext& context, std::size_t number) {
  const StreamOutputConfig& config = context.config.streams[number];
  const UdpDestination& to = config.to;
  const bool records = std::holds_alternative<BoardRecords>(config.shape);
  UdpStream stream{.cut = cut_of(config), .format = kRecordsFormat, .view = 0};
  check_radar(context.host, to, stream.name());
  if (records && context.host.find_board(to.radar) == nullptr) {
    fail_stream(to, stream, "that radar has no interface board");
  }
  if (!records) stream = spokes_of(context, number);
  return std::make_unique<UdpSender>(context, to, stream);
}

}  // namespace skerry::server
