// The built program `skerry`, run against fake servers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <future>

#include "protocol/asterix/cat240.hpp"
#include "tests/unit/clients/fake_server.hpp"
#include "tests/unit/clients/program.hpp"
#include "tests/unit/picture/synthetic_scan.hpp"

namespace skerry::client {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

struct Outcome {
  int code;
  std::string out, err;
};

Outcome run(std::vector<std::string> arguments) {
  Program program(std::move(arguments));
  const int code = program.wait();
  return {code, program.out(), program.err()};
}

Outcome run_at(const FakeServer& server, std::vector<std::string> arguments) {
  arguments.insert(arguments.end(), {"--port", std::to_string(server.port())});
  return run(std::move(arguments));
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t from = 0, to; from < text.size(); from = to + 1) {
    to = std::min(text.find('\n', from), text.size());
    lines.push_back(text.substr(from, to - from));
  }
  return lines;
}

Spoke striped(std::uint32_t scan, std::uint32_t index) {
  Spoke spoke = spoke_of(kSmall, scan, index, 30.0);
  for (std::size_t n = 0; n < spoke.cells.size(); ++n) {
    spoke.cells[n] = static_cast<std::uint8_t>(index + n);
  }
  return spoke;
}

// Spokes from `index` of `scan` on until the client leaves or `count` are sent.
void send_spokes(FakePeer& peer, std::uint32_t scan, std::uint32_t index, std::uint32_t count) {
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::uint32_t at = index + k;
    if (!peer.send(striped(scan + at / 256, at % 256))) return;
  }
}

TEST(Cli, SaysWhatItCanDoWithoutArguments) {
  const Outcome outcome = run({});
  EXPECT_EQ(outcome.code, 2);
  for (const char* command : {"status", "snapshot", "dump", "set"}) {
    EXPECT_THAT(outcome.err, HasSubstr(command));
    const Outcome help = run({command, "--help"});
    EXPECT_EQ(help.code, 0);
    EXPECT_THAT(help.out, HasSubstr(std::string("Examples:\n  skerry ") + command));
  }
  EXPECT_EQ(run({"--help"}).code, 0);
  EXPECT_THAT(run({"--version"}).out, StartsWith("skerry "));
}

TEST(Cli, EndsWithTwoWhenTheCommandLineIsWrong) {
  const std::vector<std::vector<std::string>> wrong = {
      {"launch"},
      {"status", "extra"},
      {"status", "--port", "70000"},
      {"status", "--port", "x"},
      {"snapshot", "--size", "10"},
      {"snapshot", "--size", "100000"},
      {"snapshot", "--radar", "-1"},
      {"snapshot", "--timeout", "0"},
      {"snapshot", "--timeout", "nan"},
      {"dump", "--format", "xml"},
      {"dump", "--count", "0"},
      {"dump", "--turns", "-3"},
      {"dump", "--udp", "somewhere"},
      {"dump", "--udp", "7411", "--cat240", "8600"},
      {"set"},
      {"set", "--gain", "loud"},
      {"set", "--course", "nan"},
      {"set", "--radar", "1"},
      {"set", "--instructor"},
      {"set", "--doppler", "fast"},
      {"set", "--blank", "10"},
      {"set", "--blank", "10-"},
      {"set", "--blank", "10-twenty"},
      {"set", "--blank", "10-20", "none"}};
  for (const auto& arguments : wrong) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 2) << testing::PrintToString(arguments);
    EXPECT_NE(outcome.err, "") << testing::PrintToString(arguments);
    EXPECT_EQ(outcome.out, "") << testing::PrintToString(arguments);
  }
}

TEST(Cli, SaysWhereItFoundNoServerAndWhatToTry) {
  const std::string port = std::to_string(unused_port());
  const std::vector<std::vector<std::string>> commands = {
      {"status"}, {"snapshot"}, {"dump"}, {"set", "--gain", "50"}};
  for (auto arguments : commands) {
    arguments.insert(arguments.end(), {"--port", port});
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.err, HasSubstr("127.0.0.1:" + port + " refused"));
    EXPECT_THAT(outcome.err, HasSubstr("server/run"));
  }
}

