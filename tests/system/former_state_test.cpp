// A server of today on what version 0.1 kept (tests/golden/state/README.md).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/system/running_server.hpp"
#include "tests/system/small_scenario.hpp"
#include "tests/unit/net/test_client.hpp"

namespace skerry::system_test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

class FormerState : public testing::Test {
 protected:
  FormerState() {
    fs::copy(SKERRY_SOURCE_DIR "/tests/golden/state/0.1/state", state_,
             fs::copy_options::recursive);
  }
  static std::string ask(const RunningServer& server, const std::string& request,
                         const std::string& token, const std::string& body = {}) {
    return server::http_exchange(
        server.http_port(), request + " HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n" +
                                (token.empty() ? "" : "Authorization: Bearer " + token + "\r\n") +
                                "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" +
                                body);
  }
  Ending verify() const {
    return run(
        {skerry_program(), "audit", "verify", state_ + "/audit.jsonl.1", state_ + "/audit.jsonl"});
  }

  TempFolder folder_;
  const std::string state_ = folder_.path("state");
};

TEST_F(FormerState, IsReadAndGoesOn) {
  EXPECT_EQ(verify().code, 0) << verify().err;
  {
    RunningServer server(
        {"--scenario", folder_.write("small.yaml", small_scenario()), "--state", state_});
    EXPECT_THAT(ask(server, "GET /login", "skerry_sIZzYvMKSBq7zg8KhIde7NXtoSNrgV9ftvZQxX3gg0I"),
                AllOf(StartsWith("HTTP/1.1 200"), HasSubstr("\"trainee\""), HasSubstr("\"Tern\"")));
    EXPECT_THAT(ask(server, "GET /audit", "skerry_guess"), StartsWith("HTTP/1.1 401"));
    for (const auto& [name, password] :
         {std::pair("Anna", "kept password"), std::pair("Bj\u00f8rn", "another one!")}) {
      EXPECT_THAT(ask(server, "POST /login", "",
                      std::string("{\"name\":\"") + name + "\",\"password\":\"" + password + "\"}"),
                  StartsWith("HTTP/1.1 200"))
          << name;
    }
    EXPECT_THAT(ask(server, "GET /setups", ""), HasSubstr("Natt å"));
    EXPECT_THAT(ask(server, "GET /setups/Natt%20%C3%A5", ""), HasSubstr("\"palette\": \"night\""));
    EXPECT_EQ(server.stop().code, 0);
  }
  const Ending verified = verify();
  EXPECT_EQ(verified.code, 0) << verified.err;
  EXPECT_THAT(verified.out, HasSubstr("goes on from entry "));
  const Ending shown =
      run({skerry_program(), "audit", "show", state_ + "/audit.jsonl.1", state_ + "/audit.jsonl"});
  EXPECT_THAT(shown.out,
              AllOf(HasSubstr("     1 2026-"), HasSubstr("gain: 50 -> 71"),
                    HasSubstr("sign in as Anna: no user has this name"), HasSubstr("Bj")));
}

}  // namespace
}  // namespace skerry::system_test
