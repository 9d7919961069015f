#include "server/debrief/observer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <stdexcept>
#include <utility>

#include "protocol/quantity/angle.hpp"
#include "server/debrief/deeds.hpp"
#include "server/debrief/known_targets.hpp"
#include "server/debrief/orders_told.hpp"
#include "server/debrief/passings.hpp"
#include "server/replay/replayed_world.hpp"
#include "server/world/ship_units.hpp"
#include "server/world/short_way.hpp"

namespace skerry::server {
namespace {

constexpr double kTargetEvery_s = 10.0;  // between points of targets' tracks
constexpr double kFastestSailed_mps = 140.0;

double air_seconds(const WorldState& state) { return in_seconds(state.time.time_since_epoch()); }

TrackPoint point_of(const ShipState& ship, Moment now) {
  TrackPoint point;
  point.when = now;
  point.position = ship.position;
  point.heading_deg = ship.heading_deg;
  point.course_over_ground_deg = ship.course_over_ground_deg;
  point.speed_kn = ship.speed_mps / knots_in_mps(1.0);
  point.turn_deg_min = 60.0 * ship.rate_of_turn_deg_s;
  if (ship.con) {
    point.rudder_deg = ship.con->rudder_deg;
    point.shaft_rpm = 60.0 * ship.con->shaft_rps;
    point.engine_percent = ship.con->engine_percent;
  }
  return point;
}

void add_point(ShipTrack& track, const ShipState& ship, Moment now, double every_s) {
  // A frozen exercise adds nothing but its first and last point.
  if (!track.points.empty() && now.at_s < track.points.back().when.at_s + every_s - 1e-6) return;
  TrackPoint point = point_of(ship, now);
  if (!track.points.empty()) {
    const TrackPoint& last = track.points.back();
    const ShortWay way = short_way_between(last.position, point.position);
    const double sailed_s = now.exercise_s - last.when.exercise_s;
    point.jumped =
        std::hypot(way.north_m, way.east_m) > kFastestSailed_mps * std::max(sailed_s, 0.2);
  }
  track.points.push_back(point);
}

bool is_same(const Contact& a, const Contact& b) {
  return a.when == b.when && a.kind == b.kind && a.own_ship == b.own_ship &&
         a.other_own == b.other_own && a.other == b.other;
}

class Observer {
 public:
  Observer(const RecordedExercise& exercise, const ExercisePlan& plan,
           const DebriefOptions& options, Debrief& out)
      : exercise_(exercise),
        plan_(plan),
        options_(options),
        out_(out),
        world_(plan.scenario, exercise.world, plan.in_range),
        passings_(options.limits) {
    if (options.judge) {
      for (const auto& check : plan.scenario.exercise().checks()) due_.push_back(&check);
    }
    std::stable_sort(due_.begin(), due_.end(),
                     [](const auto* a, const auto* b) { return a->at_min() > b->at_min(); });
  }

  bool run(double end_s, const DebriefProgress& progress) {
    double at_s = 0.0;
    for (;;) {
      const WorldStatePtr state = world_.at(ScenarioTime(seconds_as_duration(at_s + 1e-6)));
      look(*state, end_s, progress);
      if (at_s >= end_s) break;
      if (!progress(at_s / std::max(end_s, 1e-9), "sailing the exercise again")) return false;
      // A second of the exercise, in whole ticks.
      const double ticks = std::clamp(10.0 / std::max(state->rate, 0.1), 1.0, 10.0);
      at_s = std::min(end_s, at_s + 0.1 * std::floor(ticks));
    }
    finish(end_s);
    return true;
  }

 private:
  void look(const WorldState& state, double end_s, const DebriefProgress& progress) {
    now_ = {air_seconds(state), in_seconds(state.exercise)};
    if (std::fabs(now_.at_s - now_.exercise_s) > 0.15) out_.has_one_clock = false;
    take_inputs(state);
    passings_.look(state, now_);
    add_tracks(state);
    hear(state);
    while (!due_.empty() && 60.0 * due_.back()->at_min() <= now_.exercise_s + 1e-9) {
      progress(now_.at_s / std::max(end_s, 1e-9), "judging a check");
      JudgedCheck& judged = out_.checks.emplace_back(options_.judge(*due_.back(), world_.world()));
      judged.when = now_;
      judged.says = due_.back()->says();
      due_.pop_back();
    }
    before_ = now_;
  }

