// Garmin xHD.
#include <algorithm>
#include <cmath>

#include "protocol/captures/counter_gap.hpp"
#include "protocol/captures/picture_decoder.hpp"
#include "protocol/garmin/xhd_packet.hpp"
#include "protocol/garmin/xhd_spoke.hpp"

namespace skerry::captures {
namespace {

using garmin::Type;

constexpr std::uint32_t kStep = garmin::kAnglesPerTurn / garmin::kSpokesPerTurn;

class GarminPicture : public PictureDecoder {
 public:
  using PictureDecoder::PictureDecoder;

  std::optional<WireError> decode(const pcap::Datagram& datagram,
                                  std::vector<CapturedSpoke>& out) override {
    const auto from = garmin::decode_spoke(datagram.payload);
    if (!from) return from.error();
    CapturedSpoke spoke;
    spoke.time = datagram.time;
    spoke.spokes_per_turn = garmin::kSpokesPerTurn;
    spoke.index = from->angle / kStep;
    spoke.reach = metres(from->span_m);
    spoke.nominal = metres(from->range_m);
    // There is no counter but the angle itself.
    spoke.missing = gap_.take(spoke.index, datagram.time, traits_.turn / 2);
    spoke.cells.assign(from->cells.begin(), from->cells.end());
    out.push_back(std::move(spoke));
    settings_.set_standby(false);
    return std::nullopt;
  }

  void hear(const pcap::Datagram& datagram) override {
    if (datagram.from.address != traits_.key.from || datagram.to.port != kReports) return;
    const auto packet = garmin::decode_packet(datagram.payload);
    if (!packet) return;
    const auto number = packet->number();
    if (number) take(packet->type, *number, packet->signed_number().value_or(0));
  }

 private:
  static constexpr std::uint16_t kReports = garmin::kReportAddress.port;

  void take(std::uint32_t type, std::uint32_t number, std::int32_t signed_number) {
    const double percent = std::min(number / 100.0, 100.0);
    switch (static_cast<Type>(type)) {
      case Type::transmit:
        settings_.set_standby(number == 0);
        break;
      case Type::gain_auto:
        settings_.set_gain_auto(number != 0);
        break;
      case Type::gain:
        settings_.set_gain(percent);
        break;
      case Type::sea_mode:
        settings_.set_sea_auto(number == 2);
        break;
      case Type::sea:
        settings_.set_sea(percent);
        break;
      case Type::rain:
        settings_.set_rain(percent);
        break;
      case Type::rejection:
        settings_.set_interference_rejection(number == 0 ? 0.0 : 50.0);
        break;
      case Type::alignment:
        settings_.set_bearing_alignment_deg(
            std::remainder(static_cast<double>(signed_number) / 32.0, 360.0));
        break;
      default:
        break;
    }
  }

  CounterGap gap_{garmin::kSpokesPerTurn, garmin::kSpokesPerTurn / 2};
};

}  // namespace

std::unique_ptr<PictureDecoder> make_garmin_picture(const PictureTraits& traits) {
  return std::make_unique<GarminPicture>(traits);
}

}  // namespace skerry::captures
