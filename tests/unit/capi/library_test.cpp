// The library itself: version, texts, and structures that grow.
#include <array>
#include <cstring>
#include <limits>
#include <thread>

#include "tests/unit/capi/capi_support.hpp"

namespace skerry::capi_test {
namespace {

TEST(CInterface, IsTheVersionOfItsHeader) {
  EXPECT_EQ(skerry_echo_version(),
            static_cast<std::uint32_t>(SKERRY_ECHO_VERSION_MAJOR << 16 |
                                       SKERRY_ECHO_VERSION_MINOR << 8 | SKERRY_ECHO_VERSION_PATCH));
  const std::string begin = std::to_string(SKERRY_ECHO_VERSION_MAJOR) + "." +
                            std::to_string(SKERRY_ECHO_VERSION_MINOR) + "." +
                            std::to_string(SKERRY_ECHO_VERSION_PATCH) + " (skerry ";
  EXPECT_THAT(skerry_echo_version_text(), testing::StartsWith(begin));
}

TEST(CInterface, NamesEveryResultAndNoOther) {
  EXPECT_STREQ(skerry_echo_result_name(SKERRY_ECHO_OK), "OK");
  EXPECT_STREQ(skerry_echo_result_name(SKERRY_ECHO_ERROR_ARGUMENT), "ARGUMENT");
  EXPECT_STREQ(skerry_echo_result_name(SKERRY_ECHO_ERROR_HANDLE), "HANDLE");
  EXPECT_STREQ(skerry_echo_result_name(SKERRY_ECHO_ERROR_BUSY), "BUSY");
  EXPECT_STREQ(skerry_echo_result_name(SKERRY_ECHO_ERROR_SIZE), "SIZE");
  EXPECT_STREQ(skerry_echo_result_name(SKERRY_ECHO_ERROR_STATE), "STATE");
  EXPECT_STREQ(skerry_echo_result_name(SKERRY_ECHO_ERROR_CHART), "CHART");
  EXPECT_STREQ(skerry_echo_result_name(SKERRY_ECHO_ERROR_MEMORY), "MEMORY");
  EXPECT_STREQ(skerry_echo_result_name(SKERRY_ECHO_ERROR_INTERNAL), "INTERNAL");
  for (const std::int32_t code : {9, -1, INT32_MAX, INT32_MIN}) {
    EXPECT_STREQ(skerry_echo_result_name(code), "UNKNOWN");
  }
}

TEST(CInterface, KeepsTheTextOfTheLastFailurePerThread) {
  ASSERT_EQ(skerry_echo_style_defaults(7, nullptr, 0), SKERRY_ECHO_ERROR_ARGUMENT);
  const std::string mine = skerry_echo_last_error();
  EXPECT_EQ(mine, "type is 7; allowed: 0 to 3");
  std::string at_first, theirs;
  std::thread([&] {
    at_first = skerry_echo_last_error();
    skerry_echo_style_defaults(0, nullptr, 0);
    theirs = skerry_echo_last_error();
  }).join();
  EXPECT_EQ(at_first, "");
  EXPECT_EQ(theirs, "style is NULL");
  EXPECT_EQ(skerry_echo_last_error(), mine);
  skerry_echo_style style;
  ASSERT_OK(skerry_echo_style_defaults(0, &style, sizeof style));
  EXPECT_EQ(skerry_echo_last_error(), mine) << "a call that succeeds leaves the text";
}

TEST(CInterface, CutsALongTextAtAWholeCharacter) {
  std::string path(1000, 'x');
  for (std::size_t i = 0; i < path.size(); i += 2) path.replace(i, 2, "\xC3\xA5");
  for (const std::string& name : {path, "/" + path}) {
    Chart chart;
    EXPECT_EQ(open_chart(name, chart), SKERRY_ECHO_ERROR_CHART);
    const std::string text = skerry_echo_last_error();
    EXPECT_LE(text.size(), 511u);
    EXPECT_GE(text.size(), 500u);
    EXPECT_EQ(std::count(text.begin(), text.end(), '\xC3'),
              std::count(text.begin(), text.end(), '\xA5'));
  }
}

template <typename T>
using Defaults = int32_t (*)(T*, std::size_t);
int32_t rocky_style(skerry_echo_style* style, std::size_t size) {
  return skerry_echo_style_defaults(SKERRY_ECHO_COAST_ROCKY, style, size);
}

// Defaults that are asked for by an older, this and a newer program.
template <typename T>
void check_defaults(Defaults<T> defaults) {
  EXPECT_REFUSED(defaults(nullptr, sizeof(T)), SKERRY_ECHO_ERROR_ARGUMENT, "NULL");
  T value;
  for (const std::size_t size : {std::size_t{0}, std::size_t{4}, sizeof(T) - 1, std::size_t{4097},
                                 std::numeric_limits<std::size_t>::max()}) {
    std::memset(&value, 0xA5, sizeof value);
    EXPECT_REFUSED(defaults(&value, size), SKERRY_ECHO_ERROR_SIZE, std::to_string(sizeof(T)));
    EXPECT_EQ(value.struct_size, 0xA5A5A5A5u) << "a refused call writes nothing";
  }
  EXPECT_OK(defaults(&value, sizeof value));
  EXPECT_EQ(value.struct_size, sizeof(T));
  struct {
    T known;
    std::array<unsigned char, 24> unknown;
    std::uint64_t beyond;
  } newer;
  std::memset(&newer, 0xA5, sizeof newer);
  EXPECT_OK(defaults(&newer.known, sizeof(T) + sizeof newer.unknown));
  EXPECT_EQ(newer.known.struct_size, sizeof(T) + sizeof newer.unknown);
  EXPECT_THAT(newer.unknown, testing::Each(0));
  EXPECT_EQ(newer.beyond, 0xA5A5A5A5A5A5A5A5u);
}

TEST(CInterface, FillsStructuresOfEverySizeThatItCanKnow) {
  check_defaults<skerry_echo_style>(rocky_style);
  check_defaults<skerry_echo_radar_options>(skerry_echo_radar_defaults);
  check_defaults<skerry_echo_own_ship>(skerry_echo_own_ship_defaults);
  check_defaults<skerry_echo_target>(skerry_echo_target_defaults);
}

TEST(CInterface, TakesANewerProgramsStructureOnlyWhereItAsksForNothingNew) {
  const Chart chart = chart_of({});
  const Coast coast = coast_of(chart);
  struct {
    skerry_echo_style known;
    std::uint64_t unknown;
  } newer;
  ASSERT_OK(rocky_style(&newer.known, sizeof newer));
  EXPECT_OK(skerry_echo_coast_set_style(coast, SKERRY_ECHO_COAST_ROCKY, &newer.known));
  newer.unknown = std::uint64_t{1} << 63;
  EXPECT_REFUSED(skerry_echo_coast_set_style(coast, SKERRY_ECHO_COAST_ROCKY, &newer.known),
                 SKERRY_ECHO_ERROR_SIZE, "byte 47 of 48");
}

}  // namespace
}  // namespace skerry::capi_test
