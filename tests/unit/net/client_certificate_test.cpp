// Clients that say by a certificate who they are: what they may, and which certificates are taken.
#include <gmock/gmock.h>
#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "clients/common/spoke_client.hpp"
#include "server/access/asked.hpp"
#include "server/access/token_file.hpp"
#include "tests/unit/net/kept_audit.hpp"
#include "tests/unit/net/server_with_tls.hpp"
#include "tests/unit/net/test_certificates.hpp"

namespace skerry::server {
namespace {

using client::SpokeClient;
using testing::AnyOf;
using testing::Contains;
using testing::Field;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

const std::string kGain = "/signalk/v2/api/vessels/self/radars/skerry0/controls/gain";
const std::string kNoEntry = "the certificate has no entry among the server's tokens";

// The native protocol under TLS.
class TlsClient {
 public:
  TlsClient(std::uint16_t port, const std::string& certificate)
      : tls_(port, {.certificate = certificate}) {
    if (!tls_.is_open()) throw std::runtime_error("no handshake");
  }
  void send(const wire::ClientMessage& message) {
    const Bytes frame = frame_of(message);
    tls_.send({frame.begin(), frame.end()});
  }
  // Nothing: the server has closed.
  std::optional<wire::ServerMessage> receive() {
    for (;;) {
      const auto body = reader_.next();
      if (!body.ok()) throw std::runtime_error(body.error().text);
      if (*body) {
        wire::ServerMessage message;
        message.ParseFromArray((*body)->data(), static_cast<int>((*body)->size()));
        return message;
      }
      const std::string more = tls_.receive(1);
      if (more.empty()) return std::nullopt;
      reader_.feed({reinterpret_cast<const std::uint8_t*>(more.data()), more.size()});
    }
  }
  wire::Reply receive_reply() {
    while (auto message = receive()) {
      if (message->has_reply()) return message->reply();
    }
    throw std::runtime_error("closed before a reply");
  }
  wire::Reply ask(const wire::ClientMessage& message) {
    send(message);
    return receive_reply();
  }

 private:
  TestTls tls_;
  FrameReader reader_{kMaxServerFrame};
};

class ClientCertificate : public ServerWithTls {
 protected:
  ClientCertificate() : ServerWithTls(2) {
    config_.tokens = file("tokens.yaml");
    config_.audit = &audit_;
    config_.limits.handshakes_burst = 1e6;  // some tests look until something has changed
    change_tokens(config_.tokens, [](TokenFile&) {});
  }
  ~ClientCertificate() override {
    if (server_) server_->stop();  // while there is an audit
    ::unsetenv("SKERRY_CERT");
    ::unsetenv("SKERRY_KEY");
  }

  std::string make(const std::string& name) {
    make_client_certificate(folder_, name, ClientFiles::are_new);
    return client_certificate_file(folder_, name).string();
  }
  void enter(const std::string& name, Role role, const std::string& ship = {},
             std::optional<UtcTime> ends = {}) {
    const auto facts = facts_of_certificate(client_certificate_file(folder_, name));
    change_tokens(config_.tokens, [&](TokenFile& file) {
      file.add({name, role, ship, "", ends, facts.sha256});
    });
  }
  std::string make_and_enter(const std::string& name, Role role, const std::string& ship = {}) {
    const std::string certificate = make(name);
    enter(name, role, ship);
    return certificate;
  }
  void revoke(const std::string& name) {
    change_tokens(config_.tokens, [&](TokenFile& file) { EXPECT_TRUE(file.remove(name)); });
  }
  static std::string request(const std::string& method, const std::string& path,
                             const std::string& headers = {}, const std::string& body = {}) {
    return method + " " + path + " HTTP/1.1\r\nHost: 127.0.0.1\r\n" + headers +
           "Connection: close\r\nContent-Length: " + std::to_string(body.size()) + "\r\n\r\n" +
           body;
  }
  static std::string bearer(const std::string& token) {
    return "Authorization: Bearer " + token + "\r\n";
  }
  static std::string put_gain(const std::string& headers = {}) {
    return request("PUT", kGain, headers, R"({"value":20})");
  }
  void use_in_environment(const std::string& certificate) {
    ::setenv("SKERRY_CERT", certificate.c_str(), 1);
    ::setenv("SKERRY_KEY", std::filesystem::path(certificate).replace_extension(".key").c_str(), 1);
  }
  std::string why_no_client() {
    const auto client = SpokeClient::connect("tls://127.0.0.1", server_->tcp_port(), kPatience);
    return client.ok() ? "none" : client.error().text;
  }
  static std::vector<int> versions() { return {TLS1_2_VERSION, TLS1_3_VERSION}; }

