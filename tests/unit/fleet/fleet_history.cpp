#include "tests/unit/fleet/fleet_history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <random>
#include <utility>

#include "server/fleet/exercise_log.hpp"
#include "tests/unit/fleet/memory_store.hpp"

namespace skerry::fleet {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr Duration kStep = milliseconds(5);
constexpr seconds kLeaseTime{2};

struct Applied {
  Tick tick = 0;
  std::string id;
  friend bool operator==(const Applied&, const Applied&) = default;
};

struct SimWorld {
  ExerciseLog::Snapshot at;
  std::vector<Applied> applied;
};

struct SimHost {
  std::string name;
  Duration offset{0};  // of its clock
  double rate = 1.0;
  std::unique_ptr<ExerciseLog> log;
  std::vector<Applied> applied;
  SimWorld kept;
  bool cut = false;
  HostTime paused_until{};
  // The watch: what is on its way to the host.
  std::deque<std::pair<HostTime, KeyEvent>> coming;
  std::size_t read = 0;  // entries of the store's history that are on their way or there
  HostTime watch_from{};
  bool watches = true;
  // Leading.
  LeaseId lease = 0;
  Epoch epoch = 0;
  HostTime holds_until{}, next_keep{};
  HostTime comes_back_at{};
  bool was_free = false, must_come_back = false;
};

// An order that a host tries to append.
struct Try {
  std::string id;
  std::size_t host = 0;
  HostTime again_at{};  // when no reply has come
  bool waits = false;   // for one
  int attempts = 0;
};

class Simulation {
 public:
  explicit Simulation(const HistoryPlan& plan) : plan_(plan), random_(plan.seed) {
    cluster_.ignores_conditions_on_revisions = plan.sabotage == Sabotage::no_fence;
    for (std::size_t i = 0; i < plan.hosts; ++i) {
      SimHost& host = hosts_.emplace_back();
      host.name = "host-" + std::to_string(i);
      host.offset = seconds(random_() % 100000);
      host.rate = 1.0 + 1e-6 * (static_cast<double>(random_() % 400) - 200.0);
      begin(host, {});
    }
  }

  History run() {
    const HostTime end = now_ + plan_.length;
    while (now_ < end) {
      disturb();
      step();
    }
    heal();
    // Until all that is under way has come, and all have come back.
    for (const HostTime last = now_ + seconds(12); now_ < last;) step();
    check_end();
    return std::move(history_);
  }

 private:
  int roll(int n) { return static_cast<int>(random_() % static_cast<std::uint64_t>(n)); }
  // Of what a network does; nothing once it is healed.
  bool happens(int percent) { return !is_calm_ && roll(100) < percent; }
  Duration some_ms(int least, int most) { return milliseconds(least + roll(most - least + 1)); }
  HostTime local(const SimHost& host) const {
    const double ran = static_cast<double>((now_ - HostTime{}).count()) * host.rate;
    return HostTime(Duration(static_cast<std::int64_t>(ran)) + host.offset);
  }
  void violated(std::string text) {
    if (history_.violations.size() < 5)
      history_.violations.push_back(
          fmt::format("seed {}, {:.3f} s: {}", plan_.seed, in_seconds(now_ - HostTime{}), text));
  }
  void after(Duration delay, std::function<void()> what) {
    agenda_.emplace(now_ + delay, std::move(what));
  }

  // A host with that world: it reads the log and watches from there.
  void begin(SimHost& host, const SimWorld& world) {
    ExerciseLog::Settings settings;
    host.log = std::make_unique<ExerciseLog>(host.name, settings, world.at);
    host.applied = world.applied;
    host.kept = world;
    host.must_come_back = false;
    host.was_free = false;
    host.coming.clear();
    host.read = 0;
    std::vector<LogEvent> events;
    for (; host.read < cluster_.history().size(); ++host.read) {
      auto event = keys_.event_of(cluster_.history()[host.read]);
      if (event && *event) events.push_back(**event);
    }
    // As OrderStore::read() gives it: of grants and holders the last one alone.
    for (std::size_t i = 0; i < events.size(); ++i) {
      const bool order = std::holds_alternative<OrderSeen>(events[i]);
      const bool later =
          std::any_of(events.begin() + static_cast<std::ptrdiff_t>(i) + 1, events.end(),
                      [&](const LogEvent& e) { return e.index() == events[i].index(); });
      if (order || !later) hear(host, events[i]);
    }
  }

  void hear(SimHost& host, const LogEvent& event) {
    if (const auto error = host.log->hear(event, local(host)))
      violated(fmt::format("{} finds the log broken: {}", host.name, error->text));
  }

