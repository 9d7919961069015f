#include "protocol/nmea/radar_sentences.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "protocol/nmea/tracked_target_data.hpp"
#include "tests/unit/nmea/sentence_kit.hpp"

namespace skerry::nmea {
namespace {

using namespace std::chrono_literals;

constexpr Duration kTimeOfDay = 9h + 8min + 7s + 60ms;

TEST(Rsd, HasTheRangeInItsEleventhField) {
  const std::string line = encode(Rsd{.range_nm = 1.5});
  EXPECT_EQ(body(line), "$RARSD,,,,,,,,,,,1.500,N,H");
  const auto rsd = decode_rsd(parse_sentence(line).value());
  ASSERT_TRUE(rsd) << rsd.error().text;
  EXPECT_EQ(rsd->range_nm, 1.5);
  EXPECT_EQ(rsd->rotation, 'H');
  EXPECT_FALSE(rsd->cursor_range_nm);
}

TEST(Osd, IsAsWritten) {
  const std::string line = encode(Osd{.heading_deg = 35.1, .course_deg = 36.0, .speed_kn = 10.2});
  EXPECT_EQ(body(line), "$RAOSD,35.1,A,36.0,P,10.20,P,,,N");
  // The sentence of a Furuno FAR-21x7.
  const auto osd =
      decode_osd(parse_sentence(with_checksum("RAOSD,35.1,A,36.0,P,10.2,P,15.3,0.1,N")).value());
  ASSERT_TRUE(osd) << osd.error().text;
  EXPECT_EQ(osd->set_deg, 15.3);
  EXPECT_EQ(osd->drift_kn, 0.1);
}

Ttm a_target() {
  return {.number = 7,
          .range_nm = 3.4567,
          .bearing_deg = 359.97,
          .speed_kn = 12.34,
          .course_deg = 180.0,
          .cpa_nm = 0.25,
          .tcpa_min = -4.44,
          .name = "ASTRID",
          .status = TargetStatus::tracking,
          .time_of_day = kTimeOfDay};
}

TEST(Ttm, HasRangesToTwoMetres) {
  const std::string line = encode(a_target());
  EXPECT_EQ(body(line), "$RATTM,07,3.457,0.0,T,12.3,180.0,T,0.25,-4.4,N,ASTRID,T,,090807.06,A");
  const auto ttm = decode_ttm(parse_sentence(line).value());
  ASSERT_TRUE(ttm) << ttm.error().text;
  EXPECT_EQ(ttm->number, 7u);
  EXPECT_EQ(ttm->range_nm, 3.457);
  EXPECT_EQ(ttm->tcpa_min, -4.4);
  EXPECT_EQ(ttm->name, "ASTRID");
  EXPECT_EQ(ttm->time_of_day, kTimeOfDay);
}

TEST(Ttm, GivesUpPartOfTheNameAndNotOfTheNumbers) {
  Ttm longest = a_target();
  longest.name = "QUEEN ELIZABETH THE SECOND";
  longest.range_nm = 99.9996;
  longest.tcpa_min = -1e9;
  longest.speed_kn = 102.2;
  longest.course_deg = longest.bearing_deg = 234.5;
  const std::string line = encode(longest);
  EXPECT_EQ(line.size(), kMaxSentence) << line;
  const auto ttm = decode_ttm(parse_sentence(line).value());
  ASSERT_TRUE(ttm) << ttm.error().text;
  EXPECT_FALSE(ttm->name.empty());
  EXPECT_TRUE(longest.name.starts_with(ttm->name));
  EXPECT_EQ(ttm->tcpa_min, -999.9);
}

TEST(Ttm, OfATargetThatIsBeingAcquiredHasEmptyFields) {
  const Ttm acquired{.number = 3,
                     .range_nm = 2.5,
                     .bearing_deg = 45.0,
                     .status = TargetStatus::acquiring,
                     .acquisition = TargetAcquisition::manual};
  const std::string line = encode(acquired);
  EXPECT_EQ(body(line), "$RATTM,03,2.500,45.0,T,,,T,,,N,,Q,,,M");
  const Ttm back = decoded(line, decode_ttm);
  EXPECT_FALSE(back.speed_kn || back.course_deg || back.cpa_nm || back.tcpa_min);
  EXPECT_EQ(back.status, TargetStatus::acquiring);
  EXPECT_EQ(back.acquisition, TargetAcquisition::manual);
  EXPECT_FALSE(back.is_reference);
}

TEST(Ttm, SaysWhichIsTheReferenceTarget) {
  Ttm target = a_target();
  target.is_reference = true;
  target.acquisition = {};
  const std::string line = encode(target);
  EXPECT_TRUE(body(line).ends_with(",N,ASTRID,T,R,090807.06,")) << line;
  EXPECT_TRUE(decoded(line, decode_ttm).is_reference);
  EXPECT_FALSE(decoded(line, decode_ttm).acquisition);
  EXPECT_TRUE(is_refused("RATTM,01,1,45.0,T,1,2,T,0,0,N,,T,X,,A", decode_ttm));
  EXPECT_TRUE(is_refused("RATTM,01,1,45.0,T,1,2,T,0,0,N,,T,,,X", decode_ttm));
  Tll place{.number = 1, .position = {60.0, 5.0}, .is_reference = true};
  EXPECT_TRUE(body(encode(place)).ends_with(",,,T,R"));
  EXPECT_TRUE(decoded(encode(place), decode_tll).is_reference);
}

TEST(Ttm, HasEmptyFieldsForWhatIsOutOfRange) {
  Ttm target = a_target();
  target.number = 1023;
  target.range_nm = 9999.999;
  target.speed_kn = 1000.0;
  target.cpa_nm = 9999.99;
  target.tcpa_min = 999.9;
  target.course_deg = target.bearing_deg = 359.9;
  target.is_reference = true;
  target.name = "NO ROOM";
  EXPECT_EQ(body(encode(target)),
            "$RATTM,1023,9999.999,359.9,T,1000.0,359.9,T,9999.99,999.9,N,N,T,R,090807.06,A");
  target.tcpa_min = std::numeric_limits<double>::infinity();
  target.speed_kn = 1000.1;
  target.cpa_nm = 10'000.0;
  EXPECT_TRUE(
      body(encode(target)).starts_with("$RATTM,1023,9999.999,359.9,T,,359.9,T,,,N,NO ROOM"));
  target.number = 1024;
  EXPECT_TRUE(body(encode(target)).starts_with("$RATTM,,9999.999"));
  target.range_nm = 10'000.0;
  EXPECT_FALSE(decode_ttm(parse_sentence(encode(target)).value()));
}

TEST(Tlb, GivesLabelsInPairs) {
  const std::vector<TargetLabel> labels{{1, "XXX"}, {1023, ""}, {27, "PILOT BOAT"}};
  const auto lines = encode_tlb(labels);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(body(lines[0]), "$RATLB,1,XXX,1023,,27,PILOT BOAT");
  EXPECT_EQ(decoded(lines[0], decode_tlb), labels);
  EXPECT_TRUE(encode_tlb({}).empty());
}

TEST(Tlb, APairIsNotSplitAndALongLabelIsCut) {
  std::vector<TargetLabel> labels;
  for (unsigned i = 0; i < 100; ++i) labels.push_back({i, std::string(i % 20, 'x')});
  std::vector<TargetLabel> back;
  for (const std::string& line : encode_tlb(labels)) {
    (void)body(line);
    const auto some = decoded(line, decode_tlb);
    back.insert(back.end(), some.begin(), some.end());
  }
  EXPECT_EQ(back, labels);
  const std::vector<TargetLabel> long_ones{{5, std::string(200, 'y')}, {1024, "NONE"}, {6, "z"}};
  const auto lines = encode_tlb(long_ones);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].size(), kMaxSentence);
  EXPECT_EQ(body(lines[1]), "$RATLB,6,z");
}

