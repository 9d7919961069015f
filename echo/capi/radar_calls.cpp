// The calls of skerry_echo.h on radars.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "echo/capi/held.hpp"
#include "echo/capi/radar.hpp"
#include "echo/radar/set_checks.hpp"

namespace {

using namespace skerry::echo::capi;
using skerry::RangeScale;
using skerry::ScanGeometry;
using skerry::echo::ShipMotion;

// Layouts of version 1.0, which never change.
static_assert(sizeof(skerry_echo_radar_options) == 88);
static_assert(sizeof(skerry_echo_own_ship) == 56 && sizeof(skerry_echo_target) == 88);
static_assert(sizeof(skerry_echo_radar_state) == 40);

constexpr std::size_t kMostTargets = 10'000;
constexpr std::int64_t kMostTime = 1'000'000'000'000'000'000;  // ns

skerry_echo_radar_options default_options() {
  const RadarMount mount;
  return {sizeof(skerry_echo_radar_options),
          mount.number,
          mount.geometry.spokes_per_turn,
          mount.geometry.cells,
          mount.geometry.bits,
          0,
          mount.set.rpm,
          mount.set.frequency_hz,
          mount.set.peak_power_w,
          mount.set.antenna_gain_db,
          mount.set.beam_width_deg,
          mount.set.antenna_height_m,
          mount.set.noise_figure_db,
          mount.set.losses_db};
}

// Spokes of a turn and cells of a spoke, at least.
constexpr std::uint32_t kFewest = 256;

RadarMount mount_of(const skerry_echo_radar_options* given) {
  const auto o = from_caller("options", given, default_options());
  require_range("options.spokes_per_turn", std::uint64_t{o.spokes_per_turn}, kFewest,
                ScanGeometry::kMaxSpokes);
  require_range("options.cells", std::uint64_t{o.cells}, kFewest, ScanGeometry::kMaxCells);
  if (o.bits != 4 && o.bits != 8) {
    throw CallError(SKERRY_ECHO_ERROR_ARGUMENT,
                    fmt::format("options.bits is {}; allowed: 4 or 8", o.bits));
  }
  require_choice("options.reserved", o.reserved, 0, 0);
  skerry::echo::RadarSet set;
  set.rpm = o.rpm;
  set.frequency_hz = o.frequency_hz;
  set.peak_power_w = o.peak_power_w;
  set.antenna_gain_db = o.antenna_gain_db;
  set.beam_width_deg = o.beam_width_deg;
  set.antenna_height_m = o.antenna_height_m;
  set.noise_figure_db = o.noise_figure_db;
  set.losses_db = o.losses_db;
  for (const skerry::echo::SetLimit& limit : skerry::echo::kSetLimits) {
    const std::string name = fmt::format("options.{}", limit.name);
    require_range(name.c_str(), set.*limit.member, limit.min, limit.max);
  }
  return {std::move(set), {o.spokes_per_turn, o.cells, o.bits}, o.number};
}

// Both kinds of ship have these fields.
template <typename Ship>
ShipMotion motion_of(const Ship& ship) {
  require_choice("reserved", ship.reserved, 0, 0);
  const skerry::GeoPoint position = place_of(ship.latitude_deg, ship.longitude_deg);
  require_range("course_deg", ship.course_deg, -360.0, 360.0);
  require_range("speed_mps", ship.speed_mps, -50.0, 50.0);
  require_range("heading_deg", ship.heading_deg, -360.0, 360.0);
  require_range("turn_rate_deg_s", ship.turn_rate_deg_s, -30.0, 30.0);
  return {position, ship.course_deg, ship.speed_mps, ship.heading_deg, ship.turn_rate_deg_s};
}

skerry_echo_own_ship default_own_ship() {
  skerry_echo_own_ship ship{};
  ship.struct_size = sizeof ship;
  return ship;
}

skerry_echo_target default_target() {
  const TargetShip typical;
  skerry_echo_target target{};
  target.struct_size = sizeof target;
  target.length_m = typical.length_m;
  target.beam_m = typical.beam_m;
  target.height_m = typical.height_m;
  return target;
}

TargetShip target_of(const std::byte* given) {
  auto t = default_target();
  read_struct("target", given, sizeof t, std::as_writable_bytes(std::span(&t, 1)));
  require_range("length_m", t.length_m, 0.3, 500.0);
  require_range("beam_m", t.beam_m, 0.1, 100.0);
  require_range("height_m", t.height_m, 0.1, 100.0);
  return {motion_of(t), t.length_m, t.beam_m, t.height_m, t.identity};
}

std::vector<TargetShip> targets_of(const skerry_echo_target* targets, std::size_t count) {
  require_range("count", std::uint64_t{count}, 0, kMostTargets);
  std::vector<TargetShip> out;
  if (count == 0) return out;
  require_pointer("targets", targets);
  const auto* bytes = reinterpret_cast<const std::byte*>(targets);
  std::uint32_t distance = 0;
  std::memcpy(&distance, bytes, sizeof distance);
  out.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    of_part([&] { return fmt::format("targets[{}]", i); },
            [&] {
              // The first one's size is checked before the second is looked for by it.
              std::uint32_t size = 0;
              std::memcpy(&size, bytes + i * distance, sizeof size);
              if (size != distance) {
                throw CallError(SKERRY_ECHO_ERROR_SIZE,
                                fmt::format("struct_size is {}, of targets[0] {}; expected the "
                                            "same",
                                            size, distance));
              }
              out.push_back(target_of(bytes + i * distance));
            });
  }
  return out;
}

