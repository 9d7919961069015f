// `skerry targets` against fake servers: what it asks, and what it makes of the answers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <google/protobuf/util/json_util.h>

#include <functional>
#include <mutex>

#include "tests/unit/clients/fake_server.hpp"
#include "tests/unit/clients/made_targets.hpp"
#include "tests/unit/clients/program.hpp"

namespace skerry::client {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

struct Outcome {
  int code;
  std::string out, err;
};

Outcome run(std::vector<std::string> words) {
  words.insert(words.begin(), "targets");
  Program program(std::move(words));
  const int code = program.wait();
  return {code, program.out(), program.err()};
}

// A server with a plotter that sends `list` when it is asked for targets, and answers orders.
class Plotter {
 public:
  // What it answers to an order, and the list that it sends after that.
  using Answer = std::function<wire::Reply(const wire::TargetOrder&, wire::TargetList&)>;

  explicit Plotter(
      wire::TargetList list, Answer answer = [](const auto&, auto&) { return wire::Reply(); })
      : list_(std::move(list)), answer_(std::move(answer)) {}

  Outcome run(std::vector<std::string> words) {
    words.insert(words.end(), {"--port", std::to_string(server_.port())});
    return client::run(std::move(words));
  }
  // Once run() has ended.
  std::vector<wire::Subscribe> subscriptions() const {
    const std::lock_guard lock(mutex_);
    return subscriptions_;
  }
  std::vector<wire::TargetOrder> orders() const {
    const std::lock_guard lock(mutex_);
    return orders_;
  }

 private:
  void send_list(FakePeer& peer) {
    wire::ServerMessage message;
    *message.mutable_targets() = list_;
    peer.send(message);
  }
  void serve(FakePeer& peer) {
    peer.say_hello();
    while (const auto message = peer.receive()) {
      const std::lock_guard lock(mutex_);
      if (message->has_subscribe()) {
        subscriptions_.push_back(message->subscribe());
        peer.answer(message->request());
      } else if (message->has_target_order()) {
        orders_.push_back(message->target_order());
        const wire::Reply reply = answer_(message->target_order(), list_);
        peer.answer(message->request(), reply.code(), reply.text());
      }
      send_list(peer);
    }
  }

  mutable std::mutex mutex_;
  wire::TargetList list_;
  Answer answer_;
  std::vector<wire::Subscribe> subscriptions_;
  std::vector<wire::TargetOrder> orders_;
  FakeServer server_{[this](FakePeer& peer) { serve(peer); }};
};

wire::Reply reply_of(wire::Reply::Code code, const std::string& text) {
  wire::Reply reply;
  reply.set_code(code);
  reply.set_text(text);
  return reply;
}

// The one order that these words make.
wire::TargetOrder order_of(const std::vector<std::string>& words, const std::string& told,
                           const wire::TargetList& list = made_list()) {
  Plotter plotter(list);
  const Outcome outcome = plotter.run(words);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, told) << outcome.err;
  EXPECT_EQ(plotter.orders().size(), 1u);
  return plotter.orders().empty() ? wire::TargetOrder() : plotter.orders().front();
}

TEST(TargetsCli, ShowsTheFirstListThatComes) {
  Plotter plotter(made_list());
  const Outcome shown = plotter.run({"--radar", "1", "--view", "3"});
  EXPECT_EQ(shown.code, 0) << shown.err;
  EXPECT_THAT(shown.out, StartsWith("TARGETS  3 of 100"));
  ASSERT_EQ(plotter.subscriptions().size(), 1u);
  EXPECT_EQ(plotter.subscriptions()[0].ShortDebugString(),
            "radar: 1 view: 3 no_spokes: true targets_hz: 2");
  EXPECT_TRUE(plotter.orders().empty());
}

TEST(TargetsCli, WritesJsonAndCsv) {
  wire::TargetList read;
  const Outcome json = Plotter(made_list()).run({"--json"});
  ASSERT_TRUE(google::protobuf::util::JsonStringToMessage(json.out, &read).ok());
  EXPECT_EQ(read.SerializeAsString(), made_list().SerializeAsString());
  EXPECT_THAT(Plotter(made_list()).run({"--csv", "--by", "range"}).out,
              StartsWith("kind,number,mmsi"));
}

