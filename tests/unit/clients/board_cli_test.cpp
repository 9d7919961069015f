// `skerry board` as a user runs it, against a fake board.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/clients/fake_board.hpp"
#include "tests/unit/clients/program.hpp"

namespace skerry::client {
namespace {

using board::address_of;
using board::Reg;
using testing::HasSubstr;
using testing::StartsWith;

struct Outcome {
  int code;
  std::string out, err;
};
Outcome run(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "board");
  Program program(std::move(arguments));
  const int code = program.wait();
  return {code, program.out(), program.err()};
}
Outcome run_at(FakeBoard board, std::vector<std::string> arguments, int connections = 1) {
  FakeServer server([&](FakePeer& peer) { board.serve(peer); }, connections);
  arguments.insert(arguments.end(), {"--radar", "3", "--port", std::to_string(server.port())});
  return run(std::move(arguments));
}

// Two turns and a bit of the fake board, with edges.
void send_turns(FakePeer& peer) {
  std::uint64_t sequence = 0, tick = 0;
  for (std::uint64_t n = 0; n < 1100; ++n) {
    Bytes bytes;
    const board::Sweep sweep = fake_sweep(n);
    board::append_record(bytes, sequence++, sweep);
    const std::uint64_t to = sweep.meta.trigger_tick + 1;
    const auto edge = n % 512 == 0 ? board::Line::arp : board::Line::acp;
    board::append_record(bytes, sequence++,
                         edges_of(tick, to,
                                  {{sweep.meta.trigger_tick - 16, edge},
                                   {sweep.meta.trigger_tick, board::Line::trigger}}));
    tick = to;
    if (!send_records(peer, bytes, 2)) return;
  }
}

TEST(BoardCli, HelpsWithExamples) {
  EXPECT_EQ(run({}).code, 2);
  const Outcome all = run({"--help"});
  EXPECT_EQ(all.code, 0);
  for (const char* command : {"registers", "set", "scope", "watch", "ppi"}) {
    EXPECT_THAT(all.out, HasSubstr(command));
    const Outcome help = run({command, "--help"});
    EXPECT_EQ(help.code, 0);
    EXPECT_THAT(help.out, HasSubstr(std::string("Examples:\n  skerry board ") + command));
  }
}

TEST(BoardCli, EndsWithTwoWhenTheCommandLineIsWrong) {
  const std::vector<std::vector<std::string>> wrong = {{"registers", "no_such_register"},
                                                       {"registers", "--watch", "0"},
                                                       {"set"},
                                                       {"set", "GAIN_A"},
                                                       {"set", "WARP=9"},
                                                       {"set", "GAIN_A=loud"},
                                                       {"scope", "--azimuth", "400"},
                                                       {"scope", "--stream", "udp"},
                                                       {"scope", "--columns", "3"},
                                                       {"scope", "--width", "10"},
                                                       {"watch", "--count", "0"},
                                                       {"ppi", "--channel", "C"},
                                                       {"ppi", "--spokes", "100"}};
  for (const auto& arguments : wrong) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 2) << testing::PrintToString(arguments);
    EXPECT_NE(outcome.err, "") << testing::PrintToString(arguments);
    EXPECT_EQ(outcome.out, "") << testing::PrintToString(arguments);
  }
  const std::string port = std::to_string(unused_port());
  for (const char* command : {"registers", "scope", "watch", "ppi"}) {
    const Outcome outcome = run({command, "--port", port});
    EXPECT_EQ(outcome.code, 1) << command;
    EXPECT_THAT(outcome.err, HasSubstr("127.0.0.1:" + port + " refused"));
  }
  FakeServer server([](FakePeer& peer) { FakeBoard().serve(peer); });
  const Outcome outcome = run({"registers", "--port", std::to_string(server.port())});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("radar 0 of 127.0.0.1"));
}

