#include "tests/scenes/artefact_scenes.hpp"

#include <functional>
#include <stdexcept>
#include <utility>

#include "echo/kernel/exact_math.hpp"
#include "echo/radar/shipped_sets.hpp"
#include "protocol/quantity/speed.hpp"

namespace skerry::scenes {
namespace {

using echo::Scene;
using Change = std::function<void(Scene&)>;

constexpr ScanGeometry kGeometry{1024, 512, 8};

PlanePoint polar(double bearing_deg, double metres) {
  const echo::SinCos at = echo::sin_cos_degrees(bearing_deg);
  return {metres * at.sin, metres * at.cos};
}

// The own ship lies still in open water, heading north.
Scene open_water(RangeScale scale, echo::CoastChart chart) {
  Scene scene = *scene_at(std::move(chart), kBergen, scale, kGeometry);
  scene.own_velocity = {};
  return scene;
}

struct Recipe {
  std::string name, caption;
  double range_nm = 3.0;
  Change fill;     // what there is either way
  Change cause{};  // what makes the artefact; empty: `cure` alone tells them apart
  Change cure{};   // what takes it away again
  echo::ViewControls controls{};
  std::uint32_t scan = 0;
  echo::RadarSet set{};
  std::function<void(echo::CoastChart&, bool with)> land{};
};

ArtefactScene make(Recipe recipe) {
  const RangeScale scale = *RangeScale::find(recipe.range_nm);
  recipe.controls.range_scale = scale;
  const auto scene = [&](bool with) {
    echo::CoastChart chart = made_up_chart(kBergen, scale.length() * 1.3, 0, 1);
    if (recipe.land) recipe.land(chart, with);
    auto made = std::make_shared<Scene>(open_water(scale, std::move(chart)));
    recipe.fill(*made);
    if (with && recipe.cause) recipe.cause(*made);
    if (!with && recipe.cure) recipe.cure(*made);
    return echo::ScenePtr(std::move(made));
  };
  ArtefactScene out;
  out.name = recipe.name;
  out.caption = std::move(recipe.caption);
  out.with = {recipe.name, scene(true), recipe.set, kGeometry, recipe.set.rpm, recipe.controls};
  out.without = scene(false);
  out.scan = recipe.scan;
  return out;
}

echo::Hull ship(PlanePoint at, double heading_deg, double length_m, std::uint64_t identity) {
  echo::Hull hull;
  hull.centre = at;
  hull.heading_deg = heading_deg;
  hull.length_m = length_m;
  hull.beam_m = 0.15 * length_m + 1.5;
  hull.height_m = 3.0 + 0.1 * length_m;
  hull.identity = identity;
  return hull;
}

echo::PointTarget point(PlanePoint at, double height_m, double m2, std::uint64_t identity) {
  echo::PointTarget target;
  target.place = at;
  target.height_m = height_m;
  target.x_band_m2 = target.s_band_m2 = m2;
  target.fluctuation = echo::Fluctuation::steady;
  target.identity = identity;
  return target;
}

void sea(Scene& scene, double state, double from_deg = 315.0) {
  scene.sea.state = state;
  scene.sea.wind_from_deg = from_deg;
}

// An island of these corners (bearing, metres), counter-clockwise.
void add_island(echo::CoastChart& chart, const std::vector<PlanePoint>& corners) {
  echo::CoastRing ring;
  for (const PlanePoint& p : corners) {
    ring.vertices.push_back({kBergen.latitude_deg + p.north_m / 111'412.0,
                             kBergen.longitude_deg + p.east_m / 55'354.0});
    ring.vertex_ids.push_back(chart.rings.size() * 1000 + ring.vertices.size());
  }
  ring.edges.assign(corners.size(), echo::EdgeKind::shoreline);
  chart.rings.push_back(std::move(ring));
}

echo::RadarSet one_pulse() {
  echo::RadarSet set;
  set.pulses = {{0.3e-6, 6e6, 3000.0, 96.0}};
  return set;
}

echo::RadarSet high_antenna() {
  echo::RadarSet set;
  set.antenna_height_m = 30.0;
  return set;
}

echo::RadarSet s_band_set() {
  for (const echo::RadarSet& set : echo::shipped_sets()) {
    if (set.band() == echo::Band::s) return set;
  }
  throw std::out_of_range("no S band set is shipped");
}

void add_artefacts(std::vector<ArtefactScene>& out) {
  using namespace places;
  echo::ViewControls open;
  open.sea = 0.0;  // no sea control: what is weak shows
  out.push_back(
      make({.name = "side lobes",
            .caption = "arcs at the range of a ship abeam",
            .range_nm = 1.5,
            .fill = [](Scene& s) { s.hulls = {ship(polar(90.0, kSideLobeShip), 20.0, 70.0, 3)}; },
            .cure = [](Scene& s) { s.artefacts.side_lobes = false; },
            .controls = open}));
  out.push_back(make({.name = "multiple echoes",
                      .caption = "a ship abeam again at 2, 3, 4 times her range",
                      .range_nm = 3.0,
                      .fill =
                          [](Scene& s) {
                            s.hulls = {ship(polar(90.0, kParallelShip), 0.0, 180.0, 3)};
                            s.own_hull = {200.0, 30.0};
                            s.artefacts.side_lobes = false;
                          },
                      .cure = [](Scene& s) { s.artefacts.multiple_echoes = false; }}));
  out.push_back(make({.name = "indirect echoes",
                      .caption = "ships ahead, and again on mast and funnel aft",
                      .range_nm = 3.0,
                      .fill =
                          [](Scene& s) {
                            s.hulls = {ship(polar(kMastTargetDeg, kMastTarget), 150.0, 200.0, 4),
                                       ship(polar(310.0, 3300.0), 40.0, 250.0, 5)};
                            s.obstructions = {{175.0, 1.0, 9.0, 0.6}, {200.0, 4.0, 22.0, 0.7}};
                            s.artefacts.multiple_echoes = s.artefacts.side_lobes = false;
                          },
                      .cure = [](Scene& s) { s.artefacts.indirect_echoes = false; },
                      .controls = open}));
  out.push_back(make({.name = "shadow and blind sectors",
                      .caption = "mast 170, funnel 200, blanked 300 to 340",
                      .range_nm = 1.5,
                      .fill = [](Scene& s) { sea(s, 5.0); },
                      .cause =
                          [](Scene& s) {
                            s.obstructions = {{170.0, 0.8, 8.0, 0.0}, {200.0, 5.0, 20.0, 0.0}};
                            s.blanked = {{300.0, 340.0}};
                          },
                      .controls = open}));
  out.push_back(make({.name = "second trace",
                      .caption = "a straight coast 29.5 NM off, PRF 3000, a duct",
                      .range_nm = 12.0,
                      .fill =
                          [](Scene& s) {
                            s.atmosphere.ducting = 1.0;
                            for (int i = -40; i <= 40; ++i) {
                              s.points.push_back(point({kFarCoastNm * 1852.0, i * 350.0}, 400.0,
                                                       1e7, static_cast<std::uint64_t>(i + 100)));
                            }
                          },
                      .cure = [](Scene& s) { s.artefacts.second_trace = false; },
                      .controls = open,
                      .set = one_pulse()}));
  const auto interference = [&](std::string name, std::string caption, double prf_hz) {
    return make({.name = std::move(name),
                 .caption = std::move(caption),
                 .range_nm = 12.0,
                 .fill =
                     [prf_hz](Scene& s) {
                       echo::Emitter other;
                       other.place = polar(40.0, 5000.0);
                       other.prf_hz = prf_hz;
                       other.rpm = 23.0;
                       other.identity = 2;  // whose pulses fall within our range scale
                       s.emitters = {other};
                       s.hulls = {ship(polar(40.0, 5000.0), 250.0, 150.0, 4)};
                     },
                 .cure = [](Scene& s) { s.artefacts.interference = false; }});
  };
  out.push_back(interference("interference", "another radar, PRF 0.1 % off ours: spirals", 1001.0));
  out.push_back(interference("interference, same PRF", "another radar of our PRF: rings", 1000.0));
  out.push_back(make({.name = "overhead cable",
                      .caption = "one echo where it runs square to the sight",
                      .range_nm = 1.5,
                      .fill =
                          [](Scene& s) {
                            s.hulls = {ship(polar(300.0, 1800.0), 40.0, 60.0, 5)};
                            s.artefacts.side_lobes = false;
                          },
                      .cause =
                          [](Scene& s) {
                            s.cables = {{{kCableEast, -1900.0}, {kCableEast, 1500.0}, 35.0, 1}};
                          }}));
  out.push_back(
      make({.name = "saturation",
            .caption = "buoys behind a very strong echo are lost",
            .range_nm = 0.75,
            .fill =
                [](Scene& s) {
                  for (const double bearing : {45.0, 135.0}) {
                    for (int i = 1; i <= 8; ++i) {
                      s.points.push_back(point(polar(bearing, kStrongTarget + 45.0 * i), 3.0, 0.2,
                                               static_cast<std::uint64_t>(100 * bearing + i)));
                    }
                  }
                  s.points.push_back(point(polar(kStrongTargetDeg, kStrongTarget), 10.0, 2e6, 1));
                  s.artefacts.side_lobes = s.artefacts.multiple_echoes = false;
                },
            .cure = [](Scene& s) { s.artefacts.saturation = false; },
            .controls = open}));
  out.push_back(make({.name = "minimum range",
                      .caption = "blind to 27 m, then recovering",
                      .range_nm = 0.125,
                      .fill = [](Scene& s) { sea(s, 3.0); },
                      .cure = [](Scene& s) { s.artefacts.minimum_range = false; },
                      .controls = open}));
  out.push_back(make({.name = "roll and pitch",
                      .caption = "15 and 5 deg: near sea lost, buoys sway",
                      .range_nm = 0.75,
                      .fill =
                          [](Scene& s) {
                            sea(s, 2.0);
                            s.artefacts.side_lobes = s.artefacts.multiple_echoes = false;
                            for (int i = 0; i < 12; ++i) {
                              s.points.push_back(point(polar(30.0 * i, kSwayBuoy), 3.0, 3000.0,
                                                       static_cast<std::uint64_t>(i)));
                            }
                            s.motion = {15.0, 8.0, 5.0, 6.0};
                          },
                      .cure = [](Scene& s) { s.artefacts.antenna_motion = false; },
                      .controls = open,
                      .set = high_antenna()}));
}

void add_beacons(std::vector<ArtefactScene>& out) {
  using namespace places;
  const auto sart = [](double nm, double scale, std::string name, std::string caption) {
    return make({.name = std::move(name),
                 .caption = std::move(caption),
                 .range_nm = scale,
                 .fill = [](Scene&) {},
                 .cause =
                     [nm](Scene& s) {
                       echo::Sart rescue;
                       rescue.place = polar(70.0, nm * 1852.0);
                       s.sarts = {rescue};
                     }});
  };
  out.push_back(make(
      {.name = "racon",
       .caption = "K: dash dot dash behind the mark",
       .range_nm = 6.0,
       .fill = [](Scene& s) { s.points = {point(polar(30.0, kRaconNm * 1852.0), 10.0, 100.0, 1)}; },
       .cause =
           [](Scene& s) {
             echo::Racon racon;
             racon.place = polar(30.0, kRaconNm * 1852.0);
             racon.on_s = racon.period_s;
             s.racons = {racon};
           }}));
  out.push_back(sart(kFarSartNm, 12.0, "SART, far", "twelve dots 0.64 NM apart"));
  out.push_back(sart(kNearSartNm, 6.0, "SART, near", "arcs and rings through the side lobes"));
}

void add_clutter(std::vector<ArtefactScene>& out) {
  using namespace places;
  echo::ViewControls open;
  open.sea = 0.0;
  out.push_back(make({.name = "sea clutter",
                      .caption = "sea state 4, wind from the north-west",
                      .range_nm = 3.0,
                      .fill = [](Scene&) {},
                      .cause = [](Scene& s) { sea(s, 4.0); },
                      .controls = open}));
  out.push_back(make({.name = "swell",
                      .caption = "5 m of 12 s from the north-west, sea state 3",
                      .range_nm = 1.5,
                      .fill = [](Scene& s) { sea(s, 3.0); },
                      .cause =
                          [](Scene& s) {
                            s.sea.swell = {5.0, 12.0, 315.0};
                          },
                      .controls = open}));
  const auto rain = [&](std::string name, std::string caption, const echo::RadarSet& set) {
    return make({.name = std::move(name),
                 .caption = std::move(caption),
                 .range_nm = 6.0,
                 .fill =
                     [](Scene& s) {
                       s.hulls = {ship(polar(51.0, 9500.0), 300.0, 100.0, 2)};
                       s.artefacts.side_lobes = false;
                     },
                 .cause =
                     [](Scene& s) {
                       s.rain = {{{kRainEast, kRainNorth}, {}, kRainRadius, 16.0, 1}};
                     },
                 .controls = open,
                 .set = set});
  };
  out.push_back(rain("rain cell", "16 mm/h over 3 km at X band", {}));
  out.push_back(rain("rain cell, S band", "the same by a second set of 30 kW", s_band_set()));
}

void add_bodies(std::vector<ArtefactScene>& out) {
  using namespace places;
  echo::ViewControls open;
  open.sea = 0.0;
  out.push_back(make({.name = "shadow of a ship",
                      .caption = "a ship at 090 hides sea and boats behind her",
                      .range_nm = 1.5,
                      .fill =
                          [](Scene& s) {
                            sea(s, 5.0);
                            for (const double bearing : {82.0, 86.0, 90.0, 94.0, 98.0}) {
                              s.points.push_back(point(polar(bearing, kShadowedBoat), 2.0, 300.0,
                                                       static_cast<std::uint64_t>(bearing)));
                            }
                          },
                      .cause =
                          [](Scene& s) {
                            s.hulls = {ship(polar(90.0, kShadowingShip), 0.0, 150.0, 3)};
                            s.artefacts.multiple_echoes = s.artefacts.side_lobes = false;
                          },
                      .controls = open}));
  out.push_back(make({.name = "ship behind an island",
                      .caption = "one ship in sight, one behind the land at 090",
                      .range_nm = 3.0,
                      .fill =
                          [](Scene& s) {
                            s.hulls = {ship(polar(90.0, kHiddenShip), 10.0, 80.0, 3),
                                       ship(polar(250.0, kHiddenShip), 10.0, 80.0, 4)};
                            s.hulls[0].height_m = s.hulls[1].height_m = 8.0;
                            s.artefacts.side_lobes = s.artefacts.multiple_echoes = false;
                          },
                      .land =
                          [](echo::CoastChart& chart, bool with) {
                            if (!with) return;
                            add_island(chart, {{1500.0, -700.0},
                                               {2400.0, -500.0},
                                               {2500.0, 300.0},
                                               {1900.0, 900.0},
                                               {1300.0, 400.0}});
                          }}));
  out.push_back(make({.name = "wind farm",
                      .caption = "turbines, side lobes and blades",
                      .range_nm = 3.0,
                      .fill = [](Scene&) {},
                      .cause =
                          [](Scene& s) {
                            for (int i = 0; i < 20; ++i) {
                              echo::WindTurbine turbine;
                              turbine.place = {1800.0 + 550.0 * (i % 5), -900.0 + 600.0 * (i / 5)};
                              turbine.identity = static_cast<std::uint64_t>(i);
                              s.turbines.push_back(turbine);
                            }
                          }}));
  out.push_back(make({.name = "wake",
                      .caption = "a ship at 24 kn to the north, and her wake",
                      .range_nm = 0.75,
                      .fill =
                          [](Scene& s) {
                            s.hulls = {ship({500.0, 300.0}, 0.0, 60.0, 3)};
                            s.hulls[0].velocity = {0.0, 24.0 * kKnot};
                            s.artefacts.multiple_echoes = s.artefacts.side_lobes = false;
                          },
                      .cause = [](Scene& s) { s.hulls[0].wake = true; },
                      .controls = open}));
}

}  // namespace

std::vector<ArtefactScene> artefact_scenes() {
  std::vector<ArtefactScene> out;
  add_artefacts(out);
  add_beacons(out);
  add_clutter(out);
  add_bodies(out);
  return out;
}

ArtefactScene artefact_scene(const std::string& name) {
  for (ArtefactScene& scene : artefact_scenes()) {
    if (scene.name == name) return std::move(scene);
  }
  throw std::out_of_range("no artefact scene \"" + name + "\"");
}

}  // namespace skerry::scenes