TEST(TargetsCli, SaysThatAPlotterHasSeenNothingYet) {
  const Outcome none = Plotter(wire::TargetList()).run({});
  EXPECT_EQ(none.code, 0);
  EXPECT_THAT(none.out, HasSubstr("no targets\n"));
  EXPECT_THAT(none.err, HasSubstr("--wait"));
}

TEST(TargetsCli, SaysThatAServerHasNoPlotter) {
  FakeServer server([](FakePeer& peer) {
    peer.say_hello();
    if (peer.accept_subscription()) peer.wait_until_client_leaves();
  });
  const Outcome outcome =
      run({"silence", "--timeout", "0.3", "--port", std::to_string(server.port())});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("told no targets of radar 0 view 0"));
}

TEST(TargetsCli, WordsBecomeOrders) {
  EXPECT_EQ(order_of({"cancel", "3", "7"}, "cancelled: 3, 7\n").ShortDebugString(),
            "cancel: 3 cancel: 7");
  EXPECT_EQ(order_of({"cancel", "--all"}, "cancelled: all 3\n").ShortDebugString(),
            "cancel_all: true");
  EXPECT_EQ(order_of({"reference", "3"}, "target 3 is the reference\n").ShortDebugString(),
            "reference: 3");
  EXPECT_EQ(order_of({"reference", "--none"}, "no target is the reference\n").ShortDebugString(),
            "reference: 0");
  EXPECT_EQ(order_of({"test", "off"}, "test targets off\n").ShortDebugString(),
            "test_targets: false");
  EXPECT_EQ(order_of({"silence"}, "silenced\n").ShortDebugString(), "silence: true");
  EXPECT_EQ(order_of({"ais", "activate", "257000002"}, "activated: 257000002\n").activate(0),
            257000002u);
  EXPECT_EQ(order_of({"ais", "sleep", "257000002"}, "asleep: 257000002\n").let_sleep(0),
            257000002u);
  EXPECT_EQ(order_of({"trial", "--end"}, "the trial has ended\n").ShortDebugString(),
            "end_trial: true");
  EXPECT_EQ(order_of({"rules", "--cpa", "0.5", "--acquire", "all", "--lost-warnings", "off"},
                     "acquire all, CPA limit 0.5 NM, lost warnings off\n")
                .rules()
                .ShortDebugString(),
            "acquire: AUTO_ACQUIRE_ALL cpa_nm: 0.5 lost_warnings: false");
  EXPECT_EQ(order_of({"rules", "--default"}, "all as at the start\n").ShortDebugString(),
            "default_rules: true");
  EXPECT_EQ(order_of({"zone", "2", "--inner", "1", "--outer", "4", "--from", "300", "--to", "60",
                      "--relative", "--excludes"},
                     "zone 2: excludes, 1.00 to 4.00 NM, 300.0 to 060.0 from the bow\n")
                .zones(0)
                .ShortDebugString(),
            "number: 2 kind: EXCLUDES inner_nm: 1 outer_nm: 4 from_deg: 300 to_deg: 60 relative: "
            "true");
  EXPECT_EQ(order_of({"zone", "2", "--remove"}, "zone 2: removed\n").ShortDebugString(),
            "remove_zones: 2");
}

TEST(TargetsCli, AnOrderHasTheViewAndTheToken) {
  const wire::TargetOrder order =
      order_of({"--radar", "2", "silence", "--view", "5", "--token", "secret"}, "silenced\n");
  EXPECT_EQ(order.ShortDebugString(), "radar: 2 view: 5 token: \"secret\" silence: true");
}

TEST(TargetsCli, WithoutOptionsRulesAreShown) {
  Plotter plotter(made_list());
  const Outcome shown = plotter.run({"rules"});
  EXPECT_EQ(shown.code, 0) << shown.err;
  EXPECT_THAT(shown.out, HasSubstr("CPA limit            1 NM       --cpa"));
  EXPECT_TRUE(plotter.orders().empty());
}