  // ---- the network and the store

  // Sends a transaction; `reply` comes back or not.
  void send(SimHost& host, const Transaction& transaction,
            std::function<void(const TransactionReply&)> reply) {
    if (host.cut || happens(2)) return;
    const Duration there = happens(4) ? some_ms(50, 3000) : some_ms(1, 6);
    after(there, [this, &host, transaction, reply = std::move(reply)] {
      arrive(host, transaction, reply);
    });
  }

  void arrive(SimHost& host, const Transaction& transaction,
              const std::function<void(const TransactionReply&)>& reply) {
    if (!cluster_.has_majority) {
      // Lost with the store's leader, or carried out by its next one.
      if (roll(2)) after(some_ms(50, 1500), [=, this, &host] { arrive(host, transaction, reply); });
      return;
    }
    const TransactionReply answer = cluster_.transact(transaction, now_);
    if (host.cut || happens(4)) return;
    const Duration back = happens(5) ? some_ms(50, 900) : some_ms(1, 6);
    after(back, [this, &host, answer, reply] {
      if (!host.cut && now_ >= host.paused_until) reply(answer);
    });
  }

  void disturb() {
    if (roll(1200) == 0) {  // some hosts are cut off: one, half of them, all
      const int most = roll(3) == 0 ? static_cast<int>(hosts_.size()) : 1 + roll(2);
      for (int i = 0; i < most; ++i) {
        SimHost& host = hosts_[roll(static_cast<int>(hosts_.size()))];
        host.cut = true;
        after(some_ms(20, 4000), [&host] { host.cut = false; });
      }
    }
    if (roll(1500) == 0) {
      cluster_.has_majority = false;
      after(some_ms(100, 2500), [this] {
        if (!cluster_.has_majority) cluster_.lead_anew(now_);
        cluster_.has_majority = true;
      });
    }
    for (SimHost& host : hosts_) {
      if (roll(3000) == 0) host.paused_until = now_ + some_ms(20, 5000);
      if (roll(700) == 0) {  // the watch breaks
        host.watches = false;
        host.watch_from = now_ + some_ms(5, 800);
      }
      if (roll(8000) == 0) {  // killed, and replaced from the log
        ++history_.reborn;
        history_.came_back += host.must_come_back;
        host.lease = 0;
        host.epoch = 0;
        host.kept = {};
        begin(host, {});
      }
    }
    if (roll(20) == 0) {
      tries_.push_back({fmt::format("o{}", next_id_++),
                        static_cast<std::size_t>(roll(static_cast<int>(hosts_.size()))), now_,
                        false, 0});
    }
  }

  void heal() {
    is_calm_ = true;
    cluster_.has_majority = true;
    cluster_.lead_anew(now_);
    for (SimHost& host : hosts_) {
      host.cut = false;
      host.paused_until = now_;
    }
  }

  void step() {
    now_ += kStep;
    while (!agenda_.empty() && agenda_.begin()->first <= now_) {
      const auto what = std::move(agenda_.begin()->second);
      agenda_.erase(agenda_.begin());
      what();
    }
    cluster_.run_to(now_);
    note_truth();
    for (SimHost& host : hosts_) {
      carry(host);
      if (now_ < host.paused_until) continue;
      listen(host);
      hold(host);
      grant(host);
      advance(host);
    }
    std::erase_if(tries_, [](const Try& t) { return t.host == SIZE_MAX; });
    for (Try& t : tries_) order(t);
  }

  // ---- what a host does

  // The store's changes set out for the host, in order.
  void carry(SimHost& host) {
    if (host.cut || !cluster_.has_majority) host.watches = false;
    if (!host.watches) {
      host.read -= host.coming.size();  // lost on the way: it asks for them again
      host.coming.clear();
      if (host.cut || !cluster_.has_majority || now_ < host.watch_from) return;
      host.watches = true;
    }
    for (; host.read < cluster_.history().size(); ++host.read) {
      HostTime due = now_ + (happens(2) ? some_ms(10, 500) : some_ms(0, 5));
      if (!host.coming.empty()) due = std::max(due, host.coming.back().first);
      host.coming.emplace_back(due, cluster_.history()[host.read]);
    }
  }

  void listen(SimHost& host) {
    while (!host.coming.empty() && host.coming.front().first <= now_) {
      const auto event = keys_.event_of(host.coming.front().second);
      host.coming.pop_front();
      if (!event) violated(event.error().text);
      if (event && *event) hear(host, **event);
    }
  }

