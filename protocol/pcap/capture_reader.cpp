#include "protocol/pcap/capture_reader.hpp"

#include <fmt/format.h>
#include <pcap/pcap.h>

#include <cstdio>
#include <memory>
#include <optional>

#include "protocol/pcap/capture_stream.hpp"
#include "protocol/pcap/ipv4_fragments.hpp"
#include "protocol/wire/byte_order.hpp"

namespace skerry::pcap {
namespace {

constexpr std::uint16_t kEtherIpv4 = 0x0800;
constexpr std::uint16_t kEtherVlan = 0x8100, kEtherServiceVlan = 0x88A8;

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
struct ClosePcap {
  void operator()(pcap_t* pcap) const { pcap_close(pcap); }
};

// The IPv4 packet in a frame of a link of that kind; nothing if it holds something else.
std::optional<std::span<const std::uint8_t>> find_ipv4(int link,
                                                       std::span<const std::uint8_t> frame) {
  ByteReader in(frame);
  std::uint16_t ether = kEtherIpv4;
  switch (link) {
    case DLT_EN10MB:
      in.take(12);
      ether = in.big_endian<std::uint16_t>();
      while (ether == kEtherVlan || ether == kEtherServiceVlan) {
        in.take(2);
        ether = in.big_endian<std::uint16_t>();
      }
      break;
    case DLT_LINUX_SLL:
      in.take(14);
      ether = in.big_endian<std::uint16_t>();
      break;
    case DLT_LINUX_SLL2:
      ether = in.big_endian<std::uint16_t>();
      in.take(18);
      break;
    case DLT_NULL:
    case DLT_LOOP:
      in.take(4);  // an address family, whose number and byte order differ between systems
      break;
    case DLT_RAW:
    case DLT_IPV4:
      break;
    default:
      return std::nullopt;
  }
  const auto packet = in.take(in.left());
  if (in.truncated() || ether != kEtherIpv4 || packet.empty() || packet[0] >> 4 != 4) {
    return std::nullopt;
  }
  return packet;
}

class FrameReader {
 public:
  explicit FrameReader(const std::function<void(const Datagram&)>& sink) : sink_(sink) {}

  void read(int link, UtcTime time, std::span<const std::uint8_t> frame) {
    ++counts_.frames;
    const auto packet = find_ipv4(link, frame);
    if (!packet || packet->size() < 20 || (*packet)[9] != kProtocolUdp) {
      ++counts_.others;
      return;
    }
    read_packet(time, *packet);
  }

  CaptureCounts counts() const {
    CaptureCounts counts = counts_;
    counts.incomplete += fragments_.given_up() + fragments_.pending();
    return counts;
  }

 private:
  void read_packet(UtcTime time, std::span<const std::uint8_t> packet) {
    ByteReader in(packet);
    const std::size_t header = (in.octet() & 0x0Fu) * 4u;
    in.take(1);
    const std::size_t total = in.big_endian<std::uint16_t>();
    const auto identification = in.big_endian<std::uint16_t>();
    const auto fragment = in.big_endian<std::uint16_t>();
    in.take(4);
    Datagram datagram{};
    datagram.time = time;
    datagram.from.address = in.big_endian<std::uint32_t>();
    datagram.to.address = in.big_endian<std::uint32_t>();
    if (header < 20 || total < header || total > packet.size()) {
      ++counts_.incomplete;
      return;
    }
    const auto payload = packet.subspan(header, total - header);
    const bool more = (fragment & 0x2000) != 0;
    const std::size_t offset = (fragment & 0x1FFFu) * 8u;
    if (!more && offset == 0) {
      give(datagram, payload);
    } else if (const auto whole = fragments_.add(
                   {datagram.from.address, datagram.to.address, identification, kProtocolUdp},
                   offset, more, payload)) {
      give(datagram, *whole);
    }
  }

