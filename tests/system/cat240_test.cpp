// CAT240 as it leaves the running server: the same spokes as on the native stream, whether our own
// decoder or Wireshark's reads them.
#include <gtest/gtest.h>
#include <unistd.h>

#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "clients/common/datagram_socket.hpp"
#include "protocol/asterix/cat240.hpp"
#include "tests/system/receive.hpp"
#include "tests/system/small_scenario.hpp"

namespace skerry::system_test {
namespace {

constexpr std::size_t kTurns = 2;

// Time of day as CAT240 says it: 1/128 s since midnight, truncated.
std::uint32_t time_of_day(UtcTime utc) {
  constexpr std::uint64_t kDay = 86'400'000'000'000, kSecond = 1'000'000'000;
  const auto ns = static_cast<std::uint64_t>(utc.time_since_epoch().count()) % kDay;
  return static_cast<std::uint32_t>(ns * 128 / kSecond);
}

// Azimuth as CAT240 says it: 1/65536 turn, rounded.
std::uint16_t azimuth_of(TrueBearing bearing) {
  return static_cast<std::uint16_t>((bearing.units() + (1u << 15)) >> 16);
}

std::string hex_of(std::span<const std::uint8_t> bytes) {
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (const std::uint8_t byte : bytes) {
    text += kDigits[byte >> 4];
    text += kDigits[byte & 15];
  }
  return text;
}

// The cells as they must stand in item 050, 051 or 052.
std::string octets_of(const Spoke& spoke) {
  if (spoke.header.geometry.bits == 8) return hex_of(spoke.cells);
  Bytes octets;
  for (std::size_t i = 0; i < spoke.cells.size(); i += 2) {
    octets.push_back(static_cast<std::uint8_t>(spoke.cells[i] << 4 | spoke.cells[i + 1]));
  }
  return hex_of(octets);
}

std::vector<Cat240Record> records_of(const Bytes& datagram) {
  auto records = decode_cat240(datagram);
  if (records) return std::move(records).value();
  ADD_FAILURE() << "byte " << records.error().offset << ": " << records.error().text;
  return {};
}

// The same turns of one radar on both streams.
struct Recording {
  std::vector<std::vector<Spoke>> native;  // whole turns, spokes by index
  std::vector<Bytes> cat240;               // from before the first to after the last of them
};

// Param: the radar of small_scenario(), 0 with 8 bits and 1 with 4.
class Cat240Stream : public testing::TestWithParam<std::uint32_t> {
 protected:
  void SetUp() override {
    auto socket = client::DatagramSocket::open({client::kDefaultHost, 0});
    ASSERT_TRUE(socket) << socket.error().text;
    port_ = std::to_string(socket->port());
    const RunningServer server({"--scenario", folder_.write("small.yaml", small_scenario()),
                                "--cat240", std::to_string(GetParam()) + "@127.0.0.1:" + port_});
    client::SpokeClient native = subscribed(server, GetParam());
    record(native, *socket);
    ASSERT_EQ(native.losses().lost(), 0u);
  }

  void record(client::SpokeClient& native, client::DatagramSocket& socket) {
    const auto keep = [&](Duration timeout) {
      const auto datagram = socket.receive(timeout);
      if (!datagram) throw std::runtime_error(datagram.error().text);
      if (*datagram) recording_.cat240.emplace_back((*datagram)->begin(), (*datagram)->end());
      return datagram->has_value();
    };
    // A turn before the first, in which the CAT240 stream has begun, and the beginning of one more.
    Spoke spoke = next_spoke(native);
    const std::uint32_t first = spoke.header.scan + 1;
    for (; spoke.header.scan < first + kTurns; spoke = next_spoke(native)) {
      if (spoke.header.scan >= first) {
        recording_.native.resize(spoke.header.scan - first + 1);
        recording_.native.back().push_back(std::move(spoke));
      }
      while (keep(Duration::zero())) {
      }
    }
    const std::uint32_t end = time_of_day(spoke.header.utc);
    const auto ends = [&](const Bytes& datagram) {
      const auto records = records_of(datagram);
      return !records.empty() && records[0].kind == Cat240Kind::summary &&
             records[0].time_of_day == end;
    };
    while (recording_.cat240.empty() || !ends(recording_.cat240.back())) {
      if (!keep(kAnswerTime)) throw std::runtime_error("the CAT240 stream ends early");
    }
  }

