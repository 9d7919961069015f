#include "server/fleet/member/member.hpp"

#include <pthread.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "server/fleet/log_messages.pb.h"
#include "server/fleet/ship_shares.hpp"

namespace skerry::fleet {
namespace {

constexpr std::chrono::milliseconds kMemberLook{5};
// A host that is more ticks behind than this catches up: it compares no worlds, does not stand to
// lead, and its radars do not start.
constexpr Tick kBehind = 20;
constexpr Tick kAtOnce = 200;  // between looks whether it is to stop
// The grant that a host finds when it comes may be old: its time is believed kSettle after the log
// was read.
constexpr std::chrono::milliseconds kSettle{700};
constexpr std::chrono::seconds kTellAgain{30};
constexpr int kGrantsToLead = 5;
constexpr std::chrono::seconds kNobodyLeads{6};

}  // namespace

Member::Member(MemberPlan plan, Exercise& exercise)
    : plan_(std::move(plan)),
      exercise_(exercise),
      log_(std::in_place, plan_.host, ExerciseLog::Settings{}, ExerciseLog::Snapshot{}),
      holders_(plan_.ships),
      made_until_(plan_.ships),
      reader_(plan_, mark_,
              [this](LogReader::Heard heard) {
                const std::lock_guard lock(mutex_);
                queue_.push_back(std::move(heard));
              }),
      desk_(
          plan_, mark_,
          [this] {
            const std::lock_guard lock(mutex_);
            return log_->place_of_order(host_now());
          },
          [this](const std::string& id, const std::string& text) { exercise_.refused(id, text); }),
      leader_(
          plan_, mark_,
          [this] {
            const std::lock_guard lock(mutex_);
            return !awaits_log_ && !ended_ && !behind_;
          },
          [this]() -> std::optional<GrantWish> {
            const std::lock_guard lock(mutex_);
            return awaits_log_ || ended_ ? std::nullopt : log_->grant_due(host_now());
          },
          [this](std::optional<StoreError> error) {
            const std::lock_guard lock(mutex_);
            log_->store_said(error);
            view_.problem = error ? error->text : std::string();
          }),
      seats_(
          plan_, mark_, [this] { return known(); }, [this](std::size_t) { return let_go(); }) {
  view_.standing = "joining";
}

void Member::start() {
  reader_.start();
  desk_.start();
  thread_ = std::jthread([this](const std::stop_token& stop) {
    pthread_setname_np(pthread_self(), "fleet");
    run(stop);
  });
}

void Member::stop() {
  stops_.store(true);
  thread_.request_stop();
  if (thread_.joinable()) thread_.join();
  exercise_.hold(std::vector<HostTime>(plan_.ships));
  seats_.stop();
  desk_.stop();
  leader_.stop();
  reader_.stop();
}

std::optional<Duration> Member::time() const {
  const std::lock_guard lock(mutex_);
  return runs_ ? log_->time(host_now()) : std::nullopt;
}

std::optional<std::string> Member::ended() const {
  const std::lock_guard lock(mutex_);
  return ended_;
}

void Member::order(std::string id, std::string order) {
  const std::string name = id;
  if (!desk_.add(std::move(id), std::move(order)))
    exercise_.refused(name, "too many orders wait for the exercise's log; give it again");
}

bool Member::leads() const {
  const std::lock_guard lock(mutex_);
  return leader_host_ == plan_.host && leader_.held(host_now()).has_value();
}

bool Member::alone() const {
  const std::lock_guard lock(mutex_);
  return runs_ && !ended_ && !seats_.is_present(host_now());
}

void Member::go_on_alone(HostTime asked) {
  const std::lock_guard lock(mutex_);
  alone_until_ = asked + ShipSeats::kAloneAnswer;
}

// Without the store a ship is kept only if that follows at once: for as long as others would need
// to take her, lose the store themselves, and say that they are without it (1.5 s).
std::vector<HostTime> Member::held_until(HostTime now) {
  const std::vector<HostTime> held = seats_.until();
  const std::vector<bool> claimed = seats_.claimed();
  const std::lock_guard lock(mutex_);
  const bool goes_on = !seats_.is_present(now) && now < alone_until_;
  for (std::size_t ship = 0; ship < held.size(); ++ship) {
    HostTime& made = made_until_[ship];
    if (held[ship] > now) {
      made = held[ship];
    } else if (goes_on && claimed[ship] && now < made + ShipSeats::kAloneAnswer) {
      made = alone_until_;
    } else if (!claimed[ship]) {
      made = HostTime{};
    }
  }
  return made_until_;
}

// Thread: fleet-ships.  Waits for two more calls of hold(), the second of which surely knows what
// was given up; false: not within 0.5 s.
bool Member::let_go() {
  const std::uint64_t before = holds_.load();
  const HostTime until = host_now() + kStoreCall;
  // A stopped member holds nothing any more.
  while (!stops_.load() && holds_.load() < before + 2 && host_now() < until)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return stops_.load() || holds_.load() >= before + 2;
}

MemberView Member::view() const {
  const std::lock_guard lock(mutex_);
  return view_;
}

void Member::run(const std::stop_token& stop) {
  bool seated = false;
  while (!stop.stop_requested()) {
    step();
    if (!seated && may_be_seated()) {
      seated = true;
      leader_.start();
      seats_.start();
    }
    std::this_thread::sleep_for(kMemberLook);
  }
}

// Who has just come knows the time by an old grant, perhaps of a leader that is dead: it would hold
// all others up as long as that is old.  Those have led for a while; if there are none, it begins.
bool Member::may_be_seated() const {
  const std::lock_guard lock(mutex_);
  if (awaits_log_ || ended_) return false;
  if (!log_->granted()) return true;  // a new exercise
  const HostTime now = host_now();
  return (grants_heard_ >= kGrantsToLead && now >= settled_) || now >= settled_ + kNobodyLeads;
}

void Member::hear(LogReader::Heard heard, HostTime now) {
  if (heard.error) {
    log_->store_said(heard.error);
    view_.problem = heard.error->text;
    if (heard.ended) end(heard.error->text);
    return;
  }
  if (awaits_log_ && !heard.anew) return;
  if (heard.anew) {
    log_.emplace(plan_.host, ExerciseLog::Settings{}, from_);
    present_.clear();
    holders_.assign(plan_.ships, {});
    awaits_log_ = false;
    settled_ = now + kSettle;
    grants_heard_ = 0;
  }
  view_.problem.clear();
  for (const LogEvent& event : heard.events) hear(event, now);
}

void Member::hear(const LogEvent& event, HostTime now) {
  if (const auto* note = std::get_if<NoteSeen>(&event)) return hear_note(*note, now);
  if (const auto* holder = std::get_if<HolderSeen>(&event)) {
    if (const auto ship = ship_of(holder->name); ship && *ship < holders_.size())
      holders_[*ship] = holder->host;
    if (const auto host = present_host(holder->name)) {
      if (holder->host.empty()) {
        present_.erase(*host);
        if (const auto note = notes_.find(*host); note != notes_.end()) note->second.takes = false;
      } else {
        present_.insert(*host);
      }
    }
    if (holder->name == kLeader) leader_host_ = holder->host;
  }
  if (std::holds_alternative<GrantSeen>(event)) ++grants_heard_;
  if (auto error = log_->hear(event, now)) end(error->text);
}

// mutex_ held.
void Member::end(const std::string& why) {
  if (ended_) return;
  ended_ = why;
  spdlog::error("fleet: this host takes no part any more: {}", why);
}

void Member::hear_note(const NoteSeen& seen, HostTime now) {
  HostNote note;
  if (!note.ParseFromString(seen.note)) return;
  if (!notes_.contains(seen.host) && notes_.size() >= WorldHashes::kMostHosts) {
    const auto gone = std::find_if(notes_.begin(), notes_.end(), [this](const auto& each) {
      return !present_.contains(each.first);
    });
    if (gone == notes_.end()) return;
    notes_.erase(gone);
  }
  HostSeen& host = notes_[seen.host];
  host = {seen.host, note.native(), note.web(), note.standing(), now, {}, 0, {}, note.takes()};
  WorldDigest digest;
  if (seen.host == plan_.host || note.tick() == 0 || note.digest().size() != digest.size()) return;
  std::copy(note.digest().begin(), note.digest().end(), digest.begin());
  host.tick = note.tick();
  host.digest = digest;
  compare(seen.host, note.tick(), digest);
}

void Member::compare(const std::string& host, Tick tick, const WorldDigest& digest) {
  const auto difference = hashes_.add(host, tick, digest);
  if (!difference) return;
  if (const HostTime now = host_now(); !told_ || now - *told_ >= kTellAgain) {
    told_ = now;
    spdlog::error("fleet: {}", difference->text);
  }
  const auto& hosts = difference->hosts;
  const bool mine = std::find(hosts.begin(), hosts.end(), plan_.host) != hosts.end();
  if (!mine || !difference->is_certain) return;
  if (++differed_ > 1) {
    end("its world differs from that of the others again, after the whole log: is its program, "
        "its processor or a library another one? (" +
        difference->text + ")");
    return;
  }
  spdlog::error("fleet: this host differs; it comes back by the whole log");
  come_back(Exercise::Back::beginning);
}

// mutex_ held.
void Member::come_back(Exercise::Back to) {
  const bool to_kept = to == Exercise::Back::kept && kept_.has_value();
  from_ = to_kept ? *kept_ : ExerciseLog::Snapshot{};
  made_ = from_.tick;
  kept_.reset();
  hashes_ = {};
  digest_tick_ = 0;
  awaits_log_ = true;
  runs_ = false;
  exercise_.come_back(to_kept ? Exercise::Back::kept : Exercise::Back::beginning);
  reader_.read_anew();
}

// If compared, stops at each kDigestTicks-th tick to compare the world.  It may come back there, or
// be told to stop: made_ is then below tick.
void Member::run_to(Tick tick, bool compared) {
  while (made_ < tick) {
    if (stops_.load()) return;
    const Tick next =
        std::min(tick, compared ? (made_ / kDigestTicks + 1) * kDigestTicks : made_ + kAtOnce);
    exercise_.run_to(next);
    made_ = next;
    if (!compared || made_ % kDigestTicks != 0) continue;
    const WorldDigest digest = exercise_.digest();
    const std::lock_guard lock(mutex_);
    digest_ = digest;
    digest_tick_ = made_;
    compare(plan_.host, made_, digest);
    if (awaits_log_) return;
  }
}

void Member::step() {
  const HostTime now = host_now();
  ExerciseLog::Step step;
  bool runs = false;
  {
    const std::lock_guard lock(mutex_);
    std::vector<LogReader::Heard> queue;
    queue.swap(queue_);
    for (LogReader::Heard& heard : queue) hear(std::move(heard), now);
    if (!awaits_log_ && !ended_) {
      log_->lead(leader_.held(now), now);
      step = log_->advance(now);
    }
    if (step.conflict) {
      spdlog::warn(
          "fleet: this host ran free past tick {}, from which order {} holds; it comes back",
          step.conflict->tick, step.conflict->order.id);
      come_back(Exercise::Back::kept);
    }
    look_around(step.standing, now);
    runs = !awaits_log_ && !ended_;
  }
  if (!runs) {
    exercise_.hold(std::vector<HostTime>(plan_.ships));
    holds_.fetch_add(1);
    return;
  }
  const bool behind = step.run_to > made_ + kBehind;
  if (behind) {
    const std::lock_guard lock(mutex_);
    behind_ = true;
  }
  const bool follows = step.standing == ExerciseLog::Standing::following;
  for (const ExerciseLog::Due& due : step.orders) {
    run_to(due.tick - 1, follows && !behind);
    if (made_ + 1 != due.tick) return;  // it stops, or came back: the log is heard anew
    exercise_.give(due.order);
  }
  run_to(step.run_to, follows && !behind);
  if (step.keep) {
    const std::lock_guard lock(mutex_);
    exercise_.keep();
    kept_ = {made_, log_->known()};
  }
  exercise_.hold(held_until(now));
  holds_.fetch_add(1);
  const std::lock_guard lock(mutex_);
  behind_ = behind;
  const bool knows_time = leader_.held(now).has_value() || now >= settled_;
  runs_ = runs_ || (log_->granted().has_value() && !awaits_log_ && !behind && knows_time);
}

}  // namespace skerry::fleet
