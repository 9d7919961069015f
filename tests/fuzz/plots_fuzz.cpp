// Plots out of any series of spokes: all numbers are sound, the same spokes give the same plots,
// and nothing is told of what is none.
//
// A spoke is 16 bytes, then cells: which geometry, flags, two of the index, four of the turn, two
// of the heading, two of the reach, two of own ship's way, how often the cells that follow are
// repeated, and how many follow.
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "server/plotter/plots/plot_extractor.hpp"
#include "tests/fuzz/fuzz_require.hpp"

namespace {

using namespace skerry;
using server::Plot;
using server::PlotExtractor;

constexpr std::size_t kHead = 16, kMostSpokes = 40;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

double reach_of(std::uint16_t value) {
  if (value == 0xffff) return kNan;
  if (value == 0xfffe) return HUGE_VAL;
  if (value >= 0xff00) return 1e300;
  return value - 8.0;  // also less than nothing
}

std::vector<Spoke> spokes_of(std::span<const std::uint8_t> input) {
  std::vector<Spoke> spokes;
  while (input.size() >= kHead && spokes.size() < kMostSpokes) {
    const std::uint8_t* head = input.data();
    const auto word = [&](std::size_t at) {
      return static_cast<std::uint16_t>(head[at] | head[at + 1] << 8);
    };
    constexpr ScanGeometry kGeometries[] = {{2048, 1024, 8}, {2048, 1024, 4}, {128, 128, 8},
                                            {250, 252, 8},   {360, 512, 4},   {8192, 4096, 8},
                                            {1440, 705, 8},  {0, 0, 0}};
    Spoke spoke;
    SpokeHeader& header = spoke.header;
    header.geometry = kGeometries[head[0] % 8];
    header.index = word(2);
    header.scan = word(4) | static_cast<std::uint32_t>(word(6)) << 16;
    header.heading = TrueBearing::from_units(static_cast<std::uint32_t>(word(8)) << 16);
    header.instrumented_range = metres(reach_of(word(10)));
    header.own_ship = {static_cast<std::int8_t>(head[12]) * 0.0001,
                       (head[1] & 1) != 0 ? kNan : static_cast<std::int8_t>(head[13]) * 1.5};
    const std::size_t count = std::min<std::size_t>(head[15], input.size() - kHead);
    for (std::size_t i = 0; i < std::size_t{head[14]} + 1; ++i)
      spoke.cells.insert(spoke.cells.end(), head + kHead, head + kHead + count);
    // Mostly of the right length.
    if ((head[1] & 2) == 0) spoke.cells.resize(header.geometry.cells);
    spokes.push_back(std::move(spoke));
    input = input.subspan(kHead + count);
  }
  return spokes;
}

std::vector<Plot> plots_of(const std::vector<Spoke>& spokes, const PlotExtractor::Rule& rule) {
  PlotExtractor extractor(rule);
  std::vector<Plot> plots;
  for (const Spoke& spoke : spokes) extractor.add(spoke, plots);
  extractor.flush(plots);
  fuzz::require(extractor.counts().plots == plots.size(), "plots are counted");
  fuzz::require(extractor.counts().spokes_left_out <= spokes.size(), "spokes are left out once");
  fuzz::require(extractor.counts().rows <= spokes.size(), "no more rows than spokes");
  return plots;
}

void require_sound(const Plot& plot) {
  fuzz::require(plot.range_m > 0.0 && plot.range_m <= 1e6, "a range that a radar has");
  fuzz::require(plot.bearing_sigma_rad > 0.0 && plot.bearing_sigma_rad < 10.0, "a bearing's error");
  fuzz::require(plot.range_sigma_m > 0.0 && plot.range_sigma_m < 1e6, "a range's error");
  fuzz::require(plot.length_m >= 0.0 && plot.length_m <= 1e6, "a length");
  fuzz::require(plot.width_m >= 0.0 && plot.width_m <= 1e8, "a width");
  fuzz::require(plot.on_land >= 0.0 && plot.on_land <= 1.0, "a share of land");
  fuzz::require(plot.clutter >= 0.0 && plot.clutter <= 1.0, "a share of clutter");
  fuzz::require(plot.greatest > 0 && plot.cells > 0, "an echo");
}

bool same(const Plot& a, const Plot& b) {
  return a.bearing == b.bearing && a.range_m == b.range_m && a.on_land == b.on_land &&
         a.clutter == b.clutter && a.length_m == b.length_m && a.width_m == b.width_m &&
         a.bearing_sigma_rad == b.bearing_sigma_rad && a.range_sigma_m == b.range_sigma_m &&
         a.greatest == b.greatest && a.cells == b.cells && a.extended == b.extended;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::vector<Spoke> spokes = spokes_of({data, size});
  PlotExtractor::Rule rule;
  if (size > 0) rule.threshold.statistic = static_cast<server::Statistic>(data[0] >> 6);
  const std::vector<Plot> plots = plots_of(spokes, rule);
  for (const Plot& plot : plots) require_sound(plot);
  const std::vector<Plot> again = plots_of(spokes, rule);
  fuzz::require(plots.size() == again.size(), "as many plots again");
  for (std::size_t i = 0; i < plots.size(); ++i)
    fuzz::require(same(plots[i], again[i]), "the same plots again");
  return 0;
}
