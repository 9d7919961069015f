#include "server/playback/player.hpp"

#include <pthread.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <exception>
#include <utility>

#include "protocol/recording/topics.hpp"

namespace skerry::server {
namespace {

using recording::Kind;
using recording::Topic;
using std::chrono::steady_clock;

// In real time: what a sector waits for its last spoke where few come.
constexpr double kSectorSeconds = 0.04;
// At fast rates a sector leaves so much early at most, rather than with a timer of its own.
constexpr Duration kEarly = std::chrono::milliseconds(1);
constexpr double kFast = 4.0;
// Between two rounds of a very short recording.
constexpr Duration kShortestRound = std::chrono::milliseconds(100);
constexpr double kHeaderBytes = 100.0;
// The most of all makes: 2048 spokes of 536 octets, and the frames' headers.
constexpr double kEmulatedTurnBytes = 1.2e6;

// Ships as they really were: while the turn before a place is played quickly, they are those of
// that place already.
bool is_truth(Kind kind) { return kind == Kind::exercise || kind == Kind::traffic; }

std::vector<OwnSpokePtr> copies_of(const std::vector<OwnSpokePtr>& spokes) {
  std::vector<OwnSpokePtr> copies;
  copies.reserve(spokes.size());
  for (const OwnSpokePtr& spoke : spokes) copies.push_back(std::make_shared<Spoke>(*spoke));
  return copies;
}

}  // namespace

Player::Player(const recording::RecordingReader& reader, const RecordedRadars& radars,
               const RadarViews& views, RelayedState& state, const PlayerOptions& options)
    : reader_(reader),
      radars_(radars),
      views_(views),
      state_(state),
      current_timestamps_(options.current_timestamps),
      begin_(reader.summary().begin),
      end_(reader.summary().end),
      pieces_(reader, radars),
      playing_(options.playing),
      loop_(options.loop),
      rate_(options.rate),
      paused_at_(options.from.value_or(begin_)) {
  for (const RecordedRadar& radar : radars.radars) {
    if (radar.views.empty()) continue;
    turns_.emplace_back(reader, Topic{Kind::spoke, radar.recorded, radar.shared_view()},
                        radar.info.rpm());
  }
  for (const Topic& topic : played_topics(reader.summary(), radars)) {
    if (topic.kind == Kind::spoke) continue;
    auto cursor = reader.items({topic});
    if (const auto item = cursor.next()) {
      first_[topic] = {item->bytes.begin(), item->bytes.end()};
    }
  }
  begin_at(begin_, begin_);
  orders_.seek = paused_at_;
}

Player::~Player() { stop(); }

void Player::start() {
  began_ = steady_clock::now();
  utc_.emplace(ClockReading{began_, read_clocks().utc});
  thread_ = std::jthread([this](const std::stop_token& stop) {
    pthread_setname_np(pthread_self(), "playback");
    try {
      run(stop);
    } catch (const std::exception& error) {
      spdlog::critical("the playback's thread ends: {}", error.what());
      std::terminate();
    }
  });
}

void Player::stop() {
  thread_.request_stop();
  if (thread_.joinable()) thread_.join();
}

// --- any thread

UtcTime Player::place(SteadyTime now) const {
  if (orders_.seek) return *orders_.seek;
  if (goal_) return *goal_;
  if (!playing_) return paused_at_;
  return std::clamp(clock_.at(now), begin_, end_);
}

void Player::order(const PlayOrder& order) {
  const std::lock_guard lock(mutex_);
  const SteadyTime now = steady_clock::now();
  const UtcTime here = place(now);
  rate_ = order.rate.value_or(rate_);
  loop_ = order.loop.value_or(loop_);
  if (order.seek) orders_ = {*order.seek, 0};
  orders_.steps = std::clamp(orders_.steps + order.steps, -kMostSteps, kMostSteps);
  const bool playing = order.steps == 0 && order.playing.value_or(playing_);
  // From the end one plays from the begin.
  if (playing && !playing_ && !order.seek && here >= end_) orders_ = {begin_, 0};
  playing_ = playing;
  if (!goal_) settle(here, now);
  ++changes_;
  ++version_;
  changed_.notify_all();
}

void Player::settle(UtcTime at, SteadyTime now) {
  paused_at_ = at;
  clock_.set(at, now, rate_);
}

PlayerStanding Player::standing() const {
  const std::lock_guard lock(mutex_);
  std::string problem = problem_;
  if (playing_ && !behind_.empty()) problem += (problem.empty() ? "" : "; ") + behind_;
  return {place(steady_clock::now()), playing_, rate_, loop_, std::move(problem)};
}

std::optional<UtcTime> Player::present_utc() const {
  if (!current_timestamps_) return std::nullopt;
  return std::chrono::time_point_cast<Duration>(std::chrono::system_clock::now());
}

std::uint64_t Player::version() const {
  const std::lock_guard lock(mutex_);
  return version_;
}

// --- the playback's thread

void Player::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    carry_out(take_orders());
    std::unique_lock lock(mutex_);
    const bool runs_on = runs();
    lock.unlock();
    runs_on ? advance(stop) : rest(stop);
  }
}

