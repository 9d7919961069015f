#include "protocol/nmea/sentence.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "protocol/nmea/field_reader.hpp"

namespace skerry::nmea {
namespace {

// Examples that stand in many manuals, with the checksums printed there.
TEST(Sentence, ReadsPublishedExamples) {
  const std::string line = "$GPGGA,123519,4807.038,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,*47\r\n";
  const auto sentence = parse_sentence(line);
  ASSERT_TRUE(sentence) << sentence.error().text;
  EXPECT_EQ(sentence->start, '$');
  EXPECT_EQ(sentence->talker, "GP");
  EXPECT_EQ(sentence->formatter, "GGA");
  ASSERT_EQ(sentence->fields.size(), 14u);
  EXPECT_EQ(sentence->fields[0], "123519");
  EXPECT_EQ(sentence->fields[13], "");

  EXPECT_TRUE(parse_sentence("!AIVDM,1,1,,A,15RTgt0PAso;90TKcjM8h6g208CQ,0*4A"));
  EXPECT_TRUE(
      parse_sentence("$GPRMC,092204.999,A,4250.5589,S,14718.5084,E,5.50,89.68,211200,,*25"));
}

TEST(Sentence, OfAProprietaryOneTheMakerIsThePartOfItsFormatter) {
  const std::string body = "PGRME,15.0,M,45.0,M,25.0,M";
  const std::string line = "$" + body + "*" + checksum_text(body);
  const auto sentence = parse_sentence(line);
  ASSERT_TRUE(sentence) << sentence.error().text;
  EXPECT_EQ(std::string(sentence->talker) + std::string(sentence->formatter), "PGRME");
}

TEST(Sentence, IsRefusedWithTheReason) {
  const auto reason = [](const std::string& line) {
    const auto sentence = parse_sentence(line);
    return sentence ? std::string("accepted") : sentence.error().text;
  };
  EXPECT_NE(reason("$HEHDT,123.4,T*2C").find("checksum is wrong"), std::string::npos);
  EXPECT_NE(reason("$HEHDT,123.4,T").find("ends with '*'"), std::string::npos);
  EXPECT_NE(reason("").find("begins with"), std::string::npos);
  EXPECT_NE(reason("HEHDT,123.4,T*2B").find("begins with"), std::string::npos);
  EXPECT_NE(reason("$*00").find("address"), std::string::npos);
  EXPECT_NE(reason("$HEHDT," + std::string(300, '1') + "*00").find("256"), std::string::npos);
  std::string body = "HEHDT,12\x01,T";
  EXPECT_NE(reason("$" + body + "*" + checksum_text(body)).find("character"), std::string::npos);
  body = "he,1";
  EXPECT_NE(reason("$" + body + "*" + checksum_text(body)).find("address"), std::string::npos);
}

TEST(Sentence, CutAnywhereItIsRefused) {
  const std::string line = "$GPRMC,092204.999,A,4250.5589,S,14718.5084,E,5.50,89.68,211200,,*25";
  for (std::size_t size = 0; size < line.size(); ++size) {
    EXPECT_FALSE(parse_sentence(line.substr(0, size))) << size;
  }
}

std::string position_text(double latitude, double longitude) {
  return SentenceWriter('$', "GP", "X").position({latitude, longitude}).finish();
}

TEST(SentenceWriter, MinutesOfAPositionNeverReachSixty) {
  EXPECT_NE(position_text(47.9999999999, -11.99999999999).find(",4800.00000,N,01200.00000,W*"),
            std::string::npos)
      << position_text(47.9999999999, -11.99999999999);
  EXPECT_NE(position_text(-0.5, 0.25).find(",0030.00000,S,00015.00000,E*"), std::string::npos);
  EXPECT_NE(position_text(90, 180).find(",9000.00000,N,18000.00000,E*"), std::string::npos);
  EXPECT_NE(position_text(std::nan(""), 0).find("X,,,,*"), std::string::npos);
}

TEST(SentenceWriter, AnglesWrapAfterRoundingAndNothingIsMinusZero) {
  const auto angle = [](double degrees, int decimals) {
    const std::string line = SentenceWriter('$', "GP", "X").angle(degrees, decimals).finish();
    return line.substr(5, line.find('*') - 5);
  };
  EXPECT_EQ(angle(359.96, 1), "0.0");
  EXPECT_EQ(angle(359.94, 1), "359.9");
  EXPECT_EQ(angle(-0.01, 1), "0.0");
  EXPECT_EQ(angle(-90, 2), "270.00");
  EXPECT_EQ(angle(720.5, 1), "0.5");
  EXPECT_EQ(angle(std::numeric_limits<double>::infinity(), 1), "");
  const std::string line =
      SentenceWriter('$', "GP", "X").number(-0.001, 1).number(-1.25, 2).finish();
  EXPECT_EQ(line.substr(0, line.find('*')), "$GPX,0.0,-1.25");
}

TEST(SentenceWriter, LeavesOutOfATextWhatNoFieldMayHave) {
  const std::string line =
      SentenceWriter('$', "RA", "TLL").text("A,B*C$D!E\\F^G~H\nI\xC3", 40).finish();
  EXPECT_EQ(line.substr(0, line.find('*')), "$RATLL,A B C D E F G H I ");
  EXPECT_TRUE(parse_sentence(line));
}

TEST(SentenceWriter, TimesAreTruncatedAndNeverReachSixtySeconds) {
  using namespace std::chrono_literals;
  const auto time = [](Duration of_day) {
    return SentenceWriter('$', "GP", "X").time(of_day).finish().substr(5, 9);
  };
  EXPECT_EQ(time(0ns), "000000.00");
  EXPECT_EQ(time(23h + 59min + 59s + 999'999'999ns), "235959.99");
  EXPECT_EQ(time(1h + 2min + 3s + 456ms), "010203.45");
}

// Worst error over the globe, seeded: 1e-5 minute has half a unit of 0.93 cm.
TEST(SentenceWriter, PositionsComeBackToACentimetre) {
  std::uint64_t state = 1;
  const auto next = [&state] {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(state >> 11) / 9007199254740992.0;
  };
  double worst = 0.0;
  for (int i = 0; i < 20'000; ++i) {
    const GeoPoint point{next() * 180 - 90, next() * 360 - 180};
    const std::string line = SentenceWriter('$', "GP", "GLL").position(point).finish();
    const auto sentence = parse_sentence(line);
    ASSERT_TRUE(sentence);
    FieldReader in(*sentence);
    const auto back = in.position(0);
    ASSERT_TRUE(back) << line;
    worst = std::max(worst, std::abs(back->latitude_deg - point.latitude_deg) * 60 * 1852);
    const double longitude = std::remainder(back->longitude_deg - point.longitude_deg, 360);
    worst = std::max(worst, std::abs(longitude) * 60 * 1852);
  }
  RecordProperty("worst_m", std::to_string(worst));
  EXPECT_LE(worst, 0.0094);
}

// The fields of a sentence, whose checksum is put right.
class Fields {
 public:
  explicit Fields(const std::string& fields)
      : line_("$GPXXX," + fields + "*" + checksum_text("GPXXX," + fields)),
        sentence_(parse_sentence(line_)),
        reader_(sentence_.value()) {}
  FieldReader* operator->() { return &reader_; }