  TempFolder folder_;
  Recording recording_;
  std::string port_;
};

TEST_P(Cat240Stream, HasTheNativeStreamsCellsAndASummaryPerTurn) {
  // Turns as the stream itself divides them: by summaries.
  struct Turn {
    std::uint32_t time_of_day = 0;
    std::vector<Cat240Record> video;
  };
  std::vector<Turn> turns;
  for (const Bytes& datagram : recording_.cat240) {
    const auto records = records_of(datagram);
    ASSERT_EQ(records.size(), 1u);
    if (records[0].kind == Cat240Kind::summary) {
      EXPECT_FALSE(records[0].summary->empty());
      turns.push_back({records[0].time_of_day.value_or(0), {}});
    } else if (!turns.empty()) {
      turns.back().video.push_back(records[0]);
    }
  }
  // The last summary only ends the turn before it; a turn before ours may be there too.
  ASSERT_GT(turns.size(), kTurns);
  turns.pop_back();
  turns.erase(turns.begin(), turns.end() - kTurns);

  std::uint32_t message_index = turns[0].video.at(0).video->message_index;
  for (std::size_t turn = 0; turn < kTurns; ++turn) {
    const std::vector<Spoke>& native = recording_.native[turn];
    ASSERT_EQ(native.size(), kSmallSpokes);
    ASSERT_EQ(turns[turn].video.size(), kSmallSpokes);
    EXPECT_EQ(turns[turn].time_of_day, time_of_day(native[0].header.utc));
    for (std::size_t i = 0; i < kSmallSpokes; ++i) {
      const SpokeHeader& header = native[i].header;
      ASSERT_EQ(header.index, i);
      const Cat240Record& record = turns[turn].video[i];
      ASSERT_EQ(record.video->cells, native[i].cells) << "turn " << turn << " spoke " << i;
      ASSERT_EQ(record.video->bits_per_cell, header.geometry.bits);
      ASSERT_EQ(record.video->message_index, message_index++);
      ASSERT_EQ(record.video->start_azimuth, azimuth_of(header.bearing()));
      ASSERT_EQ(record.video->start_range, 0u);
      ASSERT_EQ(record.time_of_day, time_of_day(header.utc));
      ASSERT_NEAR(record.video->cell_size().in_metres(), header.cell_size().in_metres(), 1e-6);
    }
  }
}

// The values of every `"key_raw": ["HEX", ...]` of tshark's jsonraw, in order.
std::vector<std::string> raw_values(const std::string& json, const std::string& key) {
  std::vector<std::string> values;
  const std::string name = "\"" + key + "_raw\": [";
  for (std::size_t at = 0; (at = json.find(name, at)) != std::string::npos;) {
    const std::size_t begin = json.find('"', at + name.size()) + 1;
    at = json.find('"', begin);
    values.push_back(json.substr(begin, at - begin));
  }
  return values;
}

TEST_P(Cat240Stream, IsReadByWiresharkWithoutAFault) {
  constexpr const char* kTshark = "/usr/bin/tshark";
  if (::access(kTshark, X_OK) != 0) {
    GTEST_SKIP() << "tshark is not installed: apt-get install tshark";
  }
  std::string dump;
  for (const Bytes& datagram : recording_.cat240) {
    const std::string hex = hex_of(datagram);
    dump += "000000";
    for (std::size_t i = 0; i < hex.size(); i += 2) dump.append(" ").append(hex, i, 2);
    dump += "\n";
  }
  const std::string capture = folder_.path("cat240.pcap");
  const Ending made = run({"/usr/bin/text2pcap", "-q", "-u", port_ + "," + port_,
                           folder_.write("cat240.txt", dump), capture});
  ASSERT_EQ(made.code, 0) << made.err;
  const auto tshark = [&](std::vector<std::string> arguments) {
    std::vector<std::string> all = {kTshark, "-r", capture, "-d",
                                    "udp.port==" + port_ + ",asterix"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const Ending ending = run(std::move(all));
    EXPECT_EQ(ending.code, 0) << ending.err;
    return ending.out;
  };

  EXPECT_EQ(tshark({"-Y", "!asterix or _ws.malformed or _ws.expert.severity >= warning"}), "");

  std::vector<std::string> types;  // 1 summary, 2 video, one a line
  std::istringstream lines(tshark({"-T", "fields", "-e", "asterix.240_000_VALUE"}));
  for (std::string line; std::getline(lines, line);) types.push_back(line);
  ASSERT_EQ(types.size(), recording_.cat240.size());
  std::vector<std::size_t> summaries;
  for (std::size_t i = 0; i < types.size(); ++i) {
    if (types[i] == "1") summaries.push_back(i);
  }
  ASSERT_GT(summaries.size(), kTurns);
  for (std::size_t i = 1; i < summaries.size(); ++i) {
    EXPECT_EQ(summaries[i] - summaries[i - 1] - 1, kSmallSpokes) << "video records in turn " << i;
  }

  // Up to 1020 octets go into item 050, blocks of 4.
  const std::string json = tshark({"-T", "jsonraw"});
  std::string seen;
  for (const std::string& blocks : raw_values(json, "asterix.240_050_VALUE")) seen += blocks;
  std::string sent;
  for (const auto& turn : recording_.native) {
    for (const Spoke& spoke : turn) sent += octets_of(spoke);
  }
  // Before ours, the rest of the turn in which the recording began.
  ASSERT_GE(seen.size(), sent.size());
  EXPECT_TRUE(seen.ends_with(sent)) << "tshark reads other cells than the native stream has";
}

INSTANTIATE_TEST_SUITE_P(Bits, Cat240Stream, testing::Values(0u, 1u),
                         [](const auto& radar) { return radar.param == 0 ? "Eight" : "Four"; });

}  // namespace
}  // namespace skerry::system_test
