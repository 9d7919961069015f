// HTTP as seen by a client: answers, limits, and who may open a WebSocket.
#include <google/protobuf/util/json_util.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <array>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "tests/unit/net/fake_host.hpp"
#include "tests/unit/net/test_client.hpp"

namespace skerry::server {
namespace {

constexpr std::array<WebFile, 1> kConsolePage = {
    {{"/index.html", "text/html; charset=utf-8", "<p>console</p>"}}};

class Http : public testing::Test {
 protected:
  Http() : server_(host_, test_config(), kConsolePage) { server_.start(); }

  std::string exchange(const std::string& request) {
    return http_exchange(server_.http_port(), request);
  }
  std::string upgrade(const std::string& headers) {
    return exchange(
        "GET /ws HTTP/1.1\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
        "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n" +
        headers + "\r\n");
  }
  std::string here() const { return "localhost:" + std::to_string(server_.http_port()); }
  static std::string body_of(const std::string& answer) {
    return answer.substr(answer.find("\r\n\r\n") + 4);
  }

  FakeHost host_;
  NetServer server_;
};

TEST_F(Http, TheConsoleIsAtTheRoot) {
  const std::string answer = http_get(server_.http_port(), "/");
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 200 OK\r\n")) << answer;
  EXPECT_NE(answer.find("Content-Type: text/html; charset=utf-8\r\n"), std::string::npos);
  EXPECT_NE(answer.find("Cache-Control: no-cache\r\n"), std::string::npos);
  EXPECT_EQ(body_of(answer), "<p>console</p>");
}

// Of pages, of data and of errors alike.
TEST_F(Http, BrowsersAreToldToGuessNothingAndToTellNobody) {
  for (const char* path : {"/", "/status", "/no-such-file"}) {
    const std::string answer = http_get(server_.http_port(), path);
    EXPECT_NE(answer.find("X-Content-Type-Options: nosniff\r\n"), std::string::npos) << path;
    EXPECT_NE(answer.find("Referrer-Policy: no-referrer\r\n"), std::string::npos) << path;
    EXPECT_EQ(answer.find("Access-Control-"), std::string::npos) << path;
  }
}

TEST_F(Http, APageMayLoadAndRunWhatIsThisServersAloneAndDataNothing) {
  const std::string page = http_get(server_.http_port(), "/");
  EXPECT_NE(page.find("Content-Security-Policy: default-src 'self'; base-uri 'none'; form-action "
                      "'self'; frame-ancestors 'self'; object-src 'none'\r\n"),
            std::string::npos)
      << page;
  for (const char* path : {"/status", "/no-such-file", "/controls.json", "/login"}) {
    const std::string data = http_get(server_.http_port(), path);
    EXPECT_NE(data.find("Content-Security-Policy: default-src 'none'; frame-ancestors 'none'\r\n"),
              std::string::npos)
        << path << data;
  }
}

TEST_F(Http, HeadHasTheLengthButNoBody) {
  const std::string answer =
      exchange("HEAD / HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 200 OK\r\n")) << answer;
  EXPECT_NE(answer.find("Content-Length: 14\r\n"), std::string::npos) << answer;
  EXPECT_EQ(body_of(answer), "");
}

TEST_F(Http, StatusIsTheStatusMessageAsJson) {
  TestClient client(server_.tcp_port());
  client.receive_hello();
  const std::string answer = http_get(server_.http_port(), "/status");
  EXPECT_NE(answer.find("Content-Type: application/json\r\n"), std::string::npos);
  wire::Status status;
  ASSERT_TRUE(google::protobuf::util::JsonStringToMessage(body_of(answer), &status).ok()) << answer;
  EXPECT_EQ(status.server(), "fake");
  ASSERT_EQ(status.clients_size(), 1);
  EXPECT_EQ(status.clients(0).transport(), "tcp");
  EXPECT_GT(status.resident_mib(), 1);
  EXPECT_NE(answer.find("\"resident_mib\""), std::string::npos) << "names as in radar.proto";
}

TEST_F(Http, MetricsAreInTheFormatThatIsAskedFor) {
  TestClient client(server_.tcp_port());
  client.receive_hello();
  const std::string plain = http_get(server_.http_port(), "/metrics?x=1");
  EXPECT_TRUE(plain.starts_with("HTTP/1.1 200 OK\r\n")) << plain;
  EXPECT_NE(plain.find("Content-Type: text/plain; version=0.0.4; charset=utf-8\r\n"),
            std::string::npos);
  EXPECT_NE(plain.find("Vary: Accept\r\n"), std::string::npos);
  EXPECT_NE(plain.find("\nskerry_clients{transport=\"tcp\"} 1\n"), std::string::npos) << plain;
  EXPECT_EQ(plain.find("127.0.0.1:"), std::string::npos) << "who they are stays in the status";
  EXPECT_EQ(plain.find("# EOF"), std::string::npos);

  const std::string open = exchange(
      "GET /metrics HTTP/1.1\r\nHost: localhost\r\nAccept: text/html\r\nAccept: "
      "application/openmetrics-text; version=1.0.0\r\nConnection: close\r\n\r\n");
  EXPECT_NE(
      open.find("Content-Type: application/openmetrics-text; version=1.0.0; charset=utf-8\r\n"),
      std::string::npos)
      << open;
  EXPECT_TRUE(open.ends_with("\n# EOF\n"));
}

TEST_F(Http, MetricsAreReadAsOtherPagesAre) {
  const std::string head =
      exchange("HEAD /metrics HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
  EXPECT_TRUE(head.starts_with("HTTP/1.1 200 OK\r\n")) << head;
  EXPECT_NE(head.find("Content-Length: "), std::string::npos);
  EXPECT_EQ(head.find("Content-Length: 0\r\n"), std::string::npos);
  EXPECT_EQ(body_of(head), "");
  EXPECT_TRUE(exchange("POST /metrics HTTP/1.1\r\nHost: localhost\r\nContent-Length: 2\r\n"
                       "Connection: close\r\n\r\nhi")
                  .starts_with("HTTP/1.1 405 "));
  EXPECT_TRUE(
      exchange("GET /metrics HTTP/1.1\r\nHost: evil.example\r\n\r\n").starts_with("HTTP/1.1 403 "));
  EXPECT_TRUE(http_get(server_.http_port(), "/metrics/").starts_with("HTTP/1.1 404 "));
}

TEST_F(Http, CountsOfClientsThatHaveGoneStayInTheMetrics) {
  const auto metrics = [&] { return http_get(server_.http_port(), "/metrics"); };
  {
    TestClient client(server_.tcp_port());
    client.receive_hello();
    client.subscribe();
    host_.publish();
    client.receive_spokes_until(FakeHost::kSectorSpokes - 1);
  }
  ASSERT_TRUE(wait_until([&] { return server_.status().clients_size() == 0; }));
  const std::string after = metrics();
  EXPECT_NE(after.find("\nskerry_clients{transport=\"tcp\"} 0\n"), std::string::npos) << after;
  EXPECT_NE(after.find("\nskerry_client_connections_total{transport=\"tcp\"} 1\n"),
            std::string::npos);
  EXPECT_NE(after.find("\nskerry_client_spokes_sent_total{transport=\"tcp\"} 16\n"),
            std::string::npos)
      << after;
}

TEST_F(Http, AConnectionServesOneRequestAfterAnother) {
  TestSocket socket(server_.http_port());
  socket.send(
      "GET / HTTP/1.1\r\nHost: localhost\r\n\r\nGET /none HTTP/1.1\r\nHost: localhost\r\n"
      "Connection: close\r\n\r\n");
  const std::string answers = socket.receive_all();
  EXPECT_TRUE(answers.starts_with("HTTP/1.1 200 OK\r\n"));
  EXPECT_NE(answers.find("HTTP/1.1 404 Not Found\r\n"), std::string::npos) << answers;
}

TEST_F(Http, WhatIsNotServedIsSaid) {
  EXPECT_TRUE(http_get(server_.http_port(), "/nothing").starts_with("HTTP/1.1 404 "));
  EXPECT_TRUE(http_get(server_.http_port(), "/../etc/passwd").starts_with("HTTP/1.1 400 "));
  EXPECT_TRUE(http_get(server_.http_port(), "/%2e%2e/etc/passwd").starts_with("HTTP/1.1 400 "));
  EXPECT_TRUE(http_get(server_.http_port(), "/ws").starts_with("HTTP/1.1 426 "));
  const std::string post = exchange(
      "POST /status HTTP/1.1\r\nHost: localhost\r\nContent-Length: 2\r\nConnection: "
      "close\r\n\r\nhi");
  EXPECT_TRUE(post.starts_with("HTTP/1.1 405 ")) << post;
  EXPECT_NE(post.find("Allow: GET, HEAD\r\n"), std::string::npos);
}

TEST_F(Http, WhatIsNoHttpIsRefused) {
  for (const char* request :
       {"nonsense\r\n\r\n", "GET /\r\n\r\n", "GET / HTTP/9.9\r\n\r\n",
        "GET / HTTP/1.1\r\nHo st: x\r\n\r\n", "\x16\x03\x01\x02", "GET / HTTP/1.1\r\n\r\n",
        "GET / HTTP/1.1\r\nHost: localhost\r\nHost: localhost\r\n\r\n"}) {
    EXPECT_TRUE(exchange(request).starts_with("HTTP/1.1 400 ")) << request;
  }
  EXPECT_TRUE(http_get(server_.http_port(), "/").starts_with("HTTP/1.1 200 ")) << "goes on";
}

TEST_F(Http, RequestsThatAreTooLongAreRefused) {
  const std::string filler(10'000, 'x');
  EXPECT_TRUE(exchange("GET / HTTP/1.1\r\nHost: localhost\r\nX: " + filler + "\r\n\r\n")
                  .starts_with("HTTP/1.1 431 "));
  EXPECT_TRUE(exchange("GET /" + filler + " HTTP/1.1\r\nHost: localhost\r\n\r\n")
                  .starts_with("HTTP/1.1 431 "));
  EXPECT_TRUE(
      exchange("POST / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 999999999\r\n\r\n" + filler)
          .starts_with("HTTP/1.1 413 "));
}

TEST(HttpTimeLimit, AConnectionThatDoesNotFinishItsRequestIsToldSoAndClosed) {
  FakeHost host;
  NetConfig config = test_config();
  config.limits.silent_time = std::chrono::milliseconds(1000);
  config.limits.request_time = std::chrono::milliseconds(200);
  NetServer server(host, config, kConsolePage);
  server.start();
  TestSocket silent(server.http_port());
  TestSocket half(server.http_port());
  half.send("GET / HTTP/1.1\r\nHos");
  const std::string late = half.receive_all();
  EXPECT_TRUE(late.starts_with("HTTP/1.1 408 ")) << late;
  EXPECT_NE(late.find("0.2 s of its first byte"), std::string::npos) << late;
  const std::string unsaid = silent.receive_all();
  EXPECT_TRUE(unsaid.starts_with("HTTP/1.1 408 ")) << unsaid;
  EXPECT_NE(unsaid.find("no request came within 1 s"), std::string::npos) << unsaid;
  EXPECT_EQ(server.status().errors().at("http too slow"), 2u);
}

// Each byte alone comes in time, the whole does not.
TEST(HttpTimeLimit, ARequestThatDripsIsToldSoAndClosed) {
  FakeHost host;
  NetConfig config = test_config();
  config.limits.request_time = std::chrono::milliseconds(300);
  NetServer server(host, config, kConsolePage);
  server.start();
  TestSocket socket(server.http_port());
  socket.send("GET / HTTP/1.1\r\nX: ");
  std::atomic<bool> over{false};
  std::thread drips([&] {
    while (!over && socket.send("x")) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  });
  const Bytes answer = socket.receive();
  over = true;
  drips.join();
  EXPECT_TRUE(std::string(answer.begin(), answer.end()).starts_with("HTTP/1.1 408 "));
}

TEST(HttpTimeLimit, AKeptConnectionThatIsIdleEndsWithoutAWord) {
  FakeHost host;
  NetConfig config = test_config();
  config.http_timeout = std::chrono::milliseconds(200);
  NetServer server(host, config, kConsolePage);
  server.start();
  TestSocket socket(server.http_port());
  socket.send("HEAD / HTTP/1.1\r\nHost: localhost\r\n\r\n");
  const std::string all = socket.receive_all();
  EXPECT_TRUE(all.starts_with("HTTP/1.1 200 ")) << all;
  EXPECT_EQ(all.find("408"), std::string::npos) << all;
}

TEST_F(Http, PagesOfOtherSitesGetNoWebSocket) {
  const std::string port = std::to_string(server_.http_port());
  for (const std::string& headers : std::vector<std::string>{
           "Host: localhost:" + port + "\r\nOrigin: http://evil.example\r\n",
           "Host: localhost:" + port + "\r\nOrigin: null\r\n",
           "Host: localhost:" + port + "\r\nOrigin: http://localhost:1\r\n",
           "Host: evil.example\r\nOrigin: http://evil.example\r\n",
           "Host: evil.example\r\n",
       }) {
    EXPECT_TRUE(upgrade(headers).starts_with("HTTP/1.1 403 ")) << headers;
  }
  EXPECT_EQ(server_.status().clients_size(), 0);
}

TEST_F(Http, ThisServersOwnPageGetsAWebSocket) {
  TestSocket socket(server_.http_port());
  socket.send(
      "GET /ws HTTP/1.1\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
      "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\nHost: " +
      here() + "\r\nOrigin: http://" + here() + "\r\n\r\n");
  const Bytes answer = socket.receive();
  EXPECT_TRUE(std::string(answer.begin(), answer.end()).starts_with("HTTP/1.1 101 "));
}

TEST_F(Http, ReboundNamesAreNotServed) {
  EXPECT_TRUE(
      exchange("GET /status HTTP/1.1\r\nHost: evil.example\r\n\r\n").starts_with("HTTP/1.1 403 "));
}

TEST(NetServer, APortInUseIsNamedWithWhatToDo) {
  FakeHost host;
  const NetServer first(host, test_config(), {});
  const auto message_of = [](const NetConfig& config) -> std::string {
    FakeHost other;
    try {
      const NetServer second(other, config, {});
      return "no error";
    } catch (const std::runtime_error& error) {
      return error.what();
    }
  };
  const auto expect_named = [&](const NetConfig& config, std::initializer_list<std::string> parts) {
    const std::string message = message_of(config);
    for (const std::string& part : parts) {
      EXPECT_NE(message.find(part), std::string::npos) << part << " in: " << message;
    }
  };
  NetConfig config = test_config();
  config.tcp_port = first.tcp_port();
  expect_named(config, {"native TCP", "127.0.0.1", std::to_string(first.tcp_port()), "--tcp-port"});
  config = test_config();
  config.http_port = first.http_port();
  expect_named(config, {"HTTP", "127.0.0.1", std::to_string(first.http_port()), "--http-port"});
  config = test_config();
  config.bind = "no address";
  expect_named(config, {"no address", "--bind"});
  config.bind = "203.0.113.1";  // an address this machine does not have
  expect_named(config, {"203.0.113.1", "--bind"});
}

// The routes of set-ups; what a set-up is has its tests in tests/unit/setups.
class HttpSetups : public testing::Test {
 protected:
  HttpSetups() {
    NetConfig config = test_config();
    config.setups = folder_;
    server_.emplace(host_, config, kConsolePage);
    server_->start();
  }
  ~HttpSetups() override {
    server_->stop();
    std::filesystem::remove_all(folder_);
  }
  std::string ask(const std::string& method, const std::string& path, const std::string& body = {},
                  const std::string& headers = {}) {
    return http_exchange(server_->http_port(),
                         method + " " + path + " HTTP/1.1\r\nHost: localhost\r\n" + headers +
                             "Connection: close\r\nContent-Length: " + std::to_string(body.size()) +
                             "\r\n\r\n" + body);
  }

  const std::string folder_ = [] {
    std::string pattern = testing::TempDir() + "skerry-http-setups-XXXXXX";
    return std::string(::mkdtemp(pattern.data()));
  }();
  const std::string document_ =
      R"({"kind": "skerry set-up", "version": 1, "name": "a b", "parts": {"keys": {}}})";
  FakeHost host_;
  std::optional<NetServer> server_;
};

TEST_F(HttpSetups, AreListedReadKeptAndDeleted) {
  EXPECT_TRUE(ask("GET", "/setups").ends_with(R"({"keeps":true,"setups":[]})"));
  EXPECT_TRUE(ask("GET", "/setups/a%20b").starts_with("HTTP/1.1 404 "));
  const std::string kept = ask("PUT", "/setups/a%20b", document_);
  EXPECT_TRUE(kept.starts_with("HTTP/1.1 200 ")) << kept;
  EXPECT_NE(kept.find(R"("name":"a b")"), std::string::npos) << "the list as it is now: " << kept;
  EXPECT_TRUE(ask("GET", "/setups/a%20b").ends_with("\r\n\r\n" + document_));
  EXPECT_TRUE(ask("HEAD", "/setups/a%20b").ends_with("\r\n\r\n"));
  EXPECT_TRUE(ask("DELETE", "/setups/a%20b").ends_with(R"({"keeps":true,"setups":[]})"));
  EXPECT_TRUE(ask("DELETE", "/setups/a%20b").starts_with("HTTP/1.1 404 "));
}

TEST_F(HttpSetups, WhatIsWrongIsRefusedWithItsReason) {
  const std::string post = ask("POST", "/setups/a", document_);
  EXPECT_TRUE(post.starts_with("HTTP/1.1 405 ")) << post;
  EXPECT_NE(post.find("Allow: GET, HEAD, PUT, DELETE\r\n"), std::string::npos) << post;
  const std::string list = ask("PUT", "/setups", document_);
  EXPECT_NE(list.find("Allow: GET, HEAD\r\n"), std::string::npos) << list;
  EXPECT_TRUE(ask("PUT", "/setups/other", document_).starts_with("HTTP/1.1 400 "));
  EXPECT_TRUE(ask("PUT", "/setups/a/../b", document_).starts_with("HTTP/1.1 405 ")) << "no path";
  const std::string other_page = "Origin: http://example.org\r\n";
  EXPECT_TRUE(ask("PUT", "/setups/a%20b", document_, other_page).starts_with("HTTP/1.1 403 "));
  EXPECT_TRUE(ask("DELETE", "/setups/a%20b", {}, other_page).starts_with("HTTP/1.1 403 "));
  EXPECT_TRUE(ask("PUT", "/setups/a", std::string(SetupShelf::kMostBytes + 1, ' '))
                  .starts_with("HTTP/1.1 413 "));
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

TEST_F(HttpSetups, AloneMayHaveALongBody) {
  const std::string body(4097, ' ');
  for (const char* path :
       {"/signalk/v2/api/vessels/self/radars/skerry0/controls/gain", "/status"}) {
    EXPECT_TRUE(ask("PUT", path, body).starts_with("HTTP/1.1 413 ")) << path;
  }
  EXPECT_TRUE(ask("PUT", "/setups/a", body).starts_with("HTTP/1.1 400 "));
}

TEST_F(Http, AServerWithoutAFolderForSetUpsSaysWhatIsMissing) {
  EXPECT_EQ(body_of(http_get(server_.http_port(), "/setups")), R"({"keeps":false,"setups":[]})");
  const std::string answer = http_get(server_.http_port(), "/setups/a");
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 404 ")) << answer;
  EXPECT_NE(answer.find("--setups"), std::string::npos) << answer;
}

}  // namespace
}  // namespace skerry::server
