// What consoles ask of the chart, and what they are told where nothing comes.
#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <utility>

#include "tests/unit/net/fake_host.hpp"
#include "tests/unit/net/test_client.hpp"

namespace skerry::server {
namespace {

class ChartHost final : public FakeHost {
 public:
  enum class Answers : std::uint8_t { chart, none_here, busy };
  std::atomic<Answers> answers = Answers::chart;

  bool has_chart() const override { return true; }
  void find_coastline(const wire::GetCoastline&, CoastlineDone done) override {
    answer<wire::Coastline>(done);
  }
  void find_chart_objects(const wire::GetChartObjects&, ChartObjectsDone done) override {
    answer<wire::ChartObjects>(done);
  }

 private:
  template <typename Told, typename Done>
  void answer(const Done& done) {
    if (answers == Answers::chart) return done(Told());
    done(answers == Answers::busy ? NoChart::busy : NoChart::none_here);
  }
};

wire::ClientMessage coastline_message() {
  wire::ClientMessage message;
  message.set_request(1);
  message.mutable_get_coastline()->set_radius_nm(10.0);
  return message;
}

wire::ClientMessage chart_message(double radius_nm = 10.0) {
  wire::ClientMessage message;
  message.set_request(2);
  message.mutable_get_chart_objects()->set_radius_nm(radius_nm);
  return message;
}

TEST(ChartRequests, SayWhyNothingComes) {
  ChartHost host;
  NetServer server(host, test_config(), {});
  server.start();
  TestClient client(server.tcp_port());
  EXPECT_TRUE(client.receive_hello().has_chart());
  bool came = false;
  client.on_message = [&](const wire::ServerMessage& message) {
    came = came || message.has_chart_objects() || message.has_coastline();
  };
  const auto asked = [&](const wire::ClientMessage& message) {
    came = false;
    client.send(message);
    return client.receive_reply();
  };
  for (const wire::ClientMessage& message : {coastline_message(), chart_message()}) {
    host.answers = ChartHost::Answers::chart;
    EXPECT_EQ(asked(message).code(), wire::Reply::OK);
    EXPECT_TRUE(came);

    host.answers = ChartHost::Answers::busy;
    wire::Reply reply = asked(message);
    EXPECT_EQ(reply.code(), wire::Reply::REFUSED);
    EXPECT_EQ(reply.text(), "chart: too many ask at once; ask again");
    EXPECT_FALSE(came);

    host.answers = ChartHost::Answers::none_here;
    reply = asked(message);
    EXPECT_EQ(reply.code(), wire::Reply::REFUSED);
    EXPECT_EQ(reply.text(), "chart: the server has no chart here");
    EXPECT_FALSE(came);
  }
  EXPECT_EQ(asked(chart_message(1000.0)).code(), wire::Reply::OUT_OF_RANGE);
  server.stop();
}

}  // namespace
}  // namespace skerry::server
