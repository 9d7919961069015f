// Hosts of a fleet with all their threads, over a store in memory.
#include "server/fleet/member/member.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include "tests/unit/fleet/shared_store.hpp"

namespace skerry::fleet {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::HasSubstr;

using Given = std::vector<std::pair<Tick, std::string>>;  // tick, order

// A world that is what orders it was given, and when.
class OrderedWorld final : public Exercise {
 public:
  void run_to(Tick tick) override {
    const std::lock_guard lock(mutex_);
    EXPECT_GE(tick, tick_);
    tick_ = tick;
  }
  void give(const OrderSeen& order) override {
    const std::lock_guard lock(mutex_);
    EXPECT_EQ(order.tick, tick_ + 1) << order.order;
    given_.emplace_back(order.tick, order.order);
  }
  void refused(const std::string& id, const std::string& text) override {
    const std::lock_guard lock(mutex_);
    refused_.push_back(id + ": " + text);
  }
  void keep() override {
    const std::lock_guard lock(mutex_);
    kept_ = {tick_, given_};
  }
  void come_back(Back to) override {
    const std::lock_guard lock(mutex_);
    ++came_back_;
    std::tie(tick_, given_) = to == Back::kept ? kept_ : std::pair<Tick, Given>();
    spoilt_ = false;
  }
  WorldDigest digest() const override {
    const std::lock_guard lock(mutex_);
    std::size_t hash = tick_ + spoilt_;
    for (const auto& [tick, order] : given_)
      hash = hash * 31 + tick * 7 + std::hash<std::string>()(order);
    WorldDigest digest{};
    for (int i = 0; i < 8; ++i) digest[i] = static_cast<std::uint8_t>(hash >> (8 * i));
    return digest;
  }
  void hold(const std::vector<HostTime>& until) override {
    const std::lock_guard lock(mutex_);
    until_ = until;
  }

  Given given() const {
    const std::lock_guard lock(mutex_);
    return given_;
  }
  bool has(const std::string& text) const {
    const std::lock_guard lock(mutex_);
    return std::any_of(given_.begin(), given_.end(),
                       [&](const auto& each) { return each.second == text; });
  }
  std::vector<std::string> refusals() const {
    const std::lock_guard lock(mutex_);
    return refused_;
  }
  int came_back() const {
    const std::lock_guard lock(mutex_);
    return came_back_;
  }
  bool holds(std::size_t ship) const {
    const std::lock_guard lock(mutex_);
    return ship < until_.size() && until_[ship] > host_now();
  }
  void spoil() {
    const std::lock_guard lock(mutex_);
    spoilt_ = true;
  }

 private:
  mutable std::mutex mutex_;
  Tick tick_ = 0;
  Given given_;
  std::pair<Tick, Given> kept_;
  std::vector<std::string> refused_;
  std::vector<HostTime> until_;
  int came_back_ = 0;
  bool spoilt_ = false;
};

constexpr std::size_t kShips = 6;

struct FleetMember {
  FleetMember(SharedCluster& cluster, const std::string& host,
              const std::string& scenario = "scenario 1")
      : member({.exercise = "e",
                .host = host,
                .ships = kShips,
                .charter = {"version 1", scenario},
                .native = host + ":7410",
                .web = "http://" + host + "/",
                .store = [this, &cluster] { return std::make_unique<SharedStore>(cluster, cut); }},
               world) {
    member.start();
  }
  ~FleetMember() { member.stop(); }

  std::atomic<bool> cut{false};
  OrderedWorld world;
  Member member;
};

class Members : public testing::Test {
 protected:
  void start(const std::string& name) {
    members_.push_back(std::make_unique<FleetMember>(cluster_, name));
  }
  // Meanwhile no ship is ever two hosts'.
  bool await(const std::function<bool()>& done, seconds most = seconds(20)) {
    const HostTime end = host_now() + most;
    while (host_now() < end) {
      for (std::size_t ship = 0; ship < kShips; ++ship) {
        int holders = 0;
        for (const auto& member : members_) holders += member->world.holds(ship);
        EXPECT_LE(holders, 1) << "ship " << ship;
      }
      if (done()) return true;
      std::this_thread::sleep_for(milliseconds(5));
    }
    return false;
  }
  bool all_held() const {
    for (std::size_t ship = 0; ship < kShips; ++ship) {
      int holders = 0;
      for (const auto& member : members_) holders += member->world.holds(ship);
      if (holders != 1) return false;
    }
    return true;
  }
  std::size_t held(std::size_t member) const {
    std::size_t count = 0;
    for (std::size_t ship = 0; ship < kShips; ++ship) count += members_[member]->world.holds(ship);
    return count;
  }
  bool all_follow() const {
    for (const auto& member : members_) {
      if (member->member.view().standing != "following" || !member->member.time()) return false;
    }
    return true;
  }
  std::string order(std::size_t member, const std::string& order) {
    const std::string id = fmt::format("id-{}", ids_++);
    members_[member]->member.order(id, order);
    return id;
  }
  // Again as long as it is refused: on a busy machine grants may be late.
  void order_surely(std::size_t member, const std::string& text) {
    const OrderedWorld& world = members_[member]->world;
    for (;;) {
      const std::string id = order(member, text);
      bool refused = false;
      ASSERT_TRUE(await([&] {
        for (const std::string& refusal : world.refusals())
          refused |= refusal.starts_with(id + ":");
        return refused || world.has(text);
      }));
      if (!refused) return;
    }
  }
  bool all_were_given(std::size_t orders) const {
    for (const auto& member : members_) {
      if (member->world.given().size() != orders) return false;
    }
    return true;
  }