TEST(BoardCli, ShowsRegistersAsATableAndAsJson) {
  FakeBoard board;
  board.registers[address_of(Reg::gain_a)] = static_cast<std::uint32_t>(-300);
  board.registers[address_of(Reg::test_mode_a)] = 2;
  board.registers[address_of(Reg::faults)] = board::fault::config;
  board.fault_reason = "FIFO_DEPTH 2 \"\x1b[2J";
  const Outcome table = run_at(board, {"registers"});
  EXPECT_EQ(table.code, 0) << table.err;
  EXPECT_THAT(table.out, StartsWith("board of radar 3 (Mast?[2J) of 127.0.0.1:"));
  EXPECT_THAT(table.out, HasSubstr("FAULTS: config: FIFO_DEPTH 2 \"?[2J"));
  EXPECT_THAT(table.out, testing::ContainsRegex("0x210 +GAIN_A +-300 0xFFFFFED4 +0.01 dB +rw"));
  EXPECT_THAT(table.out, HasSubstr("[rings]"));
  EXPECT_THAT(table.out, testing::ContainsRegex("FAULTS_LATCHED .* w1c "));
  EXPECT_THAT(table.out, testing::ContainsRegex("BITS_A .* 8, 10, 12 or 14 "));
  for (const auto& info : board::all_registers()) {
    EXPECT_THAT(table.out, HasSubstr(std::string(info.name)));
  }
  const Outcome some = run_at(board, {"registers", "gain", "--json"});
  EXPECT_EQ(some.code, 0) << some.err;
  EXPECT_THAT(some.out, HasSubstr("\"fault_reason\": \"FIFO_DEPTH 2 \\\"?[2J\""));
  EXPECT_THAT(some.out, HasSubstr("\"name\": \"GAIN_A\", \"value\": -300"));
  EXPECT_THAT(some.out, Not(HasSubstr("TEST_MODE")));
}

TEST(BoardCli, FindsRegistersByAddressAndOnTheDigitisersPage) {
  FakeBoard board;
  board.fault_reason = "FIFO";
  const Outcome page = run_at(board, {"registers", "dec_rate"});
  EXPECT_EQ(page.code, 0) << page.err;
  EXPECT_THAT(page.out, testing::ContainsRegex("0x100C +DIGDAR_DEC_RATE"));
  const Outcome address = run_at(board, {"registers", "0x1000", "0x080", "528"});
  EXPECT_EQ(address.code, 0) << address.err;
  EXPECT_THAT(address.out, testing::ContainsRegex("0x1000 +DIGDAR_COMMAND"));
  EXPECT_THAT(address.out, testing::ContainsRegex("0x080 +FAULT_REASON_0 .* 0x4F464946"));
  EXPECT_THAT(address.out, testing::ContainsRegex("0x210 +GAIN_A"));
  EXPECT_THAT(address.out, Not(HasSubstr("GAIN_B")));
}

TEST(BoardCli, ShowsWhatIsInTheRegistersAfterAWrite) {
  FakeBoard board;
  board.registers[address_of(Reg::faults_latched)] = board::fault::late;
  const Outcome cleared = run_at(board, {"set", "FAULTS_LATCHED=0xFFFFFFFF"});
  EXPECT_EQ(cleared.code, 0) << cleared.err;
  EXPECT_EQ(cleared.out, "FAULTS_LATCHED = 0 bits (none)\n");
}

