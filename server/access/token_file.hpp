// TokenFile: the tokens that a server takes, without the tokens themselves.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/quantity/time.hpp"
#include "server/access/rights.hpp"

namespace skerry::server {

// What the file has of a token, or of a client's certificate, which stands for one.
struct KeptToken {
  std::string name;  // 1 to 64 bytes of printable UTF-8
  Role role = access::OBSERVER;
  std::string ship;              // empty: of all
  std::string sha256;            // of the token's text: 64 hexadecimal digits, lower case
  std::optional<UtcTime> ends;   // it holds before; nothing: always
  std::string certificate = {};  // SHA-256 of it, in the same digits; then sha256 is empty

  bool is_certificate() const { return !certificate.empty(); }
};

// What is known of a text that claims to be a token, or of a certificate.
enum class TokenState { unknown, ended, good };

class TokenFile {
 public:
  static constexpr std::size_t kMost = 4000;  // what a YAML text may hold (yaml_tree.hpp)

  TokenFile() = default;
  // Error: ConfigError naming file, line and what is wrong: a file that cannot be read, two tokens
  // of one name or certificate, a digest that is none, neither or both of them, a time that is
  // none, more than kMost.
  static TokenFile read(const std::filesystem::path& file);
  // The same of a text; `file` is for errors.
  static TokenFile parse(const std::string& text, const std::string& file);

  const std::vector<KeptToken>& tokens() const { return tokens_; }
  // The token of this text, if it is known; and whether it still holds at `now`.
  struct Found {
    TokenState state = TokenState::unknown;
    const KeptToken* token = nullptr;
  };
  Found find(std::string_view text, UtcTime now) const;
  // The same of a certificate, by its digest.  What everybody may know of a certificate is no
  // token: find() does not look at these.
  Found find_certificate(std::string_view digest, UtcTime now) const;

  // Error: std::invalid_argument if the name or certificate is taken or a value is not allowed.
  void add(KeptToken token);
  // False if there is none of that name.
  bool remove(std::string_view name);

  // As read() reads it.
  std::string text() const;

 private:
  template <typename Is>
  Found find_if(const Is& is_it, UtcTime now) const;

  std::vector<KeptToken> tokens_;
};

// A new token: "skerry_" and 43 characters of base64url, 256 bits of the system's random numbers.
// Error: std::runtime_error if the system gives none.
std::string make_token();

// What the file keeps of it.
std::string digest_of(std::string_view token);

// Changes the file: reads it (no file: no tokens), lets `change` change it, and writes it whole or
// not at all, readable by its owner alone, while no other such change runs.
// Error: as read(); std::runtime_error naming the file and the system's reason; what `change`
// throws.  Then the file is as before.
void change_tokens(const std::filesystem::path& file,
                   const std::function<void(TokenFile&)>& change);

}  // namespace skerry::server