  void hold(SimHost& host) {
    if (now_ < host.next_keep) return;
    host.next_keep = now_ + milliseconds(400);
    if (host.cut || !cluster_.has_majority) return;
    if (host.must_come_back) {
      if (host.lease) (void)cluster_.revoke_lease(host.lease, now_);
      host.lease = 0;
      host.epoch = 0;
      return;
    }
    if (host.lease && cluster_.keep_lease(host.lease, now_).ttl.count() == 0) host.lease = 0;
    if (!host.lease) {
      host.lease = cluster_.grant_lease(kLeaseTime, now_).id;
      host.epoch = 0;
    }
    Transaction t;
    t.conditions = {{keys_.name(kLeader), Condition::Of::created, 0}};
    t.puts = {{keys_.name(kLeader), host.name, host.lease}};
    t.reads = {keys_.name(kLeader)};
    const auto found = cluster_.transact(t, now_).found[0];
    const Epoch epoch = found && found->lease == host.lease ? found->created : 0;
    if (epoch != 0 && epoch != host.epoch) ++history_.leaders;
    host.epoch = epoch;
    host.holds_until = now_ + milliseconds(1800);
  }

  void grant(SimHost& host) {
    const bool holds = host.epoch != 0 && now_ < host.holds_until;
    host.log->lead(holds ? std::optional<Epoch>(host.epoch) : std::nullopt, local(host));
    const auto wish = host.log->grant_due(local(host));
    if (!wish) return;
    Transaction transaction = transaction_of(keys_, *wish);
    if (plan_.sabotage == Sabotage::loose_grants) transaction.conditions.pop_back();
    send(host, transaction, [this, &host, wish](const TransactionReply& reply) {
      const auto outcome = granted(*wish, reply);
      if (!outcome) history_.deposed += outcome.error().trouble == Trouble::deposed;
      if (!outcome) return;
      history_.late_replies += host.log->known() >= outcome->revision;
      if (plan_.sabotage == Sabotage::trusted_reply)
        hear(host, GrantSeen{outcome->revision, wish->epoch, wish->to, wish->sent});
    });
  }

  void advance(SimHost& host) {
    const Tick before = host.log->tick();
    auto step = host.log->advance(local(host));
    if (plan_.sabotage == Sabotage::runs_ahead && roll(10) == 0)
      step = host.log->advance(local(host) + milliseconds(900));
    if (step.run_to < before) violated(fmt::format("{} runs back in time", host.name));
    for (const auto& due : step.orders) {
      if (due.tick <= before || due.tick > step.run_to)
        violated(fmt::format("{} applies {} at tick {} while it runs {} to {}", host.name,
                             due.order.id, due.tick, before, step.run_to));
      host.applied.push_back({due.tick, due.order.id});
    }
    if (step.keep) host.kept = {{step.run_to, host.log->known()}, host.applied};
    const bool free = step.standing == ExerciseLog::Standing::free;
    history_.free_runs += free && !host.was_free;
    host.was_free = free;
    (free ? history_.ticks_free : history_.ticks_followed) += step.run_to - before;
    if (step.standing == ExerciseLog::Standing::following) check_follower(host);
    if (plan_.sabotage == Sabotage::silent) step.conflict.reset();
    if (!step.conflict) return;
    if (!host.must_come_back) {
      host.must_come_back = true;
      ++history_.conflicts;
      host.comes_back_at = now_ + some_ms(0, 1000);
      if (host.kept.at.tick >= step.conflict->tick)
        violated(fmt::format("{} kept the world of tick {}, and must come back before {}",
                             host.name, host.kept.at.tick, step.conflict->tick));
      if (step.conflict->tick > step.run_to)
        violated(fmt::format("{} must come back for nothing", host.name));
    }
    if (now_ < host.comes_back_at || host.cut) return;
    ++history_.came_back;
    begin(host, host.kept);
  }

