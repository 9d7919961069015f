#include "server/exercise_tool/sheet_judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "server/exercise_tool/closest_approach.hpp"
#include "server/exercise_tool/picture_looks.hpp"

namespace skerry::server {
namespace {

constexpr double kLandSeen = 0.01, kNoLandSeen = 0.002;  // of what the chart has within the scale

class Judge {
 public:
  Judge(const scenario::ExerciseCheck& check, const ExercisePlan& plan,
        const echo::ChartSource& chart, const World& world)
      : check_(check), plan_(plan), chart_(chart), world_(world) {
    result_.check = &check;
  }

  CheckResult take(std::vector<CheckedTurn>* turn) {
    judge_world();
    if (needs_picture()) judge_picture(turn);
    return std::move(result_);
  }

 private:
  void add(bool passed, std::string text) { result_.lines.push_back({passed, std::move(text)}); }

  std::size_t radar() const {
    for (std::size_t i = 0; i < plan_.radars.size(); ++i) {
      if (plan_.radars[i].name == check_.radar()) return i;
    }
    return 0;
  }

  void judge_world() {
    if (check_.has_event()) {
      const auto when = world_.happened(check_.event());
      add(when.has_value(), when ? fmt::format("event {} happened after {:.1f} min", check_.event(),
                                               in_seconds(*when) / 60.0)
                                 : fmt::format("event {} has not happened", check_.event()));
    }
    const WorldState state = world_.state();
    for (const auto& apart : check_.apart()) judge_apart(apart, state);
    if (check_.has_gyro_error_least_deg() || check_.has_position_error_least_m()) judge_errors();
  }

  static const ShipState* find(const std::string& name, const WorldState& state) {
    for (const auto* ships : {&state.own_ships, &state.targets}) {
      for (const ShipState& ship : *ships) {
        if (ship.name == name) return &ship;
      }
    }
    return nullptr;
  }

  void judge_apart(const scenario::Apart& apart, const WorldState& state) {
    const ShipState* const a = find(apart.ship(), state);
    const ShipState* const b = find(apart.other(), state);
    const std::string who = fmt::format("{} and {}", apart.ship(), apart.other());
    if (a == nullptr || b == nullptr) {
      add(false, fmt::format("{}: {} is not on the water", who,
                             a == nullptr ? apart.ship() : apart.other()));
      return;
    }
    const double apart_nm = metres_apart(*a, *b) / 1852.0;
    const bool well = (!apart.has_least_nm() || apart_nm >= apart.least_nm()) &&
                      (!apart.has_most_nm() || apart_nm <= apart.most_nm());
    add(well,
        fmt::format("{} are {:.2f} NM apart (asked: {}{}{})", who, apart_nm,
                    apart.has_least_nm() ? fmt::format("at least {} NM", apart.least_nm()) : "",
                    apart.has_least_nm() && apart.has_most_nm() ? ", " : "",
                    apart.has_most_nm() ? fmt::format("at most {} NM", apart.most_nm()) : ""));
  }

  void judge_errors() {
    wire::ExerciseState told;
    world_.tell(told);
    const auto own = static_cast<int>(plan_.radars[radar()].own_ship);
    const wire::ExerciseShip& ship = told.ships(own);
    if (check_.has_gyro_error_least_deg()) {
      add(std::fabs(ship.gyro_error_deg()) >= check_.gyro_error_least_deg(),
          fmt::format("{}: the gyro is {:.1f} deg off (asked: at least {})", ship.name(),
                      ship.gyro_error_deg(), check_.gyro_error_least_deg()));
    }
    if (check_.has_position_error_least_m()) {
      add(ship.gnss_error_m() >= check_.position_error_least_m(),
          fmt::format("{}: the position is {:.0f} m off (asked: at least {})", ship.name(),
                      ship.gnss_error_m(), check_.position_error_least_m()));
    }
  }

  bool needs_picture() const {
    return check_.sees_size() > 0 || check_.misses_size() > 0 || check_.has_land() ||
           check_.has_clutter_least_percent() || check_.has_clutter_most_percent();
  }

  void judge_picture(std::vector<CheckedTurn>* turn) {
    std::optional<RangeScale> range;
    if (check_.has_range_nm()) range = RangeScale::find(check_.range_nm());
    PictureLooks looks(plan_, radar(), range, chart_, world_);
    for (const std::string& name : check_.sees()) {
      const EchoStand stand = looks.seen(name);
      add(stand.stands_out, fmt::format("sees {}: {}", name, stand.why));
    }
    for (const std::string& name : check_.misses()) {
      const EchoStand stand = looks.seen(name);
      add(!stand.stands_out, fmt::format("misses {}: {}", name, stand.why));
    }
    const LitShares shares = looks.shares(check_.clutter_within_nm() * 1852.0);
    if (check_.has_land()) {
      const bool well = check_.land() ? shares.land_cells > 0 && shares.land >= kLandSeen
                                      : shares.land <= kNoLandSeen;
      add(well, fmt::format("land {}: {:.1f} % of the chart's land in reach is lit",
                            check_.land() ? "is there" : "is not there", 100.0 * shares.land));
    }
    const std::string clutter = fmt::format("clutter: {:.1f} % of the water within {} NM is lit",
                                            100.0 * shares.water, check_.clutter_within_nm());
    if (check_.has_clutter_least_percent()) {
      add(100.0 * shares.water >= check_.clutter_least_percent(),
          fmt::format("{} (asked: at least {} %)", clutter, check_.clutter_least_percent()));
    }
    if (check_.has_clutter_most_percent()) {
      add(100.0 * shares.water <= check_.clutter_most_percent(),
          fmt::format("{} (asked: at most {} %)", clutter, check_.clutter_most_percent()));
    }
    if (turn != nullptr) turn->push_back({looks.config().name, looks.first()});
  }

  const scenario::ExerciseCheck& check_;
  const ExercisePlan& plan_;
  const echo::ChartSource& chart_;
  const World& world_;
  CheckResult result_;
};

}  // namespace

bool CheckResult::passed() const {
  return std::all_of(lines.begin(), lines.end(), [](const Line& line) { return line.passed; });
}

CheckResult judge(const scenario::ExerciseCheck& check, const ExercisePlan& plan,
                  const echo::ChartSource& chart, const World& world,
                  std::vector<CheckedTurn>* turn) {
  return Judge(check, plan, chart, world).take(turn);
}

}  // namespace skerry::server