RangeScale scale_of(double range_nm) {
  if (const auto scale = RangeScale::find(range_nm)) return *scale;
  throw CallError(SKERRY_ECHO_ERROR_ARGUMENT,
                  fmt::format("range_nm is {}; allowed: {}", range_nm,
                              fmt::join(RangeScale::kNauticalMiles, " ")));
}

// The spokes whose times the interface can say.
void require_in_time(const Radar& radar, std::uint64_t spoke) {
  const double turns = 1e9 / 60.0 *
                       std::min(240.0, 60.0 / (radar.clock().seconds_per_spoke() *
                                               radar.geometry().spokes_per_turn));
  require_range("spoke", spoke, 0,
                static_cast<std::uint64_t>(turns * radar.geometry().spokes_per_turn));
}

// The bytes a render writes over, the stride between included.
void require_video(std::uint32_t count, std::uint32_t cells, std::size_t size, std::size_t stride) {
  if (stride < cells) {
    throw CallError(SKERRY_ECHO_ERROR_SIZE,
                    fmt::format("stride is {}; expected {} cells or more", stride, cells));
  }
  // Without overflow: (count - 1) * stride + cells <= size.
  if (size < cells || (count > 1 && stride > (size - cells) / (count - 1))) {
    throw CallError(
        SKERRY_ECHO_ERROR_SIZE,
        fmt::format("video has {} bytes; {} spokes of {} cells, {} bytes apart, take "
                    "{}",
                    size, count, cells, stride,
                    static_cast<double>(count - 1) * static_cast<double>(stride) + cells));
  }
}

}  // namespace

