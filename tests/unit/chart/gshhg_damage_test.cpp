// Charts whose container is sound and whose content is not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netcdf.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <utility>

#include "echo/chart/gshhg_reader.hpp"

namespace skerry::echo {
namespace {

using testing::AllOf;
using testing::HasSubstr;

// A copy of the crude chart that a test may spoil.
class GshhgDamage : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(whole_)) GTEST_SKIP() << "no chart; apt-get install gmt-gshhg-low";
    folder_ = std::filesystem::temp_directory_path() /
              ("skerry-chart-damage-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
    file_ = folder_ / "binned_GSHHS_c.nc";
    std::filesystem::copy_file(whole_, file_, std::filesystem::copy_options::overwrite_existing);
    std::filesystem::permissions(file_, std::filesystem::perms::owner_all);
  }
  void TearDown() override {
    if (!folder_.empty()) std::filesystem::remove_all(folder_);
  }
  void put(const char* variable, std::size_t index, int value) {
    int nc = -1, var = -1;
    ASSERT_EQ(nc_open(file_.c_str(), NC_WRITE, &nc), NC_NOERR);
    ASSERT_EQ(nc_inq_varid(nc, variable, &var), NC_NOERR);
    ASSERT_EQ(nc_put_var1_int(nc, var, &index, &value), NC_NOERR);
    ASSERT_EQ(nc_close(nc), NC_NOERR);
  }
  // Writes the file anew without that variable, or with one of another type or dimension in place.
  struct Other {
    nc_type type;
    const char* dimension;
  };
  void replace(const std::string& name, std::optional<Other> other) {
    const std::filesystem::path anew = folder_ / "anew.nc";
    int from = -1, to = -1, dimensions = 0, variables = 0;
    ASSERT_EQ(nc_open(whole_.c_str(), NC_NOWRITE, &from), NC_NOERR);
    ASSERT_EQ(nc_create(anew.c_str(), NC_NETCDF4 | NC_CLOBBER, &to), NC_NOERR);
    ASSERT_EQ(nc_inq(from, &dimensions, &variables, nullptr, nullptr), NC_NOERR);
    std::array<char, NC_MAX_NAME + 1> text{};
    for (int i = 0, id = -1; i < dimensions; ++i) {
      std::size_t length = 0;
      ASSERT_EQ(nc_inq_dim(from, i, text.data(), &length), NC_NOERR);
      ASSERT_EQ(nc_def_dim(to, text.data(), length, &id), NC_NOERR);
    }
    for (int i = 0; i < variables; ++i) {
      ASSERT_EQ(nc_inq_varname(from, i, text.data()), NC_NOERR);
      if (text.data() != name) {
        ASSERT_EQ(nc_copy_var(from, i, to), NC_NOERR);
      }
    }
    if (other) {
      int dimension = -1, id = -1;
      ASSERT_EQ(nc_inq_dimid(to, other->dimension, &dimension), NC_NOERR);
      ASSERT_EQ(nc_def_var(to, name.c_str(), other->type, 1, &dimension, &id), NC_NOERR);
    }
    ASSERT_EQ(nc_close(from), NC_NOERR);
    ASSERT_EQ(nc_close(to), NC_NOERR);
    std::filesystem::rename(anew, file_);
  }
  // The error of opening the file and loading the whole Earth.
  std::string complaint() const {
    try {
      (void)GshhgReader::open(file_).load({0.0, 0.0}, metres(2.1e7));
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }
  const std::filesystem::path whole_ = "/usr/share/gmt-gshhg/binned_GSHHS_c.nc";
  std::filesystem::path folder_, file_;
};

TEST_F(GshhgDamage, TheUnspoiledCopyIsAccepted) { EXPECT_EQ(complaint(), ""); }

TEST_F(GshhgDamage, AMissingVariableIsNamed) {
  for (const char* name :
       {"Bin_size_in_minutes", "Id_of_first_segment_in_a_bin", "N_segments_in_a_bin",
        "Embedded_node_levels_in_a_bin", "Embedded_npts_levels_exit_entry_for_a_segment",
        "Id_of_first_point_in_a_segment", "Embedded_ANT_flag",
        "Relative_longitude_from_SW_corner_of_bin", "Relative_latitude_from_SW_corner_of_bin"}) {
    replace(name, std::nullopt);
    EXPECT_THAT(complaint(), AllOf(HasSubstr(file_.string()), HasSubstr(name)));
  }
}

TEST_F(GshhgDamage, AVariableOfAnotherTypeIsNamed) {
  replace("N_segments_in_a_bin", Other{NC_DOUBLE, "Dimension_of_bin_arrays"});
  EXPECT_THAT(complaint(), AllOf(HasSubstr("N_segments_in_a_bin"), HasSubstr("type short")));
}

TEST_F(GshhgDamage, AVariableOfAnotherLengthIsNamed) {
  replace("Id_of_first_segment_in_a_bin", Other{NC_INT, "Dimension_of_segment_arrays"});
  EXPECT_THAT(complaint(), AllOf(HasSubstr("Id_of_first_segment_in_a_bin"),
                                 HasSubstr("2258 values instead of 162")));
  replace("Relative_latitude_from_SW_corner_of_bin", Other{NC_SHORT, "Dimension_of_bin_arrays"});
  EXPECT_THAT(complaint(), HasSubstr("Relative_latitude_from_SW_corner_of_bin"));
}

TEST_F(GshhgDamage, ABinSizeThatDoesNotDivideTheEarthIsNamed) {
  for (const int minutes : {0, -60, 7, 29, 1100, 2'000'000'000}) {
    put("Bin_size_in_minutes", 0, minutes);
    EXPECT_THAT(complaint(),
                AllOf(HasSubstr("Bin_size_in_minutes"), HasSubstr(std::to_string(minutes))));
  }
}

TEST_F(GshhgDamage, AnIndexThatPointsElsewhereIsNamed) {
  put("Id_of_first_segment_in_a_bin", 20, 2'000'000'000);
  EXPECT_THAT(complaint(), HasSubstr("Id_of_first_segment_in_a_bin"));
}

TEST_F(GshhgDamage, ANegativeCountIsNamed) {
  put("N_segments_in_a_bin", 20, -5);
  EXPECT_THAT(complaint(), HasSubstr("N_segments_in_a_bin"));
}

TEST_F(GshhgDamage, APointIndexThatPointsElsewhereIsNamed) {
  put("Id_of_first_point_in_a_segment", 7, -1);
  EXPECT_THAT(complaint(), HasSubstr("Id_of_first_point_in_a_segment"));
}

TEST_F(GshhgDamage, SegmentsThatHoldMorePointsThanThereAreAreNamed) {
  put("Embedded_npts_levels_exit_entry_for_a_segment", 2257, 0x7fffffff);
  EXPECT_THAT(complaint(), HasSubstr("Embedded_npts_levels_exit_entry_for_a_segment"));
}

TEST_F(GshhgDamage, APointOutOfPlaceIsNoticedWhenItsBinIsRead) {
  put("Relative_longitude_from_SW_corner_of_bin", 0, 1234);
  put("Relative_latitude_from_SW_corner_of_bin", 0, 1234);
  EXPECT_THAT(complaint(), AllOf(HasSubstr(file_.string()), HasSubstr("bin ")));
}

TEST_F(GshhgDamage, SideCodesAndLevelsOutOfRangeAreNoticed) {
  constexpr const char* kInfo = "Embedded_npts_levels_exit_entry_for_a_segment";
  int nc = -1, var = -1, info = 0;
  const std::size_t first = 0;
  ASSERT_EQ(nc_open(file_.c_str(), NC_NOWRITE, &nc), NC_NOERR);
  ASSERT_EQ(nc_inq_varid(nc, kInfo, &var), NC_NOERR);
  ASSERT_EQ(nc_get_var1_int(nc, var, &first, &info), NC_NOERR);
  nc_close(nc);
  for (const int broken : {info | 7, info | (7 << 3), info | (7 << 6), info & ~(7 << 6)}) {
    put(kInfo, 0, broken);
    EXPECT_THAT(complaint(), HasSubstr("bin ")) << broken;
  }
}

// Any value anywhere: it loads, or throws what the header says, and nothing else happens.
TEST_F(GshhgDamage, ASpoiledValueNeverDoesMoreThanThrow) {
  constexpr std::pair<const char*, unsigned> kVariables[] = {
      {"Bin_size_in_minutes", 1},
      {"Id_of_first_segment_in_a_bin", 162},
      {"N_segments_in_a_bin", 162},
      {"Embedded_node_levels_in_a_bin", 162},
      {"Embedded_npts_levels_exit_entry_for_a_segment", 2258},
      {"Id_of_first_point_in_a_segment", 2258},
      {"Embedded_ANT_flag", 2258},
      {"Relative_longitude_from_SW_corner_of_bin", 14138},
      {"Relative_latitude_from_SW_corner_of_bin", 14138}};
  std::mt19937 random(17);
  int refused = 0;
  constexpr int kRounds = 200;
  for (int round = 0; round < kRounds; ++round) {
    std::filesystem::copy_file(whole_, file_, std::filesystem::copy_options::overwrite_existing);
    const auto& [name, length] = kVariables[random() % std::size(kVariables)];
    const std::size_t index = random() % length;
    const int bits = static_cast<int>(random() >> (random() % 32));
    const bool narrow = std::string_view(name).starts_with("Embedded_ANT");
    const bool wide = length == 1 || std::string_view(name).starts_with("Id_of") ||
                      std::string_view(name).starts_with("Embedded_npts");
    put(name, index, wide ? bits : narrow ? bits & 127 : static_cast<std::int16_t>(bits));
    refused += !complaint().empty();
  }
  std::printf("%d of %d spoiled charts refused\n", refused, kRounds);
  EXPECT_GT(refused, kRounds / 4);
}

TEST_F(GshhgDamage, AWindowOffTheGlobeIsRefused) {
  const GshhgReader reader = GshhgReader::open(file_);
  EXPECT_THROW((void)reader.load({90.1, 0.0}, metres(1.0)), std::invalid_argument);
  EXPECT_THROW((void)reader.load({std::nan(""), 0.0}, metres(1.0)), std::invalid_argument);
  EXPECT_THROW((void)reader.load({0.0, INFINITY}, metres(1.0)), std::invalid_argument);
  EXPECT_THROW((void)reader.load({0.0, 0.0}, metres(-1.0)), std::invalid_argument);
  EXPECT_THROW((void)reader.load({0.0, 0.0}, metres(std::nan(""))), std::invalid_argument);
  EXPECT_EQ(reader.load({0.0, 725.0}, metres(1.0)).centre, (GeoPoint{0.0, 5.0}));
}

}  // namespace
}  // namespace skerry::echo
