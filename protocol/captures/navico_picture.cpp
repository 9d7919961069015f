// BR24, 3G, 4G and HALO.
#include <algorithm>
#include <variant>

#include "protocol/captures/counter_gap.hpp"
#include "protocol/captures/picture_decoder.hpp"
#include "protocol/navico/frame.hpp"
#include "protocol/navico/report.hpp"

namespace skerry::captures {
namespace {

using navico::Model;

double percent_of_level(std::uint8_t raw) { return raw * 100.0 / 255.0; }
double percent_of_step(int raw, int most) { return std::clamp(raw, 0, most) * 100.0 / most; }

// A spoke's reach over the set range.  Source: protocol/navico/spoke_range.hpp.
double captured_reach_per_range(Model model) {
  return navico::is_first_generation(model) ? 1.769 : model == Model::g4 ? 1.953 : 1.719;
}

class NavicoPicture : public PictureDecoder {
 public:
  explicit NavicoPicture(const PictureTraits& traits)
      : PictureDecoder(traits), doppler_(traits.doppler) {}

  std::optional<WireError> decode(const pcap::Datagram& datagram,
                                  std::vector<CapturedSpoke>& out) override {
    auto spokes = navico::decode_frame(traits_.model, datagram.payload);
    if (!spokes) return spokes.error();
    // The frame leaves when its last spoke is made.
    const std::size_t count = spokes->size();
    Duration step = traits_.turn / navico::kTurnSpokes;
    if (last_frame_) {
      const Duration since = (datagram.time - *last_frame_) / static_cast<std::int64_t>(count);
      step = std::clamp(since, Duration{}, step);
    }
    for (std::size_t i = 0; i < count; ++i) {
      const auto later = static_cast<std::int64_t>(count - 1 - i);
      out.push_back(spoke_of((*spokes)[i], datagram.time - step * later));
    }
    last_frame_ = datagram.time;
    settings_.set_standby(false);
    return std::nullopt;
  }

  void hear(const pcap::Datagram& datagram) override {
    if (!traits_.reports || datagram.to != *traits_.reports) return;
    const auto report = navico::decode_report(datagram.payload);
    if (!report) return;
    std::visit([this](const auto& each) { this->take(each); }, *report);
  }

 private:
  CapturedSpoke spoke_of(const navico::FrameSpoke& from, UtcTime time) {
    CapturedSpoke spoke;
    spoke.time = time;
    spoke.spokes_per_turn = navico::kTurnSpokes;
    spoke.index = from.fields.angle / 2u;
    spoke.bits = 4;
    spoke.reach = from.fields.reach;
    spoke.nominal = from.fields.reach / captured_reach_per_range(traits_.model);
    spoke.missing = gap_.take(from.fields.scan, time, traits_.turn);
    if (const auto heading = navico::heading_of(from.fields.heading)) {
      spoke.heading = TrueBearing::of_spoke(heading->units, navico::kTurnUnits);
      spoke.heading_magnetic = !heading->is_true;
    }
    spoke.cells.assign(from.cells.begin(), from.cells.end());
    if (doppler_) {
      spoke.doppler.resize(spoke.cells.size());
      for (std::size_t i = 0; i < spoke.cells.size(); ++i) {
        spoke.doppler[i] = spoke.cells[i] == navico::kApproaching ? DopplerClass::approaching
                           : spoke.cells[i] == navico::kReceding  ? DopplerClass::receding
                                                                  : DopplerClass::none;
      }
    }
    return spoke;
  }

  void take(const navico::StateReport& report) {
    settings_.set_standby(report.state != navico::RadarState::transmit);
  }
  void take(const navico::ControlReport& report) {
    if (wire::PictureMode_IsValid(report.mode)) {
      settings_.set_mode(static_cast<wire::PictureMode>(report.mode));
    }
    settings_.set_gain_auto(report.gain_auto);
    settings_.set_gain(percent_of_level(report.gain));
    settings_.set_sea_auto(report.sea_auto > 0);
    settings_.set_sea(report.sea_auto > 0 ? 50.0 : percent_of_level(report.sea));
    settings_.set_rain(percent_of_level(report.rain));
    settings_.set_interference_rejection(percent_of_step(report.interference, 3));
    settings_.set_echo_stretch(
        percent_of_step(report.expansion, navico::is_halo(traits_.model) ? 3 : 1));
    settings_.set_target_boost(percent_of_step(report.boost, 2));
  }
  void take(const navico::InstallationReport& report) {
    const double alignment = report.bearing_alignment / 10.0;
    settings_.set_bearing_alignment_deg(alignment > 180.0 ? alignment - 360.0 : alignment);
    settings_.set_antenna_height_m(report.antenna_height_mm / 1000.0);
    take_sectors(report.sectors);
  }
  void take(const navico::BlankingReport& report) { take_sectors(report.sectors); }
  void take(const navico::AdvancedReport& report) {
    settings_.set_side_lobe_auto(report.side_lobe_auto);
    settings_.set_side_lobe_suppression(percent_of_level(report.side_lobe));
    settings_.set_noise_rejection(percent_of_step(report.noise_rejection, 3));
    settings_.set_target_separation(percent_of_step(report.target_separation, 3));
    if (!navico::is_halo(traits_.model)) return;
    if (settings_.sea_auto()) {
      settings_.set_sea(std::clamp(50.0 + report.halo_sea_adjust, 0.0, 100.0));
    } else {
      settings_.set_sea(std::min<double>(report.halo_sea, 100.0));
    }
    doppler_ = report.doppler != 0;
    if (wire::DopplerMode_IsValid(report.doppler)) {
      settings_.set_doppler(static_cast<wire::DopplerMode>(report.doppler));
    }
    settings_.set_doppler_threshold_mps(report.doppler_threshold_cms / 100.0);
  }
  static void take(const navico::IdentityReport&) {}
  static void take(const navico::HeartbeatReport&) {}

  void take_sectors(const navico::BlankedSectors& sectors) {
    settings_.clear_blanked_sectors();
    for (const navico::BlankedSector& each : sectors) {
      if (!each.on) continue;
      auto* const sector = settings_.mutable_blanked_sectors()->add_sectors();
      sector->set_from_deg(std::min<double>(each.from / 10.0, 360.0));
      sector->set_to_deg(std::min<double>(each.to / 10.0, 360.0));
    }
  }

  // The upper bits of the counter have been used for other things.
  CounterGap gap_{navico::kTurnUnits, navico::kTurnSpokes};
  std::optional<UtcTime> last_frame_;
  bool doppler_;
};

}  // namespace

std::unique_ptr<PictureDecoder> make_navico_picture(const PictureTraits& traits) {
  return std::make_unique<NavicoPicture>(traits);
}

}  // namespace skerry::captures
