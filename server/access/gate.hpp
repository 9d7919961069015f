// Gate: who stands behind a connection, by where it comes from and by its token.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "server/access/rights.hpp"
#include "server/access/token_file.hpp"

namespace skerry::server {

// Where there is no file of tokens, everybody sees and the control token makes an admin.  With one,
// who is not on the server's own host sees nothing without a token of it.  Who is on that host is
// an admin, unless a token says otherwise.
//
// Thread: one at a time.
class Gate {
 public:
  struct Config {
    std::string control_token;     // empty: none
    std::filesystem::path tokens;  // empty: none
  };

  // Reads the file of tokens.  Error: ConfigError as TokenFile::read().
  explicit Gate(Config config);

  // Who has `token` and comes from the server's own host, or not.  Never throws for a token.
  Who who(bool from_here, std::string_view token, UtcTime now) const;

  // Whether the token is a good one, wherever it comes from.
  bool knows(std::string_view token, UtcTime now) const;

  // Reads the file of tokens anew if it is another than before; call it once a second.  What is
  // wrong with it is returned, once; then what was read before holds.
  std::optional<std::string> refresh(UtcTime now);

  // Another number after each change of who may do what: the file changed, or a token ended.
  std::uint64_t generation() const { return generation_; }

  bool has_tokens() const { return !config_.tokens.empty(); }  // a file of them
  bool knows_tokens() const { return has_tokens() || !config_.control_token.empty(); }

 private:
  struct Stamp {
    std::filesystem::file_time_type time;
    std::uintmax_t size = 0;
    std::uint64_t inode = 0;
    bool operator==(const Stamp&) const = default;
  };
  // nothing: the file is not there
  std::optional<Stamp> stamp_of_file() const;

  Config config_;
  TokenFile tokens_;
  std::optional<Stamp> stamp_;
  UtcTime looked_at_{};
  std::uint64_t generation_ = 1;
};

}  // namespace skerry::server
