#include "server/traffic_logs/track_book.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "protocol/quantity/speed.hpp"
#include "server/world/short_way.hpp"

namespace skerry::server {
namespace {

constexpr std::int64_t kLeast_ms = 1000;  // between fixes of a ship
constexpr double kTimeRounding_s = 1.0;   // of logs
constexpr double kFixNoise_m = 30.0;

// The MMSI of what is no ship, by its first digits.  Source: ITU-R M.585-9.
std::optional<LeftOut> other_than_ship(std::uint32_t mmsi) {
  if (mmsi > 999'999'999) return LeftOut::bad_mmsi;
  if (mmsi < 10'000'000 && mmsi > 0) return LeftOut::base_station;
  if (mmsi < 100'000'000) return LeftOut::bad_mmsi;
  if (mmsi / 1'000'000 == 111) return LeftOut::aircraft;
  const std::uint32_t three = mmsi / 1'000'000;
  if (three == 970 || three == 972 || three == 974) return LeftOut::distress;
  if (mmsi / 10'000'000 == 99) return LeftOut::aid;
  return std::nullopt;
}

double metres_between(GeoPoint from, GeoPoint to) {
  const ShortWay way = short_way_between(from, to);
  return std::hypot(way.north_m, way.east_m);
}

bool can_sail(const LogFix& from, const LogFix& to) {
  const double seconds = static_cast<double>(to.utc_ms - from.utc_ms) / 1000.0 + kTimeRounding_s;
  return metres_between(from.place(), to.place()) <=
         TrackBook::kMostSpeed_kn * kKnot * seconds + kFixNoise_m;
}

void put(const HeardIdentity& heard, HeardIdentity& into) {
  if (!heard.name.empty()) into.name = heard.name;
  if (heard.ship_type != 0) into.ship_type = heard.ship_type;
  if (heard.length_m > 0.0) into.length_m = heard.length_m;
  if (heard.beam_m > 0.0) into.beam_m = heard.beam_m;
  if (heard.class_b) into.class_b = heard.class_b;
}

std::int64_t begin_of(const LoggedPiece& piece) { return piece.fixes.front().utc_ms; }

}  // namespace

bool TrackBook::Doubted::agree_with(const LogFix& fix) {
  const bool agrees = count > 0 && fix.utc_ms - last.utc_ms >= kLeast_ms && can_sail(last, fix);
  count = agrees ? count + 1 : 1;
  last = fix;
  return count >= kStraysThatAgree;
}

bool TrackBook::Ship::has_finished(std::int64_t utc_ms) const {
  // Nearly always the time is after all of them.
  for (auto each = pieces.rbegin(); each != pieces.rend(); ++each) {
    if (utc_ms > each->fixes.back().utc_ms) return false;
    if (utc_ms >= begin_of(*each)) return true;
  }
  return false;
}

bool TrackBook::Ship::has_begun_since_last(std::int64_t utc_ms) const {
  return std::any_of(pieces.rbegin(), pieces.rend(), [&](const LoggedPiece& each) {
    return begin_of(each) > last->utc_ms && begin_of(each) <= utc_ms;
  });
}

void TrackBook::Ship::finish(LoggedPiece done) {
  const auto after = std::upper_bound(
      pieces.begin(), pieces.end(), begin_of(done),
      [](std::int64_t utc_ms, const LoggedPiece& each) { return utc_ms < begin_of(each); });
  pieces.insert(after, std::move(done));
}

TrackBook::Ship* TrackBook::ship_of(std::uint32_t mmsi) {
  if (const auto other = other_than_ship(mmsi)) {
    left_out_.add(*other);
    return nullptr;
  }
  const auto found = ships_.find(mmsi);
  if (found != ships_.end()) return &found->second;
  if (ships_.size() >= kMostShips) {
    left_out_.add(LeftOut::too_many);
    return nullptr;
  }
  Ship& ship = ships_[mmsi];
  ship.identity.mmsi = mmsi;
  return &ship;
}

void TrackBook::take(const HeardIdentity& identity) {
  if (Ship* const ship = ship_of(identity.mmsi)) put(identity, ship->identity);
}

void TrackBook::take(const HeardFix& heard) {
  Ship* const found = ship_of(heard.mmsi);
  if (found == nullptr) return;
  Ship& ship = *found;
  if (heard.class_b) ship.identity.class_b = heard.class_b;
  if (!heard.position || !(std::fabs(heard.position->latitude_deg) <= 90.0) ||
      !(std::fabs(heard.position->longitude_deg) <= 180.0)) {
    return left_out_.add(LeftOut::no_position);
  }
  if (!heard.utc) return left_out_.add(LeftOut::no_time);
  if ((rules_.from && *heard.utc < *rules_.from) || (rules_.until && *heard.utc > *rules_.until)) {
    return left_out_.add(LeftOut::out_of_time);
  }
  if (rules_.area && metres_between(rules_.area->centre, *heard.position) > rules_.area->radius_m) {
    return left_out_.add(LeftOut::out_of_area);
  }
  const std::int64_t utc_ms =
      std::chrono::duration_cast<std::chrono::milliseconds>(heard.utc->time_since_epoch()).count();
  const LogFix fix = log_fix(utc_ms, *heard.position);
  if (!ship.last) return begin_piece(ship, fix, heard);
  if (ship.has_finished(fix.utc_ms)) return left_out_.add(LeftOut::time_back);
  if (fix.utc_ms - ship.last->utc_ms < kLeast_ms) return take_earlier(ship, fix, heard);
  ship.backs.count = 0;
  if (!can_sail(*ship.last, fix)) {
    if (!ship.strays.agree_with(fix)) return left_out_.add(LeftOut::jump);
    end_piece(ship);
    return begin_piece(ship, fix, heard);
  }
  ship.strays.count = 0;
  if (Duration(std::chrono::milliseconds(fix.utc_ms - ship.last->utc_ms)) > rules_.gap ||
      ship.has_begun_since_last(fix.utc_ms)) {
    end_piece(ship);
    return begin_piece(ship, fix, heard);
  }
  ship.block.push_back(fix);
  ship.last = fix;
  ++ship.piece.heard;
  ++used_;
  if (ship.block.size() >= kBlock) thin_block(ship);
}

void TrackBook::take_earlier(Ship& ship, const LogFix& fix, const HeardFix& heard) {
  if (fix.utc_ms >= ship.piece.fixes.front().utc_ms) return left_out_.add(LeftOut::time_back);
  if (!ship.backs.agree_with(fix)) return left_out_.add(LeftOut::time_back);
  end_piece(ship);
  begin_piece(ship, fix, heard);
}

void TrackBook::begin_piece(Ship& ship, const LogFix& fix, const HeardFix& heard) {
  ship.piece = {};
  ship.piece.fixes.push_back(fix);
  ship.piece.heading_deg = heard.heading_deg ? heard.heading_deg : heard.course_deg;
  ship.piece.heard = 1;
  ship.block.assign(1, fix);
  ship.last = fix;
  ship.strays.count = ship.backs.count = 0;
  ++used_;
}

void TrackBook::thin_block(Ship& ship) {
  if (ship.block.size() < 2) return;
  const Thinned thinned = thin(ship.block, rules_.tolerance_m);
  ship.piece.worst_m = std::max(ship.piece.worst_m, thinned.worst_m);
  for (std::size_t i = 1; i < thinned.kept.size(); ++i) {
    const LogFix kept = ship.block[thinned.kept[i]];
    ship.piece.fixes.push_back(kept);
    if (ship.piece.fixes.size() < kMostFixes) continue;
    // The next piece begins where and when this one ends.
    LoggedPiece next;
    next.fixes.push_back(kept);
    ship.finish(std::exchange(ship.piece, std::move(next)));
  }
  ship.block.assign(1, ship.block.back());
}

void TrackBook::end_piece(Ship& ship) {
  thin_block(ship);
  if (ship.piece.fixes.size() >= 2) {
    ship.piece.fixes.shrink_to_fit();
    ship.finish(std::move(ship.piece));
  } else if (ship.piece.heard == 1) {
    left_out_.add(LeftOut::single);
    --used_;
  }
  ship.piece = {};
  ship.block.clear();
  ship.last.reset();
}

std::vector<LoggedShip> TrackBook::finish() {
  std::vector<LoggedShip> ships;
  for (auto& [mmsi, ship] : ships_) {
    if (ship.last) end_piece(ship);
    if (ship.pieces.empty()) continue;
    LoggedShip logged{std::move(ship.identity), std::move(ship.pieces), 0};
    for (const LoggedPiece& piece : logged.pieces) logged.heard += piece.heard;
    ships.push_back(std::move(logged));
  }
  ships_.clear();
  return ships;
}

}  // namespace skerry::server