TEST(Cli, ShowsTheStatus) {
  const auto script = [](FakePeer& peer) {
    peer.say_hello();
    if (!peer.receive()) return;
    wire::ServerMessage message;
    auto* status = message.mutable_status();
    status->set_server("skerryd 0.1.0");
    status->set_scenario("Bergen\x1b[2J");
    status->set_uptime_s(3723.0);
    auto* radar = status->add_radars();
    radar->set_name("Main mast");
    radar->set_spokes_late(12);
    radar->mutable_settings()->set_range_nm(0.75);
    radar->mutable_own_ship()->set_name("SKARV");
    radar->mutable_own_ship()->set_latitude_deg(60.5);
    auto* client = status->add_clients();
    client->set_peer("127.0.0.1:55555");
    client->set_spokes_lost(4711);
    (*status->mutable_errors())["bad frame"] = 3;
    peer.send(message);
    peer.wait_until_client_leaves();
  };
  FakeServer server(script);
  const Outcome table = run_at(server, {"status"});
  EXPECT_EQ(table.code, 0) << table.err;
  for (const char* text :
       {"skerryd 0.1.0", "Bergen?[2J", "1:02:03", "Main mast", "0.75 NM", "SKARV",
        "60\u00b030.000'N", "127.0.0.1:55555", "4711", "3  bad frame"}) {
    EXPECT_THAT(table.out, HasSubstr(text));
  }
  FakeServer again(script);
  const Outcome json = run_at(again, {"status", "--json"});
  EXPECT_EQ(json.code, 0);
  EXPECT_THAT(json.out, StartsWith("{"));
  EXPECT_THAT(json.out, HasSubstr("\"spokes_late\": \"12\""));
}

