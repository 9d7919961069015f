#include "server/recorder/file_names.hpp"

#include <gtest/gtest.h>

namespace skerry::server {
namespace {

TEST(FileNames, LettersDigitsAndWhatStandsBetweenThem) {
  for (const char* good :
       {"a", "7", "watch 3", "2026-11-22 103000Z", "a.b_c-d", "Übung 1", "Учение", "訓練3"}) {
    EXPECT_EQ(fault_in_file_name(good), std::nullopt) << good;
  }
  EXPECT_EQ(fault_in_file_name(""), std::nullopt) << "date and time are taken";
  EXPECT_EQ(fault_in_file_name(std::string(100, 'a')), std::nullopt);
}

TEST(FileNames, NothingLeavesTheFolderHidesOrLooksLikeAnother) {
  for (const char* bad : {".",
                          "..",
                          ".hidden",
                          "../a",
                          "a/b",
                          "/a",
                          "a/",
                          "a ",
                          " a",
                          "a.",
                          "-a",
                          "a-",
                          "a\\b",
                          "a:b",
                          "a\nb",
                          "a\x01",
                          "a\x7f",
                          "a*",
                          "a~b",
                          "a\xc3",
                          "\xff",
                          "a\xc0\xaf"
                          "b",
                          "a\xe2\x80\xae"
                          "b",
                          "a\xe2\x80\x8b"
                          "b",
                          "\xef\xbb\xbf"
                          "a",
                          "a\xed\xa0\x80"
                          "b",
                          "\xc2\xa0"}) {
    EXPECT_NE(fault_in_file_name(bad), std::nullopt) << bad;
  }
  EXPECT_NE(fault_in_file_name(std::string(101, 'a')), std::nullopt);
  EXPECT_NE(fault_in_file_name(std::string_view("a\0b", 3)), std::nullopt);
}

TEST(FileNames, AMarkIsAnyText) {
  for (const char* good : {"", "collision!", "14:05 / VHF 16", "…"}) {
    EXPECT_EQ(fault_in_mark_name(good), std::nullopt) << good;
  }
  for (const char* bad : {"a\nb", "\x1b[31m", "a\xc2\x85", "\xff"}) {
    EXPECT_NE(fault_in_mark_name(bad), std::nullopt) << bad;
  }
}

TEST(FileNames, OfTimeAndSeries) {
  EXPECT_EQ(name_of_time(UtcTime(std::chrono::seconds(1'795'343'400))), "2026-11-22 103000Z");
  EXPECT_EQ(file_name("a", 1), "a.mcap");
  EXPECT_EQ(file_name("a", 2), "a-002.mcap");
  EXPECT_EQ(file_name("a", 12345), "a-12345.mcap");
  EXPECT_EQ(fault_in_file_name(name_of_time({})), std::nullopt);
}

}  // namespace
}  // namespace skerry::server