  void take_inputs(const WorldState& state) {
    for (; next_ < exercise_.world.size(); ++next_) {
      const WorldInput& input = exercise_.world[next_];
      const double at_s = 0.1 * static_cast<double>(input.tick);
      if (at_s > now_.at_s + 1e-6) break;
      const double into =
          now_.at_s > before_.at_s
              ? std::clamp((at_s - before_.at_s) / (now_.at_s - before_.at_s), 0.0, 1.0)
              : 1.0;
      const Moment when{at_s, before_.exercise_s + into * (now_.exercise_s - before_.exercise_s)};
      for (HappenedLine& line : lines_of(input.input, when, *state.scenario)) {
        out_.happened.push_back(std::move(line));
      }
    }
  }

  void add_tracks(const WorldState& state) {
    for (std::size_t i = 0; i < state.own_ships.size(); ++i) {
      if (out_.own_ships.size() <= i) {
        ShipTrack& track = out_.own_ships.emplace_back();
        track.name = state.own_ships[i].name;
        track.own = true;
        track.number = i;
        track.length_m = state.own_ships[i].length_m;
        track.beam_m = state.own_ships[i].beam_m;
        track.ship_class = state.scenario->own_ships(static_cast<int>(i)).ship_class();
      }
      add_point(out_.own_ships[i], state.own_ships[i], now_, options_.limits.every_s);
    }
    for (const ShipState& ship : state.targets) {
      ShipTrack& track = targets_[ship.number];
      track.name = ship.name;
      track.number = ship.number;
      track.length_m = ship.length_m;
      track.beam_m = ship.beam_m;
      const double every_s = std::max(
          options_.limits.every_s, state.pace > 0.0 ? kTargetEvery_s / state.pace : kTargetEvery_s);
      add_point(track, ship, now_, every_s);
    }
  }

  // Marks and contacts that are new.
  void hear(const WorldState& state) {
    if (state.log == log_) return;
    const auto& marks = state.log->marks;
    std::size_t from = std::min(heard_, marks.size());
    if (marks.size() == ExerciseLog::kMaxMarks && log_ && !log_->marks.empty()) {
      // The oldest have gone: those after the one heard last are new.
      from = marks.size();
      const std::string last = log_->marks.back().SerializeAsString();
      while (from > 0 && marks[from - 1].SerializeAsString() != last) --from;
    }
    for (; from < marks.size(); ++from) {
      HappenedLine line{{moment_of(marks[from].exercise_s(), state)},
                        marks[from].kind(),
                        "",
                        marks[from].text(),
                        about(marks[from])};
      out_.happened.push_back(std::move(line));
    }
    heard_ = marks.size();
    const auto& contacts = state.log->contacts;
    std::size_t next = std::min(contacts_, contacts.size());
    if (contacts.size() == ExerciseLog::kMaxMarks && !out_.contacts.empty()) {
      // As with marks.
      next = contacts.size();
      while (next > 0 && !is_same(contacts[next - 1], out_.contacts.back())) --next;
    }
    for (; next < contacts.size(); ++next) {
      out_.contacts.push_back(contacts[next]);
      out_.contact_moments.push_back(moment_of(in_seconds(contacts[next].when), state));
    }
    contacts_ = contacts.size();
    log_ = state.log;
  }

  // On the air, of a time on the exercise's clock since the look before.
  Moment moment_of(double exercise_s, const WorldState& state) const {
    const double back_s = (now_.exercise_s - exercise_s) / std::max(state.rate, 0.1);
    return {std::clamp(now_.at_s - back_s, before_.at_s, now_.at_s), exercise_s};
  }

  std::optional<std::size_t> about(const wire::ExerciseMark& mark) const {
    const scenario::Scenario& scenario = plan_.scenario;
    for (int i = 0; i < scenario.own_ships_size(); ++i) {
      const std::string& name = scenario.own_ships(i).name();
      if (mark.kind() == "text" && mark.text().starts_with("to " + name + ": ")) return i;
      if (mark.kind() == "grounding" && mark.text().starts_with(name + " at ")) return i;
    }
    if (mark.kind() != "event") return std::nullopt;
    for (const scenario::Event& event : scenario.events()) {
      if (event.name() != mark.text() || event.has_text() || event.own_ships_size() != 1) continue;
      for (int i = 0; i < scenario.own_ships_size(); ++i) {
        if (scenario.own_ships(i).name() == event.own_ships(0).own_ship()) return i;
      }
    }
    return std::nullopt;
  }

