// Raymarine Quantum, and E-120 with an analogue scanner (RD).
#include <algorithm>

#include "protocol/captures/counter_gap.hpp"
#include "protocol/captures/picture_decoder.hpp"
#include "protocol/raymarine/quantum_report.hpp"
#include "protocol/raymarine/quantum_spoke.hpp"
#include "protocol/raymarine/rd_packets.hpp"

namespace skerry::captures {
namespace {

constexpr double kThousandthNm = 1.852;  // m
constexpr double kRejectionStep = 20.0;  // positions 0 .. 5 on 0 .. 100
constexpr double kRdReachPerRange = 2.0;

class QuantumPicture : public PictureDecoder {
 public:
  using PictureDecoder::PictureDecoder;

  std::optional<WireError> decode(const pcap::Datagram& datagram,
                                  std::vector<CapturedSpoke>& out) override {
    auto from = raymarine::decode_quantum_spoke(datagram.payload);
    if (!from) return from.error();
    if (from->cells.empty()) {
      return WireError{WireErrorKind::malformed, 8, "Quantum spoke: of no cells"};
    }
    CapturedSpoke spoke;
    spoke.time = datagram.time;
    spoke.spokes_per_turn = raymarine::kQuantumSpokes;
    // Its azimuth is from the stern.
    spoke.index = (from->azimuth + raymarine::kQuantumSpokes / 2) % raymarine::kQuantumSpokes;
    if (from->cells_per_range > 0) {
      spoke.reach = range_ * (static_cast<double>(from->cells.size()) / from->cells_per_range);
    }
    spoke.nominal = range_;
    spoke.missing = gap_.take(from->sequence, datagram.time, traits_.turn);
    spoke.cells = std::move(from->cells);
    if (traits_.doppler) {
      spoke.doppler.resize(spoke.cells.size());
      for (std::size_t i = 0; i < spoke.cells.size(); ++i) {
        spoke.doppler[i] = spoke.cells[i] == raymarine::kQuantumApproaching
                               ? DopplerClass::approaching
                           : spoke.cells[i] == raymarine::kQuantumReceding ? DopplerClass::receding
                                                                           : DopplerClass::none;
      }
    }
    out.push_back(std::move(spoke));
    settings_.set_standby(false);
    return std::nullopt;
  }

  void hear(const pcap::Datagram& datagram) override {
    if (datagram.from.address != traits_.key.from || datagram.to != traits_.key.to) return;
    const auto status = raymarine::decode_quantum_status(datagram.payload);
    if (!status) return;
    range_ = metres(status->ranges[status->range_index] * kThousandthNm);
    const auto& controls = status->controls[static_cast<std::size_t>(status->mode)];
    settings_.set_standby(!status->transmits);
    settings_.set_gain_auto(controls.gain_auto);
    settings_.set_gain(std::min<double>(controls.gain, 100.0));
    settings_.set_sea_auto(controls.sea_auto);
    settings_.set_sea(std::min<double>(controls.sea, 100.0));
    settings_.set_rain(controls.rain_on ? std::min<double>(controls.rain, 100.0) : 0.0);
    settings_.set_interference_rejection(std::min(status->rejection * kRejectionStep, 100.0));
    settings_.set_echo_stretch(status->expansion != 0 ? 50.0 : 0.0);
    settings_.set_bearing_alignment_deg(std::clamp(status->bearing_offset / 10.0, -180.0, 180.0));
  }

 private:
  Length range_{};
  CounterGap gap_{1 << 16, raymarine::kQuantumSpokes};
};

class RdPicture : public PictureDecoder {
 public:
  using PictureDecoder::PictureDecoder;

  std::optional<WireError> decode(const pcap::Datagram& datagram,
                                  std::vector<CapturedSpoke>& out) override {
    auto spokes = raymarine::decode_rd_spokes(datagram.payload);
    if (!spokes) return spokes.error();
    for (raymarine::RdSpoke& from : *spokes) {
      CapturedSpoke spoke;
      spoke.time = datagram.time;
      spoke.spokes_per_turn = raymarine::kRdSpokes;
      spoke.index = from.azimuth;
      spoke.bits = 4;
      spoke.reach = range_ * kRdReachPerRange;
      spoke.nominal = range_;
      spoke.missing = gap_.take(from.azimuth, datagram.time, traits_.turn / 2);
      spoke.cells = std::move(from.cells);
      out.push_back(std::move(spoke));
    }
    if (!spokes->empty()) settings_.set_standby(false);
    return std::nullopt;
  }

  void hear(const pcap::Datagram& datagram) override {
    if (datagram.from.address != traits_.key.from || datagram.to != traits_.key.to) return;
    const auto status = raymarine::decode_rd_status(datagram.payload);
    if (!status) return;
    range_ = metres(status->range_m());
    settings_.set_standby(status->state != static_cast<std::uint8_t>(raymarine::RdState::transmit));
  }

 private:
  Length range_{};
  // There is no counter but the azimuth; a scanner of fewer pulses skips some.
  CounterGap gap_{raymarine::kRdSpokes, raymarine::kRdSpokes / 2};
};

}  // namespace

std::unique_ptr<PictureDecoder> make_quantum_picture(const PictureTraits& traits) {
  return std::make_unique<QuantumPicture>(traits);
}

std::unique_ptr<PictureDecoder> make_rd_picture(const PictureTraits& traits) {
  return std::make_unique<RdPicture>(traits);
}

}  // namespace skerry::captures
