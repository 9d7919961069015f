// One process of a fleet under test: it says each thing that it does and is told, a line each, in a
// file.  fleet_worker hold|work HOST SEED FILE EXERCISE MEMBER...  Runs until it is ended.
//   hold: holds the name "leader" while it can.
//   work: does so too, grants, appends under its epoch and under former ones, and watches.
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "server/fleet/etcd/etcd_store.hpp"
#include "server/fleet/holding.hpp"
#include "server/fleet/order_watch.hpp"

namespace skerry::fleet {
namespace {

using std::chrono::milliseconds;

class Worker {
 public:
  Worker(const std::string& host, std::uint64_t seed, const char* file, const std::string& exercise,
         std::vector<std::string> members)
      : host_(host),
        exercise_(exercise),
        random_(seed),
        out_(std::fopen(file, "a")),
        members_(std::make_shared<EtcdMembers>(EtcdAddress{std::move(members), std::nullopt})),
        keys_(members_),
        watch_keys_(members_),
        orders_(keys_, mark_, exercise),
        leader_(keys_, mark_, {exercise, kLeader, host, Holding::kLease}) {
    for (std::size_t turns = seed % members_->size(); turns > 0; --turns) keys_.turn();
  }

  // Asks before each act whether it may; what it is told after it was stopped is what counts.
  [[noreturn]] void hold() {
    open();
    Epoch last = 0;
    for (HostTime next{};;) {
      if (const auto epoch = leader_.held(host_now()); epoch.value_or(0) != last) {
        say("{} {}", epoch ? "holds" : "holds-not", epoch.value_or(last));
        if (!epoch) {
          const auto late = append(last, "late-" + std::to_string(last), milliseconds(5000));
          say("append {}", late);
        }
        last = epoch.value_or(0);
      }
      if (host_now() >= next) {
        (void)leader_.step(host_now() + milliseconds(400));
        next = host_now() + milliseconds(400);
      }
      keys_.wait_until(host_now() + milliseconds(5));
    }
  }

  [[noreturn]] void work() {
    open();
    HostTime next_keep{};
    for (;;) {
      if (host_now() >= next_keep) {
        (void)leader_.step(host_now() + milliseconds(400));
        next_keep = host_now() + milliseconds(400);
        if (const auto epoch = leader_.held(host_now())) led_ = *epoch;
      }
      look();
      if (led_appends_ >= kAppendsOfALeader) {
        leader_.release(host_now() + milliseconds(300));
        led_appends_ = 0;
      }
      const bool holds = leader_.held(host_now()).has_value();
      if (led_ != 0 && holds && random_() % 3 == 0)
        (void)orders_.grant({led_, grant_.revision, grant_.to + 1, Duration(grant_.to)},
                            host_now() + milliseconds(300));
      // Who has been deposed tries it still: the store must not take it.
      const Epoch epoch = led_ != 0 && random_() % 2 == 0 ? led_ : epoch_;
      led_appends_ += holds;
      if (epoch != 0 && (holds || random_() % 4 == 0))
        (void)append(epoch, fmt::format("{}.{}", host_, ++appends_), milliseconds(1500));
    }
  }

 private:
  // Then it leaves it to another.
  static constexpr int kAppendsOfALeader = 25;

  template <typename... Values>
  void say(fmt::format_string<Values...> text, Values&&... values) {
    const std::string line = fmt::format(text, std::forward<Values>(values)...) + "\n";
    std::fwrite(line.data(), 1, line.size(), out_);
    std::fflush(out_);
  }

  void open() {
    while (!orders_.open("born of " + host_, host_now() + milliseconds(2000))) {
    }
    say("open {}", host_);
  }

  // What the log says meanwhile.
  void look() {
    if (!watch_) {
      const auto text = orders_.read(1, host_now() + milliseconds(1000));
      if (!text) return;
      if (text->grant) grant_ = *text->grant;
      for (const HolderSeen& holder : text->holders) epoch_ = holder.epoch;
      watch_ = std::make_unique<OrderWatch>(watch_keys_, mark_, exercise_, text->at + 1);
      say("watch {}", text->at + 1);
    }
    const auto events = watch_->next(host_now() + milliseconds(2));
    if (!events) {
      say("trouble {}", name_of(events.error().trouble));
      return;
    }
    for (const LogEvent& event : *events) {
      if (const auto* order = std::get_if<OrderSeen>(&event))
        say("seen {} {}", order->revision, order->id);
      if (const auto* grant = std::get_if<GrantSeen>(&event)) grant_ = *grant;
      if (const auto* holder = std::get_if<HolderSeen>(&event)) epoch_ = holder->epoch;
    }
  }

  std::string append(Epoch epoch, const std::string& id, Duration patience) {
    say("begin {} {} {}", id, epoch, host_now().time_since_epoch().count());
    const OrderWish wish{id, host_, "order " + id, epoch, grant_.revision, grant_.to + 1};
    auto outcome = orders_.append(wish, host_now() + patience / 2);
    if (!outcome && outcome.error().maybe_done)
      outcome = orders_.append(wish, host_now() + patience / 2);
    const auto now = host_now().time_since_epoch().count();
    if (outcome) {
      say("done {} {} {}", id, outcome->revision, now);
      return "done";
    }
    const std::string trouble(name_of(outcome.error().trouble));
    say("{} {} {} {}", outcome.error().maybe_done ? "unknown" : "never", id, trouble, now);
    return trouble;
  }

  const std::string host_, exercise_;
  std::mt19937_64 random_;
  std::FILE* out_;
  std::shared_ptr<const EtcdMembers> members_;
  StoreMark mark_;
  EtcdStore keys_, watch_keys_;
  OrderStore orders_;
  Holding leader_;
  std::unique_ptr<OrderWatch> watch_;
  GrantSeen grant_;
  Epoch epoch_ = 0, led_ = 0;
  std::uint64_t appends_ = 0;
  int led_appends_ = 0;
};

}  // namespace
}  // namespace skerry::fleet

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.size() < 6) return 2;
  skerry::fleet::Worker worker(arguments[1], std::stoull(arguments[2]), arguments[3].c_str(),
                               arguments[4], {arguments.begin() + 5, arguments.end()});
  if (arguments[0] == "hold") worker.hold();
  worker.work();
}
