// AuditPort: where it is kept who changed what, who signed in and what was refused.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "protocol/recording/recording.pb.h"

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

// As files, pages and commands name AuditEntry::Kind, in its order.
inline constexpr std::array<std::string_view, 5> kAuditKinds = {"change", "request", "sign_in",
                                                                "refusal", "server"};

// An entry with its number and time, as it is shown, recorded and written.
using AuditEntryPtr = std::shared_ptr<const recording::AuditEntry>;

// Which of the newest entries somebody wants to see.
struct AuditQuestion {
  std::size_t most = 200;
  std::uint32_t after = 0;  // only those with a greater number
  std::string who = {};     // only where this is part of name or address, small letters as large
  std::string kind = {};    // only of this kind; empty: of each
};

struct AuditAnswer {
  std::vector<AuditEntryPtr> entries;  // the newest first
  std::uint32_t newest = 0;            // number of the newest entry, shown or not; 0: there is none
  bool has_file = false;
  std::size_t unwritten = 0;  // entries that the disk has not taken
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
  // Out of those that are in memory.
  virtual AuditAnswer ask(const AuditQuestion& /*question*/) const { return {}; }
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
