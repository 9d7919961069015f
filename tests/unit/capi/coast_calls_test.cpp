#include <cmath>

#include "echo/scene/coast_picture.hpp"
#include "tests/unit/capi/capi_support.hpp"

namespace skerry::capi_test {
namespace {

struct Copied {
  std::vector<skerry_echo_plane_point> plane;
  std::vector<skerry_echo_position> geo;
  std::vector<uint32_t> runs;
  std::vector<uint8_t> types;
  skerry_echo_picture picture{};
};

template <typename T>
using CopyOut = int32_t (*)(skerry_echo_coast*, T*, std::size_t, std::size_t*);

template <typename T>
std::vector<T> copied(skerry_echo_coast* coast, CopyOut<T> copy_out) {
  std::size_t count = 0;
  EXPECT_OK(copy_out(coast, nullptr, 0, &count));
  std::vector<T> out(count);
  EXPECT_OK(copy_out(coast, out.data(), out.size(), &count));
  EXPECT_EQ(count, out.size());
  return out;
}

Copied copied(skerry_echo_coast* coast) {
  Copied out{copied(coast, skerry_echo_coast_plane_vertices),
             copied(coast, skerry_echo_coast_geo_vertices), copied(coast, skerry_echo_coast_runs),
             copied(coast, skerry_echo_coast_edge_types)};
  out.picture.struct_size = sizeof out.picture;
  EXPECT_OK(skerry_echo_coast_picture(coast, &out.picture));
  return out;
}

// Three miles, 256 cells, 2048 spokes.
constexpr double kRange = 3 * 1852.0, kCell = kRange / 256, kSpoke = 360.0 / 2048;
int32_t refine(skerry_echo_coast* coast) {
  return skerry_echo_coast_refine(coast, kAfloat.latitude_deg, kAfloat.longitude_deg, kRange, kCell,
                                  kSpoke);
}

TEST(CCoast, IsTheCoastOfTheCppChainBitForBit) {
  const Rings rings = islands(nautical_miles(4.0), 40, 3);
  const Chart chart = chart_of(rings);
  const Coast coast = coast_of(chart, 77);
  skerry_echo_style style;
  ASSERT_OK(skerry_echo_style_defaults(SKERRY_ECHO_COAST_UNKNOWN, &style, sizeof style));
  style.dimension = 1.1;
  style.amplitude = 0.7;
  ASSERT_OK(skerry_echo_coast_set_style(coast, SKERRY_ECHO_COAST_UNKNOWN, &style));
  ASSERT_OK(skerry_echo_coast_set_guessing(coast, 0));
  style.method = SKERRY_ECHO_METHOD_STRAIGHT;
  style.dimension = 1.0;
  ASSERT_OK(skerry_echo_coast_add_place(coast, 60.27, 5.20, 1500.0, SKERRY_ECHO_COAST_ARTIFICIAL,
                                        nullptr));
  ASSERT_OK(
      skerry_echo_coast_add_place(coast, 60.29, 5.15, 800.0, SKERRY_ECHO_COAST_AS_CHARTED, &style));
  ASSERT_OK(refine(coast));
  const Copied got = copied(coast);

  echo::CoastRules rules{.seed = 77, .guess_types = false};
  rules.styles[0].dimension = 1.1;
  rules.styles[0].amplitude = 0.7;
  echo::CoastStyle straight = rules.styles[0];
  straight.method = echo::CoastMethod::straight;
  straight.dimension = 1.0;
  rules.places = {{{60.27, 5.20}, 1500.0, echo::CoastType::artificial, {}},
                  {{60.29, 5.15}, 800.0, {}, straight}};
  echo::CoastPreparer preparer(coast_chart_of(rings, kAfloat, nautical_miles(12.0).in_metres()),
                               kAfloat, rules);
  const echo::CoastPicturePtr want = preparer.prepare(kAfloat, {kRange, kCell, kSpoke});

  ASSERT_GT(want->vertices.size(), 1000u);
  ASSERT_EQ(got.plane.size(), want->vertices.size());
  ASSERT_EQ(got.geo.size(), want->vertices.size());
  ASSERT_EQ(got.types.size(), want->vertices.size());
  EXPECT_EQ(got.runs, want->run_starts);
  for (std::size_t i = 0; i < got.plane.size(); ++i) {
    ASSERT_EQ(got.plane[i].east_m, want->vertices[i].east_m) << i;
    ASSERT_EQ(got.plane[i].north_m, want->vertices[i].north_m) << i;
    const auto& shore = want->shores[want->shore_of(static_cast<std::uint32_t>(i))];
    ASSERT_EQ(got.types[i], static_cast<int>(shore.type)) << i;
  }
  EXPECT_EQ(got.picture.vertices, want->vertices.size());
  EXPECT_EQ(got.picture.runs + 1, want->run_starts.size());
  EXPECT_EQ(got.picture.centre_ashore, 0);
  EXPECT_EQ(got.picture.complete_m, kRange);
  EXPECT_EQ(got.picture.anchor_latitude_deg, kAfloat.latitude_deg);
  EXPECT_EQ(got.picture.anchor_longitude_deg, kAfloat.longitude_deg);
}

TEST(CCoast, GivesTheSameVerticesInMetresAndDegrees) {
  const Chart chart = chart_of(islands(nautical_miles(4.0), 20, 5));
  const Coast coast = coast_of(chart);
  ASSERT_OK(refine(coast));
  const Copied got = copied(coast);
  const echo::LocalPlane plane({got.picture.anchor_latitude_deg, got.picture.anchor_longitude_deg});
  double worst = 0.0;
  for (std::size_t i = 0; i < got.plane.size(); ++i) {
    const PlanePoint p = plane.to_plane({got.geo[i].latitude_deg, got.geo[i].longitude_deg});
    worst = std::max(worst,
                     std::hypot(p.east_m - got.plane[i].east_m, p.north_m - got.plane[i].north_m));
  }
  EXPECT_LT(worst, 0.02) << "the plane's own error within 24 NM (local_plane.hpp)";
}

TEST(CCoast, IsAnotherOneForAnotherSeedAndTheSameForTheSame) {
  const Chart chart = chart_of(islands(nautical_miles(4.0), 20, 5));
  const auto vertices = [&](std::uint64_t seed) {
    const Coast coast = coast_of(chart, seed);
    EXPECT_OK(refine(coast));
    std::vector<double> out;
    for (const auto p : copied(coast).plane) out.insert(out.end(), {p.east_m, p.north_m});
    return out;
  };
  EXPECT_EQ(vertices(1), vertices(1));
  EXPECT_NE(vertices(1), vertices(2));
}

TEST(CCoast, OutlivesItsChart) {
  Chart chart = chart_of(islands(nautical_miles(4.0), 20, 5));
  const Coast coast = coast_of(chart);
  chart.destroy_now();
  EXPECT_OK(refine(coast));
  EXPECT_GT(copied(coast).plane.size(), 100u);
}

TEST(CCoast, RefusesStylesOutOfRange) {
  const Chart chart = chart_of({});
  const Coast coast = coast_of(chart);
  skerry_echo_style good;
  ASSERT_OK(skerry_echo_style_defaults(SKERRY_ECHO_COAST_ROCKY, &good, sizeof good));
  const auto set = [&](const skerry_echo_style& style) {
    return skerry_echo_coast_set_style(coast, SKERRY_ECHO_COAST_ROCKY, &style);
  };
  const auto with = [&](auto member, auto value) {
    skerry_echo_style style = good;
    style.*member = value;
    return style;
  };
  using Style = skerry_echo_style;
  for (const int32_t bad : {-1, 5, INT32_MAX, INT32_MIN}) {
    EXPECT_REFUSED(set(with(&Style::method, bad)), SKERRY_ECHO_ERROR_ARGUMENT, "allowed: 0 to 4");
  }
  for (const int32_t bad : {-1, 3, INT32_MAX, INT32_MIN}) {
    EXPECT_REFUSED(set(with(&Style::phases, bad)), SKERRY_ECHO_ERROR_ARGUMENT, "allowed: 0 to 2");
  }
  EXPECT_REFUSED(set(with(&Style::reserved, 1u)), SKERRY_ECHO_ERROR_ARGUMENT, "reserved");
  for (const double bad : {0.99, 1.5001, kNaN, kInfinity, -kInfinity}) {
    EXPECT_REFUSED(set(with(&Style::dimension, bad)), SKERRY_ECHO_ERROR_ARGUMENT, "dimension");
  }
  for (const double bad : {-0.01, 4.01, kNaN, kInfinity}) {
    EXPECT_REFUSED(set(with(&Style::amplitude, bad)), SKERRY_ECHO_ERROR_ARGUMENT, "amplitude");
  }
  for (const double bad : {1.0, 8.01, kNaN, kInfinity}) {
    EXPECT_REFUSED(set(with(&Style::gamma, bad)), SKERRY_ECHO_ERROR_ARGUMENT, "gamma");
  }
  for (const uint32_t bad : {0u, 39u, 4097u, UINT32_MAX}) {
    EXPECT_REFUSED(set(with(&Style::struct_size, bad)), SKERRY_ECHO_ERROR_SIZE, "struct_size");
  }
  for (const int32_t bad : {-1, int32_t{SKERRY_ECHO_COAST_SEAM}, INT32_MAX}) {
    EXPECT_REFUSED(skerry_echo_coast_set_style(coast, bad, &good), SKERRY_ECHO_ERROR_ARGUMENT,
                   "type is");
  }
  EXPECT_REFUSED(skerry_echo_coast_set_style(coast, SKERRY_ECHO_COAST_ROCKY, nullptr),
                 SKERRY_ECHO_ERROR_ARGUMENT, "style is NULL");
  for (const int32_t bad : {-1, 2, INT32_MAX}) {
    EXPECT_REFUSED(skerry_echo_coast_set_guessing(coast, bad), SKERRY_ECHO_ERROR_ARGUMENT, "guess");
  }
}

TEST(CCoast, RefusesPlacesThatAreNone) {
  const Chart chart = chart_of({});
  const Coast coast = coast_of(chart);
  const auto add = [&](double latitude, double longitude, double radius, int32_t type) {
    return skerry_echo_coast_add_place(coast, latitude, longitude, radius, type, nullptr);
  };
  EXPECT_REFUSED(add(kNaN, 5.0, 100.0, 1), SKERRY_ECHO_ERROR_ARGUMENT, "latitude_deg");
  EXPECT_REFUSED(add(60.0, 181.0, 100.0, 1), SKERRY_ECHO_ERROR_ARGUMENT, "longitude_deg");
  for (const double bad : {9.9, 200'001.0, 0.0, -100.0, kNaN, kInfinity}) {
    EXPECT_REFUSED(add(60.0, 5.0, bad, 1), SKERRY_ECHO_ERROR_ARGUMENT, "radius_m");
  }
  for (const int32_t bad : {-2, 4, INT32_MIN}) {
    EXPECT_REFUSED(add(60.0, 5.0, 100.0, bad), SKERRY_ECHO_ERROR_ARGUMENT, "type");
  }
  skerry_echo_style style;
  ASSERT_OK(skerry_echo_style_defaults(SKERRY_ECHO_COAST_ROCKY, &style, sizeof style));
  style.dimension = 9.0;
  EXPECT_REFUSED(skerry_echo_coast_add_place(coast, 60.0, 5.0, 100.0, 2, &style),
                 SKERRY_ECHO_ERROR_ARGUMENT, "dimension");
  for (int i = 0; i < 1000; ++i) ASSERT_OK(add(60.0, 5.0, 100.0, 1));
  EXPECT_REFUSED(add(60.0, 5.0, 100.0, 1), SKERRY_ECHO_ERROR_SIZE, "1000 places");
}

TEST(CCoast, RefusesToRefineOutOfRange) {
  const Chart chart = chart_of({});
  const Coast coast = coast_of(chart);
  const auto at = [&](double latitude, double longitude, double range, double cell, double spoke) {
    return skerry_echo_coast_refine(coast, latitude, longitude, range, cell, spoke);
  };
  EXPECT_REFUSED(at(91.0, 5.0, 1000.0, 4.0, 0.1), SKERRY_ECHO_ERROR_ARGUMENT, "latitude_deg");
  EXPECT_REFUSED(at(60.0, kNaN, 1000.0, 4.0, 0.1), SKERRY_ECHO_ERROR_ARGUMENT, "longitude_deg");
  for (const double bad : {199.0, 200'001.0, 0.0, -1000.0, kNaN, kInfinity}) {
    EXPECT_REFUSED(at(60.0, 5.0, bad, 4.0, 0.1), SKERRY_ECHO_ERROR_ARGUMENT, "range_m");
  }
  for (const double bad : {0.24, 62.6, 0.0, -4.0, kNaN, kInfinity}) {
    EXPECT_REFUSED(at(60.0, 5.0, 1000.0, bad, 0.1), SKERRY_ECHO_ERROR_ARGUMENT, "cell_m");
  }
  for (const double bad : {0.04, 5.1, 0.0, -1.0, kNaN, kInfinity}) {
    EXPECT_REFUSED(at(60.0, 5.0, 1000.0, 4.0, bad), SKERRY_ECHO_ERROR_ARGUMENT, "spoke_deg");
  }
  std::size_t count = 7;
  EXPECT_REFUSED(skerry_echo_coast_runs(coast, nullptr, 0, &count), SKERRY_ECHO_ERROR_STATE,
                 "skerry_echo_coast_refine");
  EXPECT_EQ(count, 7u) << "none of them refined anything";
  EXPECT_OK(at(60.0, 5.0, 1000.0, 4.0, 0.1));
  EXPECT_OK(skerry_echo_coast_plane_vertices(coast, nullptr, 0, &count));
  EXPECT_EQ(count, 0u) << "open sea";
}

template <typename T>
void check_copy(skerry_echo_coast* coast, CopyOut<T> copy_out) {
  std::size_t count = 0;
  ASSERT_OK(copy_out(coast, nullptr, 0, &count));
  ASSERT_GT(count, 3u);
  std::vector<unsigned char> room(count * sizeof(T) + 1, 0xA5);
  auto* const out = reinterpret_cast<T*>(room.data());
  std::size_t said = 0;
  EXPECT_REFUSED(copy_out(coast, out, count - 1, &said), SKERRY_ECHO_ERROR_SIZE, "room for");
  EXPECT_EQ(said, count);
  EXPECT_THAT(room, testing::Each(0xA5)) << "a refused call writes nothing";
  EXPECT_REFUSED(copy_out(coast, out, 0, &said), SKERRY_ECHO_ERROR_SIZE, "room for 0");
  EXPECT_REFUSED(copy_out(coast, nullptr, count, &said), SKERRY_ECHO_ERROR_ARGUMENT, "out is NULL");
  EXPECT_REFUSED(copy_out(coast, out, count, nullptr), SKERRY_ECHO_ERROR_ARGUMENT, "count");
  ASSERT_OK(copy_out(coast, out, SIZE_MAX, &said));
  EXPECT_EQ(room.back(), 0xA5) << "no element too many";
  for (skerry_echo_coast* none : no_handles<skerry_echo_coast>()) {
    EXPECT_REFUSED(copy_out(none, out, count, &said), SKERRY_ECHO_ERROR_HANDLE, "coast is");
  }
}

TEST(CCoast, CopiesOutOnlyWhatThereIsRoomFor) {
  const Chart chart = chart_of(islands(nautical_miles(4.0), 20, 5));
  const Coast coast = coast_of(chart);
  ASSERT_OK(refine(coast));
  check_copy<uint32_t>(coast, skerry_echo_coast_runs);
  check_copy<skerry_echo_plane_point>(coast, skerry_echo_coast_plane_vertices);
  check_copy<skerry_echo_position>(coast, skerry_echo_coast_geo_vertices);
  check_copy<uint8_t>(coast, skerry_echo_coast_edge_types);
  skerry_echo_picture picture{};
  for (const uint32_t bad : {0u, 63u, 4097u}) {
    picture.struct_size = bad;
    EXPECT_REFUSED(skerry_echo_coast_picture(coast, &picture), SKERRY_ECHO_ERROR_SIZE, "64");
  }
  EXPECT_REFUSED(skerry_echo_coast_picture(coast, nullptr), SKERRY_ECHO_ERROR_ARGUMENT, "NULL");
}

TEST(CCoast, RefusesWhatIsNoCoast) {
  const Chart chart = chart_of({});
  skerry_echo_style style;
  ASSERT_OK(skerry_echo_style_defaults(SKERRY_ECHO_COAST_ROCKY, &style, sizeof style));
  skerry_echo_picture picture{};
  picture.struct_size = sizeof picture;
  const skerry_echo_radar_options options = small_options();
  skerry_echo_radar* radar = nullptr;
  const auto refused_everywhere = [&](skerry_echo_coast* coast) {
    const int32_t code = SKERRY_ECHO_ERROR_HANDLE;
    EXPECT_REFUSED(skerry_echo_coast_set_style(coast, 2, &style), code, "coast is");
    EXPECT_REFUSED(skerry_echo_coast_set_guessing(coast, 1), code, "coast is");
    EXPECT_REFUSED(skerry_echo_coast_add_place(coast, 0, 0, 100, 1, nullptr), code, "coast is");
    EXPECT_REFUSED(refine(coast), code, "coast is");
    EXPECT_REFUSED(skerry_echo_coast_picture(coast, &picture), code, "coast is");
    EXPECT_REFUSED(skerry_echo_radar_create(coast, &options, &radar), code, "coast is");
  };
  for (skerry_echo_coast* coast : no_handles<skerry_echo_coast>()) {
    refused_everywhere(coast);
    EXPECT_EQ(skerry_echo_coast_destroy(coast), coast ? SKERRY_ECHO_ERROR_HANDLE : SKERRY_ECHO_OK);
  }
  refused_everywhere(reinterpret_cast<skerry_echo_coast*>(static_cast<skerry_echo_chart*>(chart)));
  skerry_echo_coast* gone = nullptr;
  ASSERT_OK(skerry_echo_coast_create(chart, 1, &gone));
  ASSERT_OK(skerry_echo_coast_destroy(gone));
  refused_everywhere(gone);
  EXPECT_EQ(skerry_echo_coast_destroy(gone), SKERRY_ECHO_ERROR_HANDLE);
  EXPECT_EQ(radar, nullptr);
  EXPECT_REFUSED(skerry_echo_coast_create(chart, 1, nullptr), SKERRY_ECHO_ERROR_ARGUMENT,
                 "coast is NULL");
}

}  // namespace
}  // namespace skerry::capi_test
