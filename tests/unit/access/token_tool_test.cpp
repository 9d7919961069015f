#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "server/access/token_file.hpp"
#include "server/access_tool/tls_command.hpp"
#include "server/access_tool/token_command.hpp"
#include "server/tls/certificate.hpp"
#include "tests/unit/access/run_tool.hpp"

namespace skerry::server {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::StartsWith;

class TokenTool : public testing::Test {
 protected:
  ~TokenTool() override { std::filesystem::remove_all(folder_); }

  Ran run(std::vector<std::string> arguments) {
    if (arguments.front() != "rights") {
      arguments.insert(arguments.end(), {"--tokens", file_.string()});
    }
    return run_tool(make_token_commands, std::move(arguments));
  }
  UtcTime now() const { return std::chrono::system_clock::now(); }

  std::filesystem::path folder_ = [] {
    std::string pattern = testing::TempDir() + "skerry-token-tool-XXXXXX";
    return std::filesystem::path(::mkdtemp(pattern.data()));
  }();
  std::filesystem::path file_ = folder_ / "tokens.yaml";
};

TEST_F(TokenTool, MakesListsAndRevokes) {
  const Ran made = run({"new", "bridge 1", "--role", "trainee", "--ship", "Frida", "--for", "8h"});
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, StartsWith("skerry_"));
  const std::string token = made.out.substr(0, made.out.find('\n'));
  const TokenFile file = TokenFile::read(file_);
  const auto found = file.find(token, now());
  ASSERT_EQ(found.state, TokenState::good);
  EXPECT_EQ(found.token->role, access::TRAINEE);
  EXPECT_EQ(found.token->ship, "Frida");
  EXPECT_EQ(file.find(token, now() + 8h + 1min).state, TokenState::ended);
  EXPECT_EQ(file.find(token, now() + 8h - 1min).state, TokenState::good);
  EXPECT_EQ(file.text().find(token), std::string::npos) << "the file must not have the token";

  const Ran listed = run({"list"});
  EXPECT_THAT(listed.out, HasSubstr("bridge 1"));
  EXPECT_THAT(listed.out, HasSubstr("trainee"));
  EXPECT_EQ(listed.out.find(token), std::string::npos);

  EXPECT_EQ(run({"revoke", "bridge 2"}).code, echo::kExitFailure);
  EXPECT_EQ(run({"revoke", "bridge 1"}).code, 0);
  EXPECT_TRUE(TokenFile::read(file_).tokens().empty());
}

TEST_F(TokenTool, EntersACertificateThatEndsNoLaterThanItself) {
  make_authority(folder_, "Test authority");
  make_server_certificate(folder_, {"localhost"});
  for (const char* name : {"relay", "recorder"}) {
    make_client_certificate(folder_, name, ClientFiles::are_new);
  }
  const std::string file = client_certificate_file(folder_, "relay").string();
  const CertificateFacts facts = facts_of_certificate(file);
  const Ran made = run({"new", "relay 2", "--certificate", file, "--ship", "Frida"});
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_EQ(made.out, "") << "there is no token";
  EXPECT_THAT(made.err, HasSubstr("known by its certificate"));
  ASSERT_EQ(run({"new", "recorder", "--role", "assessor", "--for", "8h", "--certificate",
                 client_certificate_file(folder_, "recorder").string()})
                .code,
            0);
  const TokenFile kept = TokenFile::read(file_);
  const auto found = kept.find_certificate(facts.sha256, now());
  ASSERT_EQ(found.state, TokenState::good);
  EXPECT_EQ(found.token->name, "relay 2");
  EXPECT_EQ(found.token->ends, facts.until);
  EXPECT_EQ(kept.tokens()[1].role, access::ASSESSOR);
  EXPECT_LT(kept.tokens()[1].ends, now() + 9h);

  ASSERT_EQ(run({"new", "wall"}).code, 0);
  const std::string listed = run({"list"}).out;
  EXPECT_THAT(listed, testing::ContainsRegex("relay 2 +observer +Frida +certificate +20"));
  EXPECT_THAT(listed, testing::ContainsRegex("wall +observer +all +token +never"));

  const Ran again = run({"new", "other", "--certificate", file});
  EXPECT_EQ(again.code, echo::kExitFailure);
  EXPECT_THAT(again.err, HasSubstr("that of 'relay 2'; revoke it first"));
  for (const char* wrong : {"server.pem", "authority.pem"}) {
    EXPECT_THAT(run({"new", "x", "--certificate", (folder_ / wrong).string()}).err,
                HasSubstr("no client's certificate; `skerry tls client NAME`"));
  }
  EXPECT_THAT(run({"new", "x", "--certificate", (folder_ / "none.pem").string()}).err,
              HasSubstr("none.pem: there is no such file"));
  EXPECT_EQ(run({"revoke", "relay 2"}).code, 0);
  EXPECT_EQ(TokenFile::read(file_).find_certificate(facts.sha256, now()).state,
            TokenState::unknown);
}