  SharedCluster cluster_;
  std::vector<std::unique_ptr<FleetMember>> members_;
  int ids_ = 0;
};

TEST_F(Members, HaveTheSameOrdersAtTheSameTicksAndShareTheShips) {
  for (const char* const name : {"a", "b", "c"}) start(name);
  ASSERT_TRUE(await([&] { return all_follow() && all_held() && held(0) == 2 && held(1) == 2; }));
  for (int i = 0; i < 9; ++i)
    order_surely(static_cast<std::size_t>(i % 3), fmt::format("order {}", i));
  ASSERT_TRUE(await([&] { return all_were_given(9); }));
  EXPECT_EQ(members_[0]->world.given(), members_[1]->world.given());
  EXPECT_EQ(members_[0]->world.given(), members_[2]->world.given());
  // Who comes later has all of it, too.
  start("d");
  ASSERT_TRUE(await([&] { return all_follow() && all_held() && all_were_given(9); }));
  EXPECT_EQ(members_[0]->world.given(), members_[3]->world.given());
  ASSERT_TRUE(await([&] {
    const MemberView view = members_[3]->member.view();
    return view.hosts.size() == 4 && view.hosts[0].tick > 0;
  }));
  EXPECT_EQ(members_[3]->member.view().hosts[0].web, "http://a/");
  EXPECT_NE(members_[3]->member.view().leader, "");
}

TEST_F(Members, TakeTheShipsOfOneThatIsKilledAndTheLead) {
  for (const char* const name : {"a", "b", "c"}) start(name);
  ASSERT_TRUE(await([&] { return all_follow() && all_held(); }));
  order_surely(0, "before");
  ASSERT_TRUE(await([&] { return all_were_given(1); }));
  members_[0]->cut = true;  // so that it gives nothing back
  members_.erase(members_.begin());
  ASSERT_TRUE(await([&] { return all_held(); }));
  ASSERT_TRUE(await([&] { return all_follow() && !members_[0]->member.view().leader.empty(); }));
  EXPECT_NE(members_[0]->member.view().leader, "a");
  order_surely(0, "after");
  ASSERT_TRUE(await([&] { return all_were_given(2); }));
  EXPECT_EQ(members_[0]->world.given(), members_[1]->world.given());
}

TEST_F(Members, GiveTheirShipsUpAtOnceWhenTheyStop) {
  for (const char* const name : {"a", "b"}) start(name);
  ASSERT_TRUE(await([&] { return all_follow() && all_held() && held(0) == 3; }));
  members_[1]->member.stop();
  cluster_.with([](MemoryCluster& cluster, HostTime) {
    for (const auto& [key, value] : cluster.keys()) EXPECT_NE(value.value, "b") << key;
  });
  ASSERT_TRUE(await([&] { return held(0) == kShips; }));
}

TEST_F(Members, OneThatIsCutOffRunsFreeWithoutShipsAndComesBack) {
  start("a");  // leads
  ASSERT_TRUE(await([&] { return all_follow(); }));
  start("b");
  ASSERT_TRUE(await([&] { return all_follow() && all_held() && held(1) == 3; }));
  members_[1]->cut = true;
  ASSERT_TRUE(await([&] { return members_[1]->member.view().standing == "free"; }));
  order(1, "of one that is cut off");
  order_surely(0, "of the others");
  ASSERT_TRUE(await([&] { return members_[1]->world.refusals().size() == 1; }));
  EXPECT_THAT(members_[1]->world.refusals().front(), HasSubstr("is cut off"));
  EXPECT_THAT(members_[1]->member.view().refusal, HasSubstr("is cut off"));
  ASSERT_TRUE(await([&] { return held(0) == kShips; })) << "the other takes all";
  EXPECT_EQ(held(1), 0u);
  // Its orders were in its past: it comes back to before them.
  members_[1]->cut = false;
  ASSERT_TRUE(await([&] { return all_follow() && all_were_given(1); }));
  EXPECT_GE(members_[1]->world.came_back(), 1);
  EXPECT_EQ(members_[0]->world.given(), members_[1]->world.given());
  ASSERT_TRUE(await([&] { return all_held() && held(1) == 3; }));
}

TEST_F(Members, OneWhoseWorldDiffersComesBackByTheWholeLog) {
  for (const char* const name : {"a", "b", "c"}) start(name);
  ASSERT_TRUE(await([&] { return all_follow() && all_held(); }));
  order_surely(2, "order");
  ASSERT_TRUE(await([&] { return all_were_given(1); }));
  members_[2]->world.spoil();
  ASSERT_TRUE(await([&] { return members_[2]->world.came_back() >= 1; }));
  ASSERT_TRUE(await([&] { return all_follow() && all_held() && all_were_given(1); }));
  EXPECT_EQ(members_[0]->world.given(), members_[2]->world.given());
}

TEST_F(Members, OneOfAnotherScenarioIsRefusedWithBothNamed) {
  start("a");
  ASSERT_TRUE(await([&] { return all_follow(); }));
  FleetMember other(cluster_, "b", "scenario 2");
  ASSERT_TRUE(await([&] { return other.member.ended().has_value(); }));
  EXPECT_THAT(*other.member.ended(), HasSubstr("here it is \"scenario 2\", there \"scenario 1\""));
  EXPECT_FALSE(other.member.time());
}

}  // namespace
}  // namespace skerry::fleet
