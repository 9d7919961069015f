// AuditFile: the file that a server writes its audit to.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "server/audit/audit_chain.hpp"

namespace skerry::server {

// Open and locked from begin to end.  Thread: one at a time.
class AuditFile {
 public:
  enum class Kind : std::uint8_t {
    any,        // it goes on where it ends
    next_only,  // new or empty: it goes on from another
  };
  // Opens the file, or makes it.  An entry at its end that was not finished is cut off.
  // Error: std::runtime_error naming the file: it cannot be opened, another server has it, its last
  // line is no entry, or it has lines and should not.
  explicit AuditFile(std::filesystem::path path, Kind kind = Kind::any);
  ~AuditFile();
  AuditFile(const AuditFile&) = delete;
  AuditFile& operator=(const AuditFile&) = delete;

  const std::filesystem::path& path() const { return path_; }
  // Of its last entry, when it was opened.
  const AuditHead& head() const { return head_; }
  std::uint64_t bytes_cut() const { return bytes_cut_; }
  std::uint64_t size() const { return size_; }  // of its whole lines, bytes
  // Whether the path still names it: it was neither moved nor deleted.
  bool is_in_place() const;

  // Whole lines, on the disk when it returns.  False, with the reason in errno: the disk took none
  // of them, and the file is as before.
  bool append(std::string_view lines);

 private:
  void look_at_end(Kind kind);
  std::string read_tail(std::uint64_t size, std::uint64_t bytes) const;
  bool cut();

  const std::filesystem::path path_;
  int descriptor_ = -1;
  AuditHead head_;
  std::uint64_t size_ = 0;
  std::uint64_t bytes_cut_ = 0;
  bool has_rest_ = false;  // behind them there is the begin of one that was not taken
};

}  // namespace skerry::server
