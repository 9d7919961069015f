#include "server/net/outputs/udp_sender.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "protocol/wire/byte_order.hpp"
#include "protocol/wire/frame.hpp"
#include "protocol/wire/host_and_port.hpp"

namespace skerry::server {
namespace {

constexpr std::size_t kCat240BlockHeader = 3;  // category, length in two bytes

}  // namespace

void fail_stream(const UdpDestination& to, const UdpStream& stream, const std::string& reason) {
  fail_destination(to, stream.name(), reason);
}

std::string UdpStream::name() const {
  switch (cut) {
    case Cut::native:
      return "udp";
    case Cut::records:
      return "sweeps";
    case Cut::cat240:
      break;
  }
  return "cat240";
}

UdpSender::UdpSender(NetContext& context, const UdpDestination& to, const UdpStream& stream)
    : context_(context),
      to_(to),
      stream_(stream),
      max_datagram_(longest_datagram(to)),
      destination_(open_destination(context.io, to, stream.name())) {
  client_ = context.clients.add(stream.name(), host_and_port(to.address, to.port));
  client_->radar.store(to.radar, std::memory_order_relaxed);
  client_->view.store(stream.view, std::memory_order_relaxed);
}

void UdpSender::start() {
  feed_ = stream_.cut == UdpStream::Cut::records
              ? context_.find_board_feed(to_.radar, stream_.format)
              : context_.find_feed(to_.radar, stream_.view, stream_.format);
  cursor_ = feed_->add(*this);
}

void UdpSender::close() {
  if (feed_ != nullptr) feed_->remove(*this);
  feed_ = nullptr;
  error_code ignored;
  destination_.socket.close(ignored);
}

void UdpSender::on_sector() {
  while (const EncodedSectorPtr sector = feed_->ring().take(cursor_)) {
    datagrams_.clear();
    switch (stream_.cut) {
      case UdpStream::Cut::native:
        cut_native(*sector);
        send(fragments_, sector->spoke_count());
        break;
      case UdpStream::Cut::records:
        cut_records(*sector);
        send(fragments_, sector->spoke_count());
        break;
      case UdpStream::Cut::cat240:
        cut_cat240(*sector);
        send(sector->bytes, sector->spoke_count());
        break;
    }
  }
  client_->spokes_lost.store(cursor_.spokes_lost + dropped_, std::memory_order_relaxed);
}

void UdpSender::cut_native(const EncodedSector& sector) {
  fragments_.clear();
  std::size_t begin = 0;
  for (std::uint32_t spoke = 0; spoke < sector.spoke_count(); ++spoke) {
    const std::size_t end = sector.spoke_ends[spoke];
    const auto body = frame_body(std::span(sector.bytes).subspan(begin, end - begin));
    begin = end;
    cut(sector.first_sequence + spoke, body, spoke, DatagramKind::spokes);
  }
}

void UdpSender::cut_records(const EncodedSector& sector) {
  fragments_.clear();
  std::size_t begin = sector.begin;
  for (std::uint32_t record = 0; record < sector.spoke_count(); ++record) {
    const std::size_t end = sector.spoke_ends[record];
    cut(sector.first_sequence + record, std::span(sector.bytes).subspan(begin, end - begin), record,
        DatagramKind::records);
    begin = end;
  }
}

void UdpSender::cut(std::uint64_t sequence, std::span<const std::uint8_t> body, std::uint32_t spoke,
                    DatagramKind kind) {
  const DatagramSpoke name{.radar = static_cast<std::uint16_t>(to_.radar),
                           .view = static_cast<std::uint16_t>(stream_.view),
                           .sequence = sequence};
  for_each_datagram(
      name, body, max_datagram_, scratch_,
      [&](std::span<const std::uint8_t> datagram) {
        const std::size_t at = fragments_.size();
        fragments_.insert(fragments_.end(), datagram.begin(), datagram.end());
        datagrams_.push_back({at, fragments_.size(), spoke});
      },
      kind);
}

void UdpSender::cut_cat240(const EncodedSector& sector) {
  std::size_t begin = 0;
  for (std::uint32_t spoke = 0; spoke < sector.spoke_count(); ++spoke) {
    while (begin + kCat240BlockHeader <= sector.spoke_ends[spoke]) {
      const auto length = big_endian_at<std::size_t>(sector.bytes, begin + 1, 2);
      datagrams_.push_back({begin, begin + length, spoke});
      begin += length;
    }
  }
}

void UdpSender::send(std::span<const std::uint8_t> bytes_in_hand, std::uint32_t spoke_count) {
  pieces_.resize(datagrams_.size());
  messages_.assign(datagrams_.size(), mmsghdr{});
  for (std::size_t i = 0; i < datagrams_.size(); ++i) {
    const auto payload =
        bytes_in_hand.subspan(datagrams_[i].begin, datagrams_[i].end - datagrams_[i].begin);
    // sendmmsg() does not write; iovec just has no const.
    pieces_[i] = {const_cast<std::uint8_t*>(payload.data()), payload.size()};
    msghdr& message = messages_[i].msg_hdr;
    message.msg_name = destination_.endpoint.data();
    message.msg_namelen = static_cast<socklen_t>(destination_.endpoint.size());
    message.msg_iov = &pieces_[i];
    message.msg_iovlen = 1;
  }

  spoke_dropped_.assign(spoke_count, false);
  std::uint64_t bytes = 0;
  std::size_t next = 0;
  while (next < messages_.size()) {
    const int sent = ::sendmmsg(destination_.socket.native_handle(), messages_.data() + next,
                                static_cast<unsigned>(messages_.size() - next), MSG_DONTWAIT);
    if (sent > 0) {
      for (const std::size_t end = next + static_cast<std::size_t>(sent); next < end; ++next) {
        bytes += messages_[next].msg_len;
      }
    } else if (errno != EINTR) {
      context_.errors.add(client_->transport + " send",
                          fmt::format("{}: {}", client_->peer, std::strerror(errno)));
      spoke_dropped_[datagrams_[next].spoke] = true;
      ++next;
    }
  }
  const auto dropped =
      static_cast<std::uint64_t>(std::count(spoke_dropped_.begin(), spoke_dropped_.end(), true));
  dropped_ += dropped;
  client_->spokes_sent.fetch_add(spoke_count - dropped, std::memory_order_relaxed);
  client_->bytes_sent.fetch_add(bytes, std::memory_order_relaxed);
}

}  // namespace skerry::server
