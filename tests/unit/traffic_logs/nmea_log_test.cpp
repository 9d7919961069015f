// Logs of sentences: the good ones are used, the rest is counted by kind.
#include "server/traffic_logs/nmea_log.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "protocol/nmea/position_sentences.hpp"
#include "tests/unit/traffic_logs/log_kit.hpp"

namespace skerry::server {
namespace {

class NmeaLogs : public testing::Test {
 protected:
  void take(const std::vector<std::string>& lines) {
    for (const std::string& line : lines) log_.take(line);
  }
  // A ship's fix, as one line; she sails north.
  std::string fix(double seconds, std::uint32_t mmsi = 219'000'001) {
    return logged(position_of(mmsi, 55.0 + 1e-4 * seconds / 2, 11.0), seconds)[0];
  }
  std::uint64_t left_out(LeftOut kind) const { return book_.left_out().of(kind); }
  // Nothing else was left out than so much of those.
  void expect_left_out(const std::map<LeftOut, std::uint64_t>& kinds) {
    for (std::size_t i = 0; i < kLeftOutKinds; ++i) {
      const auto kind = static_cast<LeftOut>(i);
      const auto expected = kinds.find(kind);
      EXPECT_EQ(left_out(kind), expected == kinds.end() ? 0u : expected->second) << name_of(kind);
    }
  }

