#include "clients/signals/sha512.hpp"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>
#include <iterator>
#include <stdexcept>

namespace skerry::client {
namespace {

void require(int done) {
  if (done != 1) throw std::runtime_error("libcrypto cannot make a SHA-512");
}

}  // namespace

struct Sha512::Context {
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> evp{EVP_MD_CTX_new(), EVP_MD_CTX_free};
};

Sha512::Sha512() : context_(std::make_unique<Context>()) {
  require(context_->evp ? 1 : 0);
  require(EVP_DigestInit_ex(context_->evp.get(), EVP_sha512(), nullptr));
}

Sha512::~Sha512() = default;

void Sha512::add(std::span<const std::uint8_t> bytes) {
  require(EVP_DigestUpdate(context_->evp.get(), bytes.data(), bytes.size()));
}

std::string Sha512::finish() {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned size = 0;
  require(EVP_DigestFinal_ex(context_->evp.get(), digest.data(), &size));
  std::string text;
  for (unsigned i = 0; i < size; ++i) fmt::format_to(std::back_inserter(text), "{:02x}", digest[i]);
  return text;
}

}  // namespace skerry::client
