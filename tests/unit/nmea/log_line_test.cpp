#include "protocol/nmea/log_line.hpp"

#include <gtest/gtest.h>

#include "protocol/nmea/log_time.hpp"
#include "protocol/nmea/sentence.hpp"

namespace skerry::nmea {
namespace {

using namespace std::chrono_literals;

constexpr UtcTime at(std::int64_t seconds, std::int64_t ms = 0) {
  return UtcTime(std::chrono::seconds(seconds) + std::chrono::milliseconds(ms));
}

const std::string kSentence = "!AIVDM,1,1,,A,15RTgt0PAso;90TKcjM8h6g208CQ,0*4A";

std::string tagged(const std::string& tags) {
  return "\\" + tags + "*" + checksum_text(tags) + "\\" + kSentence;
}

TEST(LogTime, ReadsTheFormsOfLogsAndTables) {
  // 2021-01-05 01:51:55 UTC, reckoned by date(1).
  EXPECT_EQ(log_time_of("2021-01-05T01:51:55Z"), at(1'609'811'515));
  EXPECT_EQ(log_time_of("2021-01-05 01:51:55"), at(1'609'811'515));
  EXPECT_EQ(log_time_of(" 2021-01-05T01:51:55.250 "), at(1'609'811'515, 250));
  EXPECT_EQ(log_time_of("2021-01-05T03:51:55+02:00"), at(1'609'811'515));
  EXPECT_EQ(log_time_of("2021-01-04T21:21:55-0430"), at(1'609'811'515));
  EXPECT_EQ(log_time_of("05/01/2021 01:51:55"), at(1'609'811'515));
  EXPECT_EQ(log_time_of("1609811515"), at(1'609'811'515));
  EXPECT_EQ(log_time_of("1609811515.5"), at(1'609'811'515, 500));
  EXPECT_EQ(log_time_of("1609811515250"), at(1'609'811'515, 250));
  EXPECT_EQ(log_time_of("2024-02-29T00:00:00Z"), at(1'709'164'800));
}

TEST(LogTime, RefusesWhatIsNone) {
  for (const char* text : {"", "now", "2021-02-30T00:00:00Z", "2021-13-01T00:00:00Z", "12345",
                           "2021-01-05", "2021-01-05T25:00:00Z", "31/02/2021 00:00:00",
                           "99999999999999", "2021-01-05T01:51:55Zulu", "1609811515x",
                           // Seconds that have no nanoseconds since 1970, then the first and last
                           // second out of range.
                           "0000-01-01T00:00:00Z", "1013-01-05T00:04:00Z", "9999-12-31T23:59:59Z",
                           "1989-12-31T23:59:59Z", "2100-01-01T00:00:00Z"}) {
    EXPECT_FALSE(log_time_of(text)) << text;
  }
  EXPECT_EQ(read_log_time("1609811515,x")->length, 10u);
}

TEST(LogLine, ReadsTagBlocks) {
  const std::string line = tagged("g:1-2-7,s:r3669945,c:1609811515") + "\r\n";
  const auto read = parse_log_line(line);
  ASSERT_TRUE(read.ok());
  EXPECT_EQ(read->sentence, kSentence);
  EXPECT_EQ(read->source, "r3669945");
  EXPECT_EQ(read->utc, at(1'609'811'515));
  EXPECT_EQ(parse_log_line(tagged("c:1609811515250"))->utc, at(1'609'811'515, 250));
  EXPECT_EQ(parse_log_line(tagged("n:12"))->utc, std::nullopt);
  const std::string first = tagged("c:1609811515");
  const std::string both = first.substr(0, first.find('\\', 1) + 1) + tagged("s:a");
  EXPECT_EQ(parse_log_line(both)->source, "a");
  EXPECT_EQ(parse_log_line(both)->utc, at(1'609'811'515));
}

TEST(LogLine, ReadsTimesBeforeAndBehind) {
  for (const char* before :
       {"1609811515 ", "1609811515,", "2021-01-05T01:51:55Z\t",
        "2021-01-05 01:51:55 rx1: ", "[2021-01-05T01:51:55Z] ", "1609811515.000;"}) {
    const std::string line = before + kSentence;
    const auto read = parse_log_line(line);
    ASSERT_TRUE(read.ok()) << before;
    EXPECT_EQ(read->sentence, kSentence) << before;
    EXPECT_EQ(read->utc, at(1'609'811'515)) << before;
  }
  for (const char* behind : {",1609811515", ",r003669945,1609811515", ",s28,d-089,1609811515,x"}) {
    const std::string line = kSentence + behind;
    EXPECT_EQ(parse_log_line(line)->utc, at(1'609'811'515)) << behind;
    EXPECT_EQ(parse_log_line(line)->sentence, kSentence) << behind;
  }
  EXPECT_EQ(parse_log_line(kSentence)->utc, std::nullopt);
}

TEST(LogLine, SaysWhatIsWrong) {
  EXPECT_EQ(parse_log_line("# a comment").error().kind, WireErrorKind::unknown_kind);
  EXPECT_EQ(parse_log_line("").error().kind, WireErrorKind::unknown_kind);
  EXPECT_EQ(parse_log_line("\\c:1609811515*00\\" + kSentence).error().kind,
            WireErrorKind::malformed);
  EXPECT_EQ(parse_log_line("\\c:1609811515" + kSentence).error().kind, WireErrorKind::truncated);
}

}  // namespace
}  // namespace skerry::nmea
