#include "server/exercise_tool/radar_turns.hpp"

#include <utility>

namespace skerry::server {
namespace {

RadarConfig on_scale(RadarConfig config, std::optional<RangeScale> range) {
  if (range) config.controls.range_scale = *range;
  return config;
}

}  // namespace

RadarTurns::RadarTurns(const ExercisePlan& plan, std::size_t radar, std::optional<RangeScale> range,
                       const echo::ChartSource& chart, const World& world)
    : config_(on_scale(plan.radars.at(radar), range)),
      maker_(config_, 0),
      pictures_(chart, plan.coast),
      airwaves_(plan.radars.size()),
      world_(world),
      state_(std::make_shared<const WorldState>(world_.state())) {
  for (const RadarConfig& other : plan.radars) {
    const RadarConfig& config = other.radar == config_.radar ? config_ : other;
    airwaves_.set(config.radar, SectorMaker(config, 0).emission(config.radar_controls,
                                                                config.controls.range_scale));
  }
  given_.radar = config_.radar_controls;
  given_.on_air = config_.controls.range_scale;
  given_.views = {{0, config_.controls}};
  given_.emissions = airwaves_.get();
}

void RadarTurns::step_to(ScenarioTime time) {
  const auto tick = static_cast<std::uint64_t>(time.time_since_epoch() / World::kTick);
  if (world_.tick() >= tick) return;
  while (world_.tick() < tick) world_.step();
  state_ = std::make_shared<const WorldState>(world_.state());
}

// As far as one turn needs it.
void RadarTurns::see_coast() {
  const CoastWish wish = maker_.wish(state_->own_ships.at(config_.own_ship), given_.views, 0);
  if (!pictures_.serves(wish)) pictures_.lay(wish);
  given_.coast =
      std::make_shared<const CoastInSight>(seen_from(pictures_.picture(wish), wish, {0, 0}));
}

void RadarTurns::pass(Duration time) {
  step_to(ScenarioTime(World::kTick * static_cast<std::int64_t>(world_.tick()) + time));
}

Scan RadarTurns::turn() {
  const std::uint32_t spokes = config_.geometry.spokes_per_turn;
  const ScenarioTime now(World::kTick * static_cast<std::int64_t>(world_.tick()));
  const double turns =
      in_seconds(now - maker_.clock().time_of(0)) / (maker_.clock().seconds_per_spoke() * spokes);
  next_ = std::max(next_, static_cast<std::uint64_t>(turns) * spokes);
  while (maker_.clock().time_of(next_) < now) next_ += spokes;
  step_to(maker_.clock().time_of(next_));
  see_coast();

  Scan scan;
  scan.radar = config_.radar;
  scan.geometry = config_.geometry;
  scan.number = static_cast<std::uint32_t>(next_ / spokes);
  scan.spokes.resize(spokes);
  std::vector<ViewSector> out;
  for (const std::uint64_t end = next_ + spokes; next_ < end; next_ += SectorMaker::kSectorSpokes) {
    maker_.turn(next_, given_.radar);
    step_to(maker_.clock().time_of(next_));
    given_.state = state_;
    maker_.make(next_, given_, out);
    for (const ViewSector& part : out) {
      for (const SpokePtr& spoke : part.sector.spokes) {
        scan.spokes[spoke->header.index] = *spoke;
        ++scan.received;
      }
    }
  }
  return scan;
}

}  // namespace skerry::server
