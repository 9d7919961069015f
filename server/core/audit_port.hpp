// AuditPort: where it is kept who changed what, who signed in and what was refused.
#pragma once

#include <cstdint>
#include <string>

namespace skerry::server {

struct AuditEntry {
  enum class Kind : std::uint8_t {
    change,   // of a control or of the exercise: what, before, after
    request,  // of a recording, a playback, targets, a board, a set-up: what, result
    sign_in,  // who it is from now on
    refusal,  // what somebody might not, and why
    server,   // begin, end, the file of tokens, and what is missing here
  };
  Kind kind = Kind::server;
  std::string from = {};  // "console 10.0.0.5:4711 (websocket)"; empty: the server itself
  std::string who = {};   // of the token; empty: who is known at `from`
  std::string what = {};
  std::string before = {}, after = {};
  std::uint32_t times = 1;  // changes that are told as one
  std::string result = {};  // "ok", or why not
};

// Thread: any.
class AuditPort {
 public:
  virtual ~AuditPort() = default;
  // Never blocks on a disk and never throws.
  virtual void add(AuditEntry entry) = 0;
  // Who is at `from`, until some seconds after forget().
  virtual void know(const std::string& from, const std::string& who) = 0;
  virtual void forget(const std::string& from) = 0;
};

}  // namespace skerry::server
