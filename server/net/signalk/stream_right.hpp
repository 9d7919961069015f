// StreamRight: whether the client of a Signal K stream may have it, and still may.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "server/net/common/net_context.hpp"

namespace skerry::server {

// Thread: net-0.
class StreamRight {
 public:
  // `token` as it came with the request; `radar` is on the ship that the stream is of.
  StreamRight(const NetContext& context, TcpPeer peer, std::string token, std::uint32_t radar)
      : context_(context), peer_(std::move(peer)), token_(std::move(token)), radar_(radar) {}

  // Why she may not, with this token, or with her own where this is empty.
  std::optional<std::string> refusal_of(std::string_view right, std::string_view token = {}) const {
    const Who who = context_.who(peer_, token.empty() ? token_ : token);
    return why_not(who, right, context_.ship_of(radar_));
  }

  // For the audit, by this token, or by her own.
  std::string who(std::string_view token = {}) const {
    return text_of(context_.who(peer_, token.empty() ? token_ : token));
  }

  // True once when she may have the stream no longer: her token was revoked or has ended.  Cheap
  // while no rights change.
  bool has_ended() {
    if (looked_at_ == context_.gate.generation()) return false;
    looked_at_ = context_.gate.generation();
    return refusal_of("signalk.stream").has_value();
  }

 private:
  const NetContext& context_;
  TcpPeer peer_;
  std::string token_;
  std::uint32_t radar_;
  std::uint64_t looked_at_ = 0;  // Gate::generation()
};

}  // namespace skerry::server
