// What is written of the ships on the water, and when.
#include "server/traffic_logs/traffic_writer.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "server/traffic_logs/csv_log.hpp"
#include "server/traffic_logs/nmea_log.hpp"
#include "tests/unit/traffic_logs/log_kit.hpp"

namespace skerry::server {
namespace {

using namespace std::chrono_literals;

TrafficItem ship(std::uint32_t number, double speed_kn, TrafficKind kind = TrafficKind::ship) {
  TrafficItem item;
  item.number = number;
  item.kind = kind;
  item.name = "SHIP";
  item.mmsi = 219'000'000 + number;
  item.position = {55.0, 11.0};
  item.speed_mps = speed_kn * 1852 / 3600;
  item.length_m = 100;
  item.beam_m = 20;
  item.ship_type = 70;
  return item;
}

class TrafficWriters : public testing::Test {
 protected:
  TrafficWriter::Sink sink() {
    return [this](std::string_view text) { lines_.emplace_back(text); };
  }
  // Seconds at which the ship reports her position.
  std::vector<int> reports_of(TrafficItem item, int seconds, double turn_deg_s = 0.0) {
    TrafficWriter writer(TrafficForm::nmea, {}, sink());
    std::vector<int> when;
    for (int second = 0; second <= seconds; ++second) {
      const auto before = writer.reports();
      item.course_over_ground_deg = item.heading_deg = turn_deg_s * second;
      item.rate_of_turn_deg_min = 60 * turn_deg_s;
      writer.second({item}, log_time(second));
      if (writer.reports() > before) when.push_back(second);
    }
    return when;
  }
  std::vector<std::string> lines_;
};

TEST_F(TrafficWriters, ShipsReportAtTheIntervalsOfAis) {
  EXPECT_EQ(reports_of(ship(1, 12), 30), (std::vector<int>{0, 10, 20, 30}));
  EXPECT_EQ(reports_of(ship(1, 18), 18), (std::vector<int>{0, 6, 12, 18}));
  EXPECT_EQ(reports_of(ship(1, 30), 6), (std::vector<int>{0, 2, 4, 6}));
  EXPECT_EQ(reports_of(ship(1, 0), 360), (std::vector<int>{0, 180, 360}));
  EXPECT_EQ(reports_of(ship(1, 12), 12, 0.5), (std::vector<int>{0, 4, 8, 12}));
  EXPECT_EQ(reports_of(ship(1, 12, TrafficKind::boat), 60), (std::vector<int>{0, 30, 60}));
}

TEST_F(TrafficWriters, ATurnOrStopAtOnceIsReportedAtOnce) {
  TrafficWriter writer(TrafficForm::nmea, {}, sink());
  TrafficItem item = ship(1, 12);
  std::vector<int> when;
  for (int second = 0; second <= 9; ++second) {
    const auto before = writer.reports();
    if (second == 3) item.course_over_ground_deg = 90;
    if (second == 6) item.speed_mps = 0;
    writer.second({item}, log_time(second));
    if (writer.reports() > before) when.push_back(second);
  }
  EXPECT_EQ(when, (std::vector<int>{0, 3, 6}));
}

TEST_F(TrafficWriters, WhoVanishesAndWhoIsThereAtTheEndReportOnceMore) {
  TrafficWriter writer(TrafficForm::csv, {}, sink());
  for (int second = 0; second <= 7; ++second) {
    std::vector<TrafficItem> items = {ship(1, 12)};
    if (second <= 3) items.push_back(ship(2, 12));
    writer.second(items, log_time(second));
  }
  writer.finish();
  ASSERT_EQ(lines_.size(), 5u);
  EXPECT_NE(lines_[3].find("219000002,2021-01-05T01:51:58Z"), std::string::npos) << lines_[3];
  EXPECT_NE(lines_[4].find("219000001,2021-01-05T01:52:02Z"), std::string::npos) << lines_[4];
  EXPECT_EQ(writer.ships(), 2u);
}

TEST_F(TrafficWriters, ALogIsReadBackWithNamesAndTimes) {
  TrafficWriter writer(TrafficForm::nmea, 5s, sink());
  TrafficItem silent = ship(3, 5);
  silent.ais = AisSaid{.silent = true};
  for (int second = 0; second <= 20; ++second) {
    writer.second({ship(1, 12), ship(2, 5, TrafficKind::boat), silent,
                   ship(4, 0, TrafficKind::aid_to_navigation)},
                  log_time(second));
  }
  TrackBook book{TrackRules{}};
  NmeaLog log(book);
  for (const std::string& line : lines_) log.take(line);
  log.finish();
  EXPECT_EQ(book.left_out().of(LeftOut::aid), 5u);
  EXPECT_EQ(book.left_out().all(), 5u);
  const auto ships = book.finish();
  ASSERT_EQ(ships.size(), 2u);
  EXPECT_EQ(ships[0].identity.name, "SHIP");
  EXPECT_EQ(ships[0].identity.class_b, false);
  EXPECT_EQ(ships[0].identity.length_m, 100);
  EXPECT_EQ(ships[0].heard, 5u);
  EXPECT_EQ(ships[0].pieces[0].fixes.back().utc_ms, 1000 * (kLogBegin_s + 20));
  EXPECT_EQ(ships[1].identity.class_b, true);
}

TEST_F(TrafficWriters, ATableIsReadBack) {
  TrafficWriter writer(TrafficForm::csv, 5s, sink());
  TrafficItem named = ship(1, 12);
  named.name = "A, \"B\"";
  for (int second = 0; second <= 10; ++second) {
    writer.second({named, ship(2, 5, TrafficKind::boat)}, log_time(second));
  }
  TrackBook book{TrackRules{}};
  auto table = CsvLog::open(lines_[0].substr(0, lines_[0].size() - 1), book);
  ASSERT_TRUE(table.ok());
  for (std::size_t i = 1; i < lines_.size(); ++i) {
    table->take(std::string_view(lines_[i]).substr(0, lines_[i].size() - 1));
  }
  EXPECT_EQ(book.left_out().all(), 0u);
  const auto ships = book.finish();
  ASSERT_EQ(ships.size(), 2u);
  EXPECT_EQ(ships[0].identity.name, "A, \"B\"");
  EXPECT_EQ(ships[0].identity.ship_type, 70u);
  EXPECT_EQ(ships[0].identity.beam_m, 20);
  EXPECT_EQ(ships[1].identity.class_b, true);
}

}  // namespace
}  // namespace skerry::server
