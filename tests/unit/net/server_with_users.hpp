// A server with two users, for tests that sign in over HTTP and natively.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>

#include "protocol/signalk/json.hpp"
#include "server/access/password.hpp"
#include "server/access/user_file.hpp"
#include "tests/unit/net/fake_host.hpp"
#include "tests/unit/net/kept_audit.hpp"
#include "tests/unit/net/test_client.hpp"

namespace skerry::server {

inline constexpr PasswordCost kCheap{.memory_kib = 8, .passes = 1};
inline const std::string kPassword = "correct horse";
inline const std::string kShip = "ship of radar 0", kOtherShip = "ship of radar 1";

// Anna is an instructor, Tom a trainee of kShip.  Who comes from 127.0.0.1, as all do that do not
// say otherwise, is on another host.
class ServerWithUsers : public testing::Test {
 protected:
  ServerWithUsers() : host_(2) {
    add("Anna", access::INSTRUCTOR, kPassword);
    add("Tom", access::TRAINEE, "battery staple", kShip);
    config_.foreign_addresses = {"127.0.0.1"};
    config_.users = file_.string();
    config_.audit = &audit_;
  }
  ~ServerWithUsers() override {
    if (server_) server_->stop();
    std::filesystem::remove_all(folder_);
  }

  void start() {
    server_.emplace(host_, config_, std::span<const WebFile>{});
    server_->start();
  }
  void add(const std::string& name, Role role, const std::string& password,
           const std::string& ship = {}, PasswordCost cost = kCheap) {
    change_users(file_, [&](UserFile& file) {
      file.add({name, role, ship, hash_of_password(password, cost)});
    });
  }

  struct Answer {
    std::string head;
    std::string body;
    // Of the response header; empty: none.
    std::string header(const std::string& name) const {
      const auto at = head.find("\r\n" + name + ": ");
      if (at == std::string::npos) return {};
      const auto begin = at + name.size() + 4;
      return head.substr(begin, head.find("\r\n", begin) - begin);
    }
  };
  static std::string request(const std::string& method, const std::string& path,
                             const std::string& body, const std::string& token,
                             const std::string& headers = {}) {
    return method + " " + path + " HTTP/1.1\r\nHost: localhost\r\n" +
           (token.empty() ? "" : "Authorization: Bearer " + token + "\r\n") + headers +
           "Connection: close\r\nContent-Length: " + std::to_string(body.size()) + "\r\n\r\n" +
           body;
  }
  Answer http(const std::string& method, const std::string& path, const std::string& body = {},
              const std::string& token = {}, const std::string& headers = {},
              const char* from = nullptr) {
    const std::string all =
        http_exchange(server_->http_port(), request(method, path, body, token, headers), from);
    const auto end = all.find("\r\n\r\n");
    return {all.substr(0, end), end == std::string::npos ? "" : all.substr(end + 4)};
  }
  static std::string who(const std::string& name, const std::string& password) {
    return signalk::Json{{"name", name}, {"password", password}}.dump();
  }
  signalk::Json sign_in(const std::string& name, const std::string& password) {
    const Answer answer = http("POST", "/login", who(name, password));
    EXPECT_THAT(answer.head, testing::StartsWith("HTTP/1.1 200")) << answer.body;
    return signalk::read_json(answer.body).value_or(signalk::Json());
  }
  wire::Reply native_sign_in(TestClient& client, const std::string& token) {
    wire::ClientMessage message;
    message.mutable_sign_in()->set_token(token);
    client.send(message);
    return client.receive_reply();
  }

  std::filesystem::path folder_ = [] {
    std::string pattern = testing::TempDir() + "skerry-login-XXXXXX";
    return std::filesystem::path(::mkdtemp(pattern.data()));
  }();
  std::filesystem::path file_ = folder_ / "users.yaml";
  NetConfig config_ = test_config();
  KeptAudit audit_;
  FakeHost host_;
  std::optional<NetServer> server_;
};

}  // namespace skerry::server