 private:
  std::string line_;
  Result<Sentence, WireError> sentence_;
  FieldReader reader_;
};

TEST(FieldReader, AnEmptyFieldIsAbsentAndNoFault) {
  Fields fields(",,");
  EXPECT_FALSE(fields->number(0, 0, 1));
  EXPECT_FALSE(fields->position(0));
  EXPECT_FALSE(fields->time(1));
  EXPECT_FALSE(fields->whole(50, 0, 1));
  EXPECT_EQ(fields->letter(50), '\0');
  EXPECT_FALSE(fields->error());
}

TEST(FieldReader, WhatIsNoNumberOrOutOfRangeIsAFaultThatNamesTheField) {
  for (const char* bad : {"1e5", "nan", "inf", "0x10", "--1", "1.2.3", ".", "-", " 1", "1 ", "12A",
                          "400", "99999999999999999999999999"}) {
    Fields fields(bad);
    EXPECT_FALSE(fields->number(0, -360, 360)) << bad;
    ASSERT_TRUE(fields->error()) << bad;
    EXPECT_NE(fields->error()->text.find("field 1"), std::string::npos) << fields->error()->text;
    EXPECT_EQ(fields->error()->offset, 7u);
  }
  Fields fields("+12.5,-3,.5,7.");
  EXPECT_EQ(fields->number(0, -360, 360), 12.5);
  EXPECT_EQ(fields->number(1, -360, 360), -3.0);
  EXPECT_EQ(fields->number(2, -360, 360), 0.5);
  EXPECT_EQ(fields->number(3, -360, 360), 7.0);
  EXPECT_FALSE(fields->error());
}

TEST(FieldReader, PositionsAndTimesOutsideTheirRangesAreFaults) {
  for (const char* bad :
       {"4860.0,N,01131.0,E", "4807.0,E,01131.0,E", "9001.0,N,01131.0,E", "4807.0,N,18001.0,E",
        "07.0,N,01131.0,E", "4807.0,N,1131.0,", "48-7.0,N,01131.0,E", "48,N,011,E"}) {
    Fields fields(bad);
    EXPECT_FALSE(fields->position(0)) << bad;
    EXPECT_TRUE(fields->error()) << bad;
  }
  for (const char* bad : {"240000", "126000", "12346", "12:34:56", "123461", "1234x6"}) {
    Fields fields(bad);
    EXPECT_FALSE(fields->time(0)) << bad;
    EXPECT_TRUE(fields->error()) << bad;
  }
}

}  // namespace
}  // namespace skerry::nmea
