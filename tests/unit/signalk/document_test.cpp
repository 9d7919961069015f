// The documents of the interface, the subscriptions of its stream, and tracked targets.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "protocol/signalk/documents.hpp"
#include "protocol/signalk/subscription.hpp"
#include "protocol/signalk/target.hpp"

namespace skerry::signalk {
namespace {

using std::chrono::milliseconds;

Radar radar() {
  return {.id = "skerry0",
          .name = "Frida X-band",
          .brand = "Skerry",
          .model = "25 kW X",
          .address = "192.0.2.7",
          .spokes_per_turn = 2048,
          .cells = 1024,
          .legend = legend_of(8)};
}
ControlStates states() {
  return {{"power", {.value = kPowerTransmit}},
          {"range", {.value = 5556}},
          {"gain", {.value = 50, .automatic = false}}};
}

TEST(RadarList, OfTheCurrentDialectHasAVersionAndNoAddressesOfStreams) {
  const ListedRadar listed[] = {{radar(), states()}};
  EXPECT_EQ(text_of(radar_list_document(listed, Dialect::current, HttpPlace{"192.0.2.7:7480"})),
            R"({"version":"3.4.0","radars":{"skerry0":{"name":"Frida X-band","brand":"Skerry",)"
            R"("model":"25 kW X","radarIpAddress":"192.0.2.7"}}})");
}

TEST(RadarList, OfOlderDialectsIsAnArrayOrKeyed) {
  const ListedRadar listed[] = {{radar(), states()}};
  const Json array = radar_list_document(listed, Dialect::array, HttpPlace{"h:1"});
  ASSERT_TRUE(array.is_array());
  EXPECT_EQ(array[0]["id"], "skerry0");
  EXPECT_EQ(array[0]["status"], "transmit");
  EXPECT_EQ(array[0]["spokesPerRevolution"], 2048);
  EXPECT_EQ(array[0]["maxSpokeLen"], 1024);
  EXPECT_EQ(array[0]["range"], 5556);
  EXPECT_EQ(array[0]["controls"]["gain"]["value"], 50);
  const Json keyed = radar_list_document(listed, Dialect::keyed, HttpPlace{"h:1"});
  EXPECT_EQ(keyed["skerry0"]["spokeDataUrl"],
            "ws://h:1/signalk/v2/api/vessels/self/radars/skerry0/spokes");
  EXPECT_EQ(keyed["skerry0"]["streamUrl"], "ws://h:1/signalk/v1/stream");
}

TEST(Capabilities, SayWhatASpokeIsAndWhichControlsThereAre) {
  const Json document = capabilities_document(radar());
  EXPECT_EQ(document["spokesPerRevolution"], 2048);
  EXPECT_EQ(document["maxSpokeLength"], 1024);
  EXPECT_EQ(document["pixelValues"], 128);
  EXPECT_EQ(document["minRange"], 232);
  EXPECT_EQ(document["maxRange"], 177792);
  EXPECT_EQ(document["supportedRanges"].size(), 12u);
  EXPECT_EQ(document["noTransmitSectors"], 4);
  EXPECT_EQ(document["controls"].size(), control_definitions().size());
  EXPECT_EQ(document["legend"]["pixels"].size(), legend_of(8).size());
}

TEST(Controls, PowerIsANumber) {
  const Json document = controls_document(states());
  EXPECT_TRUE(document["power"]["value"].is_number_integer());
  EXPECT_EQ(document["power"]["value"], 2);
}

TEST(OwnShip, IsInSiUnits) {
  const OwnShip ship{.name = "Frida",
                     .position = GeoPoint{60.5, 4.96},
                     .heading_deg = 180.0,
                     .course_over_ground_deg = 90.0,
                     .speed_over_ground_mps = 5.0,
                     .rate_of_turn_deg_min = 60.0};
  const Json tree = own_ship_document(ship, UtcTime{});
  EXPECT_EQ(tree["name"], "Frida");
  const Json& navigation = tree["navigation"];
  EXPECT_EQ(navigation["position"]["value"]["latitude"], 60.5);
  EXPECT_NEAR(navigation["headingTrue"]["value"], std::numbers::pi, 1e-12);
  EXPECT_NEAR(navigation["courseOverGroundTrue"]["value"], std::numbers::pi / 2, 1e-12);
  EXPECT_EQ(navigation["speedOverGround"]["value"], 5.0);
  EXPECT_NEAR(navigation["rateOfTurn"]["value"], std::numbers::pi / 180, 1e-12);
}

TEST(OwnShip, SaysNothingOfWhatNobodyKnows) {
  const Json tree = own_ship_document({.name = "Frida", .heading_deg = 180.0}, UtcTime{});
  EXPECT_EQ(tree["navigation"].size(), 1u);
  EXPECT_TRUE(tree["navigation"].contains("headingTrue"));
}

TEST(Time, IsIsoWithMilliseconds) {
  EXPECT_EQ(iso_time(UtcTime{}), "1970-01-01T00:00:00.000Z");
  EXPECT_EQ(iso_time(UtcTime(milliseconds(951'827'696'250))), "2000-02-29T12:34:56.250Z");
}

TEST(Subscription, PatternsFitPathsByTheirStars) {
  EXPECT_TRUE(path_matches("*", "navigation.position"));
  EXPECT_TRUE(path_matches("radars.*", "radars.skerry0.controls.gain"));
  EXPECT_TRUE(path_matches("radars.*.controls.*", "radars.skerry0.controls.gain"));
  EXPECT_TRUE(path_matches("radars.skerry0.controls.gain", "radars.skerry0.controls.gain"));
  EXPECT_FALSE(path_matches("radars.*.controls.*", "radars.skerry0.targets.1"));
  EXPECT_FALSE(path_matches("radars.skerry1.*", "radars.skerry0.controls.gain"));
  EXPECT_FALSE(path_matches("", "navigation.position"));
  EXPECT_FALSE(path_matches("navigation", "navigation.position"));
  EXPECT_TRUE(path_matches("*a*b*c", "xxaxxbxxaxbxc"));
  EXPECT_FALSE(path_matches("*a*b*c", "xxaxxbxxaxbx"));
}

TEST(Subscription, TheShortestPeriodOfThoseThatFitCounts) {
  Subscriptions wanted;
  EXPECT_FALSE(wanted.wants("navigation.position"));
  wanted.subscribe("*", milliseconds(5000));
  wanted.subscribe("navigation.*", milliseconds(200));
  EXPECT_EQ(wanted.period_of("navigation.position"), milliseconds(200));
  EXPECT_EQ(wanted.period_of("radars.skerry0.controls.gain"), milliseconds(5000));
  wanted.unsubscribe("*");
  EXPECT_TRUE(wanted.empty());
}

TEST(Subscription, ThereAreOnlySoMany) {
  Subscriptions wanted;
  for (int i = 0; i < 1000; ++i) wanted.subscribe(fmt::format("p{}", i), milliseconds(1000));
  EXPECT_TRUE(wanted.wants("p0"));
  EXPECT_FALSE(wanted.wants("p999"));
}

TEST(StreamRequest, SubscribesToPathsOfOnesOwnShipAlone) {
  const auto request = read_stream_request(
      R"({"context":"vessels.self","subscribe":[{"path":"radars.*","policy":"instant"},)"
      R"({"path":"navigation.*","period":"2000"},{"path":7},{}]})");
  ASSERT_TRUE(request.ok());
  ASSERT_EQ(request->subscribe.size(), 2u);
  EXPECT_EQ(request->subscribe[0].period, Subscriptions::kShortestPeriod);
  EXPECT_EQ(request->subscribe[1].period, milliseconds(2000));
  const auto others = read_stream_request(R"({"context":"atons.*","subscribe":[{"path":"*"}]})");
  ASSERT_TRUE(others.ok());
  EXPECT_TRUE(others->subscribe.empty());
}

TEST(StreamRequest, SetsControlsInEitherForm) {
  const auto plain =
      read_stream_request(R"({"path":"radars.skerry0.controls.gain","value":40,"auto":false})");
  ASSERT_TRUE(plain.ok());
  EXPECT_EQ(plain->put_path, "radars.skerry0.controls.gain");
  EXPECT_EQ(read_change(plain->put_value, *find_control("gain"))->value, 40.0);
  const auto put = read_stream_request(
      R"({"requestId":"7","put":{"path":"radars.skerry0.controls.gain","value":{"value":41}}})");
  ASSERT_TRUE(put.ok());
  EXPECT_EQ(put->request_id, "7");
  EXPECT_EQ(read_change(put->put_value, *find_control("gain"))->value, 41.0);
  for (const char* bad : {"", "[]", "7", "{", "\"subscribe\""}) {
    EXPECT_FALSE(read_stream_request(bad).ok()) << bad;
  }
}

TEST(Target, ItsDocumentLeavesOutWhatThereIsNot) {
  Target target{.number = 3, .position = {60.1, 5.0}, .range_m = 11'141.0, .bearing_deg = 360.0};
  const Json young = target_document(target);
  EXPECT_EQ(young["id"], 3);
  EXPECT_EQ(young["status"], "tracking");
  EXPECT_EQ(young["acquisition"], "auto");
  EXPECT_EQ(young["position"]["bearing"], 0.0);
  for (const char* absent : {"motion", "danger", "name", "mmsi"}) {
    EXPECT_FALSE(young.contains(absent)) << absent;
  }
  target.course_deg = 180.0;
  target.speed_mps = 9.0;
  target.cpa_m = 120.0;
  target.tcpa_s = -5.0;
  target.acquired_by_hand = true;
  target.name = "Frida";
  target.mmsi = 2'570'001;
  EXPECT_FALSE(target_document(target).contains("danger")) << "past";
  target.tcpa_s = 60.0;
  const Json meets = target_document(target);
  EXPECT_EQ(meets["acquisition"], "manual");
  EXPECT_NEAR(meets["motion"]["course"], std::numbers::pi, 1e-12);
  EXPECT_EQ(meets["danger"]["cpa"], 120.0);
  EXPECT_EQ(meets["mmsi"], "002570001");
}

TEST(Notification, SoundsUntilItIsAcknowledged) {
  const Json alarm = notification_document(NotificationState::alarm, true, "near", UtcTime{});
  EXPECT_EQ(alarm["state"], "alarm");
  EXPECT_EQ(alarm["method"], Json::array({"visual", "sound"}));
  EXPECT_EQ(alarm["timestamp"], "1970-01-01T00:00:00.000Z");
  const Json seen = notification_document(NotificationState::warn, false, "lost", UtcTime{});
  EXPECT_EQ(seen["method"], Json::array({"visual"}));
}

}  // namespace
}  // namespace skerry::signalk
