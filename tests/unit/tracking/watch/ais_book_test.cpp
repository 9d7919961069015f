#include "server/tracking/watch/ais_book.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "server/tracking/watch/vectors.hpp"
#include "tests/unit/tracking/watch/watch_times.hpp"

namespace skerry::server {
namespace {

constexpr GeoPoint kOwn{50.0, 3.0};

AisContact contact(std::uint32_t mmsi, double range_nm, double bearing_deg, double t = 0.0,
                   std::optional<double> course_deg = 90.0, std::optional<double> speed_kn = 12.0) {
  AisContact contact;
  contact.mmsi = mmsi;
  contact.name = "ALMA";
  contact.place = GroundPlane(kOwn).to_geo(vector_of(bearing_deg, range_nm * kNm));
  contact.course_deg = course_deg;
  if (speed_kn) contact.speed_mps = *speed_kn * kKnot;
  contact.utc = utc_at(t);
  return contact;
}

struct Book : AisBook {
  void go_on(std::vector<AisContact> contacts, double t,
             std::optional<PlanePoint> own_mps = PlanePoint{}) {
    take(contacts, utc_at(t));
    place(GroundPlane(kOwn), own_mps, utc_at(t));
  }
};

TEST(AisBook, TargetsGoOnFromTheirLastReport) {
  Book book;
  book.go_on({contact(7, 4.0, 0.0)}, 0.0);
  book.go_on({contact(7, 4.0, 0.0)}, 300.0);  // told again is not reported again
  const AisRecord* record = book.find(7);
  ASSERT_NE(record, nullptr);
  EXPECT_EQ(record->age_s, 300.0);
  EXPECT_NEAR(record->from_own_ship.east_m, 1.0 * kNm, 5.0);
  EXPECT_NEAR(record->from_own_ship.north_m, 4.0 * kNm, 5.0);
}

TEST(AisBook, CpaIsByOwnMotionOverGround) {
  Book book;
  book.go_on({contact(7, 8.0, 0.0, 0.0, 180.0, 10.0)}, 0.0, PlanePoint{0.0, 10.0 * kKnot});
  ASSERT_TRUE(book.find(7)->approach);
  EXPECT_NEAR(book.find(7)->approach->range_m, 0.0, 1.0);
  EXPECT_NEAR(book.find(7)->approach->time_s, 24.0 * 60.0, 1.0);
  book.go_on({}, 1.0, std::nullopt);
  EXPECT_FALSE(book.find(7)->approach);
  book.go_on({contact(8, 3.0, 0.0, 1.0, std::nullopt, std::nullopt)}, 1.0);
  EXPECT_FALSE(book.find(8)->approach);
  // One that lies still needs no course.
  book.go_on({contact(9, 3.0, 0.0, 1.0, std::nullopt, 0.0)}, 1.0, PlanePoint{0.0, 5.0});
  EXPECT_NEAR(book.find(9)->approach->time_s, 3.0 * kNm / 5.0, 1.0);
}

// The course is by true north where the target is, not where own ship is.
TEST(AisBook, CoursesAreByTheNorthOfTheirPlace) {
  Book book;
  book.go_on({contact(7, 40.0, 90.0, 0.0, 0.0, 20.0)}, 0.0);
  const double convergence_deg = 40.0 / 60.0 * std::tan(50.0 / kDegreesPerRadian);
  EXPECT_NEAR(std::remainder(direction_of(*book.find(7)->motion_mps), 360.0), -convergence_deg,
              0.02);
}

TEST(AisBook, SilentOnesAreStaleAfterThreeOfTheirIntervals) {
  Book book;
  for (double t = 0.0; t <= 150.0; t += 30.0) book.go_on({contact(7, 4.0, 0.0, t)}, t);
  book.go_on({}, 239.0);
  EXPECT_TRUE(AisBook::is_fresh(*book.find(7)));
  book.go_on({}, 241.0);
  EXPECT_FALSE(AisBook::is_fresh(*book.find(7)));

  Book often;  // the same reports, told twice a second
  for (double t = 0.0; t <= 150.0; t += 0.5) {
    often.go_on({contact(7, 4.0, 0.0, 30.0 * std::floor(t / 30.0))}, t);
  }
  often.go_on({}, 239.0);
  EXPECT_TRUE(AisBook::is_fresh(*often.find(7)));

  Book quick;  // every 2 s: a minute all the same
  for (double t = 0.0; t <= 20.0; t += 2.0) quick.go_on({contact(7, 4.0, 0.0, t)}, t);
  quick.go_on({}, 79.0);
  EXPECT_TRUE(AisBook::is_fresh(*quick.find(7)));
  quick.go_on({}, 81.0);
  EXPECT_FALSE(AisBook::is_fresh(*quick.find(7)));

  Book anchored;  // it may have let go its anchor just now
  for (double t = 0.0; t <= 20.0; t += 10.0) {
    anchored.go_on({contact(7, 4.0, 0.0, t, {}, 0.1)}, t);
  }
  anchored.go_on({}, 379.0);
  EXPECT_TRUE(AisBook::is_fresh(*anchored.find(7)));
  anchored.go_on({}, 381.0);
  EXPECT_FALSE(AisBook::is_fresh(*anchored.find(7)));
}

TEST(AisBook, TheNearestAreListedAndTheOthersCounted) {
  Book book;
  std::vector<AisContact> many;
  for (std::uint32_t k = 0; k < 300; ++k) {
    many.push_back(contact(1000 + k, 0.1 * static_cast<double>(300 - k), k, 0.0));
  }
  many.push_back(contact(9, 60.0, 0.0));  // too far to count
  book.go_on(many, 0.0);
  EXPECT_EQ(book.left_out(), 60u);
  EXPECT_EQ(book.find(1000), nullptr);
  EXPECT_EQ(book.find(1059), nullptr);
  EXPECT_NE(book.find(1060), nullptr);
  EXPECT_NE(book.find(1299), nullptr);
  EXPECT_EQ(book.find(9), nullptr);
}

TEST(AisBook, NonsenseIsLeftOut) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  Book book;
  AisContact nowhere = contact(1, 4.0, 0.0), far = contact(2, 4.0, 0.0), old = contact(3, 4.0, 0.0);
  nowhere.place.latitude_deg = kNan;
  far.place = {91.0, 181.0};
  old.utc = UtcTime::min();
  AisContact ahead = contact(4, 4.0, 0.0), odd = contact(5, 4.0, 0.0);
  ahead.utc = UtcTime::max();
  odd.course_deg = kNan;
  odd.speed_mps = 1e300;
  odd.heading_deg = -1e300;
  odd.name = "A\x1b[2J\xff" + std::string(500, 'x');
  book.go_on({nowhere, far, old, ahead, odd, contact(0, 1.0, 0.0)}, 0.0);
  EXPECT_EQ(book.records().size(), 1u);
  const AisContact& told = book.find(5)->contact;
  EXPECT_FALSE(told.course_deg || told.speed_mps || told.heading_deg);
  EXPECT_EQ(told.name.substr(0, 6), "A?[2J?");
  EXPECT_LE(told.name.size(), 34u);

  std::vector<AisContact> flood;
  for (std::uint32_t k = 1; k < 10'000; ++k) flood.push_back(contact(k, 4.0, 0.0));
  book.go_on(flood, 0.0);
  EXPECT_EQ(book.records().size(), AisBook::kMostKnown);
  book.go_on({}, 400.0);
  EXPECT_LE(book.records().size(), AisBook::kMostListed);
}

}  // namespace
}  // namespace skerry::server
