// Sha256: the digest that charts and video are known again by.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

struct evp_md_ctx_st;

namespace skerry::server {

// SHA-256 (FIPS 180-4) of a stream of bytes.  Throws std::runtime_error where OpenSSL has none.
//
// Thread: one at a time.
class Sha256 {
 public:
  Sha256();
  void add(std::span<const std::uint8_t> bytes);
  void add(std::string_view bytes);
  // The 32 bytes of what was added; then it begins anew.
  std::string take();

 private:
  struct Free {
    void operator()(evp_md_ctx_st* context) const;
  };
  void begin();

  std::unique_ptr<evp_md_ctx_st, Free> context_;
};

// Two digits to a byte, lower case.
std::string hexadecimal(std::string_view bytes);

}  // namespace skerry::server
