#include "protocol/wire/datagram.hpp"

#include <gmock/gmock.h>

#include <map>
#include <random>

#include "protocol/wire/frame.hpp"
#include "tests/unit/wire/test_spoke.hpp"

namespace skerry {
namespace {

using testing::ElementsAreArray;

Bytes body_of_length(std::size_t length, std::uint32_t seed) {
  std::mt19937 random(seed);
  Bytes body(length);
  for (std::uint8_t& byte : body) byte = static_cast<std::uint8_t>(random());
  return body;
}

std::vector<Bytes> cut(const DatagramSpoke& spoke, const Bytes& body, std::size_t max_datagram) {
  std::vector<Bytes> datagrams;
  Bytes scratch;
  for_each_datagram(spoke, body, max_datagram, scratch, [&](std::span<const std::uint8_t> each) {
    datagrams.emplace_back(each.begin(), each.end());
  });
  return datagrams;
}

// The reassembler's answer to `datagram`; empty too if it refuses.
std::optional<Bytes> fed(DatagramReassembler& reassembler, const Bytes& datagram) {
  auto result = reassembler.feed(datagram);
  return result.ok() ? std::move(result).value() : std::nullopt;
}

// Written out by hand from the table in SPEC.md.
const Bytes kGoldenHeader = {
    0x53, 0x4B, 0x52, 0x59,                          // "SKRY"
    0x01,                                            // version
    0x20,                                            // header size
    0x00, 0x03,                                      // radar 3
    0x01, 0x02,                                      // view 258
    0x00, 0x02,                                      // fragment 2
    0x00, 0x03,                                      // of 3
    0x05, 0xA0,                                      // in fragments of 1440 bytes
    0x01, 0x23, 0x45, 0x67, 0x89, 0xAB, 0xCD, 0xEF,  // sequence
    0x00, 0x00, 0x10, 0x40,                          // body of 4160 bytes
    0x00, 0x00, 0x0B, 0x40,                          // offset 2880
};
const DatagramHeader kGolden{.spoke = {3, 258, 0x0123456789ABCDEF},
                             .fragment_index = 2,
                             .fragment_count = 3,
                             .fragment_size = 1440,
                             .body_length = 4160,
                             .offset = 2880};

TEST(DatagramHeader, IsTheGoldenBytes) {
  Bytes out;
  append_datagram_header(out, kGolden);
  EXPECT_THAT(out, ElementsAreArray(kGoldenHeader));
}

TEST(DatagramHeader, IsReadFromTheGoldenBytes) {
  Bytes datagram = kGoldenHeader;
  datagram.resize(kDatagramHeaderSize + 1280);
  const auto header = decode_datagram_header(datagram);
  ASSERT_TRUE(header.ok()) << header.error().text;
  EXPECT_EQ(*header, kGolden);
}

TEST(DatagramHeader, MayBeLongerInALaterVersionOfTheWriter) {
  Bytes datagram = kGoldenHeader;
  datagram[5] = 0x24;
  datagram.resize(kDatagramHeaderSize + 4 + 1280);
  const auto header = decode_datagram_header(datagram);
  ASSERT_TRUE(header.ok()) << header.error().text;
  EXPECT_EQ(header->header_size, 36);
}

TEST(DatagramHeader, EveryCutIsRefused) {
  for (const Bytes& datagram : cut({1, 0, 7}, body_of_length(3000, 1), 1472)) {
    ASSERT_TRUE(decode_datagram_header(datagram).ok());
    for (std::size_t size = 0; size < datagram.size(); ++size) {
      ASSERT_FALSE(decode_datagram_header(std::span(datagram).first(size)).ok()) << size;
    }
  }
}

struct WrongByte {
  const char* what;
  std::size_t at;
  std::uint8_t byte;
  WireErrorKind kind;
};
class WrongDatagram : public testing::TestWithParam<WrongByte> {};

TEST_P(WrongDatagram, IsRefused) {
  Bytes datagram = kGoldenHeader;
  datagram.resize(kDatagramHeaderSize + 1280);
  datagram[GetParam().at] = GetParam().byte;
  const auto header = decode_datagram_header(datagram);
  ASSERT_FALSE(header.ok());
  EXPECT_EQ(name_of(header.error().kind), name_of(GetParam().kind)) << header.error().text;
}

INSTANTIATE_TEST_SUITE_P(
    EachField, WrongDatagram,
    testing::Values(WrongByte{"Magic", 0, 0x54, WireErrorKind::malformed},
                    WrongByte{"Version", 4, 2, WireErrorKind::unknown_kind},
                    WrongByte{"SmallHeader", 5, 31, WireErrorKind::malformed},
                    WrongByte{"OtherHeader", 5, 33, WireErrorKind::malformed},
                    WrongByte{"IndexBeyondCount", 11, 3, WireErrorKind::malformed},
                    WrongByte{"Index", 11, 1, WireErrorKind::malformed},
                    WrongByte{"ManyFragments", 13, 4, WireErrorKind::malformed},
                    WrongByte{"NoFragments", 13, 0, WireErrorKind::malformed},
                    WrongByte{"FragmentSize", 15, 0xA1, WireErrorKind::malformed},
                    WrongByte{"LongBody", 25, 1, WireErrorKind::oversized},
                    WrongByte{"OtherBody", 27, 0x41, WireErrorKind::malformed},
                    WrongByte{"Offset", 31, 0x42, WireErrorKind::malformed},
                    WrongByte{"FarOffset", 28, 0xFF, WireErrorKind::malformed}),
    [](const auto& each) { return std::string(each.param.what); });

TEST(Datagrams, CarryATcpFrameWithoutItsLength) {
  const Spoke spoke = test_spoke({4096, 4096, 8}, 5, 17);
  Bytes frame;
  append_spoke_frame(frame, spoke);
  const auto body = frame_body(frame);
  const std::vector<Bytes> datagrams =
      cut({1, 2, spoke.header.sequence}, Bytes(body.begin(), body.end()), kDefaultDatagram);
  EXPECT_EQ(datagrams.size(), 3u);
  DatagramReassembler reassembler;
  std::optional<Bytes> whole;
  for (const Bytes& each : datagrams) {
    EXPECT_FALSE(whole);
    EXPECT_LE(each.size(), kDefaultDatagram);
    whole = fed(reassembler, each);
  }
  ASSERT_TRUE(whole);
  EXPECT_THAT(*whole, ElementsAreArray(body));
}

TEST(Datagrams, LongestSpokeIsOneOnLoopback) {
  Bytes frame;
  append_spoke_frame(frame, test_spoke({8192, 4096, 8}, 11, 8191));
  const auto body = frame_body(frame);
  EXPECT_EQ(cut({}, Bytes(body.begin(), body.end()), kMaxDatagram).size(), 1u);
}

TEST(Datagrams, EveryLengthComesBackAtEverySize) {
  for (const std::size_t max : {kMinDatagram, std::size_t{548}, kDefaultDatagram, kMaxDatagram}) {
    const std::size_t piece = max - kDatagramHeaderSize;
    for (const std::size_t length :
         {std::size_t{1}, piece - 1, piece, piece + 1, 2 * piece - 1, 2 * piece, 2 * piece + 1,
          std::size_t{4200}, kMaxDatagramBody}) {
      if (length > kMaxDatagramBody) continue;
      const Bytes body = body_of_length(length, 3);
      const auto datagrams = cut({0, 0, length}, body, max);
      ASSERT_EQ(datagrams.size(), datagram_count(length, max));
      DatagramReassembler reassembler;
      for (std::size_t i = 0; i < datagrams.size(); ++i) {
        const auto whole = fed(reassembler, datagrams[i]);
        ASSERT_EQ(whole.has_value(), i + 1 == datagrams.size()) << length << " in " << max;
        if (whole) {
          ASSERT_EQ(*whole, body);
        }
      }
    }
  }
}

TEST(DatagramReassembler, TakesFragmentsInAnyOrder) {
  const Bytes body = body_of_length(1000, 4);
  std::vector<Bytes> datagrams = cut({0, 0, 1}, body, 256);
  ASSERT_EQ(datagrams.size(), 5u);
  std::vector<std::size_t> order = {0, 1, 2, 3, 4};
  do {
    DatagramReassembler reassembler;
    std::optional<Bytes> whole;
    for (const std::size_t i : order) {
      ASSERT_FALSE(whole);
      whole = fed(reassembler, datagrams[i]);
    }
    ASSERT_EQ(whole, body);
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(DatagramReassembler, GivesEachBodyOnceWhateverComesTwice) {
  const std::vector<Bytes> datagrams = cut({0, 0, 1}, body_of_length(1000, 4), 256);
  DatagramReassembler reassembler;
  int given = 0;
  for (int round = 0; round < 3; ++round) {
    for (const Bytes& each : datagrams) {
      given += fed(reassembler, each).has_value();
      given += fed(reassembler, each).has_value();
    }
  }
  EXPECT_EQ(given, 1);
  EXPECT_EQ(reassembler.duplicates(), 6 * datagrams.size() - datagrams.size());
  EXPECT_EQ(reassembler.in_flight(), 0u);
  EXPECT_EQ(reassembler.refused(), 0u);
}

TEST(DatagramReassembler, KeepsRadarsAndViewsApart) {
  DatagramReassembler reassembler;
  std::map<int, Bytes> bodies;
  std::vector<std::vector<Bytes>> streams;
  for (std::uint16_t i = 0; i < 4; ++i) {
    const DatagramSpoke spoke{static_cast<std::uint16_t>(i % 2), static_cast<std::uint16_t>(i / 2),
                              9};
    bodies[i] = body_of_length(900, i);
    streams.push_back(cut(spoke, bodies[i], 256));
  }
  for (std::size_t piece = 0; piece < streams[0].size(); ++piece) {
    for (int i = 0; i < 4; ++i) {
      const auto whole = fed(reassembler, streams[i][piece]);
      ASSERT_EQ(whole.has_value(), piece + 1 == streams[0].size());
      if (whole) {
        EXPECT_EQ(*whole, bodies[i]);
      }
    }
  }
}

TEST(DatagramReassembler, RefusesWhatContradictsAnEarlierPieceAndKeepsTheEarlier) {
  const Bytes body = body_of_length(1000, 6);
  const std::vector<Bytes> good = cut({0, 0, 1}, body, 256);
  const std::vector<std::vector<Bytes>> liars = {
      cut({0, 0, 1}, body_of_length(999, 7), 256), cut({0, 0, 1}, body_of_length(1300, 7), 256),
      cut({0, 0, 1}, body, 257), cut({0, 0, 1}, body, 1472)};
  DatagramReassembler reassembler;
  ASSERT_FALSE(fed(reassembler, good[0]));
  std::size_t lies = 0;
  for (const auto& liar : liars) {
    for (const Bytes& each : liar) {
      const auto result = reassembler.feed(each);
      ASSERT_FALSE(result.ok());
      EXPECT_EQ(result.error().kind, WireErrorKind::malformed);
      ++lies;
    }
  }
  EXPECT_EQ(reassembler.refused(), lies);
  std::optional<Bytes> whole;
  for (std::size_t i = 1; i < good.size(); ++i) whole = fed(reassembler, good[i]);
  EXPECT_EQ(whole, body);
}

TEST(DatagramReassembler, OldestGivesWayAndIsCounted) {
  DatagramReassembler reassembler;
  const std::size_t many = 10 * DatagramReassembler::kInFlight;
  for (std::uint64_t s = 0; s < many; ++s) {
    ASSERT_FALSE(fed(reassembler, cut({0, 0, s}, body_of_length(1000, 1), 256)[1]));
    ASSERT_LE(reassembler.in_flight(), DatagramReassembler::kInFlight);
  }
  EXPECT_EQ(reassembler.abandoned(), many - DatagramReassembler::kInFlight);
}

TEST(DatagramReassembler, DeliversExactlyTheWholeSpokesUnderLossReorderAndDuplicates) {
  std::mt19937 random(8);
  DatagramReassembler reassembler;
  std::map<std::uint64_t, Bytes> bodies, got;
  std::vector<std::pair<std::uint64_t, Bytes>> line;  // in order of arrival
  std::size_t expected = 0;
  for (std::uint64_t s = 0; s < 2000; ++s) {
    bodies[s] = body_of_length(200 + random() % 4000, static_cast<std::uint32_t>(s));
    bool whole = true;
    for (const Bytes& each : cut({0, 0, s}, bodies[s], 1472)) {
      if (random() % 20 == 0) {
        whole = false;
        continue;
      }
      line.emplace_back(s, each);
      if (random() % 20 == 0) line.emplace_back(s, each);
    }
    expected += whole;
  }
  for (std::size_t i = 0; i + 8 < line.size(); i += 8) {
    std::shuffle(line.begin() + i, line.begin() + i + 8, random);
  }
  for (const auto& [sequence, datagram] : line) {
    auto whole = fed(reassembler, datagram);
    if (!whole) continue;
    ASSERT_EQ(*whole, bodies[sequence]);
    ASSERT_TRUE(got.emplace(sequence, std::move(*whole)).second) << "given twice";
  }
  EXPECT_EQ(got.size(), expected);
  EXPECT_EQ(reassembler.completed(), expected);
  EXPECT_EQ(reassembler.refused(), 0u);
  EXPECT_GT(2000 - expected, 50u);
}

TEST(Datagram, OfRecordsHasAMagicOfItsOwnAndIsNoSpoke) {
  Bytes body(65'728);  // the longest record
  for (std::size_t i = 0; i < body.size(); ++i) body[i] = static_cast<std::uint8_t>(i * 31);
  DatagramReassembler records(DatagramKind::records), spokes;
  Bytes scratch;
  std::optional<Bytes> whole;
  std::size_t datagrams = 0;
  for_each_datagram(
      {.radar = 3, .view = 0, .sequence = 9}, body, kDefaultDatagram, scratch,
      [&](std::span<const std::uint8_t> datagram) {
        ++datagrams;
        EXPECT_EQ(Bytes(datagram.begin(), datagram.begin() + 4), (Bytes{0x53, 0x4B, 0x52, 0x42}));
        EXPECT_FALSE(spokes.feed(datagram));
        auto fed = records.feed(datagram);
        ASSERT_TRUE(fed);
        if (fed->has_value()) whole = std::move(*fed);
      },
      DatagramKind::records);
  EXPECT_EQ(whole, body);
  EXPECT_EQ(spokes.refused(), datagrams);
}

}  // namespace
}  // namespace skerry