TEST(Cli, SetsAndPrintsTheReply) {
  FakeServer server([](FakePeer& peer) {
    peer.say_hello();
    const auto message = peer.receive();
    ASSERT_TRUE(message && message->has_set());
    const wire::Set& set = message->set();
    EXPECT_DOUBLE_EQ(set.speed_kn(), -5.5);
    EXPECT_DOUBLE_EQ(set.range_nm(), 0.125);
    EXPECT_TRUE(set.has_course_deg());
    EXPECT_DOUBLE_EQ(set.course_deg(), 0.0);
    EXPECT_FALSE(set.has_gain());
    EXPECT_EQ(set.radar(), 2u);
    EXPECT_EQ(set.token(), "secret");
    peer.answer(message->request(), wire::Reply::OK, "done");
    peer.wait_until_client_leaves();
  });
  const Outcome outcome = run_at(server, {"set", "--radar", "2", "--speed", "-5.5", "--range",
                                          "0.125", "--course", "0", "--token", "secret"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "OK: done\n");
}

TEST(Cli, SetsTheControlsThatDisplaysHaveAndLocks) {
  FakeServer server([](FakePeer& peer) {
    peer.say_hello();
    const auto message = peer.receive();
    ASSERT_TRUE(message && message->has_set());
    const wire::Set& set = message->set();
    EXPECT_TRUE(set.gain_auto());
    EXPECT_TRUE(set.has_side_lobe_auto() && !set.side_lobe_auto());
    EXPECT_EQ(set.doppler(), wire::DOPPLER_BOTH);
    EXPECT_EQ(set.mode(), wire::BIRD);
    EXPECT_EQ(set.side_lobe_suppression(), 11);
    EXPECT_EQ(set.noise_rejection(), 12);
    EXPECT_EQ(set.target_separation(), 13);
    EXPECT_EQ(set.target_boost(), 14);
    EXPECT_EQ(set.doppler_threshold_mps(), 1.5);
    EXPECT_EQ(set.instrumented_range_m(), 1600);
    EXPECT_EQ(set.rotation_rpm(), 36);
    EXPECT_EQ(set.bearing_alignment_deg(), -12.5);
    EXPECT_EQ(set.antenna_height_m(), 31);
    ASSERT_EQ(set.blanked_sectors().sectors_size(), 2);
    EXPECT_EQ(set.blanked_sectors().sectors(0).from_deg(), 350);
    EXPECT_EQ(set.blanked_sectors().sectors(1).to_deg(), 150.5);
    EXPECT_TRUE(set.instructor());
    EXPECT_THAT(set.lock(), testing::ElementsAre("gain", "world"));
    EXPECT_THAT(set.unlock(), testing::ElementsAre("sea"));
    peer.answer(message->request(), wire::Reply::OK, "");
    peer.wait_until_client_leaves();
  });
  const Outcome outcome = run_at(server, {"set",    "--gain-auto",
                                          "on",     "--side-lobe-auto",
                                          "off",    "--doppler",
                                          "both",   "--mode",
                                          "bird",   "--side-lobe-suppression",
                                          "11",     "--noise-rejection",
                                          "12",     "--target-separation",
                                          "13",     "--target-boost",
                                          "14",     "--doppler-threshold",
                                          "1.5",    "--instrumented-range",
                                          "1600",   "--rotation",
                                          "36",     "--bearing-alignment",
                                          "-12.5",  "--antenna-height",
                                          "31",     "--blank",
                                          "350-10", "120-150.5",
                                          "--lock", "gain",
                                          "world",  "--unlock",
                                          "sea"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
}

TEST(Cli, FailsWithTheServersWordsWhenASettingIsRejected) {
  FakeServer server([](FakePeer& peer) {
    peer.say_hello();
    const auto message = peer.receive();
    if (message) {
      peer.answer(message->request(), wire::Reply::OUT_OF_RANGE, "gain 101 is not in 0 .. 100");
    }
    peer.wait_until_client_leaves();
  });
  const Outcome outcome = run_at(server, {"set", "--gain", "101"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("gain 101 is not in 0 .. 100"));
}

TEST(Cli, DumpsSpokesAsTextWithTotals) {
  FakeServer server([](FakePeer& peer) {
    peer.say_hello();
    ASSERT_TRUE(peer.accept_subscription());
    send_spokes(peer, 3, 64, 1);
    send_spokes(peer, 3, 67, 100);
    peer.wait_until_client_leaves();
  });
  const Outcome outcome = run_at(server, {"dump", "--count", "3"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const auto lines = lines_of(outcome.out);
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_THAT(lines[0], StartsWith("#"));
  EXPECT_THAT(lines[1], HasSubstr(" 120.0000 "));  // 64 / 256 of a turn off the bow at 30 deg
  EXPECT_THAT(lines[1], HasSubstr("2024-05-01T12:00:00.250Z"));
  EXPECT_EQ(lines[4], "# received 3, lost 2");
}

TEST(Cli, DumpsWholeTurnsWithEveryCell) {
  FakeServer server([](FakePeer& peer) {
    peer.say_hello();
    ASSERT_TRUE(peer.accept_subscription());
    send_spokes(peer, 3, 200, 56 + 2 * 256 + 50);
    peer.wait_until_client_leaves();
  });
  const Outcome outcome = run_at(server, {"dump", "--turns", "2", "--format", "hex"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const auto lines = lines_of(outcome.out);
  ASSERT_EQ(lines.size(), 1u + 2 * 256);
  EXPECT_THAT(lines[1], StartsWith("1024,4,0,"));
  EXPECT_THAT(lines[512], StartsWith("1535,5,255,"));
  EXPECT_THAT(lines[1 + 7].substr(lines[1 + 7].rfind(',')), StartsWith(",0708090a0b0c"));
  EXPECT_EQ(lines[1].size() - lines[1].rfind(',') - 1, 512u);
  EXPECT_THAT(outcome.err, HasSubstr("# received"));
}

TEST(Cli, DumpsCat240) {
  boost::asio::io_context io;
  boost::asio::ip::udp::socket socket(io, {boost::asio::ip::address_v4::loopback(), 0});
  const std::uint16_t port = [&] {
    boost::asio::ip::udp::socket probe(io, {boost::asio::ip::address_v4::loopback(), 0});
    return probe.local_endpoint().port();
  }();
  Program program({"dump", "--cat240", std::to_string(port), "--count", "2", "--format", "csv"});
  // The program says when it listens only by taking datagrams: send until it has had enough.
  std::promise<int> ended;
  std::thread waiter([&] { ended.set_value(program.wait()); });
  auto code = ended.get_future();
  for (std::uint32_t k = 0;
       code.wait_for(std::chrono::milliseconds(2)) != std::future_status::ready; ++k) {
    const Bytes bytes = encode_cat240_video(striped(0, k % 256), {1, 2}, k);
    boost::system::error_code refused;
    socket.send_to(boost::asio::buffer(bytes), {boost::asio::ip::address_v4::loopback(), port}, 0,
                   refused);
  }
  waiter.join();
  EXPECT_EQ(code.get(), 0) << program.err();
  const auto lines = lines_of(program.out());
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_THAT(lines[1], HasSubstr(",12,86.812"));  // NM, metres
  EXPECT_THAT(lines[1], HasSubstr(",255,255,12:00:00.250Z"));
  EXPECT_THAT(program.err(), HasSubstr("# received 2, lost 0"));
}

TEST(Cli, FailsWhenTheStreamStalls) {
  for (const char* command : {"dump", "snapshot"}) {
    FakeServer server([](FakePeer& peer) {
      peer.say_hello();
      ASSERT_TRUE(peer.accept_subscription());
      send_spokes(peer, 0, 0, 20);
      peer.wait_until_client_leaves();
    });
    const Outcome outcome = run_at(server, {command, "--timeout", "0.2"});
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.err, HasSubstr("no spokes"));
    EXPECT_THAT(outcome.err, HasSubstr("127.0.0.1:" + std::to_string(server.port())));
  }
}

TEST(Cli, FailsWhenTheServerCloses) {
  const std::string picture = test_folder() + "/radar.png";
  for (const char* command : {"dump", "snapshot"}) {
    FakeServer server([](FakePeer& peer) {
      peer.say_hello();
      ASSERT_TRUE(peer.accept_subscription());
      send_spokes(peer, 0, 0, 20);
    });
    std::vector<std::string> arguments = {command};
    if (command == std::string("snapshot")) arguments.insert(arguments.end(), {"-o", picture});
    const Outcome outcome = run_at(server, arguments);
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.err, HasSubstr("closed the connection"));
  }
  EXPECT_EQ(text_of_file(picture), "") << "no picture of half a turn";
}

TEST(Cli, EndsCleanlyOnCtrlC) {
  std::promise<void> streaming;
  FakeServer server([&](FakePeer& peer) {
    peer.say_hello();
    ASSERT_TRUE(peer.accept_subscription());
    send_spokes(peer, 0, 0, 5);
    streaming.set_value();
    peer.wait_until_client_leaves();
  });
  Program program({"dump", "--timeout", "60", "--port", std::to_string(server.port())});
  streaming.get_future().wait();
  program.interrupt();
  EXPECT_EQ(program.wait(), 0);
  EXPECT_THAT(program.out(), HasSubstr("# received "));
  EXPECT_EQ(program.err(), "");
}

TEST(Cli, EndsQuietlyWhenItsReaderLeaves) {
  FakeServer server([](FakePeer& peer) {
    peer.say_hello();
    ASSERT_TRUE(peer.accept_subscription());
    send_spokes(peer, 0, 0, 1'000'000);
  });
  const std::string folder = test_folder();
  const std::string piped = std::string("{ { ") + SKERRY_PROGRAM + " dump --port " +
                            std::to_string(server.port()) + " 2>" + folder + "/err; echo $? >" +
                            folder + "/code; } | head -n 2 >" + folder + "/out; }";
  ASSERT_EQ(std::system(piped.c_str()), 0);
  EXPECT_EQ(text_of_file(folder + "/code"), "0\n");
  EXPECT_EQ(text_of_file(folder + "/err"), "");
  EXPECT_EQ(lines_of(text_of_file(folder + "/out")).size(), 2u);
}

TEST(Cli, TakesASnapshotOfTheFirstWholeTurn) {
  FakeServer server([](FakePeer& peer) {
    peer.say_hello();
    ASSERT_TRUE(peer.accept_subscription());
    send_spokes(peer, 8, 100, 156 + 256);
    peer.wait_until_client_leaves();
  });
  const std::string folder = test_folder();
  const Outcome outcome = run_at(server, {"snapshot", "-o", folder + "/a.png", "--raw",
                                          folder + "/a.pgm", "--size", "400", "--head-up"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("scan 9, 256 spokes of 256 cells"));
  const std::string png = text_of_file(folder + "/a.png");
  EXPECT_THAT(png, StartsWith("\x89PNG"));
  EXPECT_THAT(png, HasSubstr(std::string("tEXtScan\0"
                                         "9",
                                         10)));
  EXPECT_THAT(png, HasSubstr(std::string("tEXtRadar name\0Mast", 19)));
  const std::string pgm = text_of_file(folder + "/a.pgm");
  ASSERT_EQ(pgm.size(), 15u + 256 * 256);
  for (std::size_t i = 0; i < 256 * 256; ++i) {
    ASSERT_EQ(static_cast<std::uint8_t>(pgm[15 + i]), static_cast<std::uint8_t>(i / 256 + i % 256));
  }
}

TEST(Cli, PrefersAWholeTurnAndSaysWhatIsMissingIfThereIsNone) {
  const auto script = [](bool whole_later) {
    return [whole_later](FakePeer& peer) {
      peer.say_hello();
      ASSERT_TRUE(peer.accept_subscription());
      for (std::uint32_t scan = 0; scan < 4; ++scan) {
        const bool whole = whole_later && scan == 1;
        send_spokes(peer, scan, 0, whole ? 256 : 250);
      }
      peer.wait_until_client_leaves();
    };
  };
  const std::string file = test_folder() + "/a.png";
  FakeServer better(script(true));
  const Outcome whole = run_at(better, {"snapshot", "-o", file});
  EXPECT_EQ(whole.code, 0);
  EXPECT_THAT(whole.out, HasSubstr("scan 1, 256 spokes"));
  FakeServer worse(script(false));
  const Outcome torn = run_at(worse, {"snapshot", "-o", file});
  EXPECT_EQ(torn.code, 0);
  EXPECT_THAT(torn.out, HasSubstr("250 spokes"));
  EXPECT_THAT(torn.err, HasSubstr("6 of the 256 spokes were lost"));
}

TEST(Cli, TakesTheScanThatWasAskedForOrSaysThatItIsPast) {
  const auto script = [](FakePeer& peer) {
    peer.say_hello();
    ASSERT_TRUE(peer.accept_subscription());
    send_spokes(peer, 20, 5, 1000);
    peer.wait_until_client_leaves();
  };
  const std::string file = test_folder() + "/a.png";
  FakeServer first(script);
  const Outcome later = run_at(first, {"snapshot", "--scan", "22", "-o", file});
  EXPECT_EQ(later.code, 0) << later.err;
  EXPECT_THAT(later.out, HasSubstr("scan 22, 256 spokes"));
  for (const char* past : {"19", "20"}) {
    FakeServer second(script);
    const Outcome outcome = run_at(second, {"snapshot", "--scan", past, "-o", file});
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.err, HasSubstr(std::string("scan ") + past + " is past"));
  }
}

TEST(Cli, SaysBeforeWaitingThatThePictureCannotBeWritten) {
  const Outcome outcome = run({"snapshot", "-o", "/no-such-folder/a.png"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("/no-such-folder"));
}

}  // namespace
}  // namespace skerry::client
