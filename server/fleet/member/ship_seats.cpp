#include "server/fleet/member/ship_seats.hpp"

#include <fmt/format.h>
#include <pthread.h>

#include <utility>

#include "server/fleet/ship_shares.hpp"
#include "server/fleet/until_answered.hpp"

namespace skerry::fleet {
namespace {

constexpr std::string_view kPresence = "host/";
constexpr std::chrono::milliseconds kShareLook{50};
constexpr auto kHoldStep = std::chrono::milliseconds(Holding::kLease) / 4;
constexpr std::chrono::milliseconds kNote{1000};
// A host that has just come may find the ships of others not yet given up: it looks once more.
constexpr std::chrono::milliseconds kGiveUp{200};

}  // namespace

std::string presence_name(const std::string& host) { return std::string(kPresence) + host; }

std::optional<std::string> present_host(const std::string& name) {
  if (!name.starts_with(kPresence)) return std::nullopt;
  return name.substr(kPresence.size());
}

ShipSeats::ShipSeats(const MemberPlan& plan, StoreMark& mark, std::function<Known()> look,
                     std::function<bool(std::size_t)> let_go)
    : plan_(plan),
      mark_(mark),
      look_(std::move(look)),
      let_go_(std::move(let_go)),
      keys_(plan.store()),
      presence_(*keys_, mark, {plan.exercise, presence_name(plan.host), plan.host}),
      until_(plan.ships),
      claimed_(plan.ships) {}

void ShipSeats::start() {
  thread_ = std::jthread([this](const std::stop_token& stop) {
    pthread_setname_np(pthread_self(), "fleet-ships");
    run(stop);
  });
}

void ShipSeats::stop() {
  thread_.request_stop();
  if (thread_.joinable()) thread_.join();
}

std::vector<HostTime> ShipSeats::until() const {
  const std::lock_guard lock(mutex_);
  return until_;
}

std::vector<bool> ShipSeats::claimed() const {
  const std::lock_guard lock(mutex_);
  return claimed_;
}

void ShipSeats::look_at_presence(HostTime now) {
  const bool is_there = is_present(now);
  if (is_there && !was_present_ && takes_from_ != HostTime{}) takes_from_ = now + kBackFirst;
  if (is_there && takes_from_ == HostTime{}) takes_from_ = now;
  was_present_ = is_there;
  may_take_.store(is_there && now >= takes_from_);
}

void ShipSeats::set_until(std::size_t ship, HostTime until) {
  const std::lock_guard lock(mutex_);
  until_[ship] = until;
  claimed_[ship] = true;
}

void ShipSeats::keep(std::size_t ship) {
  Holding& holding = *ships_.at(ship);
  const Holding::Status status = holding.step(keys_->now() + kStoreCall);
  set_until(ship, holding.held_until());
  if (status.standing == Holding::Standing::other_holds) give_up(ship);
}

// No spoke is made any more before another may take it.  Where that is not sure it is not given
// back: it runs out by itself, after the radars have stopped by their own clock.
void ShipSeats::give_up(std::size_t ship, HostTime deadline) {
  {
    const std::lock_guard lock(mutex_);
    until_[ship] = HostTime{};
    claimed_[ship] = false;
  }
  if (let_go_(ship)) ships_.at(ship)->release(deadline);
  ships_.erase(ship);
}

void ShipSeats::give_up(std::size_t ship) { give_up(ship, keys_->now() + kStoreCall); }

void ShipSeats::share(const Known& known) {
  std::vector<std::string> holders = known.holders;
  for (const auto& [ship, holding] : ships_) holders[ship] = plan_.host;
  const Shares shares = shares_of(plan_.host, holders, known.present);
  for (const std::size_t ship : shares.take) {
    ships_[ship] = std::make_unique<Holding>(
        *keys_, mark_, Holding::Wish{plan_.exercise, ship_name(ship), plan_.host});
    keep(ship);
  }
  if (shares.give_up && ships_.contains(*shares.give_up)) give_up(*shares.give_up);
}

void ShipSeats::run(const std::stop_token& stop) {
  HostTime step_at = keys_->now(), note_at = step_at, share_at = step_at;
  bool took = false;
  while (!stop.stop_requested()) {
    const HostTime now = keys_->now();
    if (now >= step_at) {
      step_at = now + kHoldStep;
      (void)presence_.step(now + kStoreCall);
      std::vector<std::size_t> held;
      for (const auto& [ship, holding] : ships_) held.push_back(ship);
      for (const std::size_t ship : held) keep(ship);
    }
    look_at_presence(keys_->now());
    const Known known = look_();
    if (!known.takes) {
      while (!ships_.empty()) give_up(ships_.begin()->first);
    } else if (now >= share_at && may_take()) {
      const std::size_t before = ships_.size();
      share(known);
      if (ships_.size() < before) share_at = keys_->now() + kGiveUp;
    }
    const bool is_news = std::exchange(took, may_take()) != may_take();
    if ((is_news || now >= note_at) && !known.note.empty()) {
      note_at = now + kNote;
      Transaction t;
      t.puts = {{LogKeys(plan_.exercise).note(plan_.host), known.note, 0}};
      (void)keys_->transact(t, now + kStoreCall);
    }
    keys_->wait_until(keys_->now() + kShareLook);
  }
  const HostTime deadline = keys_->now() + kStoreCall;  // of all
  while (!ships_.empty()) give_up(ships_.begin()->first, deadline);
  presence_.release(deadline);
}

}  // namespace skerry::fleet