  KeptAudit audit_;
};

TEST_F(ClientCertificate, IsWhoItsEntrySaysOverEachProtocol) {
  const std::string relay = make_and_enter("relay-2", access::OBSERVER);
  start();
  EXPECT_THAT(https(get("/status"), relay), StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(https(get("/login"), relay), HasSubstr("\"name\":\"relay-2\""));
  EXPECT_THAT(https(get(kGain), relay), StartsWith("HTTP/1.1 200"));
  const std::string refused = https(put_gain(), relay);
  EXPECT_THAT(refused, StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(refused, HasSubstr("the certificate relay-2 is of the role observer"));

  use_in_environment(relay);
  auto client = SpokeClient::connect("tls://127.0.0.1", server_->tcp_port(), kPatience);
  ASSERT_TRUE(client.ok()) << client.error().text;
  EXPECT_TRUE(client->subscribe(0, 0, kPatience).ok());
  const auto status = client->get_status(kPatience);
  ASSERT_TRUE(status.ok()) << status.error().text;
  EXPECT_THAT(status->clients(0).peer(), StartsWith("127.0.0.1:")) << "it is no stranger";

  TestTls tls(server_->http_port(), {.certificate = relay});
  tls.send(request("GET", "/ws",
                   "Upgrade: websocket\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: "
                   "dGhlIHNhbXBsZSBub25jZQ==\r\nConnection: Upgrade\r\n"));
  const Bytes frame = frame_of(subscribe_message(7, 0));
  std::string masked{'\x82', static_cast<char>(0x80 | frame.size()), 0, 0, 0, 0};
  masked.append(frame.begin(), frame.end());
  tls.send(masked);
  std::string answer;
  while (answer.find("ship of radar 0") == std::string::npos) answer += tls.receive(1);
  EXPECT_TRUE(wait_until([&] {
    const auto clients = server_->status().clients();
    return std::count_if(clients.begin(), clients.end(),
                         [](const auto& each) { return each.transport() == "websocket"; }) == 1;
  }));
  EXPECT_THAT(audit_.entries(),
              Contains(testing::AllOf(Field(&AuditEntry::kind, AuditEntry::Kind::sign_in),
                                      Field(&AuditEntry::who, "certificate relay-2, observer")))
                  .Times(2));
  EXPECT_THAT(audit_.entries(),
              Contains(testing::AllOf(Field(&AuditEntry::kind, AuditEntry::Kind::refusal),
                                      Field(&AuditEntry::who, "certificate relay-2, observer"))));
}

// Every kind of message, by every role: refused in the table's words, or let through.
TEST_F(ClientCertificate, EveryKindOfMessageIsForTheRolesOfTheTable) {
  const auto* kinds = wire::ClientMessage::descriptor()->FindOneofByName("kind");
  std::vector<std::pair<Role, std::string>> clients;
  for (int i = 0; i < access::Role_ARRAYSIZE; ++i) {
    const Role role = static_cast<Role>(i);
    clients.emplace_back(role, make_and_enter(name_of(role), role));
  }
  host_.board = std::make_shared<FakeBoard>();
  start();
  int asked = 0, refusals = 0;
  for (const auto& [role, certificate] : clients) {
    for (int i = 0; i < kinds->field_count(); ++i) {
      wire::ClientMessage message;
      message.GetReflection()->MutableMessage(&message, kinds->field(i));
      if (message.has_sign_in()) continue;
      if (message.has_set()) message.mutable_set()->set_gain(40);
      const Who who{role, {}, name_of(role), {}, true};
      std::optional<std::string> expected;
      for (const std::string& right : asked_by(message).rights) {
        if (!expected) expected = why_not(who, right);
      }
      const wire::Reply reply = TlsClient(server_->tcp_port(), certificate).ask(message);
      ++asked;
      if (expected) {
        ++refusals;
        EXPECT_EQ(reply.code(), wire::Reply::REFUSED) << kinds->field(i)->name();
        EXPECT_EQ(reply.text(), *expected);
      } else {
        EXPECT_THAT(reply.text(), Not(HasSubstr(" is for "))) << kinds->field(i)->name();
      }
    }
  }
  EXPECT_GT(refusals, 0);
  std::printf("%d messages by 5 roles, %d refused\n", asked, refusals);
}

TEST_F(ClientCertificate, OfAShipOpensNothingOfAnother) {
  const std::string mate = make_and_enter("mate", access::TRAINEE, "ship of radar 1");
  start();
  TlsClient client(server_->tcp_port(), mate);
  EXPECT_EQ(client.ask(set_gain_message(1, 1, 33)).code(), wire::Reply::OK);
  EXPECT_THAT(client.ask(set_gain_message(2, 0, 33)).text(),
              HasSubstr("the certificate mate is of the ship ship of radar 1 alone"));
  EXPECT_THAT(client.ask(subscribe_message(3, 0)).text(), HasSubstr("alone"));
  EXPECT_THAT(https(put_gain(), mate), StartsWith("HTTP/1.1 403")) << "of radar 0";
}

TEST_F(ClientCertificate, IsAskedForAndNotNeeded) {
  start();
  for (const int version : versions()) {
    TestTls tls(server_->http_port(),
                {.authority = file(kAuthorityCertificate), .least = version, .most = version});
    ASSERT_TRUE(tls.is_open());
    tls.send(request("GET", "/status"));
    const std::string answer = tls.receive_all();
    EXPECT_THAT(answer, StartsWith("HTTP/1.1 401"));
    EXPECT_THAT(answer, HasSubstr("from another host it needs a token"));
  }
  EXPECT_THAT(https(get("/controls.json")), StartsWith("HTTP/1.1 200"));
  EXPECT_EQ(errors("HTTP TLS client certificate") + errors("HTTP TLS handshake"), 0u);
}

TEST_F(ClientCertificate, WithoutAnEntryIsAStranger) {
  const std::string stranger = make("stranger");
  start();
  EXPECT_THAT(https(get("/status"), stranger),
              testing::AllOf(StartsWith("HTTP/1.1 401"), HasSubstr(kNoEntry)));
  TlsClient client(server_->tcp_port(), stranger);
  EXPECT_THAT(client.ask(get_status_message(1)).text(), HasSubstr(kNoEntry));
  // An entry that comes holds at once.
  enter("stranger", access::OBSERVER);
  EXPECT_TRUE(
      wait_until([&] { return client.ask(get_status_message(1)).code() == wire::Reply::OK; }));
}

TEST_F(ClientCertificate, OnTheServersOwnHostNarrowsWhatOneMay) {
  config_.foreign_addresses = {};
  const std::string looker = make_and_enter("looker", access::OBSERVER);
  const std::string other = make("other");
  start();
  EXPECT_THAT(https(put_gain(), looker), StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(https(put_gain(), other), StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(https(put_gain()), StartsWith("HTTP/1.1 200"));
}

TEST_F(ClientCertificate, ThatIsNotOfTheAuthorityOrTheTimeEndsTheHandshake) {
  using namespace std::chrono_literals;
  const std::string good = make_and_enter("good", access::ADMIN);
  const auto elsewhere = folder_ / "elsewhere";
  make_authority(elsewhere, "Test authority");  // of the same name
  make_client_certificate(elsewhere, "good", ClientFiles::are_new);
  const std::string others = client_certificate_file(elsewhere, "good").string();
  const std::string ended = make("ended"), early = make("early");
  sign_again(ended, file(kAuthorityCertificate), {-2h, -1h});
  sign_again(early, file(kAuthorityCertificate), {1h, 2h});
  // One that a client's certificate has signed, with that one as its chain.
  const std::string below = make("below");
  sign_again(below, good);
  std::ofstream(below, std::ios::app) << std::ifstream(good).rdbuf();
  const std::string itself = make("itself");
  sign_again(itself, itself);
  for (const char* name : {"ended", "early", "below", "itself"}) enter(name, access::ADMIN);
  start();

  struct Case {
    const char* what;
    std::string certificate;
    const char* reason;
  };
  const std::vector<Case> cases = {
      {"of another authority", others, "unable to get local issuer certificate"},
      {"ended", ended, "certificate has expired"},
      {"not yet valid", early, "certificate is not yet valid"},
      {"of a server", file(kServerCertificate), "unsuitable certificate purpose"},
      {"of the authority itself", file(kAuthorityCertificate), "unsuitable certificate purpose"},
      {"signed by a client", below, "certificate chain too long"},
      {"signed by itself", itself, "self-signed certificate"},
  };
  std::uint64_t refused = 0;
  for (const Case& each : cases) {
    for (const int version : versions()) {
      TestTls tls(server_->http_port(),
                  {.least = version, .most = version, .certificate = each.certificate});
      // By TLS 1.3 the client learns of it with its first byte.
      EXPECT_EQ(tls.is_open(), version == TLS1_3_VERSION) << each.what;
      if (tls.is_open()) tls.send(get("/status"));
      EXPECT_EQ(tls.receive_all(), "") << each.what;
      ++refused;
      EXPECT_TRUE(wait_until([&] { return errors("HTTP TLS client certificate") == refused; }))
          << each.what;
      EXPECT_TRUE(wait_until([&] { return audit_.entries().size() == refused; }));
      const AuditEntry told = audit_.entries().back();
      EXPECT_EQ(told.kind, AuditEntry::Kind::refusal);
      EXPECT_THAT(told.from, StartsWith("HTTP 127.0.0.1:"));
      EXPECT_EQ(told.what, std::string("the client's certificate is not taken: ") + each.reason)
          << each.what;
    }
  }
  for (const Case& each : cases) {
    TestTls native(server_->tcp_port(), {.certificate = each.certificate});
    EXPECT_EQ(native.receive_all(), "") << each.what;
    use_in_environment(each.certificate);
    EXPECT_THAT(why_no_client(), HasSubstr("it does not take the certificate of SKERRY_CERT"))
        << each.what;
  }
  EXPECT_TRUE(
      wait_until([&] { return errors("native TCP TLS client certificate") == 2 * cases.size(); }));
  EXPECT_EQ(errors("HTTP TLS handshake"), 0u);
  EXPECT_THAT(https(get("/status"), good), StartsWith("HTTP/1.1 200")) << "and the server goes on";
  std::printf("%zu kinds of bad certificates refused\n", cases.size());
}

TEST_F(ClientCertificate, ItsReasonIsInTheLog) {
  const std::string ended = make("ended");
  sign_again(ended, file(kAuthorityCertificate),
             {std::chrono::seconds(-7200), std::chrono::seconds(-3600)});
  start();
  testing::internal::CaptureStdout();
  TestTls tls(server_->http_port(), {.certificate = ended});
  EXPECT_EQ(tls.receive_all(), "");
  const bool counted = wait_until([&] { return errors("HTTP TLS client certificate") == 1; });
  EXPECT_THAT(testing::internal::GetCapturedStdout(),
              HasSubstr("the client's certificate is not taken: certificate has expired"));
  EXPECT_TRUE(counted);
}

TEST_F(ClientCertificate, WhoseEntryIsRevokedLosesItsRightsWhileConnected) {
  const std::string relay = make_and_enter("relay", access::OBSERVER);
  const std::string stays = make_and_enter("stays", access::OBSERVER);
  start();
  TlsClient native(server_->tcp_port(), relay), other(server_->tcp_port(), stays);
  EXPECT_EQ(native.ask(subscribe_message(1, 0)).code(), wire::Reply::OK);
  EXPECT_EQ(other.ask(subscribe_message(1, 0)).code(), wire::Reply::OK);
  TestTls kept(server_->http_port(), {.certificate = relay});
  const std::string ask = "GET /status HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n";
  kept.send(ask);
  EXPECT_THAT(kept.receive(12), StartsWith("HTTP/1.1 200"));
  TestTls deltas(server_->http_port(), {.certificate = relay});
  deltas.send(request("GET", "/signalk/v1/stream?subscribe=none",
                      "Upgrade: websocket\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: "
                      "dGhlIHNhbXBsZSBub25jZQ==\r\nConnection: Upgrade\r\n"));
  EXPECT_THAT(deltas.receive(12), StartsWith("HTTP/1.1 101"));

  revoke("relay");
  EXPECT_THAT(native.receive_reply().text(), HasSubstr(kNoEntry));
  while (native.receive()) {
  }
  deltas.receive_all();  // until it closes
  kept.send(ask);
  std::string answer;
  while (answer.find(kNoEntry) == std::string::npos) {
    const std::string more = kept.receive(1);
    ASSERT_FALSE(more.empty()) << answer;
    answer += more;
  }
  EXPECT_THAT(answer, HasSubstr("HTTP/1.1 401"));
  EXPECT_EQ(other.ask(get_status_message(2)).code(), wire::Reply::OK);
}

// Its entry says no end of its own.
TEST_F(ClientCertificate, ThatEndsEndsItsConnections) {
  using namespace std::chrono_literals;
  const std::string relay = make("relay"), stays = make_and_enter("stays", access::OBSERVER);
  sign_again(relay, file(kAuthorityCertificate), {-1h, 6s});
  enter("relay", access::OBSERVER);
  const UtcTime end(facts_of_certificate(relay).until);
  config_.limits.request_time = 60s;  // an idle HTTP connection stays until then
  start();
  TlsClient native(server_->tcp_port(), relay), other(server_->tcp_port(), stays);
  EXPECT_EQ(native.ask(subscribe_message(1, 0)).code(), wire::Reply::OK);
  EXPECT_EQ(other.ask(subscribe_message(1, 0)).code(), wire::Reply::OK);
  TestTls kept(server_->http_port(), {.certificate = relay});
  kept.send("GET /status HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n");
  EXPECT_THAT(kept.receive(12), StartsWith("HTTP/1.1 200"));
  TestTls deltas(server_->http_port(), {.certificate = relay});
  deltas.send(request("GET", "/signalk/v1/stream?subscribe=none",
                      "Upgrade: websocket\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: "
                      "dGhlIHNhbXBsZSBub25jZQ==\r\nConnection: Upgrade\r\n"));
  EXPECT_THAT(deltas.receive(12), StartsWith("HTTP/1.1 101"));
  EXPECT_EQ(errors("client certificate ended"), 0u);
  ASSERT_LT(std::chrono::system_clock::now(), end) << "too slow to see it live";

  ASSERT_TRUE(wait_until([&] { return errors("client certificate ended") == 3; }));
  EXPECT_GE(std::chrono::system_clock::now(), end);
  EXPECT_LT(std::chrono::system_clock::now(), end + 3s);
  while (native.receive()) {
  }
  kept.receive_all();
  deltas.receive_all();
  EXPECT_EQ(other.ask(get_status_message(2)).code(), wire::Reply::OK);
  EXPECT_THAT(audit_.entries(),
              Contains(Field(&AuditEntry::what, HasSubstr("certificate has ended"))).Times(3));
}

TEST_F(ClientCertificate, WhatEverybodyMayKnowOfItIsNoToken) {
  const std::string relay = make_and_enter("relay", access::ADMIN);
  const CertificateFacts facts = facts_of_certificate(relay);
  start();
  std::string upper = facts.sha256;
  std::transform(upper.begin(), upper.end(), upper.begin(), ::toupper);
  const std::vector<std::string> known = {facts.sha256, upper, facts.fingerprint, "relay",
                                          "certificate relay"};
  for (const std::string& text : known) {
    for (const std::string& certificate : {std::string(), relay}) {
      EXPECT_THAT(https(request("GET", "/status", bearer(text)), certificate),
                  StartsWith("HTTP/1.1 401"))
          << text;
      EXPECT_THAT(https(put_gain(bearer(text)), certificate), StartsWith("HTTP/1.1 401")) << text;
      TlsClient client(server_->tcp_port(), certificate);
      wire::ClientMessage sign_in;
      sign_in.mutable_sign_in()->set_token(text);
      EXPECT_EQ(client.ask(sign_in).code(), wire::Reply::REFUSED) << text;
      wire::ClientMessage set = set_gain_message(1, 0, 20);
      set.mutable_set()->set_token(text);
      EXPECT_EQ(client.ask(set).code(), wire::Reply::REFUSED) << text;
    }
  }
  // Nor are its bytes, whose SHA-256 the file has.
  TlsClient client(server_->tcp_port(), {});
  wire::ClientMessage set = set_gain_message(1, 0, 20);
  set.mutable_set()->set_token(der_of(relay));
  const wire::Reply reply = client.ask(set);
  EXPECT_THAT(reply.code(), AnyOf(wire::Reply::REFUSED, wire::Reply::MALFORMED)) << reply.text();
  std::printf("%zu texts tried\n", known.size() + 1);
}

TEST_F(ClientCertificate, GivesWayToATokenThatIsShown) {
  const std::string mate = make_and_enter("mate", access::TRAINEE);
  const std::string token = make_token();
  change_tokens(config_.tokens, [&](TokenFile& file) {
    file.add({"looker", access::OBSERVER, "", digest_of(token), std::nullopt});
  });
  start();
  EXPECT_THAT(https(put_gain(), mate), StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(https(put_gain(bearer(token)), mate),
              testing::AllOf(StartsWith("HTTP/1.1 403"), HasSubstr("the token looker")));
  EXPECT_THAT(https(put_gain(bearer("skerry_guess")), mate), StartsWith("HTTP/1.1 401"));
  TlsClient client(server_->tcp_port(), mate);
  wire::ClientMessage sign_in;
  sign_in.mutable_sign_in()->set_token(token);
  EXPECT_EQ(client.ask(sign_in).text(), "observer looker");
  EXPECT_EQ(client.ask(set_gain_message(1, 0, 20)).code(), wire::Reply::REFUSED);
  sign_in.mutable_sign_in()->set_token("");
  EXPECT_EQ(client.ask(sign_in).text(), "trainee mate, by its certificate") << "signed out";
  EXPECT_EQ(client.ask(set_gain_message(1, 0, 20)).code(), wire::Reply::OK);
}

TEST_F(ClientCertificate, OfABrowserIsNotForPagesOfOtherSites) {
  const std::string mate = make_and_enter("mate", access::TRAINEE);
  start();
  EXPECT_THAT(https(put_gain("Origin: https://evil.example\r\n"), mate),
              StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(https(put_gain("Sec-Fetch-Site: cross-site\r\n"), mate), StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(https(put_gain("Origin: https://127.0.0.1\r\n"), mate), StartsWith("HTTP/1.1 200"));
}

TEST_F(ClientCertificate, IsVerifiedAgainWhereOthersResume) {
  const std::string relay = make_and_enter("relay", access::OBSERVER);
  start();
  for (const int version : versions()) {
    for (const std::string& certificate : {std::string(), relay}) {
      const TestTlsOptions options{.least = version, .most = version, .certificate = certificate};
      TestTls first(server_->http_port(), options);
      first.send(request("GET", "/status"));
      const std::string answer = first.receive_all();  // and the tickets
      TestTlsOptions again = options;
      again.session = first.session();
      TestTls second(server_->http_port(), again);
      ::SSL_SESSION_free(again.session);
      ASSERT_TRUE(second.is_open());
      second.send(request("GET", "/status"));
      EXPECT_EQ(second.receive_all().substr(0, 12), answer.substr(0, 12));
      EXPECT_EQ(second.is_resumed(), certificate.empty()) << second.version();
    }
  }
}

TEST_F(ClientCertificate, AnAuthorityThatComesIsHeededOnHangUp) {
  const std::string relay = make_and_enter("relay", access::OBSERVER);
  const std::filesystem::path authority = file(kAuthorityCertificate);
  std::filesystem::copy_file(authority, file("kept"));
  std::filesystem::remove(authority);
  start();
  const auto status = [&] {
    TestTls tls(server_->http_port(), {.certificate = relay});
    tls.send(request("GET", "/status"));
    return tls.receive_all();
  };
  EXPECT_THAT(status(), HasSubstr("from another host it needs a token")) << "it was not asked for";
  std::filesystem::copy_file(file("kept"), authority);
  server_->read_certificate();  // as SIGHUP does
  EXPECT_TRUE(wait_until([&] { return status().starts_with("HTTP/1.1 200"); }));
  // A damaged one is told, and that from before holds.
  write(kAuthorityCertificate, "-----BEGIN CERTIFICATE-----\nrubbish\n");
  server_->read_certificate();
  EXPECT_TRUE(wait_until([&] {
    const auto entries = audit_.entries();
    return std::any_of(entries.begin(), entries.end(), [](const AuditEntry& each) {
      return each.what.find("authority.pem:1: the certificate that begins here is damaged") !=
             std::string::npos;
    });
  }));
  EXPECT_THAT(status(), StartsWith("HTTP/1.1 200"));
}

TEST_F(ClientCertificate, WhatIsWrongWithTheEnvironmentIsSaid) {
  const std::string relay = make_and_enter("relay", access::OBSERVER);
  make("other");
  start();
  const std::string key = file("relay.key");
  const auto why = [&](const std::string& certificate, const std::string& of_key) {
    ::setenv("SKERRY_CERT", certificate.c_str(), 1);
    ::setenv("SKERRY_KEY", of_key.c_str(), 1);
    return why_no_client();
  };
  EXPECT_EQ(why(relay, key), "none");
  EXPECT_THAT(why("", ""), "none") << "to connect: Hello is for everybody";
  EXPECT_THAT(why(relay, ""), HasSubstr("SKERRY_CERT is given and SKERRY_KEY is not"));
  EXPECT_THAT(why("", key), HasSubstr("SKERRY_KEY is given and SKERRY_CERT is not"));
  EXPECT_THAT(why("/nowhere.pem", key),
              HasSubstr("SKERRY_CERT: /nowhere.pem: there is no such file"));
  EXPECT_THAT(why(relay, "/nowhere.key"),
              HasSubstr("SKERRY_KEY: /nowhere.key: there is no such file"));
  EXPECT_THAT(why(key, key), HasSubstr("not that in PEM"));
  EXPECT_THAT(why(relay, relay), HasSubstr("not that in PEM"));
  EXPECT_THAT(why(relay, file("other.key")), HasSubstr("the key of another certificate"));
}

}  // namespace
}  // namespace skerry::server
