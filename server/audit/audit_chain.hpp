// Lines of the audit file, each of which holds the digest of all before it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/quantity/result.hpp"
#include "protocol/recording/recording.pb.h"

namespace skerry::server {

namespace audit {
using Entry = recording::AuditEntry;
}

// The end of a chain of lines.
struct AuditHead {
  std::uint32_t n = 0;                       // of the last entry; 0: there is none
  std::string chain = std::string(64, '0');  // its digest, hexadecimal
  friend bool operator==(const AuditHead&, const AuditHead&) = default;
};

// A line is the entry as JSON with one more member at its end,
//
//   {"n":7, ... ,"chain":"<64 hexadecimal digits>"}
//
// SHA-256 of the chain of the line before (64 zeros before the first) and of this line's text up to
// ,"chain": .  Whoever changes, removes or adds a line in the middle breaks all that follow.  A
// file that was made anew from some line on, or that lost its end, is found out by a head that was
// noted elsewhere.  In a file that goes on from another the first line says so: its number is the
// next one, and `follows` is the chain that it goes on from.
//
// Longer is no entry: six texts of AuditLog::kMostText, escaped, are less.
constexpr std::size_t kMostAuditLine = 64 * 1024;

// The line with its end; `head` becomes this line's.  `entry.n` is set here.
std::string audit_line(audit::Entry entry, AuditHead& head);

// The entry of a line without its end; `head` becomes its.  If it has none before the line, the
// line may say what it goes on from.  Error: what is wrong with it.
Result<audit::Entry, std::string> read_audit_line(std::string_view line, AuditHead& head);

// The head after a line, from the line alone: whether it is the right one is not looked at.
std::optional<AuditHead> read_audit_head(std::string_view line);

struct AuditCheck {
  AuditHead head;                      // of the last good line
  std::uint64_t entries = 0;           // in good lines of this file
  AuditHead follows;                   // of the file before; without entries: there is none
  std::string first_utc, last_utc;     // of the good ones
  std::uint64_t wrong_line = 0;        // 0: none is wrong
  std::string wrong;                   // what is
  std::uint64_t unfinished_bytes = 0;  // behind the last line: an entry that was being written
  bool has_wanted = false;             // the head that was looked for was there
};

// Reads the file up to the first wrong line.  `each` is given the good entries.  `wanted`: a chain
// that was noted.  `before`: the end of the file that this one must go on from; without entries: of
// any.  Error: std::runtime_error naming the file, if it cannot be read.
AuditCheck check_audit(const std::filesystem::path& file, std::string_view wanted = {},
                       const std::function<void(const audit::Entry&)>& each = {},
                       const AuditHead& before = {});

}  // namespace skerry::server
