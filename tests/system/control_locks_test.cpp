// Who may change what on a running server, and what the log says of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/system/receive.hpp"
#include "tests/system/small_scenario.hpp"

namespace skerry::system_test {
namespace {

using testing::AnyOf;
using testing::ElementsAre;
using testing::HasSubstr;

class ControlLocks : public testing::Test {
 protected:
  void set(const std::vector<std::string>& arguments) const {
    const Ending ending = server_.skerry("set", arguments);
    EXPECT_EQ(ending.code, 0) << ending.err;
  }
  TempFolder folder_;
  RunningServer server_{{"--scenario", folder_.write("small.yaml", small_scenario())}};
};

TEST_F(ControlLocks, AreToldToConsolesHoldOthersBackAndLetTheInstructorThrough) {
  client::SpokeClient console = subscribed(server_, 0);
  set({"--lock", "gain", "range_nm"});
  const auto locked =
      await<wire::Settings>(console, [](const wire::Settings& s) { return s.locked_size() == 2; });
  EXPECT_THAT(locked.locked(), ElementsAre("gain", "range_nm"));

  wire::Set request;
  request.set_gain(80.0);
  request.set_sea(66.0);
  const auto refused = console.set(request, kAnswerTime);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().text, HasSubstr("gain: locked by the instructor; it stays 50"));
  const Ending ending = server_.skerry("set", {"--range", "12"});
  EXPECT_EQ(ending.code, 1);
  EXPECT_THAT(ending.err, HasSubstr("range_nm: locked by the instructor; it stays 6"));

  set({"--instructor", "--gain", "75"});
  const auto after =
      await<wire::Settings>(console, [](const wire::Settings& s) { return s.gain() == 75.0; });
  EXPECT_EQ(after.sea(), 20.0) << "of the Set that was refused";
  EXPECT_THAT(server_.skerry("status").out, HasSubstr("locked: gain range_nm"));

  set({"--unlock", "gain", "range_nm"});
  set({"--gain", "40"});
  const auto free =
      await<wire::Settings>(console, [](const wire::Settings& s) { return s.gain() == 40.0; });
  EXPECT_EQ(free.locked_size(), 0);
}

TEST_F(ControlLocks, TheControlsThatDisplaysHaveAreSetAndShown) {
  client::SpokeClient console = subscribed(server_, 0);
  set({"--mode", "offshore", "--doppler", "approaching", "--doppler-threshold", "1.5",
       "--noise-rejection", "30", "--target-boost", "20", "--gain-auto", "on",
       "--instrumented-range", "15000", "--bearing-alignment", "-7.5", "--blank", "350-10",
       "120-150.5"});
  const auto seen = await<wire::Settings>(
      console, [](const wire::Settings& s) { return s.mode() == wire::OFFSHORE; });
  EXPECT_EQ(seen.doppler(), wire::DOPPLER_APPROACHING);
  EXPECT_EQ(seen.noise_rejection(), 30.0);
  EXPECT_TRUE(seen.gain_auto());
  EXPECT_EQ(seen.instrumented_range_m(), 15'000.0);
  ASSERT_EQ(seen.blanked_sectors().sectors_size(), 2);
  EXPECT_EQ(seen.blanked_sectors().sectors(1).to_deg(), 150.5);
  const std::string table = server_.skerry("status").out;
  for (const char* part :
       {"mode offshore", "gain auto", "noise rejection 30", "target boost 20",
        "doppler approaching", "doppler threshold 1.5 m/s", "instrumented range 15000 m",
        "bearing alignment -7.5 deg", "blanked 350-10", "blanked 120-150.5"}) {
    EXPECT_THAT(table, HasSubstr(part));
  }
  await<Spoke>(console, [](const Spoke& spoke) {
    return std::abs(spoke.header.reach().in_metres() - 15'000.0) < 1e-6 && !spoke.doppler.empty();
  });
  set({"--blank", "none"});
  await<wire::Settings>(
      console, [](const wire::Settings& s) { return s.blanked_sectors().sectors_size() == 0; });
  EXPECT_EQ(server_.skerry("set", {"--blank", "ten-20"}).code, 2);
}

TEST_F(ControlLocks, TheLogHasALineForAChangeAndNotAThousandForAThousand) {
  client::SpokeClient console = subscribed(server_, 2);
  set({"--radar", "2", "--rain", "33"});
  for (int i = 1; i <= 1000; ++i) {
    wire::Set request;
    request.set_radar(2);
    request.set_gain(i / 10.0);
    ASSERT_TRUE(console.set(request, kAnswerTime));
  }
  const Ending ending = server_.stop();
  EXPECT_EQ(ending.code, 0);
  EXPECT_THAT(ending.err, HasSubstr("radar 2 view 0: rain 0 -> 33"));
  EXPECT_THAT(ending.err, HasSubstr("console 127.0.0.1:"));
  EXPECT_THAT(ending.err, HasSubstr("radar 2 view 0: gain 50 -> 0.1"));
  // The last may have come alone, after a line about all before it.
  EXPECT_THAT(ending.err, AnyOf(HasSubstr("-> 100 ("), HasSubstr("99.9 -> 100")));
  std::size_t lines = 0;
  for (std::size_t at = 0; (at = ending.err.find(": gain ", at)) != std::string::npos; ++at) {
    ++lines;
  }
  EXPECT_LE(lines, 120u) << "one a second, and the thousand take no two minutes";
}

}  // namespace
}  // namespace skerry::system_test
