#include "protocol/digest/digest.hpp"

#include <openssl/evp.h>

#include <array>
#include <stdexcept>

namespace skerry {
namespace {

void require(int ok) {
  if (ok != 1) throw std::runtime_error("the digest is not to be had from OpenSSL");
}

}  // namespace

void Digest::Free::operator()(evp_md_ctx_st* context) const { EVP_MD_CTX_free(context); }

Digest::Digest(const evp_md_st* kind) : kind_(kind), context_(EVP_MD_CTX_new()) {
  require(context_ != nullptr);
  begin();
}

void Digest::begin() { require(EVP_DigestInit_ex(context_.get(), kind_, nullptr)); }

void Digest::add(std::span<const std::uint8_t> bytes) {
  require(EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()));
}

void Digest::add(std::string_view bytes) {
  require(EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()));
}

std::string Digest::take() {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned size = 0;
  require(EVP_DigestFinal_ex(context_.get(), digest.data(), &size));
  begin();
  return {digest.begin(), digest.begin() + size};
}

Sha256::Sha256() : Digest(EVP_sha256()) {}
Sha512::Sha512() : Digest(EVP_sha512()) {}

std::string hexadecimal(std::string_view bytes) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    text += kDigits[byte >> 4];
    text += kDigits[byte & 15];
  }
  return text;
}

}  // namespace skerry
