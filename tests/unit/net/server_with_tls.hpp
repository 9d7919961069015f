// A server under TLS, with an authority of its own, for tests.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <span>
#include <string>

#include "server/tls/certificate.hpp"
#include "tests/unit/net/fake_host.hpp"
#include "tests/unit/net/test_client.hpp"
#include "tests/unit/net/test_tls.hpp"

namespace skerry::server {

inline constexpr Duration kPatience = std::chrono::seconds(20);

class ServerWithTls : public testing::Test {
 protected:
  explicit ServerWithTls(std::uint32_t radars = 1) : host_(radars) {
    make_authority(folder_, "Test authority");
    make_server_certificate(folder_, {"127.0.0.1"});
    config_.tls = folder_.string();
    config_.foreign_addresses = {"127.0.0.1"};  // everybody is of another host
    ::setenv("SKERRY_CA", file(kAuthorityCertificate).c_str(), 1);
  }
  ~ServerWithTls() override {
    ::unsetenv("SKERRY_CA");
    if (server_) server_->stop();
    std::filesystem::remove_all(folder_);
  }

  void start() {
    server_.emplace(host_, config_, std::span<const WebFile>{});
    server_->start();
  }
  std::string file(const char* name) const { return (folder_ / name).string(); }
  void write(const char* name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  static std::string get(const std::string& path) {
    return "GET " + path + " HTTP/1.1\r\nHost: 127.0.0.1\r\nConnection: close\r\n\r\n";
  }
  // The answer to a request that asks to close, by a client with this certificate, or none.
  std::string https(const std::string& request, const std::string& certificate = {}) const {
    TestTls tls(server_->http_port(),
                {.authority = file(kAuthorityCertificate), .certificate = certificate});
    if (!tls.is_open()) return "no handshake";
    tls.send(request);
    return tls.receive_all();
  }
  std::uint64_t errors(const std::string& kind) const {
    const wire::Status status = server_->status();
    const auto found = status.errors().find(kind);
    return found == status.errors().end() ? 0 : found->second;
  }

  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("skerry-tls-" + std::to_string(::getpid()));
  FakeHost host_;
  NetConfig config_ = test_config();
  std::optional<NetServer> server_;
};

}  // namespace skerry::server
