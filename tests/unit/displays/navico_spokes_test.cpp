#include "server/displays/navico/navico_spokes.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "protocol/navico/frame.hpp"

namespace skerry::server {
namespace {

using navico::FrameSpoke;
using navico::Model;

// Sectors of 16 spokes, whose cells `paint` fills.
class View {
 public:
  View(std::uint32_t spokes, std::uint32_t cells, double scale_nm, double reach_m)
      : scale_(*RangeScale::find(scale_nm)), reach_m_(reach_m) {
    geometry_ = {spokes, cells, 8};
  }
  template <typename Paint>
  Sector next(Paint&& paint, std::uint32_t count = 16) {
    Sector sector;
    for (std::uint32_t i = 0; i < count; ++i, ++sequence_) {
      auto spoke = std::make_shared<Spoke>();
      spoke->header.sequence = sequence_;
      spoke->header.index = static_cast<std::uint32_t>(sequence_ % geometry_.spokes_per_turn);
      spoke->header.geometry = geometry_;
      spoke->header.range_scale = scale_;
      spoke->header.instrumented_range = metres(reach_m_);
      spoke->header.heading = TrueBearing::from(degrees(45.0));
      spoke->cells.resize(geometry_.cells);
      paint(*spoke);
      sector.spokes.push_back(std::move(spoke));
    }
    return sector;
  }
  void skip(std::uint64_t spokes) { sequence_ += spokes; }

 private:
  ScanGeometry geometry_;
  RangeScale scale_;
  double reach_m_;
  std::uint64_t sequence_ = 0;
};

class NavicoSpokesTest : public testing::Test {
 protected:
  void show(Model model, double scale_nm, std::uint32_t range_dm) {
    model_ = model;
    gate_ = std::make_shared<NavicoGate>();
    gate_->open(true);
    gate_->set_range(*RangeScale::find(scale_nm), range_dm);
    spokes_ = std::make_unique<NavicoSpokes>(model, gate_);
    frames_ = 0;
    decoded_.clear();
  }
  void take(const Sector& sector) {
    const EncodedSectorPtr encoded = spokes_->encode(sector);
    ASSERT_NE(encoded, nullptr);
    std::uint32_t begin = encoded->begin;
    for (const std::uint32_t end : encoded->spoke_ends) {
      const auto datagram = std::span(encoded->bytes).subspan(begin, end - begin);
      EXPECT_EQ(datagram.size(), navico::kFrameOctets);
      const auto frame = navico::decode_frame(model_, datagram);
      ASSERT_TRUE(frame.ok()) << frame.error().text;
      decoded_.insert(decoded_.end(), frame->begin(), frame->end());
      ++frames_;
      begin = end;
    }
    EXPECT_EQ(begin, encoded->bytes.size());
  }