TEST(TargetsCli, WhatTheServerRefusesIsSaidInItsWords) {
  Plotter plotter(made_list(), [](const auto&, auto&) {
    return reply_of(wire::Reply::UNKNOWN, "target 9 is not tracked");
  });
  const Outcome refused = plotter.run({"cancel", "9"});
  EXPECT_EQ(refused.code, 1);
  EXPECT_EQ(refused.out, "");
  EXPECT_THAT(refused.err, HasSubstr("target 9 is not tracked"));
}

TEST(TargetsCli, AnEchoIsLookedForUntilItHasBeenSeen) {
  int asked = 0;
  Plotter plotter(made_list(), [&](const auto&, auto&) {
    return ++asked < 3 ? reply_of(wire::Reply::UNKNOWN, "no echo there")
                       : reply_of(wire::Reply::OK, "12");
  });
  const Outcome found = plotter.run({"acquire", "--range", "3.2", "--bearing", "45"});
  EXPECT_EQ(found.code, 0) << found.err;
  EXPECT_EQ(found.out, "target 12 is tracked\n");
  ASSERT_EQ(plotter.orders().size(), 3u);
  EXPECT_EQ(plotter.orders()[2].acquire().ShortDebugString(), "range_nm: 3.2 bearing_deg: 45");

  Plotter nothing(made_list(), [](const auto&, auto&) {
    return reply_of(wire::Reply::UNKNOWN, "no echo there");
  });
  const Outcome none = nothing.run({"acquire", "--lat", "-60.5", "--lon", "5", "--wait", "0"});
  EXPECT_EQ(none.code, 1);
  EXPECT_THAT(none.err, HasSubstr("no echo there"));
  EXPECT_EQ(nothing.orders().size(), 1u);
  EXPECT_EQ(nothing.orders()[0].acquire().ShortDebugString(),
            "latitude_deg: -60.5 longitude_deg: 5");

  Plotter full(made_list(), [](const auto&, auto&) {
    return reply_of(wire::Reply::REFUSED, "100 targets are tracked, which is the capacity");
  });
  EXPECT_EQ(full.run({"acquire", "--range", "3.2", "--bearing", "45"}).code, 1);
  EXPECT_EQ(full.orders().size(), 1u) << "another refusal is final";
}

TEST(TargetsCli, ATrialIsShownOnceItsOutcomesHaveCome) {
  wire::TargetList list = made_list();
  list.mutable_trial()->mutable_order()->set_course_deg(10.0);  // of before
  Plotter plotter(list, [](const wire::TargetOrder& order, wire::TargetList& next) {
    *next.mutable_trial()->mutable_order() = order.trial();
    auto* outcome = next.mutable_trial()->add_outcomes();
    outcome->set_target(3);
    outcome->set_cpa_nm(2.5);
    return wire::Reply();
  });
  const Outcome tried = plotter.run({"trial", "--course", "90", "--speed", "12", "--delay", "5"});
  EXPECT_EQ(tried.code, 0) << tried.err;
  EXPECT_THAT(tried.out, StartsWith("trial: course 090.0 at 12.0 kn in 5.0 min"));
  EXPECT_THAT(tried.out, HasSubstr("        3    2.50"));
}

