// Plots and tracks as CAT048, CAT062 and CAT010: there and back at both ends, what is out of range,
// datagrams, and bytes from outside.
#include <gmock/gmock.h>

#include <chrono>
#include <cmath>
#include <limits>

#include "protocol/wire/byte_order.hpp"
#include "tests/unit/asterix/track_reports.hpp"

namespace skerry {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::ElementsAreArray;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();

template <typename Report>
Bytes one_datagram(const Report& report) {
  const auto datagrams = encoded(std::span(&report, 1), kAsterixDatagram);
  EXPECT_EQ(datagrams.size(), 1u);
  return datagrams.empty() ? Bytes{} : datagrams.front();
}

template <typename Report>
Report there_and_back(const Report& report) {
  const auto back = decoded_as<Report>(one_datagram(report));
  EXPECT_TRUE(back.ok()) << back.error().text;
  if (!back.ok() || back->size() != 1) {
    ADD_FAILURE() << "expected one report";
    return {};
  }
  return back->front();
}

// The same for all three.
template <typename Report>
class TrackReports : public testing::Test {
 protected:
  static Report full(bool most) {
    if constexpr (std::is_same_v<Report, Cat048Report>) return full_cat048(most);
    if constexpr (std::is_same_v<Report, Cat062Report>) return full_cat062(most);
    if constexpr (std::is_same_v<Report, Cat010Report>) return full_cat010(most);
  }
  static WireErrorKind refusal_of(const Bytes& datagram) {
    const auto reports = decoded_as<Report>(datagram);
    EXPECT_FALSE(reports.ok());
    if (reports.ok()) return {};
    EXPECT_FALSE(reports.error().text.empty());
    EXPECT_LE(reports.error().offset, datagram.size());
    return reports.error().kind;
  }
};
using Reports = testing::Types<Cat048Report, Cat062Report, Cat010Report>;
TYPED_TEST_SUITE(TrackReports, Reports);

TYPED_TEST(TrackReports, ComeBackFromBothEndsOfEveryRange) {
  for (const bool most : {false, true}) {
    const TypeParam report = this->full(most);
    EXPECT_TRUE(there_and_back(report) == report) << most;
  }
}

TYPED_TEST(TrackReports, WithoutAnythingHaveFewOctetsAndComeBack) {
  const TypeParam nothing;
  EXPECT_LE(one_datagram(nothing).size(), 12u);
  EXPECT_TRUE(there_and_back(nothing) == nothing);
}

TYPED_TEST(TrackReports, FillDatagramsAsFarAsTheyMay) {
  std::vector<TypeParam> reports;
  for (int i = 0; i < 100; ++i) {
    reports.push_back(i % 3 == 0 ? TypeParam{} : this->full(i % 3 == 1));
    reports.back().source.sic = static_cast<std::uint8_t>(i);
  }
  for (const std::size_t most : {std::size_t{1}, std::size_t{100}, std::size_t{508},
                                 kAsterixDatagram, std::size_t{1} << 40}) {
    std::vector<TypeParam> back;
    const auto datagrams = encoded(std::span<const TypeParam>(reports), most);
    for (const Bytes& datagram : datagrams) {
      EXPECT_EQ(big_endian_at<std::uint16_t>(datagram, 1), datagram.size());
      const auto some = decoded_as<TypeParam>(datagram);
      ASSERT_TRUE(some.ok()) << some.error().text;
      EXPECT_TRUE(datagram.size() <= most || some->size() == 1) << datagram.size();
      back.insert(back.end(), some->begin(), some->end());
    }
    EXPECT_TRUE(back == reports) << most;
    EXPECT_EQ(datagrams.size() == 1, most > 100'000);
  }
  EXPECT_TRUE(encoded(std::span<const TypeParam>{}, kAsterixDatagram).empty());
}

TYPED_TEST(TrackReports, OfOtherCategoriesArePassedOver) {
  Bytes datagram = {34, 0, 5, 0xFF, 0xFF};
  const Bytes own = one_datagram(this->full(true));
  datagram.insert(datagram.end(), own.begin(), own.end());
  datagram.insert(datagram.end(), {240, 0, 3});
  EXPECT_EQ(decoded_as<TypeParam>(datagram)->size(), 1u);
}

TYPED_TEST(TrackReports, AreRefusedAtEveryCut) {
  const Bytes whole = one_datagram(this->full(true));
  for (std::size_t size = 1; size < whole.size(); ++size) {
    Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
    ASSERT_EQ(this->refusal_of(cut), WireErrorKind::truncated) << size;
    if (size <= 3) continue;
    put_big_endian(cut, 1, size, 2);
    ASSERT_EQ(this->refusal_of(cut), WireErrorKind::truncated) << "block of " << size;
  }
}

TYPED_TEST(TrackReports, OfFalseLengthsOrWithoutTheirSourceAreRefused) {
  const std::uint8_t category = one_datagram(TypeParam{})[0];
  EXPECT_EQ(this->refusal_of({category, 0, 2}), WireErrorKind::malformed);
  EXPECT_EQ(this->refusal_of({category, 0, 4, 0x00}), WireErrorKind::malformed);
  EXPECT_EQ(this->refusal_of({category, 0, 6, 0x40, 0, 0}), WireErrorKind::malformed);
  EXPECT_EQ(this->refusal_of(Bytes(65'536)), WireErrorKind::oversized);
  // More octets of FSPEC than there are items.
  EXPECT_EQ(this->refusal_of({category, 0, 9, 0x01, 0x01, 0x01, 0x01, 0x01, 0x02}),
            WireErrorKind::unknown_kind);
}

TYPED_TEST(TrackReports, WithATimeThatIsNoneAreSentWithoutAndNotRead) {
  TypeParam report = this->full(true);
  for (const Duration time : {Duration{-1}, Duration{24h}, Duration::max(), Duration::min()}) {
    report.time_of_day = time;
    EXPECT_FALSE(there_and_back(report).time_of_day);
  }
  report = {};
  report.time_of_day = kLastTime;
  Bytes datagram = one_datagram(report);
  const Bytes last = {0xA8, 0xBF, 0xFF};  // 86,400 * 128 - 1
  const auto at = std::search(datagram.begin(), datagram.end(), last.begin(), last.end());
  ASSERT_NE(at, datagram.end());
  at[1] = 0xC0;
  at[2] = 0x00;
  EXPECT_EQ(this->refusal_of(datagram), WireErrorKind::out_of_range);
}

TEST(AsterixTimeOfDay, IsWithinItsDay) {
  EXPECT_EQ(asterix_time_of_day(UtcTime(24h * 20'000 + 1h)), 1h);
  EXPECT_EQ(asterix_time_of_day(UtcTime(-1ns)), 24h - 1ns);
  EXPECT_LT(asterix_time_of_day(UtcTime::min()), 24h);
  EXPECT_GE(asterix_time_of_day(UtcTime::min()), 0h);
  Cat048Report report;
  report.time_of_day = 24h - 1ns;
  EXPECT_EQ(there_and_back(report).time_of_day, kLastTime);
  report.time_of_day = 7'812'499ns;
  EXPECT_EQ(there_and_back(report).time_of_day, 0ns);
}

TEST(Cat048, ATrackIsTheGoldenBytes) {
  const Cat048Report report{.source = {25, 7},
                            .time_of_day = 1h + 2s + 500ms,
                            .is_simulated = true,
                            .measured = AsterixPolar{10 * kNauticalMile, 90.0},
                            .amplitude_dbm = -50.0,
                            .track_number = 300,
                            .velocity = AsterixVelocity{kNauticalMile / 256, 180.0},
                            .status = Cat048TrackStatus{.is_tentative = true, .is_ended = true}};
  EXPECT_THAT(one_datagram(report),
              ElementsAreArray(Bytes{
                  48,   0,    25,          // category, octets
                  0xF3, 0x16,              // FSPEC: 010 140 020 040 - - 130 | - - - 161 - 200 170
                  25,   7,                 // 010
                  0x07, 0x09, 0x40,        // 140: 3602.5 s
                  0x30,                    // 020: PSR, simulated
                  0x0A, 0x00, 0x40, 0x00,  // 040: 10 NM, a quarter of a turn
                  0x08, 0xCE,              // 130: PAM, -50 dBm
                  0x01, 0x2C,              // 161
                  0x00, 0x40, 0x80, 0x00,  // 200: 2^-8 NM/s, half a turn
                  0xA1, 0x80,              // 170: tentative, PSR; end of track
              }));
}

TEST(Cat062, ATrackIsTheGoldenBytes) {
  const Cat062Report report{.source = {25, 8},
                            .time_of_day = 1s,
                            .place = GeoPoint{45.0, -90.0},
                            .velocity = AsterixVector{2.5, -2.5},
                            .track_number = 0x1234,
                            .status = {.is_coasting = true},
                            .primary_age_s = 2.0,
                            .position_deviation = AsterixVector{10.0, 20.0}};
  EXPECT_THAT(one_datagram(report),
              ElementsAreArray(Bytes{
                  62,   0,    37,                                  // category, octets
                  0x9B, 0x0F, 0x01, 0x04,                          // FSPEC
                  25,   8,                                         // 010
                  0x00, 0x00, 0x80,                                // 070
                  0x00, 0x80, 0x00, 0x00, 0xFF, 0x00, 0x00, 0x00,  // 105: 2^23, -2^24
                  0x00, 0x0A, 0xFF, 0xF6,                          // 185
                  0x12, 0x34,                                      // 040
                  0x81, 0x01, 0x01, 0x80,                          // 080
                  0x40, 0x08,                                      // 290: PSR
                  0x80, 0x00, 0x14, 0x00, 0x28,                    // 500: APC
              }));
}

TEST(Cat010, ATargetAndATurnAreTheGoldenBytes) {
  const std::vector<Cat010Report> reports{
      {.source = {0, 9},
       .time_of_day = 2s,
       .measured = AsterixPolar{1000.0, 45.0},
       .track_number = 1,
       .size = AsterixSize{100.0, 90.0, 20.0}},
      {.source = {0, 9}, .kind = Cat010Kind::turn, .time_of_day = 2s, .amplitude = 7}};
  EXPECT_THAT(
      encode_cat010(reports),
      ElementsAre(ElementsAreArray(Bytes{10,   0,    29,                // category, octets
                                         0xF5, 0x21, 0x08,              // FSPEC
                                         0,    9,    1,                 // 010, 000
                                         0x60, 0x00, 0x01, 0x00,        // 020: PSR; 140
                                         0x03, 0xE8, 0x20, 0x00,        // 040
                                         0x00, 0x01, 0xC9, 0x41, 0x28,  // 161, 270
                                         0xD0, 0,    9,    2,    0,    1, 0})));  // the turn
}

TEST(Cat010, HasOnlyTheItemsThatItsKindMayHave) {
  Cat010Report status = full_cat010(true);
  status.kind = Cat010Kind::periodic_status;
  status.system_status = Cat010SystemStatus{7, true, true};
  const Cat010Report back = there_and_back(status);
  EXPECT_EQ(back.kind, Cat010Kind::periodic_status);
  EXPECT_EQ(back.system_status, (Cat010SystemStatus{3, true, true}));
  EXPECT_EQ(back.time_of_day, status.time_of_day);
  EXPECT_FALSE(back.measured || back.status || back.amplitude);
  status.kind = Cat010Kind::target;
  EXPECT_FALSE(there_and_back(status).system_status);
  EXPECT_TRUE(decode_cat010(Bytes{10, 0, 7, 0xC0, 0, 9, 4}).ok());
  for (const std::uint8_t kind : {std::uint8_t{0}, std::uint8_t{5}})
    EXPECT_FALSE(decode_cat010(Bytes{10, 0, 7, 0xC0, 0, 9, kind}).ok());
}

TEST(TrackReportValues, OutOfRangeAreAbsentAndNeverWrap) {
  for (const double bad : {kNaN, kInfinite, -kInfinite, 1e300, -1.0 * kNauticalMile}) {
    Cat048Report plot;
    plot.measured = AsterixPolar{bad, 0.0};
    plot.velocity = AsterixVelocity{bad, 0.0};
    EXPECT_EQ(there_and_back(plot), Cat048Report{}) << bad;
    Cat010Report shore;
    shore.measured = AsterixPolar{bad, 0.0};
    EXPECT_EQ(there_and_back(shore), Cat010Report{}) << bad;
  }
  for (const double bad : {kNaN, kInfinite, -kInfinite, 1e300, -1e300}) {
    const Cat048Report plane{.position = PlanePoint{bad, 0.0}};
    EXPECT_EQ(there_and_back(plane), Cat048Report{});
    const Cat062Report track{.place = GeoPoint{bad, 0.0},
                             .position = PlanePoint{0.0, bad},
                             .velocity = AsterixVector{bad, 0.0}};
    EXPECT_EQ(there_and_back(track), Cat062Report{}) << bad;
  }
  EXPECT_FALSE(there_and_back(Cat062Report{.place = GeoPoint{0.0, kNaN}}).place);
  EXPECT_FALSE(there_and_back(Cat062Report{.place = GeoPoint{90.0001, 0.0}}).place);
  EXPECT_FALSE(there_and_back(Cat048Report{.measured = AsterixPolar{0.0, kInfinite}}).measured);
  EXPECT_FALSE(there_and_back(Cat048Report{.track_number = 4096}).track_number);
  // Half a unit beyond the last.
  const double most = 65'535 * kNauticalMile / 256, unit = kNauticalMile / 256;
  EXPECT_TRUE(
      there_and_back(Cat048Report{.measured = AsterixPolar{most + 0.49 * unit, 0}}).measured);
  EXPECT_FALSE(
      there_and_back(Cat048Report{.measured = AsterixPolar{most + 0.51 * unit, 0}}).measured);
  EXPECT_FALSE(there_and_back(Cat062Report{.velocity = AsterixVector{8191.9, 0.0}}).velocity);
}

TEST(TrackReportValues, OfDeviationsAgesAndSizesAreTheNearestThereIs) {
  for (const double huge : {1e9, 1e300}) {
    const Cat048Report plot{.run_length_deg = huge,
                            .amplitude_dbm = -huge,
                            .quality = Cat048Quality{huge, huge, huge, -huge}};
    const Cat048Report back = there_and_back(plot);
    EXPECT_EQ(back.run_length_deg, 255 * 360.0 / 8192);
    EXPECT_EQ(back.amplitude_dbm, -128.0);
    EXPECT_EQ(back.quality, (Cat048Quality{255 * kNauticalMile / 128, 255 * kNauticalMile / 128,
                                           255 * kNauticalMile / 16'384, 0.0}));
    const Cat062Report track{.acceleration = AsterixVector{huge, -huge},
                             .track_age_s = huge,
                             .primary_age_s = kNaN,
                             .size = AsterixSize{huge, 0.0, -huge},
                             .position_deviation = AsterixVector{huge, -1.0},
                             .position_covariance_m = -huge};
    const Cat062Report got = there_and_back(track);
    EXPECT_EQ(got.acceleration, (AsterixVector{31.75, -32.0}));
    EXPECT_EQ(got.track_age_s, 63.75);
    EXPECT_FALSE(got.primary_age_s);
    EXPECT_EQ(got.size, (AsterixSize{127.0, 0.0, 0.0}));
    EXPECT_EQ(got.position_deviation, (AsterixVector{32'767.5, 0.0}));
    EXPECT_EQ(got.position_covariance_m, -16'384.0);
  }
}

TEST(TrackReportValues, OfAnglesGoRound) {
  const auto bearing = [](double degrees) {
    return there_and_back(Cat048Report{.measured = AsterixPolar{0.0, degrees}})
        .measured->bearing_deg;
  };
  EXPECT_EQ(bearing(360.0), 0.0);
  EXPECT_EQ(bearing(-90.0), 270.0);
  EXPECT_EQ(bearing(3690.0), 90.0);
  EXPECT_EQ(bearing(359.9999), 0.0);
  EXPECT_EQ(bearing(-0.0001), 0.0);
  for (double degrees = -720.0; degrees < 720.0; degrees += 0.37) {
    EXPECT_LE(std::abs(std::remainder(bearing(degrees) - degrees, 360.0)), 180.0 / 65'536 + 1e-9);
  }
  const auto longitude = [](double degrees) {
    return there_and_back(Cat062Report{.place = GeoPoint{0.0, degrees}}).place->longitude_deg;
  };
  EXPECT_EQ(longitude(180.0), -180.0);
  EXPECT_EQ(longitude(179.999999), -180.0);
  EXPECT_EQ(longitude(190.0),
            there_and_back(Cat062Report{.place = GeoPoint{0, -170}}).place->longitude_deg);
  EXPECT_EQ(there_and_back(Cat010Report{.place = GeoPoint{0, 180}}).place->longitude_deg, -180.0);
  const auto points = [](double degrees) {
    return there_and_back(Cat062Report{.size = AsterixSize{1.0, degrees}}).size->orientation_deg;
  };
  EXPECT_EQ(points(359.0), 0.0);
  EXPECT_EQ(points(-90.0), 270.0);
}

TEST(TrackReportValues, OfPlacesAreReadWithinTheEarthOnly) {
  const auto at = [](std::uint32_t latitude, std::uint32_t longitude) {
    Bytes datagram{62, 0, 18, 0x89, 0x0C, 1, 2};  // 010 105 | 040 080
    append_big_endian(datagram, latitude, 4);
    append_big_endian(datagram, longitude, 4);
    datagram.insert(datagram.end(), {0, 1, 0});
    return decode_cat062(datagram);
  };
  EXPECT_TRUE(at(1u << 24, 0).ok());
  EXPECT_FALSE(at((1u << 24) + 1, 0).ok());
  EXPECT_EQ(at(0, 1u << 25)->front().place->longitude_deg, -180.0);
  EXPECT_FALSE(at(0, 0x8000'0000).ok());
}

// Records of others have items that these reports do not; each is passed over in its length.
TEST(TrackReportReading, PassesOverEveryOtherItem) {
  // CAT048: all 28 items.
  Bytes record = {0xFF, 0xFF, 0xFF, 0xFE};
  const auto add = [&](std::size_t octets) { record.insert(record.end(), octets, 0x00); };
  add(2 + 3 + 1 + 4 + 2 + 2);
  record.insert(record.end(), {0xFE, 1, 2, 3, 4, 5, 6, 7});  // 130, all subfields
  add(3 + 6);
  record.insert(record.end(), {2});  // 250, two registers
  add(16);
  add(2 + 4 + 4 + 1 + 4);
  record.insert(record.end(), {0x03, 0x05, 0x06});  // 030
  add(2 + 4 + 2);
  record.insert(record.end(), {0xC0, 0, 0, 1, 1, 2, 3, 4, 5, 6});  // 120
  add(2 + 7 + 1 + 2 + 1 + 2);
  record.insert(record.end(), {2, 0xAA, 1});  // SP, RE
  Bytes datagram = {48, 0, static_cast<std::uint8_t>(2 * record.size() + 3)};
  for (int i = 0; i < 2; ++i) datagram.insert(datagram.end(), record.begin(), record.end());
  const auto reports = decode_cat048(datagram);
  ASSERT_TRUE(reports.ok()) << reports.error().text;
  ASSERT_EQ(reports->size(), 2u);
  EXPECT_EQ(reports->at(1).amplitude_dbm, 5.0);
  EXPECT_EQ(reports->at(1).run_length_deg, 4 * 360.0 / 8192);
}

TEST(TrackReportReading, PassesOverItemsOfEveryShape) {
  const auto plots = decode_cat048(cat048_of_others());
  ASSERT_TRUE(plots.ok()) << plots.error().text;
  ASSERT_EQ(plots->size(), 1u);
  EXPECT_EQ(plots->front().source, (AsterixSource{25, 7}));
  const auto tracks = decode_cat062(cat062_of_others());
  ASSERT_TRUE(tracks.ok()) << tracks.error().text;
  ASSERT_EQ(tracks->size(), 1u);
  EXPECT_EQ(tracks->front().track_number, 7);
}

// Item 510 is of three octets at a time, by asterix-specs; Wireshark 4.0 goes wrong in it.
TEST(TrackReportReading, PassesOverItemsExtendedByThreeOctets) {
  const Bytes start{62, 0, 18, 0x81, 0x0D, 0x01, 0x08, 25, 8, 0, 7, 0};
  Bytes master = start, both = start;
  master[2] = 15;
  master.insert(master.end(), {1, 0, 2});
  both.insert(both.end(), {1, 0, 3, 2, 0, 2});
  for (const Bytes& datagram : {master, both}) {
    const auto tracks = decode_cat062(datagram);
    ASSERT_TRUE(tracks.ok()) << tracks.error().text;
    EXPECT_EQ(tracks->size(), 1u);
  }
}

TEST(TrackReportReading, RefusesSpareItemsAndSubfields) {
  // CAT062 with FRN 2; with 290 of an eleventh subfield.
  EXPECT_EQ(decode_cat062(Bytes{62, 0, 10, 0xC1, 0x0C, 1, 2, 0, 1, 0}).error().kind,
            WireErrorKind::unknown_kind);
  EXPECT_EQ(
      decode_cat062(Bytes{62, 0, 14, 0x81, 0x0E, 1, 2, 0, 1, 0, 0x01, 0x10, 0, 0}).error().kind,
      WireErrorKind::unknown_kind);
  // CAT010 with FRN 26; SP of length 0.
  EXPECT_EQ(decode_cat010(Bytes{10, 0, 11, 0xC1, 0x01, 0x01, 0x08, 1, 2, 1, 0}).error().kind,
            WireErrorKind::unknown_kind);
  EXPECT_EQ(decode_cat010(Bytes{10, 0, 11, 0xC1, 0x01, 0x01, 0x04, 1, 2, 1, 0}).error().kind,
            WireErrorKind::malformed);
}

}  // namespace
}  // namespace skerry