  void finish(double end_s) {
    out_.end = {std::min(end_s, now_.at_s), now_.exercise_s};
    out_.differs = world_.fault();
    out_.passings = passings_.nearest();
    for (const ShipPassing& passing : out_.passings) {
      if (passing.other_own) continue;
      const auto found = targets_.find(passing.other);
      if (found == targets_.end()) continue;
      out_.targets.push_back(std::move(found->second));
      targets_.erase(found);
    }
    for (auto check = due_.rbegin(); check != due_.rend(); ++check) {
      JudgedCheck& judged = out_.checks.emplace_back();
      judged.when.exercise_s = 60.0 * (*check)->at_min();
      judged.says = (*check)->says();
      judged.reached = false;
    }
  }

  const RecordedExercise& exercise_;
  const ExercisePlan& plan_;
  const DebriefOptions& options_;
  Debrief& out_;
  ReplayedWorld world_;
  Passings passings_;
  std::vector<const scenario::ExerciseCheck*> due_;  // latest first
  std::map<std::size_t, ShipTrack> targets_;
  std::shared_ptr<const ExerciseLog> log_;
  std::size_t next_ = 0, heard_ = 0, contacts_ = 0;
  Moment before_, now_;
};

double exercise_at(const Debrief& debrief, double at_s) {
  if (debrief.own_ships.empty()) return at_s;
  const auto& points = debrief.own_ships.front().points;
  const auto after =
      std::lower_bound(points.begin(), points.end(), at_s,
                       [](const TrackPoint& point, double when) { return point.when.at_s < when; });
  if (after == points.end()) return points.empty() ? at_s : points.back().when.exercise_s;
  if (after == points.begin()) return after->when.exercise_s;
  const Moment from = std::prev(after)->when, to = after->when;
  return from.exercise_s +
         (at_s - from.at_s) / (to.at_s - from.at_s) * (to.exercise_s - from.exercise_s);
}

}  // namespace

std::optional<Debrief> make_debrief(const recording::RecordingReader& reader,
                                    const RecordedExercise& exercise, const ExercisePlan& plan,
                                    const DebriefOptions& options,
                                    const DebriefProgress& progress) {
  const recording::Summary& summary = reader.summary();
  const double whole_s = in_seconds(length_to_replay(
      reader, exercise,
      options.until_s ? std::optional(seconds_as_duration(*options.until_s)) : std::nullopt,
      "--until"));
  const double end_s = std::min(whole_s, in_seconds(summary.end - exercise.zero));
  Debrief debrief;
  const scenario::ExerciseSheet& sheet = plan.scenario.exercise();
  debrief.exercise = plan.scenario.name();
  debrief.goal = sheet.goal();
  debrief.briefing = sheet.briefing();
  debrief.answers.assign(sheet.answers().begin(), sheet.answers().end());
  debrief.server = exercise.server;
  debrief.began = exercise.epoch;
  debrief.incomplete = exercise.incomplete;
  debrief.limits = options.limits;
  Observer observer(exercise, plan, options, debrief);
  if (!observer.run(end_s, progress)) return std::nullopt;
  for (HappenedLine& line : setting_lines(reader, exercise.zero, plan.scenario)) {
    if (line.when.at_s > end_s) continue;
    line.when.exercise_s = exercise_at(debrief, line.when.at_s);
    debrief.happened.push_back(std::move(line));
  }
  std::stable_sort(
      debrief.happened.begin(), debrief.happened.end(),
      [](const HappenedLine& a, const HappenedLine& b) { return a.when.at_s < b.when.at_s; });
  const auto exercise_then = [&](double at_s) { return exercise_at(debrief, at_s); };
  debrief.known = known_views(reader, exercise.zero, end_s, plan.scenario, exercise_then);
  read_deeds(reader, exercise.zero, end_s, exercise_then, debrief);
  debrief.reactions = reactions_to(debrief.happened, debrief.passings, debrief.own_ships);
  return debrief;
}

}  // namespace skerry::server
