#include "server/fleet/etcd/etcd_status.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace skerry::fleet {
namespace {

bool says(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

StoreError unavailable(const std::string& text, std::string_view member) {
  // Said by the member itself.
  if (says(text, "etcdserver: ") || says(text, "raft: "))
    return {Trouble::no_majority,
            fmt::format("etcd {} answers that too few of the members agree ({}): start the others, "
                        "or mend the network between them",
                        member, text),
            true};
  if (says(text, "Ssl handshake") || says(text, "SSL_ERROR"))
    return {Trouble::refused,
            fmt::format("etcd {} and this host do not accept each other's certificates ({})",
                        member, text),
            false};
  const bool never_sent = says(text, "failed to connect") || says(text, "DNS");
  return {Trouble::unreachable,
          fmt::format("etcd {} cannot be reached ({}): is it running, and its address right?",
                      member, text),
          !never_sent};
}

}  // namespace

StoreError store_error_of(const grpc::Status& status, std::string_view member, bool connected) {
  const std::string& text = status.error_message();
  switch (status.error_code()) {
    case grpc::StatusCode::UNAVAILABLE:
      return unavailable(text, member);
    case grpc::StatusCode::DEADLINE_EXCEEDED:
    case grpc::StatusCode::CANCELLED:
      if (!connected)
        return {Trouble::unreachable,
                fmt::format("etcd {} cannot be reached in time: is it running, and its address "
                            "right?",
                            member),
                true};
      return {
          Trouble::slow,
          fmt::format("etcd {} is connected and did not answer in time: it is stopped, its disk "
                      "is slow, or the members do not agree",
                      member),
          true};
    case grpc::StatusCode::RESOURCE_EXHAUSTED:
      if (says(text, "space exceeded"))
        return {Trouble::full,
                fmt::format("etcd {} is full ({}): compact it, defragment it, then `etcdctl alarm "
                            "disarm`",
                            member, text),
                false};
      return {says(text, "too many requests") ? Trouble::slow : Trouble::broken,
              fmt::format("etcd {}: {}", member, text), true};
    case grpc::StatusCode::UNAUTHENTICATED:
    case grpc::StatusCode::PERMISSION_DENIED:
      return {Trouble::refused, fmt::format("etcd {} refuses this host: {}", member, text), false};
    case grpc::StatusCode::OUT_OF_RANGE:
      if (says(text, "future revision"))
        return {Trouble::went_back,
                fmt::format("etcd {} has not come to a revision that was seen ({}): it is restored "
                            "from an old backup",
                            member, text),
                false};
      return {Trouble::compacted,
              fmt::format("etcd {} has compacted what was asked for ({})", member, text), false};
    case grpc::StatusCode::UNKNOWN:
    case grpc::StatusCode::INTERNAL:
      // The member's own clock for the call ran out (etcd 3.4 says that with no code), or its
      // connection broke in the midst of it.
      if (says(text, "context deadline exceeded") || says(text, "context canceled") ||
          says(text, "timed out") || says(text, "RST_STREAM"))
        return {Trouble::slow, fmt::format("etcd {} did not answer in time ({})", member, text),
                true};
      [[fallthrough]];
    default:
      return {Trouble::broken,
              fmt::format("etcd {}: {} (gRPC code {})", member, text,
                          static_cast<int>(status.error_code())),
              true};
  }
}

gpr_timespec as_deadline(HostTime deadline, HostTime now) {
  const Duration left = std::max(deadline - now, Duration{0});
  return gpr_time_add(gpr_now(GPR_CLOCK_MONOTONIC),
                      gpr_time_from_nanos(left.count(), GPR_TIMESPAN));
}

}  // namespace skerry::fleet
