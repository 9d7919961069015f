// What a real Navico radar is told, read as the emulated one reads a display's commands.
#include "server/live/live_commands.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "protocol/garmin/xhd_packet.hpp"
#include "protocol/navico/command.hpp"
#include "protocol/raymarine/quantum_command.hpp"
#include "protocol/video/range_scale.hpp"
#include "protocol/wire/schema.hpp"
#include "server/displays/garmin/xhd_controls.hpp"
#include "server/displays/navico/navico_controls.hpp"
#include "server/displays/raymarine/quantum_controls.hpp"

namespace skerry::server {
namespace {

using navico::Model;
using testing::HasSubstr;

void take(const wire::Set& change, wire::Settings& out) {
  for (const auto* control : wire::fields_of(*wire::Controls::descriptor())) {
    if (control->message_type() != nullptr) continue;
    if (const auto value = wire::value_of(change, *control)) {
      wire::put_value(out, *control, *value);
    }
  }
  if (change.has_blanked_sectors()) *out.mutable_blanked_sectors() = change.blanked_sectors();
}

// What an emulated radar has after it obeyed.
template <typename Controls, typename Decode>
wire::Settings obeyed_by(Controls controls, const Commands& commands, Decode decode) {
  wire::Settings out;
  EXPECT_TRUE(commands.ok()) << commands.error();
  if (!commands) return out;
  controls.observe(out);
  for (const Bytes& bytes : *commands) {
    const auto command = decode(bytes);
    EXPECT_TRUE(command.ok());
    EXPECT_FALSE(command->clamped);
    if (const auto change = controls.set_of(*command, out)) take(*change, out);
    controls.accept(*command, out);
  }
  return out;
}
wire::Settings obeyed_by_xhd(const wire::Set& set) {
  return obeyed_by(XhdControls(), garmin_commands(set, {}), garmin::decode_command);
}
wire::Settings obeyed_by_quantum(const wire::Set& set) {
  return obeyed_by(QuantumControls(), quantum_commands(set, {}), raymarine::decode_quantum_command);
}

using Obeyed = wire::Settings (*)(const wire::Set&);
struct Make {
  const char* kind;
  Obeyed obeyed;
  double nearest_nm, farthest_nm;  // of its ranges, those that are scales of ours
};
class OtherCommands : public testing::TestWithParam<Make> {};

TEST_P(OtherCommands, EveryLevelArrives) {
  for (int percent = 0; percent <= 100; ++percent) {
    wire::Set set;
    set.set_gain_auto(false);
    set.set_gain(percent);
    set.set_sea_auto(false);
    set.set_sea(percent);
    set.set_rain(percent);
    const wire::Settings out = GetParam().obeyed(set);
    EXPECT_EQ(out.gain(), percent);
    EXPECT_EQ(out.sea(), percent);
    EXPECT_EQ(out.rain(), percent);
  }
}

TEST_P(OtherCommands, EveryRangeArrivesOrIsRefused) {
  for (const double nm : RangeScale::kNauticalMiles) {
    wire::Set set;
    set.set_range_nm(nm);
    if (nm >= GetParam().nearest_nm && nm <= GetParam().farthest_nm) {
      EXPECT_EQ(GetParam().obeyed(set).range_nm(), nm);
    } else {
      const auto commands = live_commands(*find_live_kind(GetParam().kind), {}, set, {});
      ASSERT_FALSE(commands.ok()) << nm;
      EXPECT_THAT(commands.error(), HasSubstr("allowed"));
    }
  }
}

TEST_P(OtherCommands, SwitchesAndInstallationArrive) {
  wire::Set set;
  set.set_gain_auto(true);
  set.set_sea_auto(true);
  set.set_interference_rejection(100);
  set.set_bearing_alignment_deg(-12.5);
  wire::Settings out = GetParam().obeyed(set);
  EXPECT_TRUE(out.gain_auto());
  EXPECT_TRUE(out.sea_auto());
  EXPECT_EQ(out.interference_rejection(), 100);
  EXPECT_EQ(out.bearing_alignment_deg(), -12.5);
}

TEST_P(OtherCommands, WhatItDoesNotHaveIsNamed) {
  wire::Set set;
  set.set_tune(30);
  const auto commands = live_commands(*find_live_kind(GetParam().kind), {}, set, {});
  ASSERT_FALSE(commands.ok());
  EXPECT_THAT(commands.error(), HasSubstr("'tune'"));
}

INSTANTIATE_TEST_SUITE_P(EveryMake, OtherCommands,
                         testing::Values(Make{"garmin_xhd", obeyed_by_xhd, 0.125, 48.0},
                                         Make{"raymarine_quantum", obeyed_by_quantum, 0.03, 64.0}),
                         [](const auto& one) { return std::string(one.param.kind); });

TEST(LiveCommands, ThoseThatOnlySendTakeNone) {
  wire::Set set;
  set.set_gain(1);
  for (const LiveKind& kind : live_kinds()) {
    EXPECT_EQ(live_commands(kind, kind.model, set, {}).ok(), kind.has_commands) << kind.name;
  }
}

class NavicoCommands : public testing::TestWithParam<Model> {
 protected:
  // What the radar has after it obeyed.
  wire::Settings obeyed(const wire::Set& set, const wire::Settings& now = {}) {
    const auto commands = navico_commands(GetParam(), set, now);
    EXPECT_TRUE(commands.ok()) << commands.error();
    NavicoControls controls(GetParam());
    wire::Settings out = now;
    if (!commands) return out;
    for (const Bytes& bytes : *commands) {
      const auto command = navico::decode_command(bytes);
      EXPECT_TRUE(command.ok());
      if (command->kind == navico::CommandKind::transmit) out.set_standby(command->value == 0);
      if (command->kind == navico::CommandKind::transmit ||
          command->kind == navico::CommandKind::prepare) {
        continue;
      }
      const auto change = controls.change(*command, out);
      EXPECT_TRUE(change.has_value()) << "refused";
      if (change) take(*change, out);
      controls.observe(out);
    }
    return out;
  }
};

TEST_P(NavicoCommands, EveryLevelArrives) {
  for (int percent = 0; percent <= 100; ++percent) {
    wire::Set set;
    set.set_gain(percent);
    set.set_gain_auto(false);
    set.set_rain(percent);
    set.set_sea(percent);
    set.set_sea_auto(false);
    set.set_side_lobe_suppression(percent);
    set.set_side_lobe_auto(percent % 2 == 0);
    const wire::Settings out = obeyed(set);
    // A level is a 255th.
    EXPECT_NEAR(out.gain(), percent, 0.4);
    EXPECT_NEAR(out.rain(), percent, 0.4);
    EXPECT_NEAR(out.sea(), percent, 0.4);
    EXPECT_NEAR(out.side_lobe_suppression(), percent, 0.4);
    EXPECT_EQ(out.side_lobe_auto(), percent % 2 == 0);
    // And is the same whole percent on a display that cuts off.
    EXPECT_EQ(std::floor(out.gain()), percent);
  }
}

TEST_P(NavicoCommands, EveryRangeArrivesOrIsRefused) {
  for (const double nm : RangeScale::kNauticalMiles) {
    wire::Set set;
    set.set_range_nm(nm);
    const double dm = nm * 18'520.0;
    const bool has = dm >= navico::kMinRangeDm && dm <= navico::max_range_dm(GetParam()) + 0.5;
    if (has) {
      EXPECT_EQ(obeyed(set).range_nm(), nm);
    } else {
      const auto commands = navico_commands(GetParam(), set, {});
      ASSERT_FALSE(commands.ok()) << nm;
      EXPECT_THAT(commands.error(), HasSubstr("range"));
    }
  }
}

TEST_P(NavicoCommands, OnlyAPartOfAControlKeepsTheOther) {
  wire::Settings now;
  now.set_gain(60);
  now.set_sea_auto(true);
  now.set_sea(50);
  wire::Set set;
  set.set_gain_auto(true);
  wire::Settings out = obeyed(set, now);
  EXPECT_TRUE(out.gain_auto());
  EXPECT_NEAR(out.gain(), 60, 0.4);
  set.Clear();
  set.set_sea_auto(false);
  out = obeyed(set, now);
  EXPECT_FALSE(out.sea_auto());
  EXPECT_NEAR(out.sea(), 50, 0.4);
}

TEST_P(NavicoCommands, StepsInstallationAndSectorsArrive) {
  wire::Set set;
  set.set_interference_rejection(66);
  set.set_target_boost(100);
  set.set_bearing_alignment_deg(-12.3);
  set.set_antenna_height_m(12.5);
  set.set_rotation_rpm(47);
  auto* const sector = set.mutable_blanked_sectors()->add_sectors();
  sector->set_from_deg(350);
  sector->set_to_deg(20.5);
  const wire::Settings out = obeyed(set);
  EXPECT_NEAR(out.interference_rejection(), 66.7, 0.1);
  EXPECT_EQ(out.target_boost(), 100);
  EXPECT_NEAR(out.bearing_alignment_deg(), -12.3, 0.01);
  EXPECT_NEAR(out.antenna_height_m(), 12.5, 1e-9);
  EXPECT_EQ(out.rotation_rpm(), 48);
  ASSERT_EQ(out.blanked_sectors().sectors_size(), 1);
  EXPECT_NEAR(out.blanked_sectors().sectors(0).to_deg(), 20.5, 1e-9);
}

TEST_P(NavicoCommands, TransmitComesLast) {
  wire::Set set;
  set.set_transmit(true);
  set.set_gain(10);
  const auto commands = navico_commands(GetParam(), set, {});
  ASSERT_TRUE(commands.ok());
  EXPECT_EQ(navico::decode_command(commands->back())->kind, navico::CommandKind::transmit);
  EXPECT_FALSE(obeyed(set).standby());
}

TEST_P(NavicoCommands, WhatItDoesNotHaveIsNamed) {
  wire::Set set;
  set.set_gain(10);
  set.set_tune(30);
  const auto commands = navico_commands(GetParam(), set, {});
  ASSERT_FALSE(commands.ok());
  EXPECT_THAT(commands.error(), HasSubstr("'tune'"));
  wire::Set course;
  course.set_course_deg(90);
  EXPECT_FALSE(navico_commands(GetParam(), course, {}).ok());
}

TEST_P(NavicoCommands, DopplerIsOfAHaloAlone) {
  wire::Set set;
  set.set_doppler(wire::DopplerMode(1));
  EXPECT_EQ(navico_commands(GetParam(), set, {}).ok(), navico::has_doppler(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(EveryModel, NavicoCommands,
                         testing::Values(Model::br24, Model::g3, Model::g4, Model::halo20,
                                         Model::halo),
                         [](const auto& one) {
                           std::string name;
                           for (const char c : navico::name_of(one.param)) name += c;
                           return "Model" + name;
                         });

}  // namespace
}  // namespace skerry::server
