// UdpSender: sends one radar's spokes, native or CAT240, or the records of its board to one address
// as datagrams.
#pragma once

#include <netinet/in.h>
#include <sys/socket.h>

#include <span>
#include <string>
#include <vector>

#include "protocol/wire/datagram.hpp"
#include "server/net/common/destination_socket.hpp"
#include "server/net/common/net_context.hpp"

namespace skerry::server {

// One datagram: bytes [begin, end) of the buffer in hand.
struct OutgoingDatagram {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::uint32_t spoke = 0;  // to which of the sector's spokes it belongs
};

// The stream of a sender, and how it is cut into datagrams.
struct UdpStream {
  enum class Cut { native, records, cat240 };  // cat240: one data block to a datagram
  Cut cut = Cut::native;
  std::string format;        // of the view's or board's rings
  std::uint32_t view = 0;    // not of records
  std::string name() const;  // "udp", "sweeps", "cat240": of a transport, for the status
};

// Error: std::runtime_error naming the stream, its destination and the reason.
[[noreturn]] void fail_stream(const UdpDestination& to, const UdpStream& stream,
                              const std::string& reason);

// Sends as soon as sectors are published and never waits: what the socket does not take at once is
// dropped, and its spokes count as lost.
// Thread: constructed anywhere, then net-0.
class UdpSender final : public FeedReader {
 public:
  // Requires that the radar has the view or board of the stream.
  // Error: of open_destination().
  UdpSender(NetContext& context, const UdpDestination& to, const UdpStream& stream);

  void start();  // net-0: from now on it sends
  void close();
  void on_sector() override;

 private:
  // Bodies into fragments_.
  void cut_native(const EncodedSector& sector);
  void cut_records(const EncodedSector& sector);
  void cut(std::uint64_t sequence, std::span<const std::uint8_t> body, std::uint32_t spoke,
           DatagramKind kind);
  void cut_cat240(const EncodedSector& sector);
  void send(std::span<const std::uint8_t> bytes_in_hand, std::uint32_t spoke_count);

  NetContext& context_;
  UdpDestination to_;
  UdpStream stream_;
  std::size_t max_datagram_;
  DestinationSocket destination_;
  ClientPtr client_;
  SpokeFeed* feed_ = nullptr;
  Cursor cursor_;
  std::uint64_t dropped_ = 0;  // spokes

  std::vector<OutgoingDatagram> datagrams_;  // of the sector in hand
  Bytes fragments_;
  Bytes scratch_;
  std::vector<iovec> pieces_;
  std::vector<mmsghdr> messages_;
  std::vector<bool> spoke_dropped_;
};

}  // namespace skerry::server