  Model model_ = Model::g4;
  std::shared_ptr<NavicoGate> gate_;
  std::unique_ptr<NavicoSpokes> spokes_;
  std::size_t frames_ = 0;
  std::vector<FrameSpoke> decoded_;
};

TEST_F(NavicoSpokesTest, MakesSixtyFourFramesATurnThatShowEveryEchoInItsPlace) {
  // An echo at 1500 m on 90 deg, whatever the view and the radar.
  for (const Model model : {Model::br24, Model::g3, Model::g4, Model::halo20, Model::halo}) {
    for (const auto& shape : {std::pair{4096u, 1024u}, {2048u, 512u}, {1440u, 700u}}) {
      const std::uint32_t spokes = shape.first, cells = shape.second;
      show(model, 1.5, 20000);
      const double reach_m = navico::spoke_range(model, 20000).reach.in_metres();
      View view(spokes, cells, 1.5, reach_m);
      const auto paint = [&](Spoke& spoke) {
        if (spoke.header.index != spokes / 4) return;
        spoke.cells[static_cast<std::size_t>(1500.0 / reach_m * cells)] = 200;
      };
      for (std::uint32_t i = 0; i < 2 * spokes / 16; ++i) take(view.next(paint));
      // Two turns, but for the spoke that is still in the making.
      EXPECT_GE(frames_, 127u);
      EXPECT_LE(frames_, 128u);
      std::size_t echoes = 0;
      for (std::size_t i = 0; i < decoded_.size(); ++i) {
        const FrameSpoke& spoke = decoded_[i];
        EXPECT_EQ(spoke.fields.scan, i % 4096);
        EXPECT_EQ(spoke.fields.angle, i * 2 % 4096);
        EXPECT_EQ(spoke.fields.status, navico::kSpokeGood);
        EXPECT_EQ(spoke.fields.heading, 0x4000 | 512);
        EXPECT_EQ(spoke.fields.reach.in_metres(), reach_m);
        for (std::size_t c = 0; c < spoke.cells.size(); ++c) {
          if (spoke.cells[c] == 0) continue;
          ++echoes;
          EXPECT_EQ(spoke.cells[c], 12);
          EXPECT_NEAR(spoke.fields.angle, 1024, 4096.0 / spokes + 2.0);
          EXPECT_NEAR((static_cast<double>(c) + 0.5) / 1024 * reach_m, 1500.0,
                      reach_m / std::min(cells, 1024u));
        }
      }
      EXPECT_GE(echoes, 1u);
    }
  }
}

TEST_F(NavicoSpokesTest, CutsAViewThatReachesTwiceAsFar) {
  // 250 m on a HALO: the spoke ends at 430 m, within the scale of 0.25 NM, so the view has 860 m.
  show(Model::halo, 0.25, 2500);
  const double reach_m = navico::spoke_range(Model::halo, 2500).reach.in_metres();
  EXPECT_LT(reach_m, 463.0);
  View view(2048, 1024, 0.25, 2.0 * reach_m);
  const std::size_t echo = 238;  // of the view's cells; each is two of the spoke's
  for (int i = 0; i < 4; ++i) {
    take(view.next([&](Spoke& spoke) {
      spoke.cells[echo] = 255;
      spoke.cells[1023] = 255;
    }));
  }
  ASSERT_EQ(frames_, 2u);
  EXPECT_EQ(decoded_[0].fields.reach.in_metres(), reach_m);
  for (std::size_t c = 0; c < 1024; ++c) {
    EXPECT_EQ(decoded_[5].cells[c] > 0, c / 2 == echo) << c;
  }
}

TEST_F(NavicoSpokesTest, EndsWhereTheViewEndsIfThatIsTooShort) {
  show(Model::g4, 6.0, 111120);
  View view(2048, 1024, 6.0, 0.0);  // no instrumented range: 6 NM
  for (int i = 0; i < 2; ++i) {
    take(view.next([](Spoke& spoke) { std::fill(spoke.cells.begin(), spoke.cells.end(), 255); }));
  }
  ASSERT_EQ(frames_, 1u);
  EXPECT_EQ(decoded_[0].cells[511], 15);
  EXPECT_EQ(decoded_[0].cells[600], 0);
}

TEST_F(NavicoSpokesTest, ColoursWhatApproachesAndRecedesOnAHalo) {
  const auto paint = [](Spoke& spoke) {
    spoke.doppler.resize(spoke.cells.size());
    std::fill(spoke.cells.begin(), spoke.cells.begin() + 40, std::uint8_t{255});
    for (std::size_t c = 0; c < 60; ++c) {
      spoke.doppler[c] = c % 4 == 1   ? DopplerClass::approaching
                         : c % 4 == 2 ? DopplerClass::receding
                                      : DopplerClass::none;
    }
  };
  for (const Model model : {Model::halo, Model::g4}) {
    show(model, 1.5, 27780);
    View view(2048, 1024, 1.5, navico::spoke_range(model, 27780).reach.in_metres());
    for (int i = 0; i < 2; ++i) take(view.next(paint));
    ASSERT_EQ(frames_, 1u);
    const bool colours = model == Model::halo;
    for (std::size_t c = 0; c < 60; ++c) {
      const int plain = colours ? 0x0D : 0x0F;
      const int expected = c >= 40                 ? 0
                           : colours && c % 4 == 1 ? 0x0F
                           : colours && c % 4 == 2 ? 0x0E
                                                   : plain;
      EXPECT_EQ(decoded_[3].cells[c], expected) << c;
    }
  }
}

TEST_F(NavicoSpokesTest, MarksTheFirstSpokeAfterAGapAsABr24Does) {
  show(Model::br24, 1.5, 27780);
  View view(2048, 1024, 1.5, navico::spoke_range(Model::br24, 27780).reach.in_metres());
  const auto paint = [](Spoke&) {};
  take(view.next(paint));
  view.skip(5);
  for (int i = 0; i < 2; ++i) take(view.next(paint));
  ASSERT_EQ(frames_, 1u);
  for (std::size_t i = 0; i < 32; ++i) {
    EXPECT_EQ(decoded_[i].fields.status, i == 16 ? navico::kSpokeAfterGap : navico::kSpokeGood);
  }
  EXPECT_EQ(decoded_[16].fields.angle, 2 * 21);
}

TEST_F(NavicoSpokesTest, SendsNothingWhileTheGateIsClosed) {
  show(Model::g4, 1.5, 27780);
  View view(2048, 1024, 1.5, 0.0);
  const auto paint = [](Spoke&) {};
  take(view.next(paint));
  gate_->open(false);
  for (int i = 0; i < 20; ++i) take(view.next(paint));
  EXPECT_EQ(frames_, 0u);
  gate_->open(true);
  for (int i = 0; i < 2; ++i) take(view.next(paint));
  EXPECT_EQ(frames_, 1u);
  EXPECT_EQ(decoded_[0].fields.angle, 2 * 21 * 16);
}

TEST_F(NavicoSpokesTest, FollowsAScaleSomebodyElseChose) {
  show(Model::g4, 1.5, 20000);
  const auto paint = [](Spoke&) {};
  View view(2048, 1024, 3.0, 0.0);  // the gate has not heard of it
  for (int i = 0; i < 2; ++i) take(view.next(paint));
  ASSERT_EQ(frames_, 1u);
  EXPECT_EQ(decoded_[0].fields.reach, navico::spoke_range(Model::g4, 55560).reach);
}

}  // namespace
}  // namespace skerry::server