TEST(Tlb, WithoutANumberIsRefused) {
  EXPECT_EQ(decoded(with_checksum("CDTLB,1,XXX,2"), decode_tlb).size(), 2u);
  for (const char* bad : {"RATLB", "RATLB,,XXX", "RATLB,1,XXX,", "RATLB,1024,X", "RATLB,-1,X"}) {
    EXPECT_TRUE(is_refused(bad, decode_tlb)) << bad;
  }
}

TEST(Ttm, WithoutRangeOrInOtherUnitsIsRefused) {
  for (const char* bad :
       {"RATTM,01,,45.0,T,1,2,T,0,0,N,,T,,,A", "RATTM,01,1,45.0,R,1,2,T,0,0,N,,T,,,A",
        "RATTM,01,1,45.0,T,1,2,T,0,0,K,,T,,,A", "RATTM,01,1,45.0,T,1,2,T,0,0,N,,X,,,A",
        "RATTM,5000,1,45.0,T,1,2,T,0,0,N,,T,,,A"}) {
    const std::string line = with_checksum(bad);
    EXPECT_FALSE(decode_ttm(parse_sentence(line).value())) << bad;
  }
}

TEST(Tll, IsAsWritten) {
  const std::string line = encode(Tll{.number = 12,
                                      .position = {-33.5, -70.25},
                                      .name = "NO NAME IS SO LONG AS THIS ONE",
                                      .time_of_day = kTimeOfDay,
                                      .status = TargetStatus::lost});
  EXPECT_TRUE(body(line).starts_with("$RATLL,12,3330.00000,S,07015.00000,W,NO NAME IS SO LONG"))
      << line;
  EXPECT_TRUE(body(line).ends_with(",090807.06,L,")) << line;
  const auto tll = decode_tll(parse_sentence(line).value());
  ASSERT_TRUE(tll) << tll.error().text;
  EXPECT_EQ(tll->position, (GeoPoint{-33.5, -70.25}));
  EXPECT_EQ(tll->status, TargetStatus::lost);
}

