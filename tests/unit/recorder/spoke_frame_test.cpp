#include "server/recorder/spoke_frame.hpp"

#include <gtest/gtest.h>

#include "protocol/wire/frame.hpp"
#include "protocol/wire/radar.pb.h"
#include "tests/unit/recorder/recorder_kit.hpp"

namespace skerry::server {
namespace {

TEST(SpokeFrame, HasTheBytesOfTheMessageAlone) {
  const RecordedHost host;
  for (const std::uint64_t sequence : {0ull, 1ull, 77ull, 1'000'000'000'000ull}) {
    const Spoke spoke = host.spoke(0, sequence);
    Bytes frame;
    append_spoke_frame(frame, spoke);
    const auto found = framed_spoke(frame);
    ASSERT_TRUE(found);
    EXPECT_EQ(std::string(found->bytes.begin(), found->bytes.end()), host.spoke_bytes(0, sequence));
    EXPECT_EQ(found->sequence, sequence);
    EXPECT_EQ(found->utc, spoke.header.utc);
    EXPECT_EQ(found->scenario, spoke.header.scenario_time);
  }
}

TEST(SpokeFrame, IsNothingOfOtherMessagesAndPieces) {
  Bytes frame;
  append_spoke_frame(frame, RecordedHost().spoke(0, 5));
  for (std::size_t size = 0; size < frame.size(); ++size) {
    EXPECT_FALSE(framed_spoke(std::span(frame).first(size)));
  }
  wire::ServerMessage message;
  message.mutable_world();
  Bytes other;
  append_frame(other, message);
  EXPECT_FALSE(framed_spoke(other));
}

}  // namespace
}  // namespace skerry::server