TEST(TargetsCli, AcknowledgesWhatIsNamedOrAllThatIsOpen) {
  wire::TargetList list = made_list();
  *list.add_alerts() = made_alert(1, wire::ALERT_ACTIVE);
  *list.add_alerts() = made_alert(2, wire::ALERT_ACKNOWLEDGED);
  *list.add_alerts() = made_alert(3, wire::ALERT_SILENCED);
  *list.add_alerts() = made_alert(4, wire::ALERT_ACTIVE);
  list.mutable_alerts(3)->set_priority(wire::ALERT_CAUTION);
  const auto told = [](int instance) {
    return "acknowledged: alarm 3044." + std::to_string(instance) +
           " CPA/TCPA: Target 3: CPA 0.2 NM in 8 min\n";
  };
  EXPECT_EQ(order_of({"acknowledge"}, told(1) + told(3), list).ShortDebugString(),
            "acknowledge { number: 3044 instance: 1 } acknowledge { number: 3044 instance: 3 }");
  EXPECT_EQ(order_of({"acknowledge", "3044.3"}, told(3), list).ShortDebugString(),
            "acknowledge { number: 3044 instance: 3 }");
  EXPECT_EQ(order_of({"acknowledge", "3044"}, told(1) + told(3), list).ShortDebugString(),
            "acknowledge { number: 3044 }");
  Plotter calm(made_list());
  EXPECT_EQ(calm.run({"acknowledge"}).out, "nothing to acknowledge\n");
  EXPECT_TRUE(calm.orders().empty());
}

TEST(TargetsCli, WatchWritesALineForEachChangeUntilItsTimeIsOver) {
  FakeServer server([](FakePeer& peer) {
    peer.say_hello();
    if (!peer.accept_subscription()) return;
    wire::ServerMessage message;
    *message.mutable_targets() = made_list();
    peer.send(message);
    peer.send(message);
    message.mutable_targets()->mutable_targets(0)->set_state(wire::TARGET_LOST);
    peer.send(message);
    peer.wait_until_client_leaves();
  });
  const Outcome watched = run({"watch", "--for", "0.5", "--port", std::to_string(server.port())});
  EXPECT_EQ(watched.code, 0) << watched.err;
  EXPECT_EQ(watched.out, "watching radar 0 view 0 at 127.0.0.1:" + std::to_string(server.port()) +
                             ": 3 of 100 targets\n"
                             "11:06:40  target 2: lost, 5.00 NM, 045.0, course 180.0 at 12.0 kn\n");
}

TEST(TargetsCli, EndsWithTwoWhenTheCommandLineIsWrong) {
  const std::vector<std::vector<std::string>> wrong = {
      {"dance"},
      {"--by", "name"},
      {"--json", "--csv"},
      {"--json", "watch"},
      {"--wait", "nan"},
      {"watch", "--for", "-1"},
      {"acquire"},
      {"acquire", "--range", "3"},
      {"acquire", "--range", "3", "--lon", "5"},
      {"acquire", "--range", "3", "--bearing", "4", "--lat", "5", "--lon", "6"},
      {"acquire", "--range", "nan", "--bearing", "4"},
      {"cancel"},
      {"cancel", "one"},
      {"cancel", "3", "--all"},
      {"reference"},
      {"reference", "0"},
      {"reference", "3", "--none"},
      {"rules", "--cpa", "near"},
      {"rules", "--capacity", "12.5"},
      {"rules", "--capacity", "-1"},
      {"rules", "--acquire", "some"},
      {"zone"},
      {"zone", "1"},
      {"zone", "1", "--outer", "3", "--remove"},
      {"trial"},
      {"trial", "--course", "90"},
      {"trial", "--end", "--course", "90"},
      {"test"},
      {"test", "perhaps"},
      {"acknowledge", "CPA"},
      {"acknowledge", "3044."},
      {"acknowledge", "3044.0"},
      {"acknowledge", "3044.1.2"},
      {"acknowledge", "99999999999"},
      {"ais"},
      {"ais", "activate"},
      {"ais", "wake", "257000002"}};
  for (const auto& words : wrong) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, 2) << testing::PrintToString(words);
    EXPECT_NE(outcome.err, "") << testing::PrintToString(words);
    EXPECT_EQ(outcome.out, "") << testing::PrintToString(words);
  }
}

TEST(TargetsCli, EachPartSaysMoreWithHelp) {
  for (const char* part : {"watch", "acquire", "cancel", "rules", "zone", "reference", "trial",
                           "test", "acknowledge", "silence", "ais"}) {
    const Outcome help = run({part, "--help"});
    EXPECT_EQ(help.code, 0) << part;
    EXPECT_THAT(help.out, HasSubstr("--view")) << part;
  }
}

}  // namespace
}  // namespace skerry::client
