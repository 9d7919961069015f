#include "tests/unit/net/test_certificates.hpp"

#include <openssl/pem.h>
#include <openssl/x509.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>

namespace skerry::server {
namespace {

template <auto Free>
struct Freed {
  template <typename T>
  void operator()(T* what) const {
    Free(what);
  }
};
using File = std::unique_ptr<std::FILE, Freed<std::fclose>>;
using Certificate = std::unique_ptr<X509, Freed<::X509_free>>;
using Key = std::unique_ptr<EVP_PKEY, Freed<::EVP_PKEY_free>>;

File open_file(const std::string& name, const char* how) {
  File file(std::fopen(name.c_str(), how));
  if (!file) throw std::runtime_error(name + ": cannot be opened");
  return file;
}

Certificate read_certificate(const std::string& file) {
  return Certificate(::PEM_read_X509(open_file(file, "r").get(), nullptr, nullptr, nullptr));
}

Key read_key(const std::string& certificate) {
  const auto file = std::filesystem::path(certificate).replace_extension(".key");
  return Key(::PEM_read_PrivateKey(open_file(file, "r").get(), nullptr, nullptr, nullptr));
}

}  // namespace

void sign_again(const std::string& file, const std::string& authority, TestValidity validity) {
  const Certificate certificate = read_certificate(file), issuer = read_certificate(authority);
  const Key key = read_key(authority);
  ::X509_gmtime_adj(::X509_getm_notBefore(certificate.get()), validity.from_now.count());
  ::X509_gmtime_adj(::X509_getm_notAfter(certificate.get()), validity.until_now.count());
  ::X509_set_issuer_name(certificate.get(), ::X509_get_subject_name(issuer.get()));
  const int at = ::X509_get_ext_by_NID(certificate.get(), NID_authority_key_identifier, -1);
  if (at >= 0) ::X509_EXTENSION_free(::X509_delete_ext(certificate.get(), at));
  if (::X509_sign(certificate.get(), key.get(), ::EVP_sha256()) == 0 ||
      ::PEM_write_X509(open_file(file, "w").get(), certificate.get()) != 1) {
    throw std::runtime_error(file + ": cannot be signed");
  }
}

std::string der_of(const std::string& file) {
  unsigned char* bytes = nullptr;
  const int size = ::i2d_X509(read_certificate(file).get(), &bytes);
  const std::string text(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(size));
  ::OPENSSL_free(bytes);
  return text;
}

}  // namespace skerry::server
