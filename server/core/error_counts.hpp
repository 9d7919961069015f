// ErrorCounts: errors by kind; the first of a kind is logged, the rest are only counted.
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <string_view>

namespace skerry::server {

// A fault that repeats a thousand times a second must neither fill a disk nor hide another one.
// Bounded: after kMaxKinds different kinds all further ones are counted as kOther.
// Thread: any.
class ErrorCounts {
 public:
  static constexpr std::size_t kMaxKinds = 64;
  static constexpr std::string_view kOther = "other";

  // `kind` is a short fixed name ("tcp accept"), `text` says what happened and where.
  void add(std::string_view kind, std::string_view text, std::uint64_t times = 1);
  std::map<std::string, std::uint64_t> counts() const;

 private:
  mutable std::mutex mutex_;
  std::map<std::string, std::uint64_t, std::less<>> counts_;
};

}  // namespace skerry::server
