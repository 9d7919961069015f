// Entries of the audit, from where they are kept.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "server/audit/audit_chain.hpp"

namespace skerry::server {

// By its first octets; false if it cannot be read.
bool is_recording(const std::string& file);

// Gives the entries of an audit file, or of a recording, in their order.  What is wrong with the
// file, if anything is: of an audit file the first wrong line, behind which nothing is given; of a
// recording, that it has none, or which are missing.
// Error: std::runtime_error naming the file, if it cannot be read.
std::optional<std::string> read_entries(const std::string& file,
                                        const std::function<void(const audit::Entry&)>& each);

// The entries of a recording beside those of the audit's files, which it was made apart from.
class RecordedEntries {
 public:
  // Error: std::runtime_error naming the file, if it cannot be read.
  explicit RecordedEntries(std::string file);

  // An entry of the files; each is given once.
  void compare(const audit::Entry& entry);

  // After all of them: what is not as the files have it, if anything.
  std::optional<std::string> fault() const;
  const std::string& file() const { return file_; }
  std::size_t count() const { return count_; }

 private:
  std::string file_;
  std::size_t count_ = 0;
  std::map<std::uint32_t, std::string> missing_;  // bytes by number, of those not given yet
  std::uint32_t first_other_ = 0;                 // number of the first that is another; 0: none is
};

}  // namespace skerry::server
