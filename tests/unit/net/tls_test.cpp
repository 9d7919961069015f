// TLS: who comes by it, who is told to, what it offers, and what a damaged certificate does.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "clients/common/spoke_client.hpp"
#include "server/net/common/tls_keys.hpp"
#include "server/tls/certificate.hpp"
#include "tests/unit/net/server_with_tls.hpp"
#include "tests/unit/net/test_client.hpp"
#include "tests/unit/net/test_tls.hpp"

namespace skerry::server {
namespace {

using client::ClientErrorKind;
using client::SpokeClient;
using testing::AnyOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

TEST_F(ServerWithTls, SendsTheSameSpokesToNativeClients) {
  start();
  auto client = SpokeClient::connect("tls://127.0.0.1", server_->tcp_port(), kPatience);
  ASSERT_TRUE(client.ok()) << client.error().text;
  ASSERT_TRUE(client->subscribe(0, 0, kPatience).ok());
  constexpr std::uint64_t kSpokes = 4096;
  for (std::uint64_t sent = 0; sent < kSpokes;) {
    host_.publish();
    sent += FakeHost::kSectorSpokes;
    // No more than the ring holds before it is read.
    for (std::uint32_t i = 0; i < FakeHost::kSectorSpokes;) {
      const auto event = client->receive(kPatience);
      ASSERT_TRUE(event.ok()) << event.error().text;
      ASSERT_TRUE(event->has_value());
      if (std::holds_alternative<Spoke>(**event)) ++i;
    }
  }
  EXPECT_EQ(client->losses().lost(), 0u);
  EXPECT_EQ(client->losses().received(), kSpokes);
}

TEST_F(ServerWithTls, TellsANativeClientInTheClearToComeByIt) {
  config_.limits.opening_time = std::chrono::milliseconds(200);
  start();
  // It waits for Hello and says nothing, or speaks at once.
  const auto silent = SpokeClient::connect("127.0.0.1", server_->tcp_port(), kPatience);
  ASSERT_FALSE(silent.ok());
  EXPECT_THAT(silent.error().text, HasSubstr("by TLS alone: connect to tls://HOST"));
  TestClient hasty(server_->tcp_port());
  hasty.send(subscribe_message(1, 0));
  EXPECT_EQ(hasty.receive_reply().code(), wire::Reply::REFUSED);
  EXPECT_FALSE(hasty.receive().has_value());
}

TEST_F(ServerWithTls, LeavesItsOwnHostInTheClear) {
  config_.foreign_addresses = {};
  start();
  EXPECT_TRUE(SpokeClient::connect("127.0.0.1", server_->tcp_port(), kPatience).ok());
  EXPECT_THAT(http_get(server_->http_port(), "/status"), StartsWith("HTTP/1.1 200"));
  // And lets it come by TLS, over HTTP.
  EXPECT_THAT(https(get("/status")), StartsWith("HTTP/1.1 200"));
}

TEST_F(ServerWithTls, IsTrustedByItsAuthorityAndItsNameAlone) {
  start();
  const auto other = folder_ / "other";
  make_authority(other, "Another authority");
  ::setenv("SKERRY_CA", (other / kAuthorityCertificate).c_str(), 1);
  const auto wrong = SpokeClient::connect("tls://127.0.0.1", server_->tcp_port(), kPatience);
  ASSERT_FALSE(wrong.ok());
  EXPECT_THAT(wrong.error().text, HasSubstr("not trusted"));
  ::setenv("SKERRY_CA", file(kAuthorityCertificate).c_str(), 1);
  const auto misnamed = SpokeClient::connect("tls://localhost", server_->tcp_port(), kPatience);
  ASSERT_FALSE(misnamed.ok());
  EXPECT_THAT(misnamed.error().text, HasSubstr("hostname mismatch"));
  ::setenv("SKERRY_CA", "/nowhere.pem", 1);
  const auto none = SpokeClient::connect("tls://127.0.0.1", server_->tcp_port(), kPatience);
  ASSERT_FALSE(none.ok());
  EXPECT_THAT(none.error().text, HasSubstr("/nowhere.pem"));
}

TEST_F(ServerWithTls, ServesHttpAndSendsOnWhoComesInTheClear) {
  start();
  EXPECT_THAT(https(get("/status")), StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(https(get("/signalk")), HasSubstr("wss://127.0.0.1/signalk/v1/stream"));
  const std::string sent_on = http_get(server_->http_port(), "/status?x=1");
  EXPECT_THAT(sent_on, StartsWith("HTTP/1.1 308"));
  EXPECT_THAT(sent_on, HasSubstr(":" + std::to_string(server_->http_port()) + "/status?x=1"));
  const std::string posted = http_exchange(server_->http_port(),
                                           "POST /login HTTP/1.1\r\nHost: localhost\r\nConnection: "
                                           "close\r\nContent-Length: 2\r\n\r\n{}");
  EXPECT_THAT(posted, StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(posted, HasSubstr("by TLS alone: https://localhost"));
}

TEST_F(ServerWithTls, CarriesWebSockets) {
  start();
  TestTls tls(server_->http_port());
  ASSERT_TRUE(tls.is_open());
  tls.send(
      "GET /ws HTTP/1.1\r\nHost: 127.0.0.1\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
      "Origin: https://127.0.0.1\r\nSec-WebSocket-Version: 13\r\n"
      "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n");
  std::string answer;
  while (answer.find("fake") == std::string::npos) {  // the server's name in Hello
    const std::string more = tls.receive(1);
    ASSERT_FALSE(more.empty()) << answer;
    answer += more;
  }
  EXPECT_THAT(answer, StartsWith("HTTP/1.1 101"));
}

TEST_F(ServerWithTls, OffersVersionsAndCiphersOfTodayAlone) {
  start();
  struct Case {
    const char* what;
    TestTlsOptions options;
    bool taken;
  };
  const std::vector<Case> cases = {
      {"TLS 1.3", {.least = TLS1_3_VERSION}, true},
      {"TLS 1.2", {.most = TLS1_2_VERSION}, true},
      {"TLS 1.1", {.least = TLS1_VERSION, .most = TLS1_1_VERSION}, false},
      {"TLS 1.0", {.least = TLS1_VERSION, .most = TLS1_VERSION}, false},
      {"AES-128-GCM", {.most = TLS1_2_VERSION, .ciphers = "ECDHE-ECDSA-AES128-GCM-SHA256"}, true},
      {"ChaCha20", {.most = TLS1_2_VERSION, .ciphers = "ECDHE-ECDSA-CHACHA20-POLY1305"}, true},
      {"CBC", {.most = TLS1_2_VERSION, .ciphers = "ECDHE-ECDSA-AES128-SHA256"}, false},
      {"no forward secrecy", {.most = TLS1_2_VERSION, .ciphers = "AES128-GCM-SHA256"}, false},
      {"RC4, 3DES, export, none",
       {.most = TLS1_2_VERSION, .ciphers = "RC4:3DES:EXPORT:eNULL:aNULL"},
       false},
  };
  for (const Case& each : cases) {
    const TestTls tls(server_->http_port(), each.options);
    EXPECT_EQ(tls.is_open(), each.taken) << each.what;
    if (tls.is_open()) {
      EXPECT_THAT(tls.version() + " " + tls.cipher(),
                  AnyOf(HasSubstr("GCM"), HasSubstr("CHACHA20")))
          << each.what;
    }
  }
}

TEST_F(ServerWithTls, DoesNotRenegotiate) {
  start();
  TestTls tls(server_->http_port(), {.most = TLS1_2_VERSION});
  ASSERT_TRUE(tls.is_open());
  EXPECT_FALSE(tls.renegotiate());
  EXPECT_THAT(https(get("/status")), StartsWith("HTTP/1.1 200"));
}

TEST_F(ServerWithTls, HoldsGarbageAndHalfAHandshake) {
  config_.limits.opening_time = std::chrono::milliseconds(300);
  start();
  TestSocket half(server_->http_port());
  half.send(std::string("\x16\x03\x01", 3));  // and nothing more
  for (const std::string& garbage :
       {std::string("\x16\x03\x01\x00\x04zzzz", 9), std::string("\x16") + std::string(70'000, 'a'),
        std::string("\x16\x03\x03\xff\xff", 5) + std::string(66'000, '\0')}) {
    for (const std::uint16_t port : {server_->http_port(), server_->tcp_port()}) {
      TestSocket socket(port);
      socket.send(garbage);
      socket.finish_sending();
      socket.receive_all();  // an alert, or nothing; then the end
    }
  }
  half.receive_all();
  EXPECT_TRUE(wait_until([&] { return errors("HTTP TLS handshake") >= 4; }));
  EXPECT_TRUE(wait_until([&] { return errors("native TCP TLS handshake") >= 3; }));
  EXPECT_THAT(https(get("/status")), StartsWith("HTTP/1.1 200"));
}

TEST_F(ServerWithTls, LimitsHandshakesOfAPeer) {
  config_.limits.handshakes_burst = 3;
  config_.limits.handshakes_per_second = 0.001;
  start();
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(TestTls(server_->http_port()).is_open());
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(TestTls(server_->http_port()).is_open());
  EXPECT_EQ(errors("HTTP too many TLS handshakes"), 3u);
}

TEST_F(ServerWithTls, TakesARenewedCertificateAndKeepsWhatIsConnected) {
  config_.limits.handshakes_burst = 1e6;  // it is looked at until it has changed
  start();
  auto client = SpokeClient::connect("tls://127.0.0.1", server_->tcp_port(), kPatience);
  ASSERT_TRUE(client.ok()) << client.error().text;
  const auto fingerprint = [&] { return TestTls(server_->http_port()).fingerprint(); };
  const std::string before = fingerprint();
  EXPECT_EQ(before, facts_of_certificate(file(kServerCertificate)).fingerprint);
  make_server_certificate(folder_, {"127.0.0.1"});
  const std::string after = facts_of_certificate(file(kServerCertificate)).fingerprint;
  EXPECT_NE(before, after);
  EXPECT_TRUE(wait_until([&] { return fingerprint() == after; }));
  EXPECT_TRUE(client->get_status(kPatience).ok());

  write(kServerCertificate, "-----BEGIN CERTIFICATE-----\nrubbish\n-----END CERTIFICATE-----\n");
  std::this_thread::sleep_for(std::chrono::milliseconds(2500));  // it is looked at twice
  EXPECT_EQ(fingerprint(), after);
  EXPECT_TRUE(client->get_status(kPatience).ok());
}

TEST_F(ServerWithTls, SaysWhatIsWrongWithItsFiles) {
  const auto what_is_wrong = [&] {
    try {
      const NetServer server(host_, config_, std::span<const WebFile>{});
      return std::string("nothing");
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
  };
  EXPECT_EQ(what_is_wrong(), "nothing");
  const std::filesystem::path key = folder_ / kServerKey, kept = folder_ / "kept";
  std::filesystem::copy_file(key, kept);

  std::filesystem::copy_file(folder_ / kAuthorityKey, key,
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_THAT(what_is_wrong(), StartsWith(key.string() + ": "));
  std::filesystem::remove(key);
  EXPECT_THAT(what_is_wrong(), HasSubstr(key.string() + ": there is no such file"));
  write(kServerKey, "not a key");
  EXPECT_THAT(what_is_wrong(), HasSubstr("in PEM without a passphrase"));
  std::filesystem::copy_file(kept, key, std::filesystem::copy_options::overwrite_existing);

  write(kServerCertificate, "Bag attributes\n\n-----BEGIN CERTIFICATE-----\nrubbish\n");
  EXPECT_THAT(what_is_wrong(),
              HasSubstr("server.pem:3: the certificate that begins here is damaged"));
  write(kServerCertificate, "");
  EXPECT_THAT(what_is_wrong(), HasSubstr("server.pem: no line '-----BEGIN CERTIFICATE-----'"));
  std::filesystem::remove(folder_ / kServerCertificate);
  EXPECT_THAT(what_is_wrong(), HasSubstr("server.pem: there is no such file"));
}

TEST(Certificate, IsAsBeforeWhereItsPairCannotBeWritten) {
  const auto folder =
      std::filesystem::temp_directory_path() / ("skerry-certificate-" + std::to_string(::getpid()));
  make_authority(folder, "Test authority");
  make_server_certificate(folder, {"radar.school"});
  const std::string before = facts_of_certificate(folder / kServerCertificate).fingerprint;
  // The key can be written, and the certificate not: its name is a folder's.
  std::filesystem::create_directory(folder / "server.pem.new");
  std::ofstream(folder / "server.pem.new" / "kept") << "so that it is not removed";
  EXPECT_THROW(make_server_certificate(folder, {"radar.school"}), std::exception);
  EXPECT_EQ(facts_of_certificate(folder / kServerCertificate).fingerprint, before);
  EXPECT_NO_THROW(read_tls({folder / kServerCertificate, folder / kServerKey})) << "still a pair";
  EXPECT_FALSE(std::filesystem::exists(folder / "server.key.new"));
  std::filesystem::remove_all(folder);
}

TEST(Certificate, OfAClientIsMadeOnceAndRenewedWhenSaidSo) {
  const auto folder =
      std::filesystem::temp_directory_path() / ("skerry-certificate-" + std::to_string(::getpid()));
  make_authority(folder, "Test authority");
  make_server_certificate(folder, {"radar.school"});
  const auto file = client_certificate_file(folder, "relay-2");
  EXPECT_THROW(make_client_certificate(folder, "relay-2", ClientFiles::are_renewed),
               std::runtime_error)
      << "there is none";
  make_client_certificate(folder, "relay-2", ClientFiles::are_new);
  const CertificateFacts made = facts_of_certificate(file);
  EXPECT_EQ(made.common_name, "relay-2");
  EXPECT_TRUE(made.is_for_clients);
  EXPECT_FALSE(facts_of_certificate(folder / kServerCertificate).is_for_clients);
  EXPECT_FALSE(facts_of_certificate(folder / kAuthorityCertificate).is_for_clients);
  EXPECT_EQ(std::filesystem::status(folder / "relay-2.key").permissions(),
            std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  try {
    make_client_certificate(folder, "relay-2", ClientFiles::are_new);
    ADD_FAILURE() << "the key from before was overwritten";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("relay-2.key is there already: --renew"));
  }
  EXPECT_EQ(facts_of_certificate(file).sha256, made.sha256);
  make_client_certificate(folder, "relay-2", ClientFiles::are_renewed);
  EXPECT_NE(facts_of_certificate(file).sha256, made.sha256);
  EXPECT_NO_THROW(read_tls({file, folder / "relay-2.key"})) << "a pair";

  const std::string before = facts_of_certificate(file).sha256;
  std::filesystem::create_directory(folder / "relay-2.pem.new");
  std::ofstream(folder / "relay-2.pem.new" / "kept") << "so that it cannot be written";
  EXPECT_THROW(make_client_certificate(folder, "relay-2", ClientFiles::are_renewed),
               std::exception);
  EXPECT_EQ(facts_of_certificate(file).sha256, before);
  EXPECT_NO_THROW(read_tls({file, folder / "relay-2.key"})) << "still a pair";

  for (const char* name : {"", "server", "authority", "a b", "../relay", "-x", ".x", "x/y", "x\n",
                           "0123456789012345678901234567890123456789012345678901234567890123x"}) {
    EXPECT_THROW(make_client_certificate(folder, name, ClientFiles::are_new), std::runtime_error)
        << name;
  }
  std::filesystem::remove_all(folder);
}

TEST(Certificate, HasTheNamesItIsFor) {
  const auto folder =
      std::filesystem::temp_directory_path() / ("skerry-certificate-" + std::to_string(::getpid()));
  make_authority(folder, "Test authority");
  make_server_certificate(folder, {"radar.school", "192.0.2.7", "2001:db8::7"});
  const CertificateFacts facts = facts_of_certificate(folder / kServerCertificate);
  EXPECT_THAT(facts.names, testing::ElementsAre("radar.school", "192.0.2.7", "2001:db8::7"));
  EXPECT_GE(facts.days_left, 823);
  EXPECT_LE(facts.days_left, 825);
  EXPECT_THROW(make_authority(folder, "Another"), std::runtime_error);
  for (const char* name : {"", "a b", "bridge:7410", "[2001:db8::7]", "x,DNS:evil", "x\n"}) {
    EXPECT_THROW(make_server_certificate(folder, {name}), std::runtime_error) << name;
  }
  EXPECT_EQ(std::filesystem::status(folder / kServerKey).permissions(),
            std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace skerry::server