extern "C" {

int32_t skerry_echo_radar_defaults(skerry_echo_radar_options* options, size_t size) {
  return guarded([&] { to_caller("options", options, size, default_options()); });
}

int32_t skerry_echo_own_ship_defaults(skerry_echo_own_ship* ship, size_t size) {
  return guarded([&] { to_caller("ship", ship, size, default_own_ship()); });
}

int32_t skerry_echo_target_defaults(skerry_echo_target* target, size_t size) {
  return guarded([&] { to_caller("target", target, size, default_target()); });
}

int32_t skerry_echo_radar_create(skerry_echo_coast* coast, const skerry_echo_radar_options* options,
                                 skerry_echo_radar** radar) {
  return guarded([&] {
    const Held<Coast> held("coast", coast);
    const RadarMount mount = mount_of(options);
    require_pointer("radar", radar);
    give(std::make_shared<Radar>(held->chart(), held->rules(), mount), radar);
  });
}

int32_t skerry_echo_radar_set_controls(skerry_echo_radar* radar, double range_nm, double gain,
                                       double sea, double rain) {
  return guarded([&] {
    const Held<Radar> held("radar", radar);
    const RangeScale scale = scale_of(range_nm);
    require_range("gain", gain, 0.0, 100.0);
    require_range("sea", sea, 0.0, 100.0);
    require_range("rain", rain, 0.0, 100.0);
    held->set_controls({scale, gain, sea, rain});
  });
}

int32_t skerry_echo_radar_set_sea(skerry_echo_radar* radar, double water_level_m,
                                  double wave_height_m) {
  return guarded([&] {
    const Held<Radar> held("radar", radar);
    require_range("water_level_m", water_level_m, -17.0, 15.0);
    require_range("wave_height_m", wave_height_m, 0.0, 15.0);
    held->set_sea({water_level_m, wave_height_m});
  });
}

int32_t skerry_echo_radar_set_scene(skerry_echo_radar* radar, int64_t time_ns,
                                    const skerry_echo_own_ship* own_ship,
                                    const skerry_echo_target* targets, size_t count) {
  return guarded([&] {
    const Held<Radar> held("radar", radar);
    require_choice("time_ns", time_ns, -kMostTime, kMostTime);
    const auto own = from_caller("own_ship", own_ship, default_own_ship());
    const ShipMotion motion =
        of_part([] { return std::string("own_ship"); }, [&] { return motion_of(own); });
    held->set_positions(
        {skerry::ScenarioTime(skerry::Duration(time_ns)), motion, targets_of(targets, count)});
  });
}

int32_t skerry_echo_radar_spoke_time(skerry_echo_radar* radar, uint64_t spoke, int64_t* time_ns) {
  return guarded([&] {
    const Held<Radar> held("radar", radar);
    require_in_time(*held, spoke);
    require_pointer("time_ns", time_ns);
    *time_ns = held->clock().time_of(spoke).time_since_epoch().count();
  });
}

int32_t skerry_echo_radar_render(skerry_echo_radar* radar, uint64_t first, uint32_t count,
                                 uint8_t* video, size_t size, size_t stride) {
  return guarded([&] {
    const Held<Radar> held("radar", radar);
    require_range("count", std::uint64_t{count}, 1, held->geometry().spokes_per_turn);
    require_in_time(*held, first);
    require_in_time(*held, first + (count - 1));
    require_pointer("video", video);
    require_video(count, held->geometry().cells, size, stride);
    held->render(first, count, video, stride);
  });
}

int32_t skerry_echo_radar_get_state(skerry_echo_radar* radar, skerry_echo_radar_state* state) {
  return guarded([&] {
    const Held<Radar> held("radar", radar);
    if (!held->scene()) {
      throw CallError(SKERRY_ECHO_ERROR_STATE,
                      "no scene is set: call skerry_echo_radar_set_scene first");
    }
    const double cell = held->geometry().cell_size(held->controls().range_scale).in_metres();
    to_caller(
        "state", state,
        skerry_echo_radar_state{sizeof(skerry_echo_radar_state), held->scene()->ashore ? 1 : 0,
                                held->scene()->coast->edge_count(), held->coasts_made(),
                                held->charts_read(), cell});
  });
}

int32_t skerry_echo_radar_destroy(skerry_echo_radar* radar) {
  return guarded([&] {
    if (!radar) return;
    const Held<Radar> held("radar", radar);
    HandleTable::global().remove(radar);
  });
}

}  // extern "C"
