// SHA-512 by OpenSSL.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace skerry::client {

class Sha512 {
 public:
  Sha512();  // Error: std::runtime_error if libcrypto has none
  ~Sha512();
  Sha512(const Sha512&) = delete;
  Sha512& operator=(const Sha512&) = delete;

  void add(std::span<const std::uint8_t> bytes);
  // 128 lower-case hex digits; nothing may be added after it.
  std::string finish();

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

}  // namespace skerry::client
