// Digests of bytes (FIPS 180-4), by OpenSSL: what charts, video and files of signals are known
// again by.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

struct evp_md_ctx_st;
struct evp_md_st;

namespace skerry {

// The digest of a stream of bytes.  Throws std::runtime_error where OpenSSL has none.
//
// Thread: one at a time.
class Digest {
 public:
  void add(std::span<const std::uint8_t> bytes);
  void add(std::string_view bytes);
  // The digest of what was added, as bytes; then it begins anew.
  std::string take();

 protected:
  explicit Digest(const evp_md_st* kind);

 private:
  struct Free {
    void operator()(evp_md_ctx_st* context) const;
  };
  void begin();

  const evp_md_st* kind_;
  std::unique_ptr<evp_md_ctx_st, Free> context_;
};

// 32 bytes.
class Sha256 : public Digest {
 public:
  Sha256();
};

// 64 bytes.
class Sha512 : public Digest {
 public:
  Sha512();
};

// Two digits to a byte, lower case.
std::string hexadecimal(std::string_view bytes);

}  // namespace skerry
