#include "server/fleet/etcd/etcd_status.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace skerry::fleet {
namespace {

using testing::HasSubstr;

StoreError error_of(grpc::StatusCode code, const std::string& text, bool connected = true) {
  return store_error_of(grpc::Status(code, text), "10.0.0.1:2379", connected);
}

// Texts of etcd 3.4.23 and gRPC 1.51, as they came.
TEST(EtcdStatus, IsToldAsTheTroubleThatItIs) {
  using enum grpc::StatusCode;
  const auto trouble = [](grpc::StatusCode code, const char* text, bool connected = true) {
    const StoreError error = error_of(code, text, connected);
    EXPECT_THAT(error.text, HasSubstr("etcd 10.0.0.1:2379"));
    return error.trouble;
  };
  EXPECT_EQ(trouble(UNAVAILABLE, "etcdserver: no leader"), Trouble::no_majority);
  EXPECT_EQ(trouble(UNAVAILABLE, "etcdserver: request timed out"), Trouble::no_majority);
  EXPECT_EQ(trouble(UNAVAILABLE,
                    "etcdserver: request timed out, possibly due to previous leader failure"),
            Trouble::no_majority);
  EXPECT_EQ(trouble(UNAVAILABLE, "Socket closed"), Trouble::unreachable);
  EXPECT_EQ(trouble(UNAVAILABLE,
                    "failed to connect to all addresses; last error: UNKNOWN: "
                    "ipv4:10.0.0.1:2379: tcp handshaker shutdown"),
            Trouble::unreachable);
  EXPECT_EQ(
      trouble(UNAVAILABLE,
              "failed to connect to all addresses; last error: UNKNOWN: Ssl handshake failed: "
              "SSL_ERROR_SSL: certificate verify failed"),
      Trouble::refused);
  EXPECT_EQ(trouble(PERMISSION_DENIED, "etcdserver: permission denied"), Trouble::refused);
  EXPECT_EQ(trouble(DEADLINE_EXCEEDED, "Deadline Exceeded"), Trouble::slow);
  EXPECT_EQ(trouble(DEADLINE_EXCEEDED, "Deadline Exceeded", false), Trouble::unreachable);
  EXPECT_EQ(trouble(RESOURCE_EXHAUSTED, "etcdserver: mvcc: database space exceeded"),
            Trouble::full);
  EXPECT_EQ(trouble(RESOURCE_EXHAUSTED, "etcdserver: too many requests"), Trouble::slow);
  EXPECT_EQ(trouble(OUT_OF_RANGE, "etcdserver: mvcc: required revision has been compacted"),
            Trouble::compacted);
  EXPECT_EQ(trouble(OUT_OF_RANGE, "etcdserver: mvcc: required revision is a future revision"),
            Trouble::went_back);
  // Seen of an etcd 3.4.23 whose peer was killed.
  EXPECT_EQ(trouble(UNKNOWN, "context deadline exceeded"), Trouble::slow);
  EXPECT_EQ(trouble(INTERNAL, "Received RST_STREAM with error code 2"), Trouble::slow);
  EXPECT_EQ(trouble(UNKNOWN, "something else"), Trouble::broken);
  EXPECT_EQ(trouble(NOT_FOUND, "etcdserver: requested lease not found"), Trouble::broken);
}

// What was sent may have been done; what was refused at once was not.
TEST(EtcdStatus, SaysWhatMayHaveBeenDone) {
  using enum grpc::StatusCode;
  EXPECT_TRUE(error_of(DEADLINE_EXCEEDED, "Deadline Exceeded").maybe_done);
  EXPECT_TRUE(error_of(UNAVAILABLE, "Socket closed").maybe_done);
  EXPECT_TRUE(error_of(UNAVAILABLE, "etcdserver: request timed out").maybe_done);
  EXPECT_FALSE(error_of(UNAVAILABLE, "failed to connect to all addresses").maybe_done);
  EXPECT_FALSE(
      error_of(RESOURCE_EXHAUSTED, "etcdserver: mvcc: database space exceeded").maybe_done);
}

}  // namespace
}  // namespace skerry::fleet
