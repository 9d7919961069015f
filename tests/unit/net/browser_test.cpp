// What browsers carry and say: cookie, subprotocol, Origin, Fetch Metadata, policies.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "server/net/http/carried_token.hpp"
#include "tests/unit/net/server_with_users.hpp"
#include "tests/unit/net/test_web_socket.hpp"

namespace skerry::server {
namespace {

using signalk::Json;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr const char* kOwnHost = "127.0.0.9";

TEST(TokenCookie, IsFoundAmongOthers) {
  EXPECT_EQ(cookie_token("__Host-skerry=abc"), "abc");
  EXPECT_EQ(cookie_token("a=b; __Host-skerry=abc ;c=d"), "abc");
  EXPECT_EQ(cookie_token("__Host-skerry=a=b"), "a=b");
  for (const char* none :
       {"", ";", "=", "__Host-skerry", "__host-skerry=abc", "x__Host-skerry=abc", "skerry=abc",
        "a=__Host-skerry=abc", "__Host-skerry=", "__Host-skerry=abc; __Host-skerry=def"}) {
    EXPECT_EQ(cookie_token(none), "") << none;
  }
}

TEST(TokenCookie, IsForEncryptedPagesOfThisHostAlone) {
  EXPECT_EQ(cookie_with("skerry_x"),
            "__Host-skerry=skerry_x; Path=/; Secure; HttpOnly; SameSite=Strict");
  EXPECT_EQ(cookie_without_token(),
            "__Host-skerry=; Path=/; Secure; HttpOnly; SameSite=Strict; Max-Age=0");
}

TEST(Subprotocols, AreOursAndTheToken) {
  EXPECT_TRUE(offered_subprotocols("skerry").skerry);
  const OfferedSubprotocols both = offered_subprotocols("skerry.token.skerry_A-b, skerry");
  EXPECT_TRUE(both.skerry);
  EXPECT_EQ(both.token, "skerry_A-b");
  EXPECT_EQ(offered_subprotocols("skerry.token.a,skerry.token.b").token, "a");
  for (const char* none : {"", ",", "skerry.token", "Skerry", "x.skerry.token.a"}) {
    EXPECT_FALSE(offered_subprotocols(none).skerry) << none;
    EXPECT_EQ(offered_subprotocols(none).token, "") << none;
  }
}

class Browser : public ServerWithUsers {
 protected:
  static std::string asks_for_cookie(const std::string& name, const std::string& password) {
    return Json{{"name", name}, {"password", password}, {"cookie", true}}.dump();
  }
  // "Cookie: __Host-skerry=TOKEN\r\n" of Anna, who has signed in on the server's own host.
  std::string cookie_of_anna() {
    const Answer answer =
        http("POST", "/login", asks_for_cookie("Anna", kPassword), {}, {}, kOwnHost);
    EXPECT_FALSE(signalk::read_json(answer.body)->contains("token"));
    const std::string set = answer.header("Set-Cookie");
    return "Cookie: " + set.substr(0, set.find(';')) + "\r\n";
  }
  std::string origin() { return "Origin: http://localhost\r\n"; }
};

TEST_F(Browser, HasTheTokenInACookieOnTheOwnHost) {
  start();
  const std::string cookie = cookie_of_anna();
  EXPECT_THAT(cookie, StartsWith("Cookie: __Host-skerry=skerry_"));
  EXPECT_THAT(http("GET", "/status", {}, {}, cookie).head, StartsWith("HTTP/1.1 200"));
  EXPECT_EQ((*signalk::read_json(http("GET", "/login", {}, {}, cookie).body))["name"], "Anna");
  TestWebSocket socket(
      server_->http_port(), "/ws",
      cookie + "Origin: http://localhost:" + std::to_string(server_->http_port()) + "\r\n");
  EXPECT_TRUE(wait_until([&] {
    for (const AuditEntry& entry : audit_.entries()) {
      if (entry.from.starts_with("console ") && entry.who == "Anna, instructor") return true;
    }
    return false;
  })) << "the WebSocket is hers from its first byte";
}

TEST_F(Browser, HasItInTheBodyWhereACookieWouldNotBeSafe) {
  start();
  const Answer plain = http("POST", "/login", asks_for_cookie("Anna", kPassword));
  EXPECT_EQ(plain.header("Set-Cookie"), "");
  EXPECT_TRUE(signalk::read_json(plain.body)->contains("token"));
  const Answer program = http("POST", "/login", who("Anna", kPassword), {}, {}, kOwnHost);
  EXPECT_EQ(program.header("Set-Cookie"), "") << "who does not ask for a cookie gets none";
}

TEST_F(Browser, SigningOutTakesTheCookieAway) {
  start();
  const std::string cookie = cookie_of_anna();
  const Answer out = http("DELETE", "/login", {}, {}, cookie + origin());
  EXPECT_THAT(out.head, StartsWith("HTTP/1.1 200"));
  EXPECT_EQ(out.header("Set-Cookie"), cookie_without_token());
  EXPECT_THAT(http("GET", "/status", {}, {}, cookie).head, StartsWith("HTTP/1.1 401"));
  EXPECT_EQ(http("GET", "/login", {}, {}, cookie).header("Set-Cookie"), cookie_without_token())
      << "a browser that still has it is nobody again";
}

TEST_F(Browser, ABearerGoesBeforeTheCookie) {
  start();
  const std::string cookie = cookie_of_anna();
  const std::string tom = sign_in("Tom", "battery staple")["token"];
  EXPECT_EQ((*signalk::read_json(http("GET", "/login", {}, tom, cookie).body))["name"], "Tom");
  EXPECT_THAT(http("GET", "/status", {}, "skerry_guess", cookie).head, StartsWith("HTTP/1.1 401"));
}

// A page of another site makes the browser send the cookie.  What it may say of itself is what
// browsers let it.
TEST_F(Browser, PagesOfOtherSitesCannotUseTheCookie) {
  config_.setups = (folder_ / "setups").string();
  start();
  const std::string cookie = cookie_of_anna();
  const std::string port = std::to_string(server_->http_port());
  const std::vector<std::string> others = {
      "Origin: http://evil.example\r\n",
      "Origin: http://localhost:1\r\n",  // another port is another origin, though the same site
      "Origin: null\r\n",                // a page in a sandbox
      "Origin: https://localhost\r\n"
      "Sec-Fetch-Site: cross-site\r\n",
      "Origin: http://localhost\r\nOrigin: http://localhost\r\n",
      "Sec-Fetch-Site: cross-site\r\n",
      "Sec-Fetch-Site: same-site\r\n",
      "Origin: http://localhost\r\nSec-Fetch-Site: cross-site\r\n",
      "",  // an old browser's form
  };
  int refused = 0;
  const std::string document =
      R"({"kind": "skerry set-up", "version": 1, "name": "a", "parts": {}})";
  for (const std::string& other : others) {
    for (const std::string& type :
         {std::string(), std::string("Content-Type: text/plain\r\n"),
          std::string("Content-Type: application/x-www-form-urlencoded\r\n")}) {
      const std::string headers = cookie + other + type;
      for (const auto& [method, path] :
           {std::pair("DELETE", "/login"), std::pair("POST", "/login"),
            std::pair("PUT", "/setups/a"), std::pair("DELETE", "/setups/a")}) {
        const Answer answer = http(method, path, document, {}, headers);
        EXPECT_THAT(answer.head,
                    testing::AnyOf(StartsWith("HTTP/1.1 403"), StartsWith("HTTP/1.1 400 ")))
            << method << " " << path << " " << other;
        EXPECT_THAT(answer.body, Not(HasSubstr("expected {"))) << "it was not even looked at";
        ++refused;
      }
    }
    EXPECT_THROW(TestWebSocket(server_->http_port(), "/ws", cookie + other), std::runtime_error)
        << other;
    ++refused;
  }
  std::printf("%d requests of other sites' pages with the cookie refused\n", refused);
  EXPECT_THAT(http("PUT", "/setups/a", document, {}, cookie + origin()).head,
              StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(
      http("PUT", "/setups/a", document, {}, cookie + "Sec-Fetch-Site: same-origin\r\n").head,
      StartsWith("HTTP/1.1 200"));
}

TEST_F(Browser, OfAnotherSitesPageTheCookieDoesNotEvenRead) {
  start();
  const std::string cookie = cookie_of_anna();
  for (const char* site : {"cross-site", "same-site"}) {
    EXPECT_THAT(http("GET", "/status", {}, {}, cookie + "Sec-Fetch-Site: " + site + "\r\n").head,
                StartsWith("HTTP/1.1 401"));
  }
}

TEST_F(Browser, OnTheOwnHostOtherSitesChangeNothingThoughItIsFree) {
  start();
  for (const char* other : {"Origin: http://evil.example\r\n", "Sec-Fetch-Site: cross-site\r\n"}) {
    EXPECT_THAT(http("DELETE", "/setups/a", {}, {}, other, kOwnHost).head,
                StartsWith("HTTP/1.1 403"));
  }
}

TEST_F(Browser, AWebSocketTakesTheTokenAsASubprotocolAndDoesNotSayItBack) {
  start();
  const std::string token = sign_in("Anna", kPassword)["token"];
  const auto upgrade = [&](const std::string& offered) {
    TestSocket socket(server_->http_port());
    socket.send(
        "GET /ws HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
        "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n" +
        offered + "\r\n");
    std::string head;
    while (head.find("\r\n\r\n") == std::string::npos) {
      const Bytes byte = socket.receive(1);
      if (byte.empty()) break;
      head += static_cast<char>(byte.front());
    }
    return head;
  };
  const std::string head =
      upgrade("Sec-WebSocket-Protocol: skerry, skerry.token." + token + "\r\n");
  EXPECT_THAT(head, StartsWith("HTTP/1.1 101"));
  EXPECT_THAT(head, HasSubstr("Sec-WebSocket-Protocol: skerry\r\n"));
  EXPECT_THAT(head, Not(HasSubstr(token)));
  EXPECT_THAT(upgrade(""), Not(HasSubstr("Sec-WebSocket-Protocol")));
  EXPECT_TRUE(wait_until([&] {
    for (const AuditEntry& entry : audit_.entries()) {
      if (entry.from.starts_with("console ") && entry.who == "Anna, instructor") return true;
    }
    return false;
  }));
}

}  // namespace
}  // namespace skerry::server
