#include "protocol/nmea/udp450.hpp"

#include <gtest/gtest.h>

#include "protocol/nmea/ais_sentences.hpp"
#include "protocol/nmea/motion_sentences.hpp"

namespace skerry::nmea {
namespace {

std::string text_of(const Bytes& bytes) { return {bytes.begin(), bytes.end()}; }
Bytes bytes_of(const std::string& text) { return {text.begin(), text.end()}; }

const std::string kHeader("UdPbC\0", 6);

TEST(Udp450, BeginsWithItsNameAZeroAndATagBlock) {
  Udp450Encoder encoder("HE0001");
  const std::vector<std::string> lines = {encode(Hdt{.heading_deg = 123.4})};
  const auto datagrams = encoder.encode(lines);
  ASSERT_EQ(datagrams.size(), 1u);
  EXPECT_EQ(text_of(datagrams[0]), kHeader + "\\s:HE0001,n:1*" + checksum_text("s:HE0001,n:1") +
                                       "\\$HEHDT,123.40,T*1B\r\n");
  EXPECT_EQ(checksum_text("s:HE0001,n:1"), "0C");
}

TEST(Udp450, NamesThePartsOfAMessage) {
  Udp450Encoder encoder("AI0002");
  const auto lines = encode_ais(AisVoyage{.mmsi = 257'000'001, .name = "X"}, false, 0, 'A');
  ASSERT_EQ(lines.size(), 2u);
  for (unsigned round = 1; round <= 100; ++round) {
    const auto datagrams = encoder.encode(lines);
    ASSERT_EQ(datagrams.size(), 1u);
    const auto back = decode_udp450(datagrams[0]);
    ASSERT_TRUE(back) << back.error().text;
    ASSERT_EQ(back->size(), 2u);
    for (unsigned i = 0; i < 2; ++i) {
      const TaggedLine& line = (*back)[i];
      EXPECT_EQ(line.source, "AI0002");
      EXPECT_EQ(line.number, (2 * (round - 1) + i) % 999 + 1);
      EXPECT_EQ(line.group, (TagGroup{i + 1, 2, (round - 1) % 99 + 1}));
      EXPECT_EQ(line.sentence + "\r\n", lines[i]);
    }
  }
}

TEST(Udp450, CountsLinesTo999AndAgain) {
  Udp450Encoder encoder("HE0001");
  const std::vector<std::string> line = {"$HEHDT,123.4,T*2B\r\n"};
  std::optional<unsigned> number;
  for (int i = 0; i < 999; ++i) number = decode_udp450(encoder.encode(line)[0]).value()[0].number;
  EXPECT_EQ(number, 999u);
  EXPECT_EQ(decode_udp450(encoder.encode(line)[0]).value()[0].number, 1u);
}

TEST(Udp450, ALongMessageGoesIntoSeveralDatagrams) {
  Udp450Encoder encoder("RA0001");
  const std::vector<std::string> lines(25, "!RATTD,19,01,0," + std::string(60, '0') + ",0*00\r\n");
  const auto datagrams = encoder.encode(lines);
  EXPECT_GT(datagrams.size(), 1u);
  std::size_t count = 0;
  for (const Bytes& datagram : datagrams) {
    EXPECT_LE(datagram.size(), kMostUdp450);
    count += decode_udp450(datagram).value().size();
  }
  EXPECT_EQ(count, lines.size());
}

TEST(Udp450, ReadsBlocksInAnyOrderAndLinesWithout) {
  const auto block = [](const std::string& parameters) {
    return "\\" + parameters + "*" + checksum_text(parameters) + "\\";
  };
  const auto lines = decode_udp450(bytes_of(kHeader + block("x:unknown,d:II0001,s:GP0001") +
                                            block("n:17,g:1-2-3") + "$GPZDA*00\r\n\r\n$GPXXX*11\n" +
                                            block("s:GP0002")));
  ASSERT_TRUE(lines) << lines.error().text;
  ASSERT_EQ(lines->size(), 2u);
  EXPECT_EQ((*lines)[0].source, "GP0001");
  EXPECT_EQ((*lines)[0].destination, "II0001");
  EXPECT_EQ((*lines)[0].number, 17u);
  EXPECT_EQ((*lines)[0].group, (TagGroup{1, 2, 3}));
  EXPECT_EQ((*lines)[0].sentence, "$GPZDA*00");
  EXPECT_EQ((*lines)[1].source, "");
  EXPECT_EQ((*lines)[1].sentence, "$GPXXX*11");
}

TEST(Udp450, OtherDatagramsAndBrokenBlocksAreRefused) {
  EXPECT_FALSE(decode_udp450({}));
  EXPECT_FALSE(decode_udp450(bytes_of("UdPbC")));
  EXPECT_FALSE(decode_udp450(bytes_of("RaUdP\0")));
  EXPECT_FALSE(decode_udp450(bytes_of(kHeader + "\\s:GP0001,n:1$GPZDA*00\r\n")));
  EXPECT_FALSE(decode_udp450(bytes_of(kHeader + "\\s:GP0001,n:1*00\\$GPZDA*00\r\n")));
  EXPECT_FALSE(decode_udp450(bytes_of(kHeader + "\\\\$GPZDA*00\r\n")));
  EXPECT_TRUE(decode_udp450(bytes_of(kHeader)));
}

TEST(Udp450, TheGroupsAreThoseOfTheStandard) {
  EXPECT_EQ(text_of(address_of(Udp450Group::misc)), "239.192.0.1:60001");
  EXPECT_EQ(text_of(address_of(Udp450Group::targets)), "239.192.0.2:60002");
  EXPECT_EQ(text_of(address_of(Udp450Group::fast)), "239.192.0.3:60003");
  EXPECT_EQ(text_of(address_of(Udp450Group::navigation)), "239.192.0.4:60004");
  EXPECT_EQ(text_of(address_of(Udp450Group::time)), "239.192.0.7:60007");
}

TEST(Udp450, ASourceIsTwoLettersAndFourDigits) {
  EXPECT_TRUE(is_udp450_source("RA0001"));
  for (const char* bad : {"", "RA001", "ra0001", "RA00011", "R10001", "RA000x"}) {
    EXPECT_FALSE(is_udp450_source(bad)) << bad;
  }
}

}  // namespace
}  // namespace skerry::nmea
