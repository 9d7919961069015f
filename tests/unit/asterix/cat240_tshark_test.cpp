// An independent decoder's opinion: Wireshark's.
#include <array>
#include <cstdio>
#include <sstream>

#include "protocol/asterix/cat240.hpp"
#include "tests/unit/asterix/tshark.hpp"
#include "tests/unit/wire/test_spoke.hpp"

namespace skerry {
namespace {

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
