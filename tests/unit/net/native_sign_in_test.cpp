// Signing in over the native protocol: by name and password, and out again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "server/access/gate.hpp"
#include "tests/unit/net/server_with_users.hpp"

namespace skerry::server {
namespace {

using testing::HasSubstr;

wire::ClientMessage sign_in_message(const std::string& name, const std::string& password) {
  wire::ClientMessage message;
  message.set_request(5);
  message.mutable_sign_in()->set_name(name);
  message.mutable_sign_in()->set_password(password);
  return message;
}

TEST_F(ServerWithUsers, ANativeClientSignsInByPassword) {
  start();
  TestClient client(server_->tcp_port());
  client.receive_hello();
  // Sent at once: what comes behind the password waits until it was tried.
  Bytes bytes = frame_of(sign_in_message("Tom", "battery staple"));
  for (const wire::ClientMessage& next : {set_gain_message(6, 0, 33), set_gain_message(7, 1, 33)}) {
    const Bytes frame = frame_of(next);
    bytes.insert(bytes.end(), frame.begin(), frame.end());
  }
  client.send_bytes(bytes);
  const wire::Reply signed_in = client.receive_reply();
  EXPECT_EQ(signed_in.request(), 5u);
  EXPECT_EQ(signed_in.code(), wire::Reply::OK);
  EXPECT_EQ(signed_in.text(), "trainee Tom, of the ship " + kShip);
  const wire::Reply own = client.receive_reply(), other = client.receive_reply();
  EXPECT_EQ(own.request(), 6u);
  EXPECT_EQ(own.code(), wire::Reply::OK) << own.text();
  EXPECT_EQ(other.code(), wire::Reply::REFUSED);
}

TEST_F(ServerWithUsers, AWrongPasswordIsRefusedAndLeavesTheConnectionAsItWas) {
  start();
  TestClient client(server_->tcp_port());
  client.receive_hello();
  client.send(sign_in_message("Anna", "incorrect horse"));
  const wire::Reply wrong = client.receive_reply();
  client.send(sign_in_message("nobody", "incorrect horse"));
  const wire::Reply nobody = client.receive_reply();
  EXPECT_EQ(wrong.code(), wire::Reply::REFUSED);
  EXPECT_EQ(wrong.text(), nobody.text());
  client.send(set_gain_message(1, 0, 40));
  EXPECT_EQ(client.receive_reply().code(), wire::Reply::REFUSED);
  client.send(sign_in_message("Anna", kPassword));
  EXPECT_EQ(client.receive_reply().text(), "instructor Anna");
  client.send(set_gain_message(1, 0, 40));
  EXPECT_EQ(client.receive_reply().code(), wire::Reply::OK);
  client.send(sign_in_message("Anna", ""));
  EXPECT_EQ(client.receive_reply().code(), wire::Reply::OUT_OF_RANGE) << "a name alone";
}

TEST_F(ServerWithUsers, ASignInOfNobodyTakesTheRightsAway) {
  start();
  const std::string token = sign_in("Anna", kPassword)["token"];
  TestClient client(server_->tcp_port());
  client.receive_hello();
  EXPECT_EQ(native_sign_in(client, token).code(), wire::Reply::OK);
  client.subscribe(0);
  const wire::Reply out = native_sign_in(client, "");
  EXPECT_EQ(out.code(), wire::Reply::OK);
  EXPECT_THAT(out.text(), HasSubstr("nobody in particular"));
  client.send(set_gain_message(1, 0, 40));
  EXPECT_EQ(client.receive_reply().code(), wire::Reply::REFUSED);
  // The video that was hers ends.
  while (client.receive()) {
  }
}

TEST_F(ServerWithUsers, AConnectionsSessionEndsWithIt) {
  start();
  // More connections than sessions that one user may have: none puts her browser's out.
  const std::string token = sign_in("Anna", kPassword)["token"];
  for (std::size_t i = 0; i < Gate::kMostOfUser + 5; ++i) {
    TestClient client(server_->tcp_port());
    client.receive_hello();
    client.send(sign_in_message("Anna", kPassword));
    ASSERT_EQ(client.receive_reply().code(), wire::Reply::OK);
    client.socket().close();
    ASSERT_TRUE(wait_until([&] { return server_->status().clients_size() == 0; }));
  }
  EXPECT_THAT(http("GET", "/status", {}, token).head, testing::StartsWith("HTTP/1.1 200"));
}

TEST_F(ServerWithUsers, WhoLeavesWhileHerPasswordIsTriedHarmsNothing) {
  start();
  for (int i = 0; i < 10; ++i) {
    TestClient client(server_->tcp_port());
    client.receive_hello();
    client.send(sign_in_message("Anna", kPassword));
    client.socket().reset();
  }
  EXPECT_TRUE(wait_until([&] { return server_->status().clients_size() == 0; }));
  sign_in("Anna", kPassword);
}

TEST_F(ServerWithUsers, OnTheOwnHostASignInNarrowsToo) {
  start();
  TestClient client(server_->tcp_port(), TestClient::kDefaultBuffer, "127.0.0.9");
  client.receive_hello();
  client.send(set_gain_message(1, 1, 40));
  EXPECT_EQ(client.receive_reply().code(), wire::Reply::OK);
  client.send(sign_in_message("Tom", "battery staple"));
  EXPECT_EQ(client.receive_reply().code(), wire::Reply::OK);
  client.send(set_gain_message(1, 1, 41));
  EXPECT_EQ(client.receive_reply().code(), wire::Reply::REFUSED);
  EXPECT_EQ(native_sign_in(client, "").code(), wire::Reply::OK);
  client.send(set_gain_message(1, 1, 42));
  EXPECT_EQ(client.receive_reply().code(), wire::Reply::OK) << "as at the beginning";
}

}  // namespace
}  // namespace skerry::server
