// What a server needs before other hosts may reach it.
#include "server/app/options/exposure.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace skerry::server {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

NetConfig bound_to(const std::string& address) {
  NetConfig net;
  net.bind = address;
  return net;
}

std::string refusal_of(const NetConfig& net) {
  try {
    require_guarded(net, false);
    return {};
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

TEST(Exposure, OfLoopbackIsNone) {
  for (const char* address : {"127.0.0.1", "127.0.0.9", "::1", "::ffff:127.0.0.1"}) {
    EXPECT_EQ(refusal_of(bound_to(address)), "") << address;
    EXPECT_EQ(exposure_of(bound_to(address)), "") << address;
  }
}

TEST(Exposure, ElsewhereWantsUsersAndEncryption) {
  for (const char* address : {"0.0.0.0", "::", "192.0.2.7", "2001:db8::7"}) {
    NetConfig net = bound_to(address);
    EXPECT_THAT(refusal_of(net), AllOf(HasSubstr(address), HasSubstr("skerry tls init"),
                                       HasSubstr("skerry user add"), HasSubstr("--insecure")));
    EXPECT_THAT(exposure_of(net), HasSubstr("without users and without encryption"));
    net.control_token = "it alone lets everybody look";
    EXPECT_THAT(refusal_of(net), HasSubstr("without users and without encryption"));
    net.users = "users.yaml";
    EXPECT_THAT(refusal_of(net), AllOf(HasSubstr("without encryption"), HasSubstr("tls init"),
                                       Not(HasSubstr("user add"))));
    net.tls = "tls";
    EXPECT_EQ(refusal_of(net), "");
    EXPECT_EQ(exposure_of(net), "");
    net.users.clear();
    EXPECT_THAT(refusal_of(net), AllOf(HasSubstr("without users"), HasSubstr("user add"),
                                       Not(HasSubstr("tls init"))));
    net.tokens = "tokens.yaml";
    EXPECT_EQ(refusal_of(net), "");
  }
}

TEST(Exposure, ElsewhereWantsAControlTokenThatCannotBeGuessed) {
  NetConfig net = bound_to("192.0.2.7");
  net.tls = "tls";
  net.users = "users.yaml";
  net.control_token = "fifteen letters";
  EXPECT_THAT(refusal_of(net), AllOf(HasSubstr("control_token"), HasSubstr("15 characters"),
                                     HasSubstr("at least 16"), HasSubstr("skerry token new")));
  EXPECT_THAT(refusal_of(net), Not(HasSubstr(net.control_token)));
  EXPECT_THAT(exposure_of(net), HasSubstr("can be guessed"));
  EXPECT_NO_THROW(require_guarded(net, true));
  net.control_token += '!';
  EXPECT_EQ(refusal_of(net), "");
  EXPECT_EQ(exposure_of(net), "");
  net.control_token = "short";
  net.bind = "127.0.0.1";
  EXPECT_EQ(refusal_of(net), "");
}

TEST(Exposure, IsLetPassByWhoSaysSoAndIsStillTold) {
  const NetConfig net = bound_to("0.0.0.0");
  EXPECT_NO_THROW(require_guarded(net, true));
  EXPECT_THAT(exposure_of(net), HasSubstr("Not secure"));
}

}  // namespace
}  // namespace skerry::server
