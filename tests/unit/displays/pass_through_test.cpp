// A recording of a real radar, played back as a radar of the same make: its spokes leave cell by
// cell as they came.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "server/displays/emulated_radars.hpp"
#include "tests/unit/captures/imported.hpp"
#include "tests/unit/displays/fake_display_port.hpp"
#include "tests/unit/pcap/radar_captures.hpp"

namespace skerry::server {
namespace {

struct Played {
  const char* file;
  const char* radar;  // that it is played as
  captures::Family family;
  navico::Model model;
};

// A display of the emulated radar.
class Passage {
 public:
  explicit Passage(const Played& played) : radar_(find_emulated_radar(played.radar)->make({})) {
    captures::PictureTraits traits;
    traits.key = {played.family, kRadar, radar_->data_address(RangeChannel::a), 0};
    traits.model = played.model;
    decoder_ = captures::make_picture(traits);
    encode_ = radar_->spoke_encoder(RangeChannel::a);
    port_.at(RangeChannel::a).set_standby(false);
  }

  // What the playback tells of a view whose spokes are so; returns the reach that is wanted of it.
  double tell(const SpokeHeader& header) {
    wire::Settings& settings = port_.at(RangeChannel::a);
    settings.set_range_nm(header.range_scale.length().in_nautical_miles());
    settings.set_instrumented_range_m(header.reach().in_metres());
    if (!begun_) {
      const std::vector<std::uint16_t> ports(radar_->listens().size());
      radar_->begin(kRadar, ports, {}, port_);
      begun_ = true;
    }
    radar_->on_settings(RangeChannel::a, {}, port_);
    port_.sent.clear();
    return radar_->instrumented_range_m(RangeChannel::a, settings);
  }
  std::vector<captures::CapturedSpoke> pass(const Spoke& spoke) {
    std::vector<captures::CapturedSpoke> out;
    const EncodedSectorPtr sector = encode_(Sector{{std::make_shared<const Spoke>(spoke)}});
    std::uint32_t begin = sector->begin;
    for (const std::uint32_t end : sector->spoke_ends) {
      const auto payload = std::span(sector->bytes).subspan(begin, end - begin);
      const auto wrong = decoder_->decode({.time = {},
                                           .from = {kRadar, 0},
                                           .to = radar_->data_address(RangeChannel::a),
                                           .payload = payload},
                                          out);
      EXPECT_FALSE(wrong.has_value());
      begin = end;
    }
    return out;
  }

 private:
  static constexpr std::uint32_t kRadar = ipv4(192, 0, 2, 7);
  std::unique_ptr<RadarEmulation> radar_;
  FakeDisplayPort port_;
  std::unique_ptr<captures::PictureDecoder> decoder_;
  SectorEncoder encode_;
  bool begun_ = false;
};

class PassThrough : public testing::TestWithParam<Played> {};

TEST_P(PassThrough, EveryCellLeavesAsItWasRecorded) {
  if (!have_radar_captures()) GTEST_SKIP() << kNoRadarCaptures;
  const captures::Imported imported = captures::imported(unpack_radar_capture(GetParam().file));
  const std::vector<Spoke>& recorded = imported.spokes.at(0);
  Passage passage(GetParam());
  double reach_m = 0.0;
  std::size_t next = 0, same = 0;
  for (const Spoke& spoke : recorded) {
    const double mine_m = spoke.header.reach().in_metres();
    if (std::exchange(reach_m, mine_m) != mine_m) {
      // Rows of whole spokes, so that the output leaves them as they are.
      const double wanted = passage.tell(spoke.header) / mine_m;
      EXPECT_NEAR(wanted, std::max(1.0, std::round(wanted)), 5e-3)
          << mine_m << " m of range scale " << spoke.header.range_scale.length().in_nautical_miles()
          << " NM";
    }
    for (const captures::CapturedSpoke& left : passage.pass(spoke)) {
      while (next < recorded.size() && recorded[next].header.index != left.index) ++next;
      ASSERT_LT(next, recorded.size()) << "azimuth " << left.index << " was not recorded";
      ASSERT_EQ(left.cells, recorded[next].cells) << "spoke " << next << ", azimuth " << left.index;
      ++next;
      ++same;
    }
  }
  std::printf("%s as %s: %zu of %zu spokes left, all cells as recorded\n", GetParam().file,
              GetParam().radar, same, recorded.size());
  EXPECT_GT(same, recorded.size() * 95 / 100);
}

using captures::Family;
using navico::Model;
INSTANTIATE_TEST_SUITE_P(
    Recordings, PassThrough,
    testing::Values(Played{"br24-ranges-nm.pcap.gz", "navico_br24", Family::navico, Model::br24},
                    Played{"3g-trueheading.pcap.gz", "navico_3g", Family::navico, Model::g3},
                    Played{"4g-ranges-nm.pcap.gz", "navico_4g", Family::navico, Model::g4},
                    Played{"halo20-ranges.pcap.gz", "navico_halo20", Family::navico, Model::halo20},
                    Played{"halo-velocitytrack-notarget.pcap.gz", "navico_halo", Family::navico,
                           Model::halo},
                    Played{"garminxhd_txon_txoff.pcap.gz", "garmin_xhd", Family::garmin, Model::g4},
                    Played{"quantum2-solent-03-gain-sea-rain.pcap.gz", "raymarine_quantum",
                           Family::quantum, Model::g4}),
    [](const auto& test) { return test_name_of(test.param.file); });

}  // namespace
}  // namespace skerry::server
