#include "protocol/wire/frame.hpp"

#include <gmock/gmock.h>
#include <google/protobuf/util/delimited_message_util.h>

#include <random>
#include <sstream>

#include "protocol/wire/spoke_message.hpp"
#include "tests/unit/wire/test_spoke.hpp"

namespace skerry {
namespace {

using testing::ElementsAre;

wire::ClientMessage request(std::uint32_t number) {
  wire::ClientMessage message;
  message.set_request(number);
  message.mutable_set()->set_gain(number * 0.25);
  return message;
}

// All bodies the reader has now; fails the test on an error.
std::vector<Bytes> bodies_in(FrameReader& reader) {
  std::vector<Bytes> bodies;
  for (;;) {
    const auto next = reader.next();
    if (!next.ok()) {
      ADD_FAILURE() << next.error().text;
      return bodies;
    }
    if (!next->has_value()) return bodies;
    bodies.emplace_back((*next)->begin(), (*next)->end());
  }
}

TEST(Frame, IsTheLengthAsAVarintThenTheMessage) {
  wire::ClientMessage message;
  message.set_request(5);
  Bytes out{0xAA};
  append_frame(out, message);
  EXPECT_THAT(out, ElementsAre(0xAA, 0x02, 0x08, 0x05));
}

TEST(Frame, IsWhatProtobufsOwnDelimitedStreamsAre) {
  std::ostringstream reference;
  Bytes ours;
  for (std::uint32_t cells = 256; cells <= 4096; cells *= 2) {
    const Spoke spoke = test_spoke({4096, cells, 8}, 5, 17);
    wire::ServerMessage message;
    to_message(spoke, *message.mutable_spoke());
    ASSERT_TRUE(google::protobuf::util::SerializeDelimitedToOstream(message, &reference));
    append_spoke_frame(ours, spoke);
  }
  EXPECT_EQ(std::string(ours.begin(), ours.end()), reference.str());
}

TEST(Frame, GivesItsBody) {
  const Spoke spoke = test_spoke({4096, 1024, 8}, 5, 17);
  Bytes frame;
  append_spoke_frame(frame, spoke);
  const auto body = frame_body(frame);
  wire::ServerMessage message;
  ASSERT_TRUE(message.ParseFromArray(body.data(), static_cast<int>(body.size())));
  const auto back = from_message(message.spoke());
  ASSERT_TRUE(back.ok());
  EXPECT_EQ(difference(spoke, *back), "");
}

TEST(Frame, HasNoBodyUnlessItIsWhole) {
  Bytes frame;
  append_frame(frame, request(9));
  EXPECT_FALSE(frame_body(frame).empty());
  for (std::size_t cut = 0; cut < frame.size(); ++cut) {
    EXPECT_TRUE(frame_body(std::span(frame).first(cut)).empty()) << cut;
  }
  frame.push_back(0);
  EXPECT_TRUE(frame_body(frame).empty());
}

TEST(FrameReader, ReadsTheSameFramesWhereverTheStreamIsCut) {
  Bytes stream;
  std::vector<Bytes> sent;
  for (std::uint32_t n = 0; n < 5; ++n) {
    const std::size_t start = stream.size();
    append_frame(stream, request(n * 1000));
    const auto body = frame_body(std::span(stream).subspan(start));
    sent.emplace_back(body.begin(), body.end());
  }
  const std::size_t start = stream.size();
  append_spoke_frame(stream, test_spoke({4096, 256, 8}, 5, 17));
  const auto body = frame_body(std::span(stream).subspan(start));
  sent.emplace_back(body.begin(), body.end());

  for (std::size_t cut = 0; cut <= stream.size(); ++cut) {
    FrameReader reader(kMaxClientFrame);
    reader.feed(std::span(stream).first(cut));
    std::vector<Bytes> got = bodies_in(reader);
    reader.feed(std::span(stream).subspan(cut));
    const std::vector<Bytes> rest = bodies_in(reader);
    got.insert(got.end(), rest.begin(), rest.end());
    ASSERT_EQ(got, sent) << "cut at " << cut;
    ASSERT_EQ(reader.pending(), 0u);
  }
}

TEST(FrameReader, ReadsByteByByteAndHoldsNoMoreThanOneFrame) {
  Bytes stream;
  for (std::uint32_t n = 0; n < 100; ++n) {
    append_spoke_frame(stream, test_spoke({4096, 512, 4}, 5, n));
  }
  FrameReader reader(kMaxServerFrame);
  std::size_t frames = 0, most = 0;
  for (const std::uint8_t& byte : stream) {
    reader.feed({&byte, 1});
    frames += bodies_in(reader).size();
    most = std::max(most, reader.pending());
  }
  EXPECT_EQ(frames, 100u);
  EXPECT_LT(most, stream.size() / 50);
}

TEST(FrameReader, GivesAnEmptyBodyForAnEmptyMessage) {
  FrameReader reader(kMaxClientFrame);
  const Bytes stream{0x00, 0x00};
  reader.feed(stream);
  EXPECT_THAT(bodies_in(reader), ElementsAre(Bytes{}, Bytes{}));
}

TEST(FrameReader, AcceptsTheLongestFrameAndRefusesOneByteMore) {
  for (const std::size_t max :
       {std::size_t{1}, std::size_t{127}, std::size_t{128}, kMaxClientFrame, kMaxServerFrame}) {
    for (const std::size_t length : {max, max + 1}) {
      Bytes stream;
      for (std::size_t rest = length; rest != 0 || stream.empty(); rest >>= 7) {
        stream.push_back(static_cast<std::uint8_t>((rest & 0x7F) | (rest > 0x7F ? 0x80 : 0)));
      }
      stream.resize(stream.size() + length);
      FrameReader reader(max);
      reader.feed(stream);
      const auto next = reader.next();
      ASSERT_EQ(next.ok(), length == max) << max;
      if (next.ok()) {
        ASSERT_TRUE(next->has_value());
        EXPECT_EQ((*next)->size(), length);
      } else {
        EXPECT_EQ(next.error().kind, WireErrorKind::oversized);
      }
    }
  }
}

TEST(FrameReader, RefusesALongLengthBeforeItsBodyArrives) {
  FrameReader reader(kMaxClientFrame);
  reader.feed(Bytes{0xFF, 0xFF, 0xFF, 0xFF, 0x0F});
  const auto next = reader.next();
  ASSERT_FALSE(next.ok());
  EXPECT_EQ(next.error().kind, WireErrorKind::oversized);
  EXPECT_NE(next.error().text.find("4294967295"), std::string::npos) << next.error().text;
}

TEST(FrameReader, StaysRefusedAndSaysWhere) {
  Bytes stream;
  append_frame(stream, request(1));
  const std::size_t good = stream.size();
  stream.insert(stream.end(), {0xFF, 0xFF, 0xFF, 0xFF, 0xFF});
  FrameReader reader(kMaxClientFrame);
  reader.feed(stream);
  ASSERT_TRUE(reader.next().ok());
  for (int again = 0; again < 3; ++again) {
    const auto next = reader.next();
    ASSERT_FALSE(next.ok());
    EXPECT_EQ(next.error().kind, WireErrorKind::malformed);
    EXPECT_EQ(next.error().offset, good);
    reader.feed(stream);
    EXPECT_EQ(reader.pending(), 0u);
  }
}

TEST(FrameReader, RefusesALengthBeyond32Bits) {
  FrameReader reader(kMaxServerFrame);
  reader.feed(Bytes{0x81, 0x80, 0x80, 0x80, 0x10});
  const auto next = reader.next();
  ASSERT_FALSE(next.ok());
  EXPECT_EQ(next.error().kind, WireErrorKind::malformed);
}

}  // namespace
}  // namespace skerry
