// Signal K as its clients see it: REST, spokes and deltas, with a host that has no radars.
#include <gmock/gmock.h>
#include <google/protobuf/descriptor.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <numbers>
#include <optional>
#include <string>

#include "protocol/signalk/json.hpp"
#include "server/net/common/net_clock.hpp"
#include "server/net/signalk/signalk_rest.hpp"
#include "tests/unit/net/fake_host.hpp"
#include "tests/unit/net/fake_plotters.hpp"
#include "tests/unit/net/test_client.hpp"
#include "tests/unit/net/test_web_socket.hpp"

namespace skerry::server {
namespace {

using signalk::Json;
using testing::HasSubstr;

const std::string kRadars = "/signalk/v2/api/vessels/self/radars";

class Signalk : public testing::Test {
 protected:
  Signalk() : host_(2) {
    // A boat 1 NM to the east of the ship, who is at 0 N 0 E; and a buoy.
    host_.traffic_items = {
        {.number = 7,
         .kind = TrafficKind::boat,
         .name = "boat",
         .position = {0.0, 1852.0 / 111'319.5},
         .course_over_ground_deg = 270.0,
         .speed_mps = 5.0},
        {.number = 9,
         .kind = TrafficKind::aid_to_navigation,
         .name = "buoy",
         .position = {0.05, 0.0}},
        {.number = 1, .kind = TrafficKind::ship, .name = "she", .position = {}, .radars = {0}}};
    host_.plotters = &plotters_;
  }
  void start(NetConfig config = test_config()) {
    server_.emplace(host_, std::move(config), std::span<const WebFile>{});
    server_->start();
  }

  struct Answer {
    unsigned status = 0;
    Json body;
  };
  Answer ask(const std::string& method, const std::string& path, const std::string& body = {},
             const std::string& headers = {}) {
    const std::string answer =
        http_exchange(server_->http_port(),
                      method + " " + path + " HTTP/1.1\r\nHost: localhost\r\n" + headers +
                          "Connection: close\r\nContent-Length: " + std::to_string(body.size()) +
                          "\r\n\r\n" + body);
    const auto json = signalk::read_json(answer.substr(answer.find("\r\n\r\n") + 4));
    EXPECT_TRUE(json.has_value()) << answer;
    return {static_cast<unsigned>(std::stoul(answer.substr(9, 3))), json.value_or(Json())};
  }
  Json get(const std::string& path) {
    Answer answer = ask("GET", path);
    EXPECT_EQ(answer.status, 200u) << path;
    return answer.body;
  }
  void expect_refused(const Answer& answer, unsigned status, const std::string& part) {
    EXPECT_EQ(answer.status, status) << answer.body;
    EXPECT_EQ(answer.body["state"], "FAILED");
    EXPECT_EQ(answer.body["statusCode"], status);
    EXPECT_THAT(answer.body["message"].get<std::string>(), HasSubstr(part));
  }
  // The next message of a delta stream in which `wanted` finds what it looks for.
  static Json receive(TestWebSocket& stream, const std::function<bool(const Json&)>& wanted) {
    while (const auto message = stream.receive()) {
      EXPECT_FALSE(message->binary);
      const auto json = signalk::read_json(message->data);
      if (json && wanted(*json)) return *json;
    }
    ADD_FAILURE() << "the server closed before";
    return {};
  }
  static std::optional<Json> value_in(const Json& delta, const std::string& path,
                                      const char* list = "values") {
    if (!delta.contains("updates")) return std::nullopt;
    for (const Json& update : delta["updates"]) {
      if (!update.contains(list)) continue;
      for (const Json& each : update[list]) {
        if (each["path"] == path) return each["value"];
      }
    }
    return std::nullopt;
  }

  FakePlotters plotters_;  // before the host, which it outlives
  FakeHost host_;
  std::optional<NetServer> server_;
};

TEST_F(Signalk, ADisplayFindsTheRadarsOfTheOwnShip) {
  start();
  EXPECT_THAT(get("/signalk")["endpoints"]["v1"]["signalk-ws"].get<std::string>(),
              HasSubstr("ws://localhost/signalk/v1/stream"));
  EXPECT_EQ(get("/signalk/v2/features?enabled=1")["apis"][0], "radar");
  EXPECT_EQ(get("/skServer/loginStatus")["authenticationRequired"], false);
  EXPECT_EQ(get("/signalk/v1/api/vessels/self")["name"], "ship of radar 0");
  const Json list = get(kRadars + "/");
  EXPECT_EQ(list["version"], "3.4.0");
  ASSERT_EQ(list["radars"].size(), 1u) << "radar 1 is another ship's";
  EXPECT_EQ(list["radars"]["skerry0"]["radarIpAddress"], "127.0.0.1");
  EXPECT_EQ(get(kRadars + "/skerry0"), list["radars"]["skerry0"]);
  EXPECT_EQ(get(kRadars + "/_default"), list["radars"]["skerry0"]);
  const Json capabilities = get(kRadars + "/skerry0/capabilities");
  EXPECT_EQ(capabilities["spokesPerRevolution"], FakeHost::kSpokesPerTurn);
  EXPECT_EQ(capabilities["maxSpokeLength"], FakeHost::kCells);
  const Json controls = get(kRadars + "/skerry0/controls");
  EXPECT_EQ(controls["power"]["value"], 2);
  EXPECT_EQ(controls["range"]["value"], 22224);
  for (const auto& [key, value] : controls.items()) {
    EXPECT_TRUE(capabilities["controls"].contains(key)) << key;
  }
  EXPECT_EQ(controls.size(), capabilities["controls"].size());
  EXPECT_EQ(get(kRadars + "/skerry0/controls/gain")["value"], 50);
  EXPECT_EQ(get(kRadars + "/skerry0/state")["status"], "transmit");
  EXPECT_TRUE(get(kRadars + "/interfaces").contains("radars"));
}

TEST_F(Signalk, OlderDialectsFindThemWhereTheyLook) {
  NetConfig config = test_config();
  config.signalk.dialect = signalk::Dialect::array;
  start(config);
  EXPECT_EQ(get(kRadars)[0]["id"], "skerry0");
  EXPECT_TRUE(get("/v1/api/radars")["skerry0"].contains("spokeDataUrl"));
  EXPECT_TRUE(get("/signalk/v1/api/vessels/self/radars")["skerry0"].contains("streamUrl"));
  EXPECT_EQ(ask("PUT", kRadars + "/skerry0/gain", R"({"value":61})").status, 200u);
  EXPECT_EQ(host_.last_set().gain(), 61.0);
  EXPECT_EQ(ask("PUT", kRadars + "/skerry0", R"({"value":{"gain":{"value":62}}})").status, 200u);
  EXPECT_EQ(host_.last_set().gain(), 62.0);
}

TEST_F(Signalk, AnotherOwnShipHasAPortOfHerOwn) {
  NetConfig config = test_config();
  config.signalk.further_ships = {{.radar = 1, .port = 0}};
  start(config);
  ASSERT_EQ(server_->signalk_ports().size(), 1u);
  const std::string answer = http_get(server_->signalk_ports()[0], kRadars);
  EXPECT_THAT(answer, HasSubstr("skerry1"));
  EXPECT_THAT(answer, testing::Not(HasSubstr("skerry0")));
}

TEST_F(Signalk, ChangesReachTheRadarWithWhoAskedForThem) {
  start();
  const Answer answer = ask("PUT", kRadars + "/skerry0/controls/gain", R"({"value":33})");
  EXPECT_EQ(answer.status, 200u);
  EXPECT_EQ(answer.body.dump(), R"({"state":"COMPLETED","statusCode":200,"message":"OK"})");
  EXPECT_EQ(host_.last_set().gain(), 33.0);
  EXPECT_FALSE(host_.last_set().gain_auto());
  EXPECT_THAT(host_.origins().at(0), HasSubstr("Signal K display 127.0.0.1:"));
  EXPECT_EQ(get(kRadars + "/skerry0/controls/gain")["value"], 33);
  EXPECT_EQ(ask("PUT", kRadars + "/skerry0/controls/range", R"({"value":5556})").status, 200u);
  EXPECT_EQ(host_.last_set().range_nm(), 3.0);
  EXPECT_EQ(ask("PUT", kRadars + "/skerry0/controls/power", R"({"value":1})").status, 200u);
  EXPECT_TRUE(host_.last_set().has_transmit());
  EXPECT_FALSE(host_.last_set().transmit());
}

TEST_F(Signalk, WhatCannotBeDoneIsAnsweredWithItsStatus) {
  start();
  const std::string gain = kRadars + "/skerry0/controls/gain";
  expect_refused(ask("PUT", gain, "{"), 400, "not JSON");
  expect_refused(ask("PUT", gain, R"({"value":101})"), 400, "0 to 100");
  expect_refused(ask("PUT", kRadars + "/skerry0/controls/range", R"({"value":4000})"), 400, "3 NM");
  expect_refused(ask("PUT", kRadars + "/skerry0/controls/warp", R"({"value":9})"), 404, "warp");
  expect_refused(ask("PUT", kRadars + "/none/controls/gain", R"({"value":9})"), 404, "radar");
  expect_refused(ask("PUT", kRadars + "/skerry0/arpa/settings", "{}"), 501, "");
  expect_refused(ask("POST", kRadars, "{}"), 501, "");
  expect_refused(ask("GET", kRadars + "/skerry0/spokes"), 426, "WebSocket");
  expect_refused(ask("GET", "/signalk/v1/api/vessels/self/steering"), 404, "");
  host_.lock_gain();
  expect_refused(ask("PUT", gain, R"({"value":9})"), 403, "instructor");
  EXPECT_EQ(get(gain)["allowed"], false);
  const std::string other = http_exchange(
      server_->http_port(), "PUT " + gain +
                                " HTTP/1.1\r\nHost: localhost\r\nOrigin: http://evil.example\r\n"
                                "Connection: close\r\nContent-Length: 11\r\n\r\n{\"value\":9}");
  EXPECT_TRUE(other.starts_with("HTTP/1.1 403 ")) << other;
}

TEST_F(Signalk, SpokesComeByDozensAndWithoutAGap) {
  start();
  TestWebSocket spokes(server_->http_port(), kRadars + "/skerry0/spokes");
  ASSERT_TRUE(wait_until([this] {
    host_.publish();
    return host_.encoded("signalk") >= 64;
  }));
  std::size_t total = 0;
  unsigned next = 0;
  for (bool first = true; total < 64;) {
    const auto message = spokes.receive();
    ASSERT_TRUE(message.has_value());
    EXPECT_TRUE(message->binary);
    std::size_t count = 0;
    for (std::size_t at = 0; at < message->data.size(); ++count) {
      ASSERT_EQ(message->data[at], 0x12);
      std::size_t size = 0;
      int shift = 0;
      do {
        size |= std::size_t{message->data[++at] & 0x7Fu} << shift;
        shift += 7;
      } while (message->data[at] & 0x80);
      ++at;
      ASSERT_EQ(message->data[at], 0x08);
      unsigned angle = static_cast<std::uint8_t>(message->data[at + 1]);
      if (angle >= 0x80) {
        angle = (angle & 0x7F) | static_cast<unsigned>(message->data[at + 2]) << 7;
      }
      EXPECT_TRUE(first || angle == next) << angle;
      first = false;
      next = (angle + 1) % FakeHost::kSpokesPerTurn;
      at += size;
    }
    total += count;
  }
  const wire::Status status = server_->status();
  ASSERT_EQ(status.clients_size(), 1);
  EXPECT_EQ(status.clients(0).transport(), "signalk");
  EXPECT_GE(status.clients(0).spokes_sent() + 256, total);
}

TEST_F(Signalk, AStreamSaysHelloAndThenWhatWasSubscribedTo) {
  start();
  TestWebSocket stream(server_->http_port(), "/signalk/v1/stream?subscribe=none");
  const Json hello = receive(stream, [](const Json&) { return true; });
  EXPECT_EQ(hello["self"], "vessels.self");
  EXPECT_TRUE(hello.contains("version") && hello.contains("roles") && hello.contains("timestamp"));

  const std::string gain = "radars.skerry0.controls.gain";
  stream.send(R"({"subscribe":[{"path":"radars.*.controls.*","policy":"instant"}]})");
  const Json meta =
      receive(stream, [&](const Json& delta) { return value_in(delta, gain, "meta").has_value(); });
  EXPECT_EQ(meta["context"], "vessels.self");
  EXPECT_EQ(value_in(meta, gain, "meta")->at("maxValue"), 100);
  const auto has_gain = [&](const Json& delta) { return value_in(delta, gain).has_value(); };
  EXPECT_EQ(value_in(receive(stream, has_gain), gain)->at("value"), 50);

  TestClient console(server_->tcp_port());
  console.send(set_gain_message(1, 0, 77));
  const Json changed = receive(stream, has_gain);
  EXPECT_EQ(value_in(changed, gain)->at("value"), 77);
  EXPECT_FALSE(value_in(changed, "radars.skerry0.controls.range").has_value()) << "did not change";
  EXPECT_FALSE(value_in(changed, "navigation.position").has_value()) << "was not asked for";
}

// As an AIS receiver would tell of them.
TEST_F(Signalk, OtherShipsAreVesselsOfTheirOwn) {
  host_.traffic_items[0].mmsi = 257'000'222;
  host_.traffic_items[0].length_m = 12.0;
  host_.traffic_items[2].mmsi = 257'900'001;  // own ship's
  host_.traffic_items.push_back({.number = 11,
                                 .kind = TrafficKind::ship,
                                 .name = "beyond VHF",
                                 .mmsi = 257'000'333,
                                 .position = {1.1, 0.0}});
  start();
  const std::string boat = "urn:mrn:imo:mmsi:257000222";
  const Json vessels = get("/signalk/v1/api/vessels");
  EXPECT_EQ(vessels.size(), 2u) << vessels << ": self and the boat; marks are no vessels";
  EXPECT_EQ(vessels[boat]["name"], "boat");
  EXPECT_EQ(vessels[boat]["mmsi"], "257000222");
  EXPECT_EQ(vessels[boat]["navigation"]["speedOverGround"]["value"], 5.0);
  EXPECT_EQ(vessels[boat]["design"]["length"]["value"]["overall"], 12.0);
  EXPECT_EQ(get("/signalk/v1/api/vessels/" + boat + "/navigation/position")["value"]["latitude"],
            0.0);

  TestWebSocket stream(server_->http_port(), "/signalk/v1/stream?subscribe=none");
  stream.send(R"({"context":"vessels.*","subscribe":[{"path":"navigation.position"}]})");
  const auto is_boats = [&](const Json& delta) {
    return delta.contains("context") && delta["context"] == "vessels." + boat;
  };
  const Json delta = receive(stream, is_boats);
  EXPECT_EQ(value_in(delta, "")->at("name"), "boat");
  EXPECT_EQ(value_in(delta, "navigation.position")->at("latitude"), 0.0);
  EXPECT_FALSE(value_in(delta, "navigation.speedOverGround")) << "nobody asked for it";

  TestWebSocket all(server_->http_port(), "/signalk/v1/stream?subscribe=all");
  EXPECT_TRUE(value_in(receive(all, is_boats), "navigation.speedOverGround"));
}

TEST_F(Signalk, AStreamTakesChangesOfControls) {
  start();
  TestWebSocket stream(server_->http_port(), "/signalk/v1/stream?subscribe=none");
  stream.send(
      R"({"requestId":"a","put":{"path":"radars.skerry0.controls.gain","value":{"value":12}}})");
  const auto is_reply = [](const Json& message) { return message.contains("requestId"); };
  const Json done = receive(stream, is_reply);
  EXPECT_EQ(done["requestId"], "a");
  EXPECT_EQ(done["state"], "COMPLETED");
  EXPECT_EQ(host_.last_set().gain(), 12.0);
  stream.send(R"({"requestId":"b","put":{"path":"radars.none.controls.gain","value":1}})");
  EXPECT_EQ(receive(stream, is_reply)["statusCode"], 404);
  stream.send("not JSON");
  stream.send(R"({"requestId":"c","path":"radars.skerry0.controls.gain","value":13})");
  EXPECT_EQ(receive(stream, is_reply)["statusCode"], 200);
  EXPECT_EQ(server_->status().errors().at("signalk malformed request"), 1u);
}

TEST_F(Signalk, AMessageThatIsTooLongEndsTheStream) {
  start();
  TestWebSocket stream(server_->http_port(), "/signalk/v1/stream?subscribe=none");
  stream.receive();
  stream.send(std::string(20'000, ' '));
  EXPECT_FALSE(stream.receive().has_value());
  EXPECT_EQ(get(kRadars)["version"], "3.4.0") << "goes on";
}

TEST_F(Signalk, TargetsAreThoseOfThePlotterAndOrdersGoToIt) {
  plotters_.change([](wire::TargetList& list) {
    *list.add_targets() = FakePlotters::target(7, 1852.0);
    wire::Target& young = *list.add_targets() = FakePlotters::target(8, 3000.0);
    young.set_state(wire::TARGET_ACQUIRING);
    young.clear_course_deg();
    young.clear_speed_kn();
    young.clear_cpa_nm();
    young.clear_tcpa_min();
    *list.add_targets() = FakePlotters::target(901, 500.0);
    list.mutable_targets(2)->set_is_test(true);
  });
  start();
  EXPECT_FALSE(plotters_.is_wanted()) << "nobody has asked";
  const std::string targets = kRadars + "/skerry0/targets";
  const Json list = get(targets);
  EXPECT_TRUE(plotters_.is_wanted());
  ASSERT_EQ(list.size(), 2u) << "no test targets";
  EXPECT_EQ(list[0]["id"], 7);
  EXPECT_EQ(list[0]["status"], "tracking");
  EXPECT_NEAR(list[0]["position"]["distance"], 1852.0, 1e-9);
  EXPECT_NEAR(list[0]["position"]["bearing"], std::numbers::pi / 2, 1e-9);
  EXPECT_NEAR(list[0]["danger"]["tcpa"], 240.0, 1e-9);
  EXPECT_EQ(list[1]["status"], "acquiring");
  EXPECT_FALSE(list[1].contains("motion"));
  EXPECT_FALSE(list[1].contains("danger"));

  EXPECT_EQ(ask("DELETE", targets + "/7").status, 200u);
  EXPECT_EQ(plotters_.orders().back().cancel(0), 7u);
  plotters_.answer(wire::Reply::UNKNOWN, "target 9 is not tracked");
  expect_refused(ask("DELETE", targets + "/9"), 404, "not tracked");
  expect_refused(ask("DELETE", targets + "/x"), 404, "");
  expect_refused(ask("POST", targets, R"({"bearing":3,"distance":9000})"), 404, "");
  plotters_.answer(wire::Reply::OK, "12");
  const Answer acquired = ask("POST", targets, R"({"bearing":1.5708,"distance":1852})");
  EXPECT_EQ(acquired.status, 201u);
  EXPECT_EQ(acquired.body["targetId"], 12);
  EXPECT_NEAR(plotters_.orders().back().acquire().range_nm(), 1.0, 1e-9);
  EXPECT_NEAR(plotters_.orders().back().acquire().bearing_deg(), 90.0, 0.01);
  expect_refused(ask("POST", targets, R"({"bearing":"x"})"), 400, "radians");
}

TEST_F(Signalk, ATargetOrAlertThatIsGoneIsNullInTheStream) {
  plotters_.change([](wire::TargetList& list) {
    *list.add_targets() = FakePlotters::target(7, 1852.0);
    wire::Alert& alert = *list.add_alerts();
    alert.set_number(3044);
    alert.set_instance(1);
    alert.set_priority(wire::ALERT_ALARM);
    alert.set_text("Target 7: CPA .1 NM in 4 min");
  });
  start();
  TestWebSocket stream(server_->http_port(), "/signalk/v1/stream?subscribe=none");
  stream.send(
      R"({"subscribe":[{"path":"radars.*.targets.*","policy":"instant"},{"path":"notifications.*","policy":"instant"}]})");
  const std::string boat = "radars.skerry0.targets.7";
  const std::string alert = "notifications.radars.skerry0.3044.1";
  const Json told =
      receive(stream, [&](const Json& delta) { return value_in(delta, alert).has_value(); });
  EXPECT_EQ(value_in(told, boat)->at("id"), 7);
  EXPECT_EQ(value_in(told, alert)->at("state"), "alarm");
  EXPECT_EQ(value_in(told, alert)->at("method").size(), 2u) << "it sounds";
  plotters_.change([](wire::TargetList& list) {
    list.clear_targets();
    list.clear_alerts();
  });
  const Json gone = receive(stream, [&](const Json& delta) {
    const auto value = value_in(delta, boat);
    return value && value->is_null();
  });
  EXPECT_TRUE(value_in(gone, alert)->is_null());
}

TEST_F(Signalk, WhatIsTrackedWithoutAisIsAVesselToo) {
  plotters_.change([](wire::TargetList& list) {
    *list.add_targets() = FakePlotters::target(7, 1852.0);
    *list.add_targets() = FakePlotters::target(8, 3000.0);
    list.mutable_targets(1)->set_mmsi(257'000'222);
    *list.add_targets() = FakePlotters::target(9, 4000.0);
    list.mutable_targets(2)->set_mmsi(257'000'333);
  });
  host_.traffic_items[0].mmsi = 257'000'222;
  start();
  const Json vessels = get("/signalk/v1/api/vessels");
  const std::string key = "urn:mrn:signalk:uuid:534b4552-5259-4000-8000-000000000007";
  ASSERT_TRUE(vessels.contains(key)) << vessels;
  EXPECT_EQ(vessels.size(), 4u) << "target 8 is AIS's own, and 9's AIS has fallen silent";
  EXPECT_NEAR(vessels[key]["navigation"]["position"]["value"]["longitude"], 0.016637, 1e-5);
  EXPECT_FALSE(vessels[key].contains("mmsi"));
}

TEST_F(Signalk, WithoutAPlotterThereAreNoTargets) {
  host_.plotters = nullptr;
  start();
  EXPECT_EQ(get(kRadars + "/skerry0/targets").size(), 0u);
  expect_refused(ask("DELETE", kRadars + "/skerry0/targets/1"), 404, "plotter");
}

TEST_F(Signalk, ALoginTakesTheControlTokenForThePassword) {
  NetConfig config = test_config();
  config.control_token = "a secret";
  start(config);
  const auto login = [this](const std::string& password) {
    return ask("POST", "/signalk/v1/auth/login",
               R"({"username":"mate","password":")" + password + R"("})");
  };
  EXPECT_EQ(login("a guess").status, 401u);
  const Answer answer = login("a secret");
  EXPECT_EQ(answer.status, 200u);
  EXPECT_EQ(answer.body["token"], "a secret");
}

TEST_F(Signalk, ItCanBeLeftOut) {
  NetConfig config = test_config();
  config.signalk.serve = false;
  start(config);
  EXPECT_TRUE(http_get(server_->http_port(), kRadars).starts_with("HTTP/1.1 404 "));
}

TEST(SignalkAccess, WhoMayNotControlMayStillLook) {
  FakeHost host;
  NetContext context(host, test_config());
  SignalkSite site(context, 0);
  const auto ask = [&](std::string_view method, const std::string& path) {
    const SignalkRequest request{.method = method,
                                 .path = kRadars + path,
                                 .body = R"({"value":20})",
                                 .place = {"192.0.2.7:7480"},
                                 .refusal = why_not(context.gate.who(false, "", utc_now()),
                                                    signalk_right(method, kRadars + path))};
    return signalk_answer(site, {}, context.gate, request);
  };
  EXPECT_EQ(ask("PUT", "/skerry0/controls/gain").status, 403u);
  EXPECT_EQ(ask("DELETE", "/skerry0/targets/1").status, 403u);
  EXPECT_FALSE(host.last_set().has_gain());
  EXPECT_EQ(ask("GET", "/skerry0/controls/gain").status, 200u);
}

TEST(SignalkAccess, ATokenComesInTheAuthorizationHeader) {
  EXPECT_EQ(token_of("Bearer secret"), "secret");
  EXPECT_EQ(token_of("JWT secret"), "secret");
  EXPECT_EQ(token_of("Basic c2VjcmV0"), "");
  EXPECT_EQ(token_of(""), "");
}

// Four places for sectors, of which the server keeps a list.
TEST(SignalkSectors, APlaceStaysWhereADisplayPutIt) {
  SectorPlaces places;
  const auto* third = signalk::find_control("noTransmitSector3");
  wire::Settings settings;
  const wire::Set set =
      set_of(*third, {.value = -0.5, .end = 0.5, .enabled = true}, settings, places);
  ASSERT_EQ(set.blanked_sectors().sectors_size(), 1);
  EXPECT_NEAR(set.blanked_sectors().sectors(0).from_deg(), 360 - 0.5 * 180 / std::numbers::pi,
              1e-9);
  *settings.mutable_blanked_sectors() = set.blanked_sectors();
  const auto state_of = [&](const char* key) {
    for (const auto& [name, state] : control_states(settings, places)) {
      if (name == key) return state;
    }
    return signalk::ControlState{};
  };
  EXPECT_EQ(state_of("noTransmitSector1").enabled, false);
  EXPECT_EQ(state_of("noTransmitSector3").enabled, true);
  EXPECT_NEAR(state_of("noTransmitSector3").value, -0.5, 1e-12);
  EXPECT_NEAR(*state_of("noTransmitSector3").end, 0.5, 1e-12);

  const wire::Set off = set_of(*third, {.enabled = false}, settings, places);
  EXPECT_EQ(off.blanked_sectors().sectors_size(), 0);
  *settings.mutable_blanked_sectors() = off.blanked_sectors();
  EXPECT_NEAR(state_of("noTransmitSector3").value, -0.5, 1e-12) << "kept while it is off";

  settings.mutable_blanked_sectors()->add_sectors()->set_to_deg(90.0);
  EXPECT_EQ(state_of("noTransmitSector1").enabled, true) << "somebody else's comes first";
  EXPECT_EQ(state_of("noTransmitSector3").enabled, false);
}

// Every control's value comes back as it was given.
TEST(SignalkControls, EveryControlReachesSetAndComesBackFromSettings) {
  for (const signalk::ControlDefinition& definition : signalk::control_definitions()) {
    if (definition.kind == signalk::ControlKind::text ||
        definition.kind == signalk::ControlKind::sector) {
      continue;
    }
    SectorPlaces places;
    const double value = definition.choices.empty()
                             ? definition.min + 0.25 * (definition.max - definition.min)
                             : definition.choices[1].value;
    const wire::Set set = set_of(definition, {.value = value}, {}, places);
    wire::Settings settings;
    if (set.has_transmit()) settings.set_standby(!set.transmit());
    // Fields of one name are the same in both.
    for (int i = 0; i < wire::Set::descriptor()->field_count(); ++i) {
      const auto* from = wire::Set::descriptor()->field(i);
      const auto* to = wire::Settings::descriptor()->FindFieldByName(from->name());
      if (to == nullptr || !from->has_presence() || !set.GetReflection()->HasField(set, from)) {
        continue;
      }
      const auto& reflection = *settings.GetReflection();
      if (from->cpp_type() == from->CPPTYPE_DOUBLE) {
        reflection.SetDouble(&settings, to, set.GetReflection()->GetDouble(set, from));
      } else if (from->cpp_type() == from->CPPTYPE_BOOL) {
        reflection.SetBool(&settings, to, set.GetReflection()->GetBool(set, from));
      } else if (from->cpp_type() == from->CPPTYPE_ENUM) {
        reflection.SetEnumValue(&settings, to, set.GetReflection()->GetEnumValue(set, from));
      }
    }
    const auto states = control_states(settings, places);
    const auto found = std::find_if(states.begin(), states.end(),
                                    [&](const auto& each) { return each.first == definition.key; });
    ASSERT_NE(found, states.end()) << definition.key;
    EXPECT_NEAR(found->second.value, value, 1e-12 * definition.max) << definition.key;
    EXPECT_NE(value, 0.0) << definition.key << " is set to what it was";
  }
}

}  // namespace
}  // namespace skerry::server
