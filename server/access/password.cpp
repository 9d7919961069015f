#include "server/access/password.hpp"

#include <argon2.h>
#include <fmt/format.h>
#include <sys/random.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <stdexcept>

namespace skerry::server {
namespace {

constexpr std::size_t kSaltBytes = 16, kHashBytes = 32;
constexpr std::size_t kLeastBytes = 8, kMostBytes = 256;
constexpr unsigned kLanes = 1;
constexpr unsigned kMostMemoryKib = 256 * 1024, kMostPasses = 10, kMostLanes = 4;
constexpr std::string_view kKind = "$argon2id$v=19$";

// Takes "m=19456" off the beginning of `text`, with what ends it.
std::optional<unsigned> take_number(std::string_view& text, std::string_view name, char end) {
  if (!text.starts_with(name)) return std::nullopt;
  text.remove_prefix(name.size());
  if (text.starts_with('0')) return std::nullopt;
  unsigned value = 0;
  const auto [last, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const auto size = static_cast<std::size_t>(last - text.data());
  if (error != std::errc() || size == text.size() || text[size] != end) return std::nullopt;
  text.remove_prefix(size + 1);
  return value;
}

bool is_base64(std::string_view text, std::size_t least) {
  constexpr std::string_view kLetters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  return text.size() >= least && text.size() % 4 != 1 &&
         text.find_first_not_of(kLetters) == std::string_view::npos;
}

}  // namespace

std::optional<std::string> why_no_password(std::string_view password) {
  const bool is_plain = std::none_of(password.begin(), password.end(),
                                     [](unsigned char c) { return c < 0x20 || c == 0x7f; });
  if (is_plain && password.size() >= kLeastBytes && password.size() <= kMostBytes) {
    return std::nullopt;
  }
  return fmt::format("a password has {} to {} bytes, without control characters", kLeastBytes,
                     kMostBytes);
}

std::optional<std::string> why_no_hash(std::string_view hash) {
  constexpr const char* kExpected =
      "is no Argon2id hash; expected: $argon2id$v=19$m=..,t=..,p=..$SALT$HASH, as `skerry user` "
      "writes it";
  if (!hash.starts_with(kKind)) return kExpected;
  // As Argon2's own reader wants it: numbers without leading zeros, two texts of base64 without
  // padding, of at least 8 and 12 bytes.
  std::string_view rest = hash.substr(kKind.size());
  const auto memory = take_number(rest, "m=", ',');
  const auto passes = memory ? take_number(rest, "t=", ',') : std::nullopt;
  const auto lanes = passes ? take_number(rest, "p=", '$') : std::nullopt;
  const auto end = rest.find('$');
  if (!lanes || end == std::string_view::npos) return kExpected;
  if (!is_base64(rest.substr(0, end), 11) || !is_base64(rest.substr(end + 1), 16)) return kExpected;
  if (*passes == 0 || *lanes == 0 || *memory < 8 * *lanes) return kExpected;
  if (*memory > kMostMemoryKib || *passes > kMostPasses || *lanes > kMostLanes) {
    return fmt::format(
        "would cost {} KiB, {} passes and {} lanes to check; allowed: {} KiB, {} passes, {} lanes",
        *memory, *passes, *lanes, kMostMemoryKib, kMostPasses, kMostLanes);
  }
  return std::nullopt;
}

std::string hash_of_password(std::string_view password, PasswordCost cost) {
  if (const auto why = why_no_password(password)) throw std::invalid_argument(*why);
  std::array<std::uint8_t, kSaltBytes> salt;
  if (::getrandom(salt.data(), salt.size(), 0) != static_cast<ssize_t>(salt.size())) {
    throw std::runtime_error("the system gives no random numbers");
  }
  std::string hash(
      argon2_encodedlen(cost.passes, cost.memory_kib, kLanes, kSaltBytes, kHashBytes, Argon2_id),
      '\0');
  const int error =
      argon2id_hash_encoded(cost.passes, cost.memory_kib, kLanes, password.data(), password.size(),
                            salt.data(), salt.size(), kHashBytes, hash.data(), hash.size());
  if (error != ARGON2_OK) throw std::runtime_error(argon2_error_message(error));
  hash.resize(hash.find('\0'));
  return hash;
}

bool is_password(const std::string& hash, std::string_view password) {
  if (why_no_hash(hash) || password.size() > kMostBytes) return false;
  return argon2id_verify(hash.c_str(), password.data(), password.size()) == ARGON2_OK;
}

}  // namespace skerry::server
