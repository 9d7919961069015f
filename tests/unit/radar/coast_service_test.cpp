// The coast service: who is served first, who is refused, and how it ends.
#include "server/radar/coast_service.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "tests/unit/radar/open_sea.hpp"

namespace skerry::server {
namespace {

constexpr GeoPoint kPlace{60.0, 5.0};

class CoastServiceTest : public testing::Test {
 protected:
  // Keeps the service's thread at one look until let_go().
  void hold() {
    std::promise<void> there;
    service_.look([&](const echo::ChartSource*) {
      there.set_value();
      held_.get_future().wait();
    });
    there.get_future().wait();
  }
  void let_go() { held_.set_value(); }

  CoastService service_{std::make_unique<OpenSea>(), 0, {}};
  std::promise<void> held_;
};

TEST_F(CoastServiceTest, StopsThoughALookAsksAgainEveryTime) {
  int looks = 0, refusals = 0;  // touched by the service's thread, and by this one after it
  std::promise<void> many;
  std::function<void(const echo::ChartSource*)> again = [&](const echo::ChartSource* chart) {
    if (chart == nullptr) {
      ++refusals;
      return;
    }
    if (++looks == 100) many.set_value();
    service_.look(again);
  };
  service_.start();
  service_.look(again);
  service_.look(again);
  many.get_future().wait();
  service_.stop();
  EXPECT_GE(looks, 100);
  EXPECT_EQ(refusals, 2) << "each is answered, in the end with nothing";
}

TEST_F(CoastServiceTest, WhatWaitsWhenItStopsIsCalledWithNothing) {
  int looks = 0;
  bool surveyed = false, charted = false;
  service_.look([&](const echo::ChartSource* chart) {
    ++looks;
    charted = charted || chart != nullptr;
  });
  service_.survey(kPlace, metres(100.0), [&](std::optional<echo::CoastChart> chart) {
    surveyed = true;
    charted = charted || chart.has_value();
  });
  EXPECT_EQ(looks, 0);
  service_.stop();  // never started: nothing was served
  EXPECT_EQ(looks, 1);
  EXPECT_TRUE(surveyed);
  service_.look([&](const echo::ChartSource* chart) {
    ++looks;
    charted = charted || chart != nullptr;
  });
  EXPECT_EQ(looks, 2) << "refused at once";
  EXPECT_FALSE(charted);
}

TEST_F(CoastServiceTest, SurveysOfTheSimulationComeBeforeClientsLooksAndAreNotRefusedForThem) {
  service_.start();
  hold();
  std::vector<std::string> served;  // touched by the service's thread, and by this one after it
  std::promise<void> all;
  int refused = 0;
  for (std::size_t i = 0; i < CoastService::kMaxLooks + 3; ++i) {
    service_.look([&](const echo::ChartSource* chart) {
      if (chart == nullptr)
        ++refused;
      else
        served.emplace_back("look");
      if (served.size() == CoastService::kMaxLooks + 1) all.set_value();
    });
  }
  EXPECT_EQ(refused, 3) << "those above kMaxLooks, at once";
  service_.survey(kPlace, metres(100.0), [&](std::optional<echo::CoastChart> chart) {
    served.emplace_back(chart ? "survey" : "nothing");
  });
  let_go();
  all.get_future().wait();
  service_.stop();
  ASSERT_EQ(served.size(), CoastService::kMaxLooks + 1);
  EXPECT_EQ(served.front(), "survey");
  EXPECT_EQ(served.back(), "look");
}

TEST_F(CoastServiceTest, OfSurveysOnlySoManyWait) {
  service_.start();
  hold();
  int refused = 0, done = 0;
  for (std::size_t i = 0; i < CoastService::kMaxSurveys + 2; ++i) {
    service_.survey(kPlace, metres(100.0),
                    [&](std::optional<echo::CoastChart> chart) { ++(chart ? done : refused); });
  }
  EXPECT_EQ(refused, 2);
  std::promise<void> looked;
  service_.look([&](const echo::ChartSource*) { looked.set_value(); });
  let_go();
  looked.get_future().wait();
  EXPECT_EQ(done, static_cast<int>(CoastService::kMaxSurveys)) << "before the look";
}

TEST_F(CoastServiceTest, ALookThatThrowsEndsNothing) {
  service_.start();
  service_.look([](const echo::ChartSource*) { throw std::runtime_error("torn chart"); });
  std::promise<bool> next;
  service_.look([&](const echo::ChartSource* chart) { next.set_value(chart != nullptr); });
  EXPECT_TRUE(next.get_future().get());
}

}  // namespace
}  // namespace skerry::server
