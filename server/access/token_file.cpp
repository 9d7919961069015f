#include "server/access/token_file.hpp"

#include <fmt/format.h>
#include <sys/random.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <set>
#include <stdexcept>

#include "protocol/digest/digest.hpp"
#include "protocol/nmea/log_time.hpp"
#include "protocol/picture/label_text.hpp"
#include "server/access/file_text.hpp"
#include "server/config/whole_file.hpp"
#include "server/config/yaml_message.hpp"

namespace skerry::server {
namespace {

namespace fs = std::filesystem;

bool is_digest(std::string_view text) {
  return text.size() == 64 && text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

KeptToken token_of_message(const access::Token& message, const std::string& path,
                           YamlSource& source) {
  KeptToken token{message.name(), message.role(), message.ship(), message.sha256(), std::nullopt};
  if (source.is_sound(path + ".sha256") && !is_digest(token.sha256)) {
    source.refuse(path + ".sha256",
                  "is no SHA-256; expected: 64 hexadecimal digits, lower case, as "
                  "`skerry token new` writes them");
  }
  if (!message.has_ends()) return token;
  token.ends = nmea::log_time_of(message.ends());
  if (!token.ends) {
    source.refuse(
        path + ".ends",
        fmt::format("'{}' is no time; expected: UTC as 2027-01-31T18:00:00Z, 1990 to 2099",
                    printable(message.ends())));
  }
  return token;
}

}  // namespace

TokenFile TokenFile::read(const fs::path& file) {
  return parse(read_yaml_file(file.string()), file.string());
}

TokenFile TokenFile::parse(const std::string& text, const std::string& file) {
  access::TokenFile message;
  YamlSource source(file);
  read_yaml(text, source, message);
  TokenFile read;
  std::set<std::string_view> names;
  for (int i = 0; i < message.tokens_size(); ++i) {
    const std::string path = fmt::format("tokens[{}]", i);
    read.tokens_.push_back(token_of_message(message.tokens(i), path, source));
    if (source.is_sound(path + ".name") && !names.insert(message.tokens(i).name()).second) {
      source.refuse(path + ".name", fmt::format("'{}' is the name of an earlier token, too",
                                                printable(message.tokens(i).name())));
    }
  }
  if (read.tokens_.size() > kMost) {
    source.refuse("tokens", fmt::format("there are {}; allowed: {}", read.tokens_.size(), kMost));
  }
  source.require_sound();
  return read;
}

TokenFile::Found TokenFile::find(std::string_view text, UtcTime now) const {
  // What is compared is a digest: how long that takes tells nothing of a token.
  const std::string digest = digest_of(text);
  const auto found = std::find_if(tokens_.begin(), tokens_.end(),
                                  [&](const KeptToken& token) { return token.sha256 == digest; });
  if (found == tokens_.end()) return {};
  const bool ended = found->ends && now >= *found->ends;
  return {ended ? TokenState::ended : TokenState::good, &*found};
}

void TokenFile::add(KeptToken token) {
  require_entry("token", token.name, token.ship);
  if (tokens_.size() >= kMost) {
    throw std::invalid_argument(fmt::format("there are {} tokens; no more are allowed", kMost));
  }
  for (const KeptToken& other : tokens_) {
    if (other.name != token.name) continue;
    throw std::invalid_argument(
        fmt::format("there is a token '{}'; revoke it, or give this one another name", token.name));
  }
  tokens_.push_back(std::move(token));
}

bool TokenFile::remove(std::string_view name) {
  return std::erase_if(tokens_, [&](const KeptToken& token) { return token.name == name; }) > 0;
}

std::string TokenFile::text() const {
  if (tokens_.empty()) return "tokens: []\n";
  std::string out =
      "# Tokens of skerryd, by what they are known again by; `skerry token` changes it.\n";
  out += "tokens:\n";
  for (const KeptToken& token : tokens_) {
    out += fmt::format("  - name: {}\n    role: {}\n", in_quotes(token.name), name_of(token.role));
    if (!token.ship.empty()) out += fmt::format("    ship: {}\n", in_quotes(token.ship));
    out += fmt::format("    sha256: \"{}\"\n", token.sha256);
    if (token.ends) out += fmt::format("    ends: \"{}\"\n", utc_text(*token.ends));
  }
  return out;
}

std::string make_token() {
  std::array<std::uint8_t, 33> random;  // 44 letters; the last is left out: 258 of 264 bits
  if (::getrandom(random.data(), random.size(), 0) != static_cast<ssize_t>(random.size())) {
    throw std::runtime_error("the system gives no random numbers");
  }
  constexpr std::string_view kLetters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
  std::string text = "skerry_";
  for (std::size_t i = 0; i < random.size(); i += 3) {
    const unsigned bits = random[i] << 16 | random[i + 1] << 8 | random[i + 2];
    for (const int shift : {18, 12, 6, 0}) text += kLetters[(bits >> shift) & 63U];
  }
  text.pop_back();
  return text;
}

std::string digest_of(std::string_view token) {
  Sha256 sha256;
  sha256.add(token);
  return hexadecimal(sha256.take());
}

void change_tokens(const fs::path& file, const std::function<void(TokenFile&)>& change) {
  while_locked(file, [&] {
    TokenFile tokens;
    if (fs::exists(file)) tokens = TokenFile::read(file);
    change(tokens);
    write_whole(file, tokens.text(), S_IRUSR | S_IWUSR);
  });
}

}  // namespace skerry::server
