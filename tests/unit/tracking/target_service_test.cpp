// The plotters' thread: whose views are plotted, and for how long.
#include "server/tracking/target_service.hpp"

#include <gtest/gtest.h>

#include <chrono>

#include "tests/unit/net/test_client.hpp"
#include "tests/unit/tracking/plotted_host.hpp"

namespace skerry::server {
namespace {

class Service : public testing::Test {
 protected:
  Service()
      : service_(host_, kNativeFormat,
                 [this](std::uint32_t radar) { return host_.own_ship(radar); }) {
    service_.start();
  }
  // Sweeps until it holds, at most two turns ahead of what the view's plotter says it has taken:
  // the ring holds not much more.
  template <typename Holds>
  bool sweep_until(std::uint32_t view, const Holds& holds) {
    return wait_until([&] {
      const auto list = service_.targets(0, view);
      const std::chrono::nanoseconds taken{list == nullptr ? 0 : list->scenario_ns()};
      if (host_.swept() - taken < std::chrono::seconds{2}) host_.turn();
      return holds();
    });
  }
  PlottedHost host_;
  TargetService service_;
};

TEST_F(Service, NobodysViewCostsNothing) {
  host_.turn(2);
  EXPECT_EQ(service_.targets(0, 0), nullptr);
  EXPECT_EQ(host_.encoded(kNativeFormat), 0u);
  EXPECT_EQ(service_.want(7, 0), nullptr);
  EXPECT_EQ(service_.want(0, 5), nullptr);
  wire::TargetOrder order;
  order.set_cancel_all(true);
  const wire::Reply refused = service_.order(order, "test");
  EXPECT_EQ(refused.code(), wire::Reply::REFUSED);
  EXPECT_NE(refused.text().find("targets_hz"), std::string::npos) << refused.text();
}

TEST_F(Service, AWantedViewIsPlottedAndItsListsComeByThemselves) {
  const auto wanted = service_.want(0, 0);
  ASSERT_NE(wanted, nullptr);
  EXPECT_EQ(service_.want(0, 0), wanted) << "one plotter for all who want it";
  ASSERT_TRUE(sweep_until(0, [&] {
    const auto list = service_.targets(0, 0);
    return list != nullptr && list->targets_size() == 1;
  }));
  const auto list = service_.targets(0, 0);
  EXPECT_EQ(list->targets(0).number(), 1u);
  EXPECT_EQ(list->spokes_lost(), 0u);
  ASSERT_TRUE(wait_until([&] { return service_.targets(0, 0) != list; })) << "another one";
}

TEST_F(Service, AViewThatIsClosedAndOpenedAnewBeginsAnew) {
  const auto open = [&] {
    return host_.open_view(0, 0, false, [](VideoChannel& channel) {
      channel.add_format(kNativeFormat, native_encoder());
    });
  };
  const auto view = open();
  auto wanted = service_.want(0, *view);
  ASSERT_NE(wanted, nullptr);
  ASSERT_TRUE(sweep_until(*view, [&] {
    const auto list = service_.targets(0, *view);
    return list != nullptr && list->targets_size() == 1;
  }));
  host_.close_view(0, *view);
  host_.count_views_from(*view - 1);
  ASSERT_EQ(open(), view) << "the same number, another view";
  const auto again = service_.want(0, *view);
  ASSERT_NE(again, wanted);
  ASSERT_TRUE(wait_until([&] { return service_.targets(0, *view) != nullptr; }));
  EXPECT_EQ(service_.targets(0, *view)->targets_size(), 0);
}

TEST_F(Service, APlotterEndsWithItsView) {
  const auto view = host_.open_view(0, 0, false, [](VideoChannel& channel) {
    channel.add_format(kNativeFormat, native_encoder());
  });
  const auto wanted = service_.want(0, *view);
  ASSERT_TRUE(sweep_until(*view, [&] { return service_.targets(0, *view) != nullptr; }));
  host_.close_view(0, *view);
  ASSERT_TRUE(wait_until([&] { return service_.targets(0, *view) == nullptr; }));
}

TEST_F(Service, StopsWhileViewsArePlotted) {
  const auto wanted = service_.want(0, 0);
  host_.turn(3);
  service_.stop();
  service_.stop();
  EXPECT_EQ(service_.targets(0, 0), nullptr);
  host_.turn(1);
}

}  // namespace
}  // namespace skerry::server
