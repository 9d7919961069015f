// AuditPort: where it is kept who changed what, who signed in and what was refused.
#pragma once

#include <cstdint>
#include <string>
#include <utility>

namespace skerry::server {

struct AuditEntry {
  enum class Kind : std::uint8_t {
    change,   // of a control or of the exercise: what, before, after
    request,  // of a recorder, playback, plotter, board, real radar or set-up: what, result
    sign_in,  // who it is from now on
    refusal,  // what somebody might not, and why
    server,   // begin, end, the file of tokens, what is missing here
  };
  Kind kind = Kind::server;
  std::string from = {};  // "console 10.0.0.5:4711"; empty: the server itself
  std::string who = {};   // name and role by the token
  std::string what = {};
  std::string before = {}, after = {};
  std::uint32_t times = 1;  // changes that are told as one
  std::string result = {};  // "ok", or why not
};

// Thread: any.
class AuditPort {
 public:
  virtual ~AuditPort() = default;
  // Never blocks on a disk and never throws.  An entry without `who` is of whoever is known at
  // `from`.
  virtual void add(AuditEntry entry) = 0;
  // Who is at `from` until forget(); empty: nobody that is known.
  virtual void know(const std::string& from, const std::string& who) = 0;
  virtual void forget(const std::string& from) = 0;
  virtual std::string who_at(const std::string& from) const = 0;
};

// While one request is carried out: who makes it.
class AuditedRequest {
 public:
  // `audit` may be null.
  AuditedRequest(AuditPort* audit, std::string from, const std::string& who)
      : audit_(audit), from_(std::move(from)) {
    if (audit_ != nullptr) audit_->know(from_, who);
  }
  ~AuditedRequest() {
    if (audit_ != nullptr) audit_->forget(from_);
  }
  AuditedRequest(const AuditedRequest&) = delete;
  AuditedRequest& operator=(const AuditedRequest&) = delete;

 private:
  AuditPort* audit_;
  std::string from_;
};

}  // namespace skerry::server
