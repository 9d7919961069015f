// Where a live radar is listened for, as locators tell.
#include "server/live/live_groups.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "protocol/navico/locator.hpp"
#include "protocol/raymarine/quantum_locator.hpp"

namespace skerry::server {
namespace {

using testing::Contains;
using testing::Not;

constexpr Ipv4Endpoint kLocatorFrom{ipv4(192, 0, 2, 7), 6878};

LiveSource locator_source_of(const char* kind) {
  LiveSource source;
  source.kind = find_live_kind(kind);
  return source;
}

navico::Addresses addresses(std::uint8_t last) {
  return {
      {ipv4(236, 6, 9, last), 6000}, {ipv4(236, 6, 9, last), 6001}, {ipv4(236, 6, 9, last), 6002}};
}

bool hear(LiveGroups& groups, const Ipv4Endpoint& to, const Bytes& payload,
          const Ipv4Endpoint& from = kLocatorFrom) {
  return groups.hear({{}, from, to, payload});
}

Bytes locator(std::uint8_t a, std::uint8_t b) {
  return navico::encode_locator(
      navico::make_locator("1403302452", {ipv4(192, 0, 2, 7), 0}, addresses(a), addresses(b)));
}

TEST(LiveGroups, AHalosAreThoseThatItsLocatorTells) {
  LiveGroups groups(locator_source_of("navico_halo"));
  EXPECT_THAT(groups.all(), Contains(navico::kLocatorGroup));
  EXPECT_TRUE(hear(groups, navico::kLocatorGroup, locator(10, 20)));
  for (const std::uint8_t last : {std::uint8_t{10}, std::uint8_t{20}}) {
    EXPECT_THAT(groups.all(), Contains(addresses(last).data));
    EXPECT_THAT(groups.all(), Contains(addresses(last).report));
    EXPECT_THAT(groups.all(),
                Not(Contains(addresses(last).send)));  // commands are not its business
  }
  EXPECT_EQ(groups.commands(), addresses(10).send);
  EXPECT_TRUE(groups.is_picture(addresses(10).data));
  EXPECT_FALSE(groups.is_picture(addresses(20).data));
  EXPECT_FALSE(hear(groups, navico::kLocatorGroup, locator(10, 20)));  // nothing new
}

TEST(LiveGroups, RangeBIsTheOther) {
  LiveSource source = locator_source_of("navico_halo");
  source.second_range = true;
  LiveGroups groups(source);
  hear(groups, navico::kLocatorGroup, locator(10, 20));
  EXPECT_FALSE(groups.is_picture(addresses(10).data));
  EXPECT_TRUE(groups.is_picture(addresses(20).data));
}

TEST(LiveGroups, AQuantumsAreAnnouncedAndOtherDevicesAreNot) {
  LiveGroups groups(locator_source_of("raymarine_quantum"));
  const Ipv4Endpoint data{ipv4(232, 1, 144, 100), 2574}, radar{ipv4(192, 0, 2, 7), 2575};
  const auto packet = [&](std::uint32_t model) {
    return raymarine::encode_locator_addresses({{7, model}, data, radar});
  };
  EXPECT_FALSE(hear(groups, raymarine::kLocatorAddress, packet(raymarine::kAnalogueModel)));
  EXPECT_TRUE(hear(groups, raymarine::kLocatorAddress, packet(raymarine::kQuantumModel)));
  EXPECT_THAT(groups.all(), Contains(data));
  EXPECT_EQ(groups.commands(), radar);
  // One that announces another's address is not told anything.
  hear(groups, raymarine::kLocatorAddress,
       raymarine::encode_locator_addresses(
           {{7, raymarine::kQuantumModel}, data, {ipv4(192, 0, 2, 99), 2575}}));
  EXPECT_EQ(groups.commands(), radar);
}

TEST(LiveGroups, AFloodOfLocatorsIsBounded) {
  LiveGroups groups(locator_source_of("navico_halo"));
  for (int i = 0; i < 200; ++i) {
    hear(groups, navico::kLocatorGroup,
         locator(static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(i + 1)));
  }
  EXPECT_EQ(groups.all().size(), LiveGroups::kMost);
  EXPECT_GT(groups.left_out(), 100u);
}

TEST(LiveGroups, ARadarMayComeBackElsewhere) {
  LiveGroups groups(locator_source_of("navico_halo"));
  hear(groups, navico::kLocatorGroup, locator(10, 20));
  groups.begin_anew();
  EXPECT_THAT(groups.all(), Not(Contains(addresses(10).data)));
  EXPECT_TRUE(hear(groups, navico::kLocatorGroup, locator(30, 40)));
  EXPECT_THAT(groups.all(), Contains(addresses(30).data));
  EXPECT_EQ(groups.commands(), addresses(30).send);
  EXPECT_EQ(groups.questions().size(), 1u);
}

TEST(LiveGroups, OnlyTheNamedRadarsLocatorCounts) {
  LiveSource source = locator_source_of("navico_halo");
  source.from = kLocatorFrom.address;
  LiveGroups groups(source);
  EXPECT_FALSE(hear(groups, navico::kLocatorGroup, locator(10, 20), {ipv4(192, 0, 2, 8), 6878}));
  EXPECT_TRUE(hear(groups, navico::kLocatorGroup, locator(10, 20)));
}

TEST(LiveGroups, EveryKindHasAnAddress) {
  for (const LiveKind& kind : live_kinds()) {
    LiveSource source = locator_source_of(std::string(kind.name).c_str());
    if (kind.has_address) source.at = Ipv4Endpoint{ipv4(239, 192, 43, 78), 4378};
    EXPECT_FALSE(LiveGroups(source).all().empty()) << kind.name;
  }
}

}  // namespace
}  // namespace skerry::server