Player::Orders Player::take_orders() {
  const std::lock_guard lock(mutex_);
  seen_ = changes_;
  const Orders orders = std::exchange(orders_, {});
  if (orders.seek) goal_ = orders.seek;
  return orders;
}

void Player::carry_out(const Orders& orders) {
  if (orders.steps != 0) {
    step(orders.steps);
  } else if (orders.seek) {
    jump(*orders.seek);
  }
}

void Player::step(int turns) {
  std::unique_lock lock(mutex_);
  const UtcTime here = goal_.value_or(paused_at_);
  lock.unlock();
  // Counted by the first radar that turns here: one in standby may be silent to the end.
  const auto turning = std::find_if(turns_.begin(), turns_.end(),
                                    [&](TurnFinder& finder) { return finder.turns_at(here); });
  std::optional<UtcTime> found;
  if (!turns_.empty()) {
    TurnFinder& finder = turning == turns_.end() ? turns_.front() : *turning;
    found = finder.turn_from(here, turns);
  }
  const UtcTime there = found.value_or(turns > 0 ? end_ : begin_);
  lock.lock();
  goal_ = there;
  ++version_;
  lock.unlock();
  jump(there);
}

void Player::jump(UtcTime place) {
  UtcTime from = place;
  for (TurnFinder& finder : turns_) from = std::min(from, finder.turn_before(place));
  begin_at(from, place);
  joins_seen_ = joins();
  joined_at_ = UtcTime::min();
  const std::lock_guard lock(mutex_);
  if (from < place) {
    goal_ = place;
    clock_.set(from, steady_clock::now(), std::max(rate_, kCatchUp));
  } else {
    goal_.reset();
    settle(place, steady_clock::now());
  }
}

void Player::begin_at(UtcTime from, UtcTime place) {
  next_.reset();
  pieces_.seek(from);
  // Truth goes from where it was to the place: whoever asks meanwhile gets one or the other.
  for (const auto& [topic, first] : first_) take_last(topic, is_truth(topic.kind) ? place : from);
  for (const auto& radar : views_) {
    const auto views = radar->get();
    for (const RelayedViewPtr& view : *views) view->begin_anew();
  }
}

void Player::take_last(const Topic& topic, UtcTime place) {
  const auto found = reader_.last_before(topic, place);
  Topic played = topic;
  if (is_of_a_radar(topic.kind)) played.radar = radars_.played.at(topic.radar);
  const auto& bytes = found ? found->bytes : first_.at(topic);
  state_.take(played, found ? found->time : place, bytes, radars_.played);
}

void Player::advance(const std::stop_token& stop) {
  for (bool begun = false;; begun = true) {
    std::unique_lock lock(mutex_);
    if (changes_ != seen_ || !runs()) return;
    const std::optional<UtcTime> goal = goal_;
    const double rate = clock_.rate();
    if (!begun && !goal && pace_.begin(rate)) tell_pace();
    lock.unlock();
    if (!begun) {
      hold_enough(rate);
      pieces_.set_span(seconds_as_duration(kSectorSeconds * rate));
    }
    if (!next_) next_ = pieces_.next(goal);
    note_faults();
    if (!next_) return goal ? reach(*goal) : reach_end();

    lock.lock();
    const SteadyTime now = steady_clock::now();
    const bool gives_up = now > clock_.due(next_->time) + kGiveUp;
    if (gives_up) clock_.set(next_->time, now, rate);
    if (!goal && pace_.note(next_->time, now, gives_up)) tell_pace();
    const SteadyTime due = clock_.due(next_->time);
    lock.unlock();
    const bool soon = rate > kFast && due - now < kEarly;
    if (!soon && !wait_until(due, stop)) return;
    if (!goal || !is_truth(next_->topic.kind)) play(*next_);
    if (const std::uint64_t readers = joins(); readers != joins_seen_) {
      joins_seen_ = readers;
      joined_at_ = next_->time;
    }
    next_.reset();
  }
}

bool Player::wait_until(SteadyTime due, const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  for (;;) {
    if (stop.stop_requested() || changes_ != seen_) return false;
    const SteadyTime now = steady_clock::now();
    if (now >= due) return true;
    // A file may say any time.
    const SteadyTime until = std::min(due, now + std::chrono::hours(1));
    changed_.wait_until(lock, stop, until, [this] { return changes_ != seen_; });
  }
}

