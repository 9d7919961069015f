#include "server/access/token_file.hpp"

#include <fmt/format.h>
#include <sys/random.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <set>
#include <stdexcept>
#include <utility>

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
  KeptToken token{message.name(),   message.role(), message.ship(),
                  message.sha256(), std::nullopt,   message.certificate()};
  if (message.has_sha256() == message.has_certificate() && source.is_sound(path + ".sha256") &&
      source.is_sound(path + ".certificate")) {
    source.refuse(
        message.has_sha256() ? path + ".certificate" : path,
        "expected: one of sha256, of a token, and certificate, of a client's certificate");
  }
  for (const auto& [key, digest] :
       {std::pair(".sha256", &token.sha256), std::pair(".certificate", &token.certificate)}) {
    if (!source.has(path + key) || !source.is_sound(path + key) || is_digest(*digest)) continue;
    source.refuse(path + key,
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
  std::set<std::string_view> names, certificates;
  for (int i = 0; i < message.tokens_size(); ++i) {
    const std::string path = fmt::format("tokens[{}]", i);
    read.tokens_.push_back(token_of_message(message.tokens(i), path, source));
    if (source.is_sound(path + ".name") && !names.insert(message.tokens(i).name()).second) {
      source.refuse(path + ".name", fmt::format("'{}' is the name of an earlier token, too",
                                                printable(message.tokens(i).name())));
    }
    const std::string& certificate = message.tokens(i).certificate();
    if (!certificate.empty() && source.is_sound(path + ".certificate") &&
        !certificates.insert(certificate).second) {
      source.refuse(path + ".certificate", "is that of an earlier entry, too");
    }
  }
  if (read.tokens_.size() > kMost) {
    source.refuse("tokens", fmt::format("there are {}; allowed: {}", read.tokens_.size(), kMost));
  }
  source.require_sound();
  return read;
}

template <typename Is>
TokenFile::Found TokenFile::find_if(const Is& is_it, UtcTime now) const {
  const auto found = std::find_if(tokens_.begin(), tokens_.end(), is_it);
  if (found == tokens_.end()) return {};
  const bool ended = found->ends && now >= *found->ends;
  return {ended ? TokenState::ended : TokenState::good, &*found};
}

TokenFile::Found TokenFile::find(std::string_view text, UtcTime now) const {
  // What is compared is a digest: how long that takes tells nothing of a token.
  const std::string digest = digest_of(text);
  return find_if([&](const KeptToken& token) { return token.sha256 == digest; }, now);
}

TokenFile::Found TokenFile::find_certificate(std::string_view digest, UtcTime now) const {
  if (digest.empty()) return {};
  return find_if([&](const KeptToken& token) { return token.certificate == digest; }, now);
}

void TokenFile::add(KeptToken token) {
  require_entry("token", token.name, token.ship);
  if (tokens_.size() >= kMost) {
    throw std::invalid_argument(fmt::format("there are {} tokens; no more are allowed", kMost));
  }
  if (token.sha256.empty() != token.is_certificate()) {
    throw std::invalid_argument("an entry is of a token or of a certificate");
  }
  for (const KeptToken& other : tokens_) {
    if (token.is_certificate() && other.certificate == token.certificate) {
      throw std::invalid_argument(
          fmt::format("the certificate is that of '{}'; revoke it first", other.name));
    }
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
    out += token.is_certificate() ? fmt::format("    certificate: \"{}\"\n", token.certificate)
                                  : fmt::format("    sha256: \"{}\"\n", token.sha256);
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
