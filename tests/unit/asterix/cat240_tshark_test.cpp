// An independent decoder's opinion: Wireshark's, by tshark on a capture written with libpcap's file
// format by hand.  Skipped where tshark is not installed.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>

#include "protocol/asterix/cat240.hpp"
#include "tests/unit/wire/test_spoke.hpp"

namespace skerry {
namespace {

namespace fs = std::filesystem;

// A classic pcap file of raw IPv4 packets (LINKTYPE_RAW, 101), each UDP to port 8600.
class Capture {
 public:
  explicit Capture(const fs::path& path) : out_(path, std::ios::binary) {
    for (const std::uint32_t word : {0xA1B2C3D4u, 0x00040002u, 0u, 0u, 65535u, 101u}) put32(word);
  }
  void add(const Bytes& payload) {
    const auto udp = static_cast<std::uint16_t>(payload.size() + 8);
    const auto ip = static_cast<std::uint16_t>(udp + 20);
    for (const std::uint32_t word : {0u, 0u, std::uint32_t{ip}, std::uint32_t{ip}}) put32(word);
    put({0x45, 0, hi(ip), lo(ip), 0, 0, 0, 0, 64, 17, 0, 0, 127, 0, 0, 1, 127, 0, 0, 1});
    put({hi(8600), lo(8600), hi(8600), lo(8600), hi(udp), lo(udp), 0, 0});
    put(payload);
  }

 private:
  static std::uint8_t hi(unsigned value) { return static_cast<std::uint8_t>(value >> 8); }
  static std::uint8_t lo(unsigned value) { return static_cast<std::uint8_t>(value); }
  void put(const Bytes& bytes) {
    out_.write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
  }
  void put32(std::uint32_t word) { out_.write(reinterpret_cast<const char*>(&word), sizeof word); }
  std::ofstream out_;
};

std::string output_of(const std::string& command) {
  std::string text;
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::array<char, 4096> part;
  while (pipe && std::fgets(part.data(), part.size(), pipe.get()) != nullptr) text += part.data();
  return text;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

class Cat240Tshark : public testing::Test {
 protected:
  void SetUp() override {
    if (output_of("tshark --version 2>/dev/null").empty()) {
      GTEST_SKIP() << "tshark is not installed (Debian package tshark)";
    }
    std::string name = (fs::temp_directory_path() / "skerry_cat240_XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override {
    if (!folder_.empty()) fs::remove_all(folder_);
  }

  std::string tshark(const std::string& arguments) {
    return output_of("tshark -r '" + capture() + "' " + arguments + " 2>/dev/null");
  }
  std::string capture() const { return (folder_ / "cat240.pcap").string(); }

  fs::path folder_;
};

TEST_F(Cat240Tshark, FindsNoFaultAndTheSameFields) {
  std::vector<std::string> expected;
  {
    Capture file(capture());
    std::uint32_t index = 0;
    for (const std::uint32_t bits : {4u, 8u}) {
      for (const std::uint32_t cells : {256u, 257u, 1020u, 1024u, 2041u, 4096u}) {
        for (const std::size_t scale : {0u, 5u, 11u}) {
          const Spoke spoke = test_spoke({4096, cells, bits}, scale, 4095 - index, index);
          file.add(encode_cat240_video(spoke, {25, 7}, ++index));
          const std::size_t octets = (cells * bits + 7) / 8;
          expected.push_back(std::to_string(index) + "|" + (bits == 4 ? "3" : "4") + "|" +
                             std::to_string(octets) + "|" + std::to_string(cells));
        }
      }
    }
    file.add(encode_cat240_summary("skerryd", {25, 7}, UtcTime{}));
    expected.emplace_back("|||");
  }
  EXPECT_EQ(tshark("-Y '_ws.malformed or _ws.expert.severity >= warning'"), "");
  EXPECT_EQ(lines_of(tshark("-T fields -E separator='|' -e asterix.240_020_VALUE "
                            "-e asterix.240_048_RES -e asterix.240_049_NBVB "
                            "-e asterix.240_049_NBCELLS")),
            expected);
}

TEST_F(Cat240Tshark, SeesTheBearingsCellSizesTimeAndCellBytes) {
  Spoke spoke = test_spoke({360, 256, 8}, 6, 0);
  spoke.header.heading = TrueBearing::from(degrees(359));
  spoke.header.utc = UtcTime(std::chrono::seconds(86'400 * 20'000 + 3600) + Duration(500'000'000));
  Capture(capture()).add(encode_cat240_video(spoke, {25, 7}, 1));
  const auto fields = lines_of(
      tshark("-T fields -E separator=/s -e asterix.240_041_STARTAZ -e asterix.240_041_ENDAZ "
             "-e asterix.240_041_STARTRG -e asterix.240_140_VALUE"));
  ASSERT_EQ(fields.size(), 1u);
  double start = 0, end = 0, first = 1, time = 0;
  std::istringstream(fields[0]) >> start >> end >> first >> time;
  EXPECT_NEAR(start, 359, 0.003);
  EXPECT_NEAR(end, 0, 0.003);
  EXPECT_EQ(first, 0);
  EXPECT_EQ(time, 3600.5);

  std::string hex;
  for (const std::uint8_t cell : spoke.cells) {
    std::array<char, 3> digits;
    std::snprintf(digits.data(), digits.size(), "%02x", cell);
    hex += digits.data();
  }
  EXPECT_NE(tshark("-T jsonraw").find(hex), std::string::npos);
}

}  // namespace
}  // namespace skerry