  TrackBook book_{TrackRules{}};
  NmeaLog log_{book_};
};

TEST_F(NmeaLogs, AShipIsHerFixesAndWhatSheSaysOfHerself) {
  take({fix(0), fix(10)});
  take(logged(
      nmea::AisVoyage{
          .mmsi = 219'000'001, .name = "ANNA", .ship_type = 71, .size = {90, 30, 8, 10}},
      11, 5));
  take({fix(20)});
  log_.finish();
  expect_left_out({});
  EXPECT_EQ(log_.sentences(), 5u);
  const auto ships = book_.finish();
  ASSERT_EQ(ships.size(), 1u);
  EXPECT_EQ(ships[0].identity.name, "ANNA");
  EXPECT_EQ(ships[0].identity.ship_type, 71u);
  EXPECT_EQ(ships[0].identity.length_m, 120.0);
  EXPECT_EQ(ships[0].identity.beam_m, 18.0);
  EXPECT_EQ(ships[0].identity.class_b, false);
  EXPECT_EQ(ships[0].heard, 3u);
  ASSERT_EQ(ships[0].pieces.size(), 1u);
  EXPECT_EQ(ships[0].pieces[0].fixes.front().utc_ms, kLogBegin_s * 1000);
  EXPECT_EQ(ships[0].pieces[0].heading_deg, 1.0);
}

TEST_F(NmeaLogs, ClassBIsKnownByItsMessages) {
  const std::uint32_t mmsi = 219'000'002;
  take(logged(position_of(mmsi, 55, 11, true), 0));
  take(logged(nmea::AisExtended{position_of(mmsi, 55.001, 11, true), "BERTA", 37, {8, 4, 2, 2}}, 30,
              2));
  take(logged(nmea::AisStatic{.mmsi = mmsi, .part_b = false, .name = "BERTA II"}, 31));
  const auto ships = book_.finish();
  ASSERT_EQ(ships.size(), 1u);
  EXPECT_EQ(ships[0].identity.class_b, true);
  EXPECT_EQ(ships[0].identity.name, "BERTA II");
  EXPECT_EQ(ships[0].identity.ship_type, 37u);
  EXPECT_EQ(ships[0].identity.length_m, 12.0);
  EXPECT_EQ(ships[0].heard, 2u);
  expect_left_out({});
}

TEST_F(NmeaLogs, BrokenLinesAreCountedByKindAndTheGoodOnesUsed) {
  const std::string good = fix(0);
  // One byte lost, changed or cut off at every place: never the whole line, never an exception.
  std::uint64_t tried = 0;
  for (std::size_t i = 0; i < good.size(); ++i) {
    log_.take(good.substr(0, i));
    std::string changed = good;
    changed[i] = '\0';
    log_.take(changed);
    log_.take(std::string(good).erase(i, 1));
    tried += 3;
  }
  // The empty line is no fault.
  EXPECT_EQ(book_.left_out().all(), tried - 1);
  EXPECT_EQ(book_.fixes(), 0u);
  EXPECT_GT(left_out(LeftOut::bad_checksum), 50u);
  EXPECT_GT(left_out(LeftOut::cut_short), 50u);
  EXPECT_GE(left_out(LeftOut::no_sentence), 1u);
  take({good, fix(10)});
  EXPECT_EQ(book_.fixes(), 2u);
}

TEST_F(NmeaLogs, EachKindOfFaultHasItsCount) {
  std::string wrong = fix(0);
  wrong[wrong.size() - 6] ^= 1;  // in the payload
  std::string untagged = fix(0);
  untagged = untagged.substr(untagged.find('!'));
  const std::string nowhere = logged(nmea::AisPosition{.mmsi = 219'000'001, .status = 0}, 0)[0];
  take({"# a comment", wrong, fix(0).substr(0, 50), untagged, nowhere,
        nmea::encode(nmea::Gll{.position = GeoPoint{55.5, 11.0}}, "GP"),
        // Published examples: a base station, an aircraft, a message of another kind.
        "!AIVDM,1,1,,A,403OviQuMGCqWrRO9>E6fE700@GO,0*4D",
        "!AIVDM,1,1,,B,91b55wi;hbOS@OdQAC062Ch2089h,0*30", "!AIVDM,1,1,,A,Dh3OvjB8IN>4,0*1D",
        std::string("!AIVDM,1,1,,A,15RTgt,0*") + nmea::checksum_text("AIVDM,1,1,,A,15RTgt,0"),
        std::string(5000, 'x') + "!"});
  take(logged(position_of(970'000'001, 55, 11), 0));
  take(logged(position_of(111'219'501, 55, 11), 0));
  take(logged(position_of(2'190'064, 55, 11), 0));
  take(logged(position_of(12'345'678, 55, 11), 0));
  take(logged(nmea::AisAid{.mmsi = 992'190'001, .name = "DROGDEN"}, 0));
  log_.finish();
  expect_left_out({{LeftOut::no_sentence, 1},
                   {LeftOut::bad_checksum, 1},
                   {LeftOut::cut_short, 2},
                   {LeftOut::no_time, 1},
                   {LeftOut::no_position, 1},
                   {LeftOut::other_sentence, 1},
                   {LeftOut::base_station, 2},
                   {LeftOut::aircraft, 2},
                   {LeftOut::unknown_type, 1},
                   {LeftOut::malformed, 1},
                   {LeftOut::distress, 1},
                   {LeftOut::bad_mmsi, 1},
                   {LeftOut::aid, 1}});
}

TEST_F(NmeaLogs, MissingAndInterleavedPartsAreCountedAndOthersUsed) {
  const auto one = logged(nmea::AisVoyage{.mmsi = 219'000'001, .name = "ONE"}, 0, 3);
  const auto two = logged(nmea::AisVoyage{.mmsi = 219'000'002, .name = "TWO"}, 0, 4);
  const auto three = logged(nmea::AisVoyage{.mmsi = 219'000'003, .name = "THREE"}, 0, 3);
  // Two messages interleaved, by their identifiers; one whose end never comes; an end alone.
  take({one[0], two[0], two[1], one[1], three[0], one[0], one[1], three[1]});
  take({two[0]});
  log_.finish();
  expect_left_out({{LeftOut::incomplete, 3}});
  EXPECT_TRUE(book_.knows(219'000'001));
  EXPECT_TRUE(book_.knows(219'000'002));
  EXPECT_FALSE(book_.knows(219'000'003));
}

TEST_F(NmeaLogs, StationsWithTheSameIdentifierAreKeptApart) {
  const auto tagged = [](const std::string& line, const std::string& station) {
    const std::string tags = "s:" + station;
    return "\\" + tags + "*" + nmea::checksum_text(tags) + "\\" + line.substr(line.find('!'));
  };
  const auto one = logged(nmea::AisVoyage{.mmsi = 219'000'001, .name = "ONE"}, 0, 3);
  const auto two = logged(nmea::AisVoyage{.mmsi = 219'000'002, .name = "TWO"}, 0, 3);
  take({tagged(one[0], "a"), tagged(two[0], "b"), tagged(one[1], "a"), tagged(two[1], "b")});
  expect_left_out({});
  take({fix(0), fix(10), fix(0, 219'000'002), fix(10, 219'000'002)});
  const auto ships = book_.finish();
  ASSERT_EQ(ships.size(), 2u);
  EXPECT_EQ(ships[0].identity.name, "ONE");
  EXPECT_EQ(ships[1].identity.name, "TWO");
}

TEST_F(NmeaLogs, ASentenceWithoutItsFieldsIsNoMessage) {
  for (const std::string between : {"AIVDM,1,1", "AIVDM,1,1,,A", "AIVDM,1,1,,A,", "AIVDM,", "AIVDM",
                                    "AIVDM,2,1,3", "AIVDM,9,9,9,,,9"}) {
    log_.take("!" + between + "*" + nmea::checksum_text(between));
  }
  log_.finish();
  EXPECT_EQ(book_.left_out().all(), 7u);
}

TEST_F(NmeaLogs, TimesThatGoBackAreLeftOut) {
  take({fix(0), fix(10), fix(5), fix(10), fix(20)});
  expect_left_out({{LeftOut::time_back, 2}});
  EXPECT_EQ(book_.fixes(), 3u);
}

TEST_F(NmeaLogs, ALogWithoutTimesGoesByItsOwnClock) {
  const auto bare = [&](double seconds) {
    const std::string line = fix(seconds);
    return line.substr(line.find('!'));
  };
  const auto clock = [](double seconds) {
    return nmea::encode(nmea::Zda{.utc = log_time(seconds)}, "GP");
  };
  take({bare(0), clock(0), bare(0), clock(10), bare(10)});
  expect_left_out({{LeftOut::no_time, 1}, {LeftOut::other_sentence, 2}});
  const auto ships = book_.finish();
  ASSERT_EQ(ships.size(), 1u);
  EXPECT_EQ(ships[0].pieces[0].fixes.back().utc_ms, (kLogBegin_s + 10) * 1000);
}

}  // namespace
}  // namespace skerry::server