  void give(Datagram& datagram, std::span<const std::uint8_t> udp) {
    ByteReader in(udp);
    datagram.from.port = in.big_endian<std::uint16_t>();
    datagram.to.port = in.big_endian<std::uint16_t>();
    const std::size_t length = in.big_endian<std::uint16_t>();
    in.take(2);
    if (in.truncated() || length < 8 || length > udp.size()) {
      ++counts_.incomplete;
      return;
    }
    ++counts_.datagrams;
    datagram.payload = udp.subspan(8, length - 8);
    sink_(datagram);
  }

  const std::function<void(const Datagram&)>& sink_;
  Ipv4Fragments fragments_{kMaxPending};
  CaptureCounts counts_;
};

WireError wrong(WireErrorKind kind, std::size_t offset, const char* why) {
  return {kind, offset, fmt::format("capture: {}", why)};
}

// `size`: of the file, as far as it is known; takes the stream over.
Result<CaptureCounts, WireError> read_stream(std::unique_ptr<std::FILE, CloseFile> stream,
                                             std::size_t size,
                                             const std::function<void(const Datagram&)>& sink) {
  char why[PCAP_ERRBUF_SIZE] = "no memory";
  pcap_t* const opened = stream ? pcap_fopen_offline_with_tstamp_precision(
                                      stream.get(), PCAP_TSTAMP_PRECISION_NANO, why)
                                : nullptr;
  if (opened == nullptr) {
    return Failure{wrong(size < 24 ? WireErrorKind::truncated : WireErrorKind::malformed, 0, why)};
  }
  (void)stream.release();  // pcap_close() closes it
  const std::unique_ptr<pcap_t, ClosePcap> pcap(opened);
  const int link = pcap_datalink(pcap.get());

  FrameReader reader(sink);
  for (;;) {
    const long at = std::ftell(pcap_file(pcap.get()));
    pcap_pkthdr* header = nullptr;
    const std::uint8_t* bytes = nullptr;
    const int got = pcap_next_ex(pcap.get(), &header, &bytes);
    if (got == PCAP_ERROR_BREAK) return reader.counts();  // the end of the file
    if (got != 1) {
      const bool cut = std::feof(pcap_file(pcap.get())) != 0;
      return Failure{wrong(cut ? WireErrorKind::truncated : WireErrorKind::malformed,
                           static_cast<std::size_t>(at < 0 ? 0 : at), pcap_geterr(pcap.get()))};
    }
    // In nanoseconds, as asked for.  Seconds beyond the year 2262 wrap instead of overflowing.
    const auto ns = static_cast<std::uint64_t>(header->ts.tv_sec) * 1'000'000'000u +
                    static_cast<std::uint64_t>(header->ts.tv_usec);
    reader.read(link, UtcTime(Duration(static_cast<std::int64_t>(ns))), {bytes, header->caplen});
  }
}

}  // namespace

Result<CaptureCounts, WireError> read_capture(std::span<const std::uint8_t> file,
                                              const std::function<void(const Datagram&)>& sink) {
  if (file.empty()) return Failure{wrong(WireErrorKind::truncated, 0, "the file is empty")};
  // fmemopen() takes a writable buffer even for reading.
  return read_stream(std::unique_ptr<std::FILE, CloseFile>(
                         fmemopen(const_cast<std::uint8_t*>(file.data()), file.size(), "rb")),
                     file.size(), sink);
}

Result<CaptureCounts, WireError> read_capture_file(const std::string& path,
                                                   const std::function<void(const Datagram&)>& sink,
                                                   const std::function<bool(double)>& progress) {
  CaptureStream stream(path, progress);
  if (!stream.problem().empty()) {
    return Failure{wrong(WireErrorKind::malformed, 0, stream.problem().c_str())};
  }
  auto counts =
      read_stream(std::unique_ptr<std::FILE, CloseFile>(stream.release()), stream.size(), sink);
  if (!stream.problem().empty()) {
    return Failure{wrong(WireErrorKind::truncated, stream.position(), stream.problem().c_str())};
  }
  return counts;
}

}  // namespace skerry::pcap
