// Native datagrams (SPEC.md, section 3): the picture of another Skerry server.
#include <utility>

#include "protocol/captures/counter_gap.hpp"
#include "protocol/captures/picture_decoder.hpp"
#include "protocol/wire/datagram.hpp"
#include "protocol/wire/spoke_message.hpp"

namespace skerry::captures {
namespace {

class NativePicture : public PictureDecoder {
 public:
  using PictureDecoder::PictureDecoder;

  std::optional<WireError> decode(const pcap::Datagram& datagram,
                                  std::vector<CapturedSpoke>& out) override {
    auto body = reassembler_.feed(datagram.payload);
    if (!body) return body.error();
    if (!*body) return std::nullopt;  // a part
    wire::ServerMessage message;
    if (!message.ParseFromArray((*body)->data(), static_cast<int>((*body)->size())) ||
        !message.has_spoke()) {
      return WireError{WireErrorKind::malformed, kDatagramHeaderSize, "its body is no spoke"};
    }
    auto spoke = from_message(message.spoke());
    if (!spoke) return spoke.error();
    out.push_back(captured(*std::move(spoke), datagram.time));
    settings_.set_standby(false);
    return std::nullopt;
  }

  void hear(const pcap::Datagram&) override {}

 private:
  CapturedSpoke captured(Spoke spoke, UtcTime time) {
    const SpokeHeader& header = spoke.header;
    CapturedSpoke out;
    out.time = time;  // another host's clock may be another
    out.spokes_per_turn = header.geometry.spokes_per_turn;
    out.index = header.index;
    out.bits = header.geometry.bits;
    out.reach = header.reach();
    out.nominal = header.range_scale.length();
    out.missing = gap_.take(header.sequence, time, traits_.turn);
    out.heading = header.heading;
    out.cells = std::move(spoke.cells);
    out.doppler = std::move(spoke.doppler);
    return out;
  }

  static constexpr std::uint64_t kSequences = std::uint64_t{1} << 48;
  DatagramReassembler reassembler_;
  CounterGap gap_{kSequences, ScanGeometry::kMaxSpokes};
};

}  // namespace

std::unique_ptr<PictureDecoder> make_native_picture(const PictureTraits& traits) {
  return std::make_unique<NativePicture>(traits);
}

}  // namespace skerry::captures