void Player::play(Piece& piece) {
  if (piece.topic.kind != Kind::spoke) {
    state_.take(piece.topic, piece.time, piece.bytes, radars_.played);
    return;
  }
  if (current_timestamps_) {
    std::unique_lock lock(mutex_);
    const PlayClock clock = clock_;
    lock.unlock();
    const SteadyTime now = steady_clock::now();
    if (now - looked_ >= ClockFollower::kLook) {
      looked_ = now;
      if (const auto step = utc_->look(read_clocks())) {
        spdlog::warn("the system's clock was set by {:+.3f} s; all UTC follows",
                     in_seconds(step->by()));
      }
    }
    for (std::size_t i = 0; i < piece.spokes.size(); ++i) {
      const Duration since = clock.due(piece.times[i]) - began_;
      SpokeHeader& header = piece.spokes[i]->header;
      header.utc = utc_->clock().at(ScenarioTime(since));
      header.scenario_time = ScenarioTime(std::max(Duration::zero(), since));
    }
  }
  state_.take(piece.spokes.back()->header);
  const auto views = views_[piece.topic.radar]->get();
  RelayedView* last = nullptr;
  for (const RelayedViewPtr& view : *views) {
    if (view->source != piece.topic.view) continue;
    if (last != nullptr) last->publish(copies_of(piece.spokes));
    last = view.get();
  }
  if (last != nullptr) last->publish(std::move(piece.spokes));
}

void Player::tell_pace() {
  behind_ = pace_.behind();
  ++version_;
}

void Player::reach(UtcTime goal) {
  const std::lock_guard lock(mutex_);
  if (changes_ != seen_) return;
  goal_.reset();
  settle(goal, steady_clock::now());
}

void Player::reach_end() {
  std::unique_lock lock(mutex_);
  if (changes_ != seen_) return;
  if (!loop_) {
    playing_ = false;
    paused_at_ = end_;
    ++version_;
    return;
  }
  const SteadyTime now = steady_clock::now();
  SteadyTime again = std::max(clock_.due(end_), now - kGiveUp / 2);
  if (clock_.due(end_) - clock_.due(begin_) < kShortestRound) again = now + kShortestRound;
  lock.unlock();
  begin_at(begin_, begin_);
  lock.lock();
  clock_.set(begin_, again, rate_);
}

void Player::rest(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  const bool ordered =
      changed_.wait_for(lock, stop, kLookAround, [this] { return changes_ != seen_; });
  if (ordered || stop.stop_requested()) return;
  const UtcTime here = paused_at_;
  lock.unlock();
  if (somebody_joined(here)) jump(here);
}

bool Player::somebody_joined(UtcTime here) {
  const std::uint64_t readers = joins();
  const bool now = readers > std::exchange(joins_seen_, readers);
  // One who joined while it ran, within the last turn, has a part of the picture.
  const Duration turn = seconds_as_duration(60.0 / radars_.radars.front().info.rpm());
  const bool lately = joined_at_ > here - turn;
  joined_at_ = UtcTime::min();
  return now || lately;
}

std::uint64_t Player::joins() const {
  std::uint64_t joins = 0;
  for (const auto& radar : views_) {
    const auto views = radar->get();
    for (const RelayedViewPtr& view : *views) joins += view->channel.joins();
  }
  return joins;
}

void Player::hold_enough(double rate) {
  for (std::size_t radar = 0; radar < views_.size(); ++radar) {
    const wire::RadarInfo& info = radars_.radars[radar].info;
    views_[radar]->hold(held_bytes(info, rate));
  }
}

std::size_t Player::held_bytes(const wire::RadarInfo& info, double rate) {
  const double spoke_bytes = info.cells() * info.bits() / 8.0 + kHeaderBytes;
  const double turn_bytes = std::max(info.spokes_per_turn() * spoke_bytes, kEmulatedTurnBytes);
  const double turns = info.rpm() / 60.0 * rate * in_seconds(kHeld);
  return static_cast<std::size_t>(std::clamp(turn_bytes * turns, static_cast<double>(kLeastHeld),
                                             static_cast<double>(kMostHeld)));
}

void Player::note_faults() {
  const std::uint64_t faults = pieces_.faults();
  if (faults == faults_) return;
  const bool first = std::exchange(faults_, faults) == 0;
  std::string problem = pieces_.problem();
  if (first) spdlog::warn("playback: {}", problem);
  const std::lock_guard lock(mutex_);
  problem_ = std::move(problem);
  ++version_;
}

}  // namespace skerry::server
