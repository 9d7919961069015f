#include <gtest/gtest.h>

#include <cmath>

#include "protocol/nmea/ais_sentences.hpp"

namespace skerry::nmea {
namespace {

Result<std::optional<HeardAis>, WireError> heard(AisAssembler& assembler, const std::string& line) {
  const auto sentence = parse_sentence(line);
  if (!sentence) return Failure{sentence.error()};
  return assembler.feed(*sentence);
}

// The message of whole lines; an exception where there is none.
template <typename Kind>
Kind message_of(const std::vector<std::string>& lines) {
  AisAssembler assembler;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    auto result = heard(assembler, lines[i]);
    if (!result) throw std::runtime_error(result.error().text);
    if (i + 1 < lines.size()) {
      EXPECT_FALSE(result->has_value());
    } else {
      return std::get<Kind>(result->value().message);
    }
  }
  throw std::runtime_error("no lines");
}

// From the test suite of gpsd and from a published description of AIVDM; the values are theirs.
TEST(Ais, ReadsPublishedPositionReports) {
  const auto a = message_of<AisPosition>({"!AIVDM,1,1,,A,15RTgt0PAso;90TKcjM8h6g208CQ,0*4A"});
  EXPECT_EQ(a.mmsi, 371798000u);
  EXPECT_EQ(a.status, 0u);
  EXPECT_EQ(a.speed_kn, 12.3);
  EXPECT_NEAR(a.position->longitude_deg, -123.395383, 1e-6);
  EXPECT_NEAR(a.position->latitude_deg, 48.381633, 1e-6);
  EXPECT_EQ(a.course_deg, 224.0);
  EXPECT_EQ(a.heading_deg, 215.0);
  EXPECT_EQ(a.utc_second, 33u);
  EXPECT_FALSE(a.class_b);
}

AisPosition a_ship(bool class_b) {
  return {.mmsi = 257'123'456,
          .class_b = class_b,
          .status = 0,
          .rate_of_turn_deg_min = -12.0,
          .speed_kn = 14.26,
          .position = GeoPoint{-60.123456, -179.999},
          .course_deg = 359.97,
          .heading_deg = 1.4,
          .utc_second = 59};
}

TEST(Ais, PositionReportsComeBack) {
  for (const bool class_b : {false, true}) {
    const auto lines = encode_ais(a_ship(class_b), false, 0, 'B');
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_TRUE(lines[0].starts_with("!AIVDM,1,1,,B,")) << lines[0];
    const auto back = message_of<AisPosition>(lines);
    EXPECT_EQ(back.class_b, class_b);
    EXPECT_EQ(back.mmsi, 257'123'456u);
    EXPECT_EQ(back.speed_kn, 14.3);
    EXPECT_NEAR(back.position->latitude_deg, -60.123456, 0.51 / 600'000);
    EXPECT_NEAR(back.position->longitude_deg, -179.999, 0.51 / 600'000);
    EXPECT_EQ(back.course_deg, 0.0);
    EXPECT_EQ(back.heading_deg, 1.0);
    EXPECT_EQ(back.utc_second, 59u);
    if (!class_b) {
      EXPECT_NEAR(*back.rate_of_turn_deg_min, -12.0, 0.8);
    }
  }
}

// A sentence of gpsd's own test suite; the values are what gpsdecode 3.22 makes of it.
TEST(Ais, ReadsAPublishedExtendedReport) {
  const auto b = message_of<AisExtended>(
      {"!AIVDM,1,1,,B,C5N3SRgPEnJGEBT>NhWAwwo862PaLELTBJ:V00000000S0D:R220,0*0B"});
  EXPECT_EQ(b.position.mmsi, 367059850u);
  EXPECT_TRUE(b.position.class_b);
  EXPECT_EQ(b.position.speed_kn, 8.7);
  EXPECT_NEAR(b.position.position->longitude_deg, -88.810392, 1e-6);
  EXPECT_NEAR(b.position.position->latitude_deg, 29.543695, 1e-6);
  EXPECT_EQ(b.position.course_deg, 335.9);
  EXPECT_FALSE(b.position.heading_deg);
  EXPECT_EQ(b.name, "CAPT.J.RIMES");
  EXPECT_EQ(b.ship_type, 70u);
  EXPECT_EQ(b.size, (AisSize{5, 21, 4, 4}));
}

TEST(Ais, ExtendedReportsComeBack) {
  const AisExtended said{a_ship(true), "ANNA", 37, {10, 5, 2, 3}};
  const auto lines = encode_ais(said, false, 4, 'A');
  ASSERT_EQ(encode(said).bits(), 312u);
  const auto back = message_of<AisExtended>(lines);
  EXPECT_EQ(back.position.mmsi, 257'123'456u);
  EXPECT_NEAR(back.position.position->latitude_deg, -60.123456, 0.51 / 600'000);
  EXPECT_EQ(back.position.utc_second, 59u);
  EXPECT_EQ(back.name, "ANNA");
  EXPECT_EQ(back.ship_type, 37u);
  EXPECT_EQ(back.size, said.size);
}

TEST(Ais, MessagesWithoutTheirEndAreCounted) {
  AisAssembler assembler;
  const auto lines = encode_ais(AisVoyage{.mmsi = 257'000'001, .name = "ONE"}, false, 3, 'A');
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(assembler.pending(), 0u);
  EXPECT_TRUE(heard(assembler, lines[0]).ok());
  EXPECT_EQ(assembler.pending(), 1u);
  EXPECT_TRUE(heard(assembler, lines[0]).ok()) << "the first is given up";
  EXPECT_EQ(assembler.given_up(), 1u);
  EXPECT_TRUE(heard(assembler, lines[1])->has_value());
  EXPECT_EQ(assembler.pending(), 0u);
  EXPECT_EQ(heard(assembler, lines[1]).error().text, AisAssembler::kNoBeginning);
  EXPECT_EQ(assembler.given_up(), 1u);
}

TEST(Ais, WhatIsNotKnownIsSaidSo) {
  const auto back = message_of<AisPosition>(encode_ais(AisPosition{.mmsi = 1}, true, 0, 'A'));
  EXPECT_FALSE(back.speed_kn);
  EXPECT_FALSE(back.position);
  EXPECT_FALSE(back.course_deg);
  EXPECT_FALSE(back.heading_deg);
  EXPECT_FALSE(back.rate_of_turn_deg_min);
  EXPECT_EQ(back.utc_second, 60u);
}

TEST(Ais, AFasterShipThanItCanSayIsAsFastAsItCan) {
  AisPosition fast = a_ship(false);
  fast.speed_kn = 400.0;
  fast.rate_of_turn_deg_min = 1e6;
  const auto back = message_of<AisPosition>(encode_ais(fast, false, 0, 'A'));
  EXPECT_EQ(back.speed_kn, 102.2);
  EXPECT_NEAR(*back.rate_of_turn_deg_min, 708.7, 0.1);
}

TEST(Ais, AVoyageReportTakesTwoSentencesOfOneIdentifier) {
  const AisVoyage voyage{.mmsi = 257'000'001,
                         .imo = 9'074'729,
                         .call_sign = "LAXY7",
                         .name = "Hurtigruten #1",
                         .ship_type = 60,
                         .size = ais_size(121.8, 19.2),
                         .draught_m = 4.94,
                         .destination = "BERGEN"};
  const auto lines = encode_ais(voyage, false, 7, 'A');
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_TRUE(lines[0].starts_with("!AIVDM,2,1,7,A,")) << lines[0];
  EXPECT_TRUE(lines[1].starts_with("!AIVDM,2,2,7,A,")) << lines[1];
  EXPECT_NE(lines[0].find(",0*"), std::string::npos);
  EXPECT_NE(lines[1].find(",2*"), std::string::npos) << "424 bits leave two over";
  for (const std::string& line : lines) EXPECT_LE(line.size(), kMaxSentence);
  const auto back = message_of<AisVoyage>(lines);
  EXPECT_EQ(back.mmsi, voyage.mmsi);
  EXPECT_EQ(back.imo, voyage.imo);
  EXPECT_EQ(back.call_sign, "LAXY7");
  EXPECT_EQ(back.name, "HURTIGRUTEN #1");
  EXPECT_EQ(back.ship_type, 60u);
  EXPECT_EQ(back.size, (AisSize{61, 61, 10, 10}));
  EXPECT_NEAR(back.draught_m, 4.9, 1e-9);
  EXPECT_EQ(back.destination, "BERGEN");
}

TEST(Ais, OfABoatTheNameAndTheRestComeInTwoMessages) {
  const auto a = message_of<AisStatic>(encode_ais(
      AisStatic{.mmsi = 257'000'002, .part_b = false, .name = "SJØGUTTEN"}, false, 0, 'A'));
  EXPECT_FALSE(a.part_b);
  EXPECT_EQ(a.name, "SJ??GUTTEN") << "six bits have no other letters";
  const auto b = message_of<AisStatic>(encode_ais(AisStatic{.mmsi = 257'000'002,
                                                            .part_b = true,
                                                            .ship_type = 37,
                                                            .call_sign = "LK1234",
                                                            .size = ais_size(9.5, 3.0)},
                                                  false, 0, 'A'));
  EXPECT_TRUE(b.part_b);
  EXPECT_EQ(b.ship_type, 37u);
  EXPECT_EQ(b.call_sign, "LK1234");
  EXPECT_EQ(b.size, (AisSize{5, 5, 1, 2}));
}

TEST(Ais, AMarkKeepsALongName) {
  for (const std::string& name :
       {std::string("MARSTEINEN"), std::string("EXACTLY TWENTY CHARS"),
        std::string("ABCDEFGHIJKLMNOPQRS TUVWXYZ"), std::string(34, 'N')}) {
    const auto lines = encode_ais(AisAid{.mmsi = 992'571'234,
                                         .type = 14,
                                         .name = name,
                                         .position = GeoPoint{60.5, 4.75},
                                         .utc_second = 12,
                                         .off_position = true},
                                  false, 3, 'A');
    for (const std::string& line : lines) EXPECT_LE(line.size(), kMaxSentence);
    const auto back = message_of<AisAid>(lines);
    EXPECT_EQ(back.name, name);
    EXPECT_EQ(back.type, 14u);
    EXPECT_EQ(back.position, (GeoPoint{60.5, 4.75}));
    EXPECT_TRUE(back.off_position);
    EXPECT_FALSE(back.is_virtual);
  }
}

TEST(Ais, SizesAreRoundedUpAndBounded) {
  EXPECT_EQ(ais_size(0, 0), AisSize{});
  EXPECT_EQ(ais_size(399.1, 58.6), (AisSize{200, 200, 29, 30}));
  EXPECT_EQ(ais_size(1e9, 1e9), (AisSize{511, 511, 63, 63}));
  EXPECT_EQ(ais_size(std::nan(""), -5), AisSize{});
}

TEST(AisAssembler, RefusesAnEndWithoutItsBeginningAndGoesOn) {
  const auto lines = encode_ais(AisVoyage{.mmsi = 1, .name = "X"}, false, 2, 'A');
  AisAssembler assembler;
  EXPECT_FALSE(heard(assembler, lines[1]));
  EXPECT_TRUE(heard(assembler, lines[0]));
  const auto whole = heard(assembler, lines[1]);
  ASSERT_TRUE(whole);
  EXPECT_TRUE(whole->has_value());
  EXPECT_FALSE(heard(assembler, lines[1])) << "an end twice";
}

TEST(AisAssembler, TwoMessagesMayCrossEachOther) {
  const auto a = encode_ais(AisVoyage{.mmsi = 1, .name = "A"}, false, 1, 'A');
  const auto b = encode_ais(AisVoyage{.mmsi = 2, .name = "B"}, false, 2, 'B');
  AisAssembler assembler;
  EXPECT_TRUE(heard(assembler, a[0]));
  EXPECT_TRUE(heard(assembler, b[0]));
  const auto first = heard(assembler, a[1]);
  const auto second = heard(assembler, b[1]);
  ASSERT_TRUE(first && first->has_value() && second && second->has_value());
  EXPECT_EQ(std::get<AisVoyage>((*first)->message).name, "A");
  EXPECT_EQ(std::get<AisVoyage>((*second)->message).name, "B");
}

TEST(AisAssembler, RefusesWhatIsShortOrNoSixBit) {
  AisAssembler assembler;
  const auto refused = [&](const std::string& between) {
    const auto result = heard(assembler, "!" + between + "*" + checksum_text(between));
    return result ? std::string("accepted") : result.error().text;
  };
  EXPECT_NE(refused("AIVDM,1,1,,A,15RTgt0PAso,0").find("168"), std::string::npos);
  EXPECT_NE(refused("AIVDM,1,1,,A,Z5RTgt0PAso;90TKcjM8h6g208CQ,0").find("six-bit"),
            std::string::npos);
  EXPECT_NE(refused("AIVDM,1,1,,A,K5RTgt0PAso;90TKcjM8h6g208CQ,0").find("27"), std::string::npos);
  EXPECT_NE(refused("AIVDM,1,2,,A,1,0").find("which"), std::string::npos);
  EXPECT_NE(refused("AIVDM,,1,,A,1,0").find("how many"), std::string::npos);
  EXPECT_NE(refused("AIVDM,1,1,,A,,0"), "accepted");
}

}  // namespace
}  // namespace skerry::nmea
