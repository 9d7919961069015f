#include "server/traffic_logs/csv_log.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/unit/traffic_logs/log_kit.hpp"

namespace skerry::server {
namespace {

std::vector<LoggedShip> ships_of(TrackBook& book, const std::vector<std::string>& rows) {
  EXPECT_TRUE(CsvLog::is_header(rows[0]));
  auto log = CsvLog::open(rows[0], book);
  if (!log) {
    ADD_FAILURE() << log.error();
    return {};
  }
  for (std::size_t i = 1; i < rows.size(); ++i) log->take(rows[i]);
  return book.finish();
}

// The header that the Danish Maritime Authority's files have; the rows are made up.
TEST(CsvLog, ReadsTheDanishMaritimeAuthoritysTables) {
  TrackBook book{TrackRules{}};
  const auto ships = ships_of(
      book,
      {"# Timestamp,Type of mobile,MMSI,Latitude,Longitude,Navigational status,ROT,SOG,COG,Heading,"
       "IMO,Callsign,Name,Ship type,Cargo type,Width,Length,Type of position fixing device,Draught,"
       "Destination,ETA,Data source type,A,B,C,D",
       "05/01/2021 01:51:55,Class A,219000001,55.700000,12.700000,Under way using engine,0.0,10.0,"
       "0.0,2,Unknown,Unknown,ANNA,Tanker,,20,140,GPS,6.1,,,AIS,100,40,10,10",
       "05/01/2021 01:52:05,Class A,219000001,55.700500,12.700000,,,10.0,0.0,,,,,,,,,,,,,AIS,,,,",
       "05/01/2021 01:51:55,Class B,219000002,55.8,12.7,,,,,,,,BERTA,Sailing,,,,,,,,AIS,8,4,2,2",
       "05/01/2021 01:53:55,Class B,219000002,55.8,12.7,,,,,,,,BERTA,Sailing,,,,,,,,AIS,8,4,2,2",
       "05/01/2021 01:51:55,Base Station,2190064,56.716570,11.519,,,,,,,,,,,,,,,,,AIS,,,,",
       "05/01/2021 01:51:55,AtoN,992190001,56.7,11.5,,,,,,,,,,,,,,,,,AIS,,,,",
       "05/01/2021 01:51:55,SAR Airborne,111219501,56.7,11.5,,,,,,,,,,,,,,,,,AIS,,,,",
       "05/01/2021 01:51:55,Class A,219000003,91.000000,0.000000,,,,,,,,,,,,,,,,,AIS,,,,"});
  ASSERT_EQ(ships.size(), 2u);
  EXPECT_EQ(ships[0].identity.name, "ANNA");
  EXPECT_EQ(ships[0].identity.ship_type, 80u);
  EXPECT_EQ(ships[0].identity.length_m, 140.0);
  EXPECT_EQ(ships[0].identity.beam_m, 20.0);
  EXPECT_EQ(ships[0].pieces[0].fixes[0].utc_ms, kLogBegin_s * 1000);
  EXPECT_EQ(ships[0].pieces[0].heading_deg, 2.0);
  EXPECT_EQ(ships[1].identity.class_b, true);
  EXPECT_EQ(ships[1].identity.length_m, 12.0);
  EXPECT_EQ(ships[1].identity.beam_m, 4.0);
  EXPECT_EQ(book.left_out().of(LeftOut::base_station), 1u);
  EXPECT_EQ(book.left_out().of(LeftOut::aid), 1u);
  EXPECT_EQ(book.left_out().of(LeftOut::aircraft), 1u);
  EXPECT_EQ(book.left_out().of(LeftOut::no_position), 1u);
}

// Both headers of MarineCadastre's files.
TEST(CsvLog, ReadsMarineCadastresTables) {
  TrackBook old_book{TrackRules{}};
  const auto old_ships =
      ships_of(old_book, {"MMSI,BaseDateTime,LAT,LON,SOG,COG,Heading,VesselName,IMO,CallSign,"
                          "VesselType,Status,Length,Width,Draft,Cargo,TransceiverClass",
                          "367000001,2021-01-05T01:51:55,47.5,-122.4,9,180,511,ANNA,IMO1,W1,31,0,"
                          "30,9,4,57,B",
                          "367000001,2021-01-05T01:52:55,47.497,-122.4,9,180,511,,,,,,,,,,B"});
  ASSERT_EQ(old_ships.size(), 1u);
  EXPECT_EQ(old_ships[0].identity.ship_type, 31u);
  EXPECT_EQ(old_ships[0].identity.class_b, true);
  EXPECT_EQ(old_ships[0].pieces[0].heading_deg, 180.0) << "511 is none: the course";
  EXPECT_EQ(old_ships[0].pieces[0].fixes[0].longitude_e7, -1'224'000'000);

  TrackBook book{TrackRules{}};
  const auto ships = ships_of(
      book, {"mmsi,base_date_time,longitude,latitude,sog,cog,heading,vessel_name,imo,call_sign,"
             "vessel_type,status,length,width,draft,cargo,transceiver\r",
             "367000001,2021-01-05 01:51:55,-122.4,47.5,9,180,175,\"ANNA, B\",,,70,0,90,14,4,,A\r",
             "367000001,2021-01-05 01:52:55,-122.4,47.497,9,180,175,,,,,,,,,,A\r"});
  ASSERT_EQ(ships.size(), 1u);
  EXPECT_EQ(ships[0].identity.name, "ANNA, B");
  EXPECT_EQ(ships[0].identity.class_b, false);
  EXPECT_EQ(ships[0].pieces[0].fixes[0].latitude_e7, 475'000'000);
}

TEST(CsvLog, ReadsSemicolonsAndDecimalCommas) {
  TrackBook book{TrackRules{}};
  const auto ships =
      ships_of(book, {"\xEF\xBB\xBFMMSI;Time;Lat;Lon", "219000001;1609811515;55,7;12,7",
                      "219000001;1609811525;55,7005;12,7"});
  ASSERT_EQ(ships.size(), 1u);
  EXPECT_EQ(ships[0].pieces[0].fixes[0].latitude_e7, 557'000'000);
}

TEST(CsvLog, BadRowsAreCountedAndTheGoodOnesUsed) {
  TrackBook book{TrackRules{}};
  const auto ships = ships_of(
      book,
      {"mmsi,time,lat,lon", "219000001,1609811515,55.7,12.7", "", "x,1609811525,55.7,12.7",
       "219000001,yesterday,55.7,12.7", "219000001,1609811525,abc,12.7", "219000001",
       "219000001,,55.7,12.7", "1e99,1609811525,55.7,12.7", ",,,", "\"219000001,\"\"",
       std::string("219000001,1609811525,55.7,12.7") + '\0', "219000001,1609811535,55.7005,12.7"});
  ASSERT_EQ(ships.size(), 1u);
  EXPECT_EQ(ships[0].heard, 2u);
  EXPECT_EQ(book.left_out().of(LeftOut::bad_row), 6u);
  EXPECT_EQ(book.left_out().of(LeftOut::no_time), 1u);
  EXPECT_EQ(book.left_out().of(LeftOut::no_position), 1u);
  EXPECT_EQ(book.left_out().of(LeftOut::bad_mmsi), 1u);
}

TEST(CsvLog, SaysWhichColumnIsMissing) {
  TrackBook book{TrackRules{}};
  const auto log = CsvLog::open("mmsi,lat,lon,speed", book);
  ASSERT_FALSE(log.ok());
  EXPECT_NE(log.error().find("no column \"time\""), std::string::npos) << log.error();
  EXPECT_FALSE(CsvLog::is_header("!AIVDM,1,1,,A,15RTgt0PAso;90TKcjM8h6g208CQ,0*4A"));
}

}  // namespace
}  // namespace skerry::server
