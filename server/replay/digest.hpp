// Digest: what video is compared by where it was not recorded.
#pragma once

#include <openssl/evp.h>

#include <array>
#include <memory>
#include <stdexcept>
#include <string>

namespace skerry::server {

// SHA-256 of a stream of bytes.
class Digest {
 public:
  Digest() : context_(EVP_MD_CTX_new(), EVP_MD_CTX_free) { begin(); }
  void begin() { require(EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr)); }
  void add(const std::string& bytes) {
    require(EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()));
  }
  std::string end() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned size = 0;
    require(EVP_DigestFinal_ex(context_.get(), digest.data(), &size));
    return {digest.begin(), digest.begin() + size};
  }

 private:
  static void require(int ok) {
    if (ok != 1) throw std::runtime_error("SHA-256 is not to be had from OpenSSL");
  }
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
};

}  // namespace skerry::server
