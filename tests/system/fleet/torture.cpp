#include "tests/system/fleet/torture.hpp"

#include <fmt/format.h>
#include <signal.h>

#include <fstream>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <sstream>
#include <stdexcept>
#include <thread>
#include <utility>

#include "server/fleet/order_store.hpp"
#include "tests/system/fleet/etcd_cluster.hpp"
#include "tests/system/fleet/history_check.hpp"

namespace skerry::fleet {
namespace {

using std::chrono::milliseconds;
using system_test::ChildProcess;

constexpr const char* kTortured = "tortured";

class Torture {
 public:
  explicit Torture(const TorturePlan& plan) : plan_(plan), random_(plan.seed) {}

  TortureReport run() {
    for (std::size_t i = 0; i < plan_.workers; ++i) start_worker(i);
    const HostTime end = host_now() + plan_.length;
    while (host_now() < end) {
      std::this_thread::sleep_for(milliseconds(100 + roll(900)));
      for (auto due = later_.begin(); due != later_.end() && due->first <= host_now();
           due = later_.erase(due))
        due->second();
      disturb();
    }
    for (auto& [time, what] : later_) what();
    etcd_.heal();
    etcd_.await_majority();
    // All that was under way is done or refused when the processes are gone and the store answers.
    std::this_thread::sleep_for(milliseconds(2000));
    for (auto& worker : workers_) worker.reset();
    for (const std::string& file : files_) read(file);
    read_log();
    report_.contradictions = contradictions(history_);
    return std::move(report_);
  }

 private:
  int roll(int n) { return static_cast<int>(random_() % static_cast<std::uint64_t>(n)); }
  void after(int ms, std::function<void()> what) {
    later_.emplace(host_now() + milliseconds(ms), std::move(what));
  }

  void start_worker(std::size_t i) {
    const std::string host = fmt::format("w{}-{}", i, files_.size());
    files_.push_back(folder_.path(host));
    std::vector<std::string> arguments = {
        FLEET_WORKER,  "work",   host, std::to_string(plan_.seed * 100 + files_.size()),
        files_.back(), kTortured};
    for (const std::string& address : etcd_.addresses()) arguments.push_back(address);
    workers_.resize(plan_.workers);
    workers_[i] = std::make_unique<ChildProcess>(std::move(arguments));
  }

  void disturb() {
    const auto member = static_cast<std::size_t>(roll(static_cast<int>(etcd_.size())));
    const auto worker = static_cast<std::size_t>(roll(static_cast<int>(plan_.workers)));
    // Every third blow at the store is at its leader.
    const auto hit = roll(3) == 0 ? etcd_.leader().value_or(member) : member;
    switch (roll(6)) {
      case 0:
      case 1:
        if (!etcd_.runs(hit) || etcd_.is_stopped(hit)) return;
        etcd_.kill(hit);
        ++report_.members_killed;
        after(100 + roll(2500), [this, hit] { etcd_.start(hit); });
        return;
      case 2:
      case 3:
        if (!etcd_.runs(hit) || etcd_.is_stopped(hit)) return;
        etcd_.stop(hit);
        ++report_.members_stopped;
        after(100 + roll(3500), [this, hit] { etcd_.resume(hit); });
        return;
      case 4:
        if (stopped_.contains(worker)) return;
        start_worker(worker);  // the one before is killed
        ++report_.workers_killed;
        return;
      default:
        if (!stopped_.insert(worker).second) return;
        workers_[worker]->signal(SIGSTOP);
        ++report_.workers_stopped;
        after(500 + roll(4000), [this, worker] {
          workers_[worker]->signal(SIGCONT);
          stopped_.erase(worker);
        });
    }
  }

  void read(const std::string& file) {
    std::map<std::string, AppendTold> open;
    std::ifstream lines(file);
    const std::string process = file.substr(file.rfind('/') + 1);
    for (std::string line; std::getline(lines, line) && !lines.eof();) {
      std::istringstream words(line);
      std::string kind, id, trouble;
      words >> kind;
      if (kind == "begin") {
        words >> id;
        AppendTold& append = open[id];
        append.process = process;
        append.id = id;
        words >> append.epoch >> append.began_ns;
      } else if (kind == "done") {
        words >> id;
        words >> open[id].revision >> open[id].ended_ns;
        open[id].end = AppendTold::End::done;
        ++report_.done;
      } else if (kind == "never") {
        words >> id >> trouble;
        open[id].end = AppendTold::End::never;
        ++report_.never;
        report_.deposed += trouble == "deposed";
      } else if (kind == "unknown") {
        ++report_.unknown;
      } else if (kind == "watch") {
        history_.watches.push_back({process, 0, {}});
        words >> history_.watches.back().from;
      } else if (kind == "seen") {
        auto& [revision, name] = history_.watches.back().orders.emplace_back();
        words >> revision >> name;
        ++report_.seen;
      } else if (kind == "trouble") {
        ++report_.troubles;
      }
    }
    for (auto& [id, append] : open) history_.appends.push_back(std::move(append));
  }

  void read_log() {
    EtcdStore keys(etcd_.connect());
    StoreMark mark;
    OrderStore orders(keys, mark, kTortured);
    auto text = orders.read(1, host_now() + std::chrono::seconds(30));
    if (!text) throw std::runtime_error("the log cannot be read: " + text.error().text);
    history_.log = std::move(text->orders);
    std::set<Epoch> epochs;
    for (const OrderSeen& order : history_.log) epochs.insert(order.epoch);
    report_.epochs = epochs.size();
  }

  const TorturePlan plan_;
  std::mt19937_64 random_;
  system_test::TempFolder folder_;
  EtcdCluster etcd_;
  std::vector<std::unique_ptr<ChildProcess>> workers_;
  std::vector<std::string> files_;
  std::set<std::size_t> stopped_;
  std::multimap<HostTime, std::function<void()>> later_;
  ToldHistory history_;
  TortureReport report_;
};

}  // namespace

TortureReport torture(const TorturePlan& plan) { return Torture(plan).run(); }

std::string TortureReport::text() const {
  std::string out = fmt::format(
      "{} appends done, {} refused for good ({} deposed), {} unknown; {} epochs in the log; {} "
      "orders "
      "seen by watches, {} troubles told; members {} killed, {} stopped; processes {} killed, {} "
      "stopped\n",
      done, never, deposed, unknown, epochs, seen, troubles, members_killed, members_stopped,
      workers_killed, workers_stopped);
  for (const std::string& contradiction : contradictions)
    out += "CONTRADICTION: " + contradiction + "\n";
  return out;
}

}  // namespace skerry::fleet