TEST(Ttd, FourTargetsFillASentenceAndTheFifthBeginsAnother) {
  std::vector<TtdTarget> targets;
  for (unsigned i = 1; i <= 5; ++i) {
    targets.push_back({.number = i,
                       .bearing_deg = 70.0 * i,
                       .speed_kn = 5.5 * i,
                       .course_deg = 300.0,
                       .heading_deg = i == 3 ? std::optional<double>() : 299.9,
                       .range_nm = 0.29 * i,
                       .status = i == 5 ? TtdStatus::lost : TtdStatus::tracking});
  }
  const auto lines = encode_ttd(targets, 13);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_TRUE(lines[0].starts_with("!RATTD,02,01,3,")) << lines[0];
  EXPECT_TRUE(lines[1].starts_with("!RATTD,02,02,3,")) << lines[1];
  EXPECT_NE(lines[0].find(",0*"), std::string::npos) << "90 bits are 15 whole characters";
  std::vector<TtdTarget> back;
  for (const std::string& line : lines) {
    EXPECT_LE(line.size(), kMaxSentence);
    const auto some = decode_ttd(parse_sentence(line).value());
    ASSERT_TRUE(some) << some.error().text;
    back.insert(back.end(), some->begin(), some->end());
  }
  ASSERT_EQ(back.size(), targets.size());
  for (std::size_t i = 0; i < back.size(); ++i) {
    EXPECT_EQ(back[i].number, targets[i].number);
    EXPECT_NEAR(*back[i].bearing_deg, *targets[i].bearing_deg, 1e-9);
    EXPECT_NEAR(*back[i].speed_kn, *targets[i].speed_kn, 1e-9);
    EXPECT_NEAR(*back[i].range_nm, *targets[i].range_nm, 1e-9);
    EXPECT_EQ(back[i].heading_deg.has_value(), targets[i].heading_deg.has_value());
    EXPECT_EQ(back[i].status, targets[i].status);
  }
}

TEST(Ttd, WhatIsOutOfRangeIsNotAvailable) {
  const auto lines = encode_ttd(std::vector<TtdTarget>{{.number = 1,
                                                        .bearing_deg = 359.97,
                                                        .speed_kn = 500.0,
                                                        .course_deg = {},
                                                        .heading_deg = {},
                                                        .range_nm = 200.0}},
                                0);
  const auto back = decode_ttd(parse_sentence(lines.at(0)).value());
  ASSERT_TRUE(back);
  EXPECT_EQ(back->at(0).bearing_deg, 0.0);
  EXPECT_FALSE(back->at(0).speed_kn);
  EXPECT_FALSE(back->at(0).range_nm);
  EXPECT_TRUE(encode_ttd({}, 0).empty());
}

}  // namespace
}  // namespace skerry::nmea
