#include "tests/system/nmea_day/day_log.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "protocol/nmea/sentence.hpp"
#include "server/app/told_ship.hpp"
#include "server/app/traffic_list.hpp"
#include "server/world/dead_reckoning.hpp"
#include "server/world/ship_reading.hpp"

namespace skerry::system_test {
namespace {

using server::ShipState;
using server::WorldState;

constexpr double kRange_nm = 6.0;

server::NavigationPlan plan() {
  server::NavigationPlan plan;
  plan.periods[server::NavigationSentence::vdo] = server::kAsAisDoes;
  plan.targets = server::TargetSource::truth;
  return plan;
}

// What a talker is told at one tick: as the server tells it (RadarServer::own_ship).
class Told final : public server::NavigationWorld {
 public:
  Told(const WorldState& state, UtcTime utc) : state_(state), utc_(utc) {}
  wire::OwnShip own_ship() const override {
    const ShipState& ship = state_.own_ships.front();
    wire::OwnShip told =
        told_ship(ship, position_at(ship, {}), reading_at(state_, ship, Duration{}));
    told.set_utc_ns(static_cast<std::uint64_t>(utc_.time_since_epoch().count()));
    return told;
  }
  wire::Settings settings() const override {
    wire::Settings settings;
    settings.set_range_nm(kRange_nm);
    return settings;
  }
  std::vector<server::TrafficItem> traffic() const override {
    auto all = server::traffic_of(state_, state_.time);
    all.erase(all.begin());  // herself: own ships come first
    return all;
  }
  std::shared_ptr<const wire::TargetList> targets() const override { return nullptr; }

 private:
  const WorldState& state_;
  UtcTime utc_;
};

std::int64_t milliseconds_of(UtcTime utc) {
  return std::chrono::duration_cast<std::chrono::milliseconds>(utc.time_since_epoch()).count();
}

std::string header_of(const server::World& world) {
  const WorldState state = world.state();
  const ShipState& own = state.own_ships.front();
  nlohmann::json header = {{"name", own.name},
                           {"mmsi", own.mmsi},
                           {"length_m", own.length_m},
                           {"beam_m", own.beam_m},
                           {"ship_class", own.con->ship_class->key},
                           {"draught_m", own.con->ship_class->hull->draught_m()},
                           {"range_nm", kRange_nm},
                           {"tick_ms", 100},
                           {"targets", nlohmann::json::array()}};
  for (const auto& target : state.targets) {
    header["targets"].push_back({{"name", target.name},
                                 {"mmsi", target.mmsi},
                                 {"length_m", target.length_m},
                                 {"beam_m", target.beam_m}});
  }
  std::string columns =
      "ms,lat,lon,heading,cog,speed_mps,rot_deg_s,u_mps,v_mps,rudder,shaft_rps,below_keel_m,"
      "wind_from,wind_mps,set,current_mps,waypoint,cross_track_m";
  for (std::size_t i = 0; i < state.targets.size(); ++i) {
    columns += fmt::format(",lat{0},lon{0},heading{0},cog{0},speed{0},rot{0}", i);
  }
  return header.dump() + "\n" + columns + "\n";
}

std::string row_of(const WorldState& state, UtcTime utc) {
  const ShipState& own = state.own_ships.front();
  const server::ConState& con = *own.con;
  std::string row = fmt::format("{}", milliseconds_of(utc));
  const auto add = [&](double value) { row += fmt::format(",{:.13g}", value); };
  for (const double value :
       {own.position.latitude_deg, own.position.longitude_deg, own.heading_deg,
        own.course_over_ground_deg, own.speed_mps, own.rate_of_turn_deg_s, con.motion.u,
        con.motion.v, con.rudder_deg, con.shaft_rps, con.depth_below_keel_m, con.wind_from_deg,
        con.wind_mps, con.current_set_deg, con.current_mps, static_cast<double>(con.waypoint),
        con.cross_track_m}) {
    add(value);
  }
  for (const ShipState& target : state.targets) {
    for (const double value :
         {target.position.latitude_deg, target.position.longitude_deg, target.heading_deg,
          target.course_over_ground_deg, target.speed_mps, target.rate_of_turn_deg_s}) {
      add(value);
    }
  }
  return row + "\n";
}

}  // namespace

DayLog::Pipe DayLog::open(const std::string& path) {
  Pipe pipe(::popen(fmt::format("gzip -1 > '{}'", path).c_str(), "w"));
  if (!pipe) throw std::runtime_error(path + " cannot be written: is there gzip?");
  return pipe;
}

DayLog::DayLog(const std::string& folder, const std::string& name, const server::World& world)
    : nmea_(open(folder + "/" + name + ".nmea.gz")),
      truth_(open(folder + "/" + name + ".truth.gz")),
      talker_(plan()) {
  put(truth_, header_of(world));
}

void DayLog::put(const Pipe& pipe, const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), pipe.get()) != text.size()) {
    throw std::runtime_error("the log cannot be written: is the disk full?");
  }
  bytes_ += text.size();
}

void DayLog::write(const server::World& world, UtcTime utc) {
  const WorldState state = world.state();
  put(truth_, row_of(state, utc));
  const std::string tag = fmt::format("c:{}", milliseconds_of(utc));
  const std::string before = fmt::format("\\{}*{}\\", tag, nmea::checksum_text(tag));
  for (const auto& message : talker_.due(state.time, Told(state, utc))) {
    for (const std::string& line : message.lines) {
      put(nmea_, before + line);
      ++lines_;
    }
  }
}

void DayLog::close() {
  for (Pipe* pipe : {&nmea_, &truth_}) {
    if (::pclose(pipe->release()) != 0) {
      throw std::runtime_error("the log cannot be written: is the disk full?");
    }
  }
}

}  // namespace skerry::system_test