TEST_F(TokenTool, TlsMakesAndShowsClientsCertificates) {
  const std::string folder = (folder_ / "tls").string();
  const auto tls = [](std::vector<std::string> arguments) {
    return run_tool(make_tls_commands, std::move(arguments));
  };
  EXPECT_THAT(tls({"client", "relay", folder}).err, HasSubstr("authority.pem: there is no such"));
  ASSERT_EQ(tls({"init", folder, "--name", "localhost"}).code, 0);
  const Ran made = tls({"client", "relay", folder});
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.err, HasSubstr("skerry token new relay --role observer --certificate " + folder +
                                  "/relay.pem"));
  EXPECT_THAT(made.err, HasSubstr("SKERRY_CERT=relay.pem SKERRY_KEY=relay.key"));
  const Ran again = tls({"client", "relay", folder});
  EXPECT_EQ(again.code, echo::kExitFailure);
  EXPECT_THAT(again.err, HasSubstr("--renew"));
  const Ran renewed = tls({"client", "relay", folder, "--renew"});
  EXPECT_EQ(renewed.code, 0) << renewed.err;
  EXPECT_THAT(renewed.err, HasSubstr("skerry token revoke relay"));
  EXPECT_EQ(tls({"client", "server", folder}).code, echo::kExitFailure);
  EXPECT_EQ(tls({"client"}).code, echo::kExitUsage);
  std::ofstream(folder_ / "tls" / "dhparam.pem") << "-----BEGIN DH PARAMETERS-----\n";
  const Ran shown = tls({"show", folder});
  EXPECT_EQ(shown.code, 0);
  EXPECT_THAT(shown.out, HasSubstr("server.pem: for localhost; until 20"));
  EXPECT_THAT(shown.out, HasSubstr("relay.pem: of the client relay; until 20"));
  EXPECT_THAT(shown.out, HasSubstr("dhparam.pem: no line"));
}

TEST_F(TokenTool, SaysWhatIsWrong) {
  EXPECT_EQ(run({"new", "a", "--role", "king"}).code, echo::kExitUsage);
  EXPECT_EQ(run({"new", "a", "--for", "8"}).code, echo::kExitUsage) << "of what?";
  EXPECT_EQ(run({"new", "a", "--for", "0h"}).code, echo::kExitUsage);
  EXPECT_EQ(run({"new"}).code, echo::kExitUsage);
  EXPECT_EQ(run({"list"}).code, echo::kExitFailure) << "there is no file yet";
  EXPECT_EQ(run({"revoke", "a"}).code, echo::kExitFailure);
  EXPECT_FALSE(std::filesystem::exists(file_)) << "and none was made";
  EXPECT_EQ(run({"new", "a"}).code, 0);
  const Ran again = run({"new", "a"});
  EXPECT_EQ(again.code, echo::kExitFailure);
  EXPECT_THAT(again.err, HasSubstr("revoke it"));
  EXPECT_THAT(again.out, testing::IsEmpty()) << "a token that is not kept must not be shown";
}

TEST_F(TokenTool, PrintsTheRights) { EXPECT_THAT(run({"rights"}).out, HasSubstr("set.world")); }

}  // namespace
}  // namespace skerry::server