  void order(Try& t) {
    SimHost& host = hosts_[t.host];
    if (now_ < t.again_at || now_ < host.paused_until) return;
    t.waits = false;
    const auto place = host.log->place_of_order(local(host));
    if (const auto* refusal = std::get_if<ExerciseLog::Refusal>(&place)) {
      if (refusal->text.empty()) violated("a refusal without a reason");
      ++history_.refused;
      t.again_at = now_ + milliseconds(20);
      if (!refusal->soon && roll(20) == 0) abandon(t);
      return;
    }
    if (++t.attempts > 8) {
      ++history_.abandoned;
      abandon(t);
      return;
    }
    const auto& under = std::get<ExerciseLog::Place>(place);
    const std::string id = plan_.sabotage == Sabotage::twice && t.attempts > 1 ? t.id + "x" : t.id;
    const OrderWish wish{id, host.name, t.id, under.epoch, under.grant, under.tick};
    Transaction transaction = transaction_of(keys_, wish);
    if (plan_.sabotage == Sabotage::any_grant)
      transaction.conditions.erase(transaction.conditions.begin() + 1);
    t.waits = true;
    t.again_at = now_ + milliseconds(500);
    send(host, transaction, [this, wish, id = t.id](const TransactionReply& reply) {
      const auto outcome = appended(wish, reply);
      const auto found = std::find_if(tries_.begin(), tries_.end(), [&](const Try& other) {
        return other.id == id && other.host != SIZE_MAX;
      });
      if (outcome) {
        acknowledged_[id] = {outcome->tick, outcome->revision};
        if (found != tries_.end()) abandon(*found);
        return;
      }
      history_.deposed += outcome.error().trouble == Trouble::deposed;
      history_.overtaken += outcome.error().trouble == Trouble::overtaken;
      if (outcome.error().trouble == Trouble::broken ||
          outcome.error().trouble == Trouble::id_taken)
        violated(outcome.error().text);
      if (found != tries_.end()) found->again_at = now_;
    });
  }
  static void abandon(Try& t) { t.host = SIZE_MAX; }

  // ---- what must hold

  void note_truth() {
    for (; noted_ < cluster_.history().size(); ++noted_) {
      const auto event = keys_.event_of(cluster_.history()[noted_]);
      if (!event || !*event) continue;
      const auto* order = std::get_if<OrderSeen>(&**event);
      if (!order) continue;
      if (!truth_.empty() && order->tick < truth_.back().tick)
        violated(fmt::format("order {} holds from tick {}, and {} before it from {}", order->id,
                             order->tick, truth_.back().id, truth_.back().tick));
      truth_.push_back({order->tick, order->id});
      ++times_[order->order];
    }
  }

  // The invariant: whatever has been committed until now, anywhere, that holds at the follower's
  // tick or before, it has applied.
  void check_follower(const SimHost& host) {
    const auto end = std::upper_bound(truth_.begin(), truth_.end(), host.log->tick(),
                                      [](Tick tick, const Applied& a) { return tick < a.tick; });
    if (static_cast<std::size_t>(end - truth_.begin()) != host.applied.size() ||
        (!host.applied.empty() && !(*(end - 1) == host.applied.back())))
      violated(fmt::format("{} follows at tick {} with {} orders of {}", host.name,
                           host.log->tick(), host.applied.size(), end - truth_.begin()));
  }

  void check_end() {
    for (const auto& [id, count] : times_) {
      if (count != 1) violated(fmt::format("order {} is in the log {} times", id, count));
    }
    for (const auto& [id, told] : acknowledged_) {
      const auto there = std::ranges::find(truth_, id, &Applied::id);
      if (there == truth_.end() || there->tick != told.first)
        violated(fmt::format("order {} was acknowledged for tick {} and is not in the log", id,
                             told.first));
    }
    for (const SimHost& host : hosts_) {
      std::vector<Applied> wanted;
      for (const Applied& a : truth_) {
        if (a.tick <= host.log->tick()) wanted.push_back(a);
      }
      if (host.applied != wanted)
        violated(fmt::format("{} has applied {} orders at the end, not the {} of the log",
                             host.name, host.applied.size(), wanted.size()));
      if (host.log->tick() + 20 < hosts_.front().log->tick())
        violated(fmt::format("{} is left behind at tick {}", host.name, host.log->tick()));
      if (host.must_come_back || host.was_free)
        violated(fmt::format("{} does not follow at the end", host.name));
    }
    history_.acknowledged = acknowledged_.size();
  }

  const HistoryPlan plan_;
  std::mt19937_64 random_;
  HostTime now_{seconds(1000)};
  bool is_calm_ = false;
  MemoryCluster cluster_;
  const LogKeys keys_{"kattegat-7"};
  std::deque<SimHost> hosts_;
  std::multimap<HostTime, std::function<void()>> agenda_;
  std::deque<Try> tries_;
  std::uint64_t next_id_ = 0;
  std::map<std::string, std::pair<Tick, Revision>> acknowledged_;
  std::vector<Applied> truth_;
  std::map<std::string, int> times_;  // by what was ordered
  std::size_t noted_ = 0;
  History history_;
};

}  // namespace

History run_history(const HistoryPlan& plan) { return Simulation(plan).run(); }

}  // namespace skerry::fleet