TEST(BoardCli, WritesRegistersAndSaysWhatWasRefusedAndWhy) {
  const Outcome outcome =
      run_at({}, {"set", "GAIN_A=-300", "ACP_PER_TURN=1", "IDENTITY=3", "TEST_MODE_A=rings"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(outcome.out, "GAIN_A = -300 0.01 dB\nTEST_MODE_A = 2 (rings)\n");
  EXPECT_THAT(outcome.err, HasSubstr("ACP_PER_TURN: 1 is out of range; allowed: 360 to 16384"));
  EXPECT_THAT(outcome.err, HasSubstr("IDENTITY is read only"));
  EXPECT_EQ(run_at({}, {"set", "0x160=450"}).out, "ACP_PER_TURN = 450\n");
  FakeBoard faulty;
  faulty.registers[address_of(Reg::faults)] = board::fault::config;
  faulty.fault_reason = "PRF too high";
  const Outcome contradiction = run_at(faulty, {"set", "PRF_MILLIHERTZ=20000000"});
  EXPECT_EQ(contradiction.code, 1);
  EXPECT_THAT(contradiction.err, HasSubstr("contradict each other: PRF too high"));
}

TEST(BoardCli, ShowsOneSweepHereAndAsAPicture) {
  FakeBoard board;
  board.on_stream = send_turns;
  const Outcome text =
      run_at(board, {"scope", "--azimuth", "90", "--columns", "80", "--rows", "20"});
  EXPECT_EQ(text.code, 0) << text.err;
  EXPECT_THAT(text.out, HasSubstr("trigger 128 at tick"));
  EXPECT_THAT(text.out, HasSubstr("azimuth 90.0"));
  const std::string file = test_folder() + "/scope.png";
  const Outcome picture = run_at(board, {"scope", "-o", file});
  EXPECT_EQ(picture.code, 0) << picture.err;
  EXPECT_THAT(text_of_file(file), StartsWith("\x89PNG"));
  EXPECT_THAT(picture.out, HasSubstr("trigger 3 at tick"))
      << "the first with the signals of three triggers before it";
  EXPECT_EQ(run_at(board, {"scope", "--from", "50", "--to", "2"}).code, 2);
  const Outcome nowhere = run({"scope", "-o", "/no/such/folder/x.png"});
  EXPECT_EQ(nowhere.code, 1);
  EXPECT_THAT(nowhere.err, HasSubstr("/no/such/folder"));
}

TEST(BoardCli, SaysThatNoSweepsComeThoughEdgesDo) {
  FakeBoard board;
  board.on_stream = [](FakePeer& peer) {
    for (std::uint64_t n = 0; n < 100'000; ++n) {
      if (!send_record(peer, n, edges_of(n, n + 1, {}))) return;
    }
    peer.wait_until_client_leaves();
  };
  const Outcome outcome = run_at(board, {"scope", "--timeout", "0.3"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("no sweeps from the board of radar 3"));
  EXPECT_THAT(outcome.err, HasSubstr("skerry board registers"));
}

TEST(BoardCli, WritesEventsLineByLine) {
  FakeBoard board;
  board.registers[address_of(Reg::sample_clock_hz)] = 20'000'000;
  board.on_stream = [](FakePeer& peer) {
    send_record(peer, 0, board::Event{3, 40'000'001, board::event::arp, 0, 17});
    send_record(
        peer, 1,
        board::Event{3, 40'000'002, board::event::fault_raised, board::fault::acp_missing, 0});
    send_record(peer, 2, edges_of(0, 50'000'000, {{40'000'020, board::Line::heading}}, 20'000'000));
  };
  const Outcome events = run_at(board, {"watch", "--count", "2"});
  EXPECT_EQ(events.code, 0) << events.err;
  EXPECT_EQ(events.out,
            "     2.000000050 s         40000001  arp            count 17\n"
            "     2.000000100 s         40000002  fault_raised   acp_missing\n");
  EXPECT_THAT(run_at(board, {"watch", "--edges", "--count", "3"}).out,
              HasSubstr("40000020  HEADING\n"));
}

TEST(BoardCli, CallsFormedSpokesWhatTheyAre) {
  FakeBoard board;
  board.on_stream = [](FakePeer& peer) {
    board::Sweep spoke = fake_sweep(8);
    spoke.meta.pulses = 4;
    spoke.meta.spoke = 2;
    spoke.meta.spokes_per_turn = 128;
    send_record(peer, 1, spoke);
    send_record(peer, 2, fake_sweep(9));
  };
  const Outcome lines = run_at(board, {"watch", "--sweeps", "--count", "2"});
  EXPECT_EQ(lines.code, 0) << lines.err;
  EXPECT_THAT(lines.out, testing::ContainsRegex("spoke +8 at .*, spoke 2 of 128, 4 pulses, "));
  EXPECT_THAT(lines.out, testing::ContainsRegex("sweep +9 at "));
}

TEST(BoardCli, DrawsATurnWithItsFaultsAndSaysWhereNoPulseCame) {
  FakeBoard board;
  board.registers[address_of(Reg::source_a)] = 4;
  board.on_stream = [](FakePeer& peer) {
    for (std::uint64_t n = 0; n < 2048; ++n) {
      board::Sweep sweep = fake_sweep(n);
      if (n == 700) sweep.meta.faults = board::fault::acp_missing;
      if (n / 10 == 80) continue;
      if (!send_record(peer, n, sweep)) return;
    }
    peer.wait_until_client_leaves();
  };
  const std::string file = test_folder() + "/board.png";
  const Outcome outcome = run_at(board, {"ppi", "-o", file}, 2);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("FAULTS: ACP_MISSING\n"));
  EXPECT_THAT(outcome.err, testing::ContainsRegex("no pulse in [45] spokes of 256"));
  EXPECT_THAT(text_of_file(file), StartsWith("\x89PNG"));
}

TEST(BoardCli, SaysAtOnceThatAChannelIsOff) {
  FakeBoard board;
  board.on_stream = send_turns;
  const Outcome outcome = run_at(board, {"ppi", "--channel", "B", "--timeout", "20"}, 2);
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("channel B is off: SOURCE_B is 0"));
  EXPECT_THAT(outcome.err, HasSubstr("skerry board set SOURCE_B=4"));
}

TEST(BoardCli, DrawsNoTurnWithoutKnowingWhereTheShipIs) {
  FakeServer server([](FakePeer& peer) {
    say_board_hello(peer);
    const auto subscribed = peer.receive();
    peer.answer(subscribed->request());
    peer.wait_until_client_leaves();
  });
  const std::string file = test_folder() + "/board.png";
  const Outcome outcome = run({"ppi", "-o", file, "--radar", "3", "--timeout", "0.3", "--port",
                               std::to_string(server.port())});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("did not say where the own ship is"));
  EXPECT_EQ(text_of_file(file), "");
}

}  // namespace
}  // namespace skerry::client
