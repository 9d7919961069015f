#include "server/tls/certificate.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <openssl/bio.h>
#include <openssl/err.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/rand.h>
#include <openssl/x509.h>
#include <openssl/x509v3.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <ctime>
#include <exception>
#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>

#include "server/config/whole_file.hpp"

namespace skerry::server {
namespace {

namespace fs = std::filesystem;

template <auto Free>
struct Freed {
  template <typename T>
  void operator()(T* what) const {
    Free(what);
  }
};
using Bio = std::unique_ptr<BIO, Freed<::BIO_free_all>>;
using Key = std::unique_ptr<EVP_PKEY, Freed<::EVP_PKEY_free>>;
using Certificate = std::unique_ptr<X509, Freed<::X509_free>>;
using Extension = std::unique_ptr<X509_EXTENSION, Freed<::X509_EXTENSION_free>>;
using Names = std::unique_ptr<GENERAL_NAMES, Freed<::GENERAL_NAMES_free>>;

constexpr long kVersion3 = 2;
// Certificates hold from an hour ago: the clocks of consoles differ.
constexpr long kBackdated = -3600;
constexpr std::size_t kMostCommonName = 64;  // RFC 5280, ub-common-name

[[noreturn]] void fail(const std::string& what) {
  std::array<char, 256> text{};
  ::ERR_error_string_n(::ERR_get_error(), text.data(), text.size());
  ::ERR_clear_error();
  throw std::runtime_error(fmt::format("{}: {}", what, text.data()));
}

template <typename T>
T needed(T made, const char* what) {
  if (!made) fail(what);
  return made;
}

Key make_key() { return Key(needed(EVP_EC_gen("P-256"), "no key could be made")); }

void set_common_name(X509_NAME* name, const std::string& text) {
  const auto* bytes = reinterpret_cast<const unsigned char*>(text.data());
  const auto size = static_cast<int>(std::min(text.size(), kMostCommonName));
  if (::X509_NAME_add_entry_by_txt(name, "CN", MBSTRING_UTF8, bytes, size, -1, 0) != 1) {
    fail("'" + text + "' is no name for a certificate");
  }
}

void extend(X509* certificate, X509* issuer, int kind, const std::string& value) {
  X509V3_CTX context{};
  ::X509V3_set_ctx(&context, issuer, certificate, nullptr, nullptr, 0);
  const Extension extension(
      needed(::X509V3_EXT_conf_nid(nullptr, &context, kind, value.c_str()), value.c_str()));
  if (::X509_add_ext(certificate, extension.get(), -1) != 1) fail(value);
}

// Without extensions, issuer and signature.
Certificate begin_certificate(EVP_PKEY* key, const std::string& name, std::chrono::days validity) {
  Certificate certificate(needed(::X509_new(), "no certificate could be made"));
  ::X509_set_version(certificate.get(), kVersion3);
  std::array<unsigned char, 16> serial{};
  if (::RAND_bytes(serial.data(), serial.size()) != 1) fail("no random numbers");
  serial[0] &= 0x7f;  // positive
  BIGNUM* const number = ::BN_bin2bn(serial.data(), serial.size(), nullptr);
  ::BN_to_ASN1_INTEGER(number, ::X509_get_serialNumber(certificate.get()));
  ::BN_free(number);
  ::X509_gmtime_adj(::X509_getm_notBefore(certificate.get()), kBackdated);
  ::X509_gmtime_adj(::X509_getm_notAfter(certificate.get()),
                    std::chrono::seconds(validity).count());
  ::X509_set_pubkey(certificate.get(), key);
  set_common_name(::X509_get_subject_name(certificate.get()), name);
  return certificate;
}

void sign(X509* certificate, EVP_PKEY* key) {
  if (::X509_sign(certificate, key, ::EVP_sha256()) == 0) fail("the certificate cannot be signed");
}

Bio memory() { return Bio(needed(::BIO_new(::BIO_s_mem()), "no memory")); }

std::string text_in(const Bio& bio) {
  char* data = nullptr;
  const long size = ::BIO_get_mem_data(bio.get(), &data);
  return {data, static_cast<std::size_t>(size)};
}

std::string pem_of(X509* certificate) {
  const Bio bio = memory();
  ::PEM_write_bio_X509(bio.get(), certificate);
  return text_in(bio);
}

std::string pem_of(EVP_PKEY* key) {
  const Bio bio = memory();
  ::PEM_write_bio_PrivateKey(bio.get(), key, nullptr, nullptr, 0, nullptr, nullptr);
  return text_in(bio);
}

std::string read_text(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) {
    throw std::runtime_error(file.string() +
                             ": there is no such file that can be read; expected PEM");
  }
  return {std::istreambuf_iterator<char>(in), {}};
}

Certificate certificate_in(const fs::path& file) {
  const std::string text = read_text(file);
  constexpr const char* kBegin = "-----BEGIN CERTIFICATE-----";
  const std::size_t begin = text.find(kBegin);
  if (begin == std::string::npos) {
    throw std::runtime_error(
        fmt::format("{}: no line '{}'; expected a certificate in PEM", file.string(), kBegin));
  }
  const Bio bio(::BIO_new_mem_buf(text.data(), static_cast<int>(text.size())));
  Certificate certificate(::PEM_read_bio_X509(bio.get(), nullptr, nullptr, nullptr));
  if (!certificate) {
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<long>(begin), '\n');
    ::ERR_clear_error();
    throw std::runtime_error(
        fmt::format("{}:{}: the certificate that begins here is damaged", file.string(), line));
  }
  return certificate;
}

Key key_in(const fs::path& file) {
  const std::string text = read_text(file);
  const Bio bio(::BIO_new_mem_buf(text.data(), static_cast<int>(text.size())));
  const auto no_passphrase = [](char*, int, int, void*) { return 0; };
  Key key(::PEM_read_bio_PrivateKey(bio.get(), nullptr, no_passphrase, nullptr));
  ::ERR_clear_error();
  if (!key) throw std::runtime_error(file.string() + ": no private key in PEM");
  return key;
}

// "IP:192.0.2.7" or "DNS:bridge".
std::string alternative_name(const std::string& name) {
  std::array<unsigned char, 16> address{};
  if (::inet_pton(AF_INET, name.c_str(), address.data()) == 1 ||
      ::inet_pton(AF_INET6, name.c_str(), address.data()) == 1) {
    return "IP:" + name;
  }
  const auto is_allowed = [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '-' || c == '.';
  };
  if (name.empty() || name.size() > 253 || !std::all_of(name.begin(), name.end(), is_allowed)) {
    throw std::runtime_error(
        fmt::format("'{}' is no host name and no IP address; without port or brackets", name));
  }
  return "DNS:" + name;
}

std::string text_of(const ASN1_OCTET_STRING* address) {
  std::array<char, INET6_ADDRSTRLEN> text{};
  const int family = ::ASN1_STRING_length(address) == 4 ? AF_INET : AF_INET6;
  ::inet_ntop(family, ::ASN1_STRING_get0_data(address), text.data(), text.size());
  return text.data();
}

struct Pair {
  fs::path key, certificate;
};

// A full disk leaves the pair from before: names alone change once both are written.
void write_both(const Pair& files, const std::string& key, const std::string& certificate) {
  const fs::path new_key = files.key.string() + ".new";
  const fs::path new_certificate = files.certificate.string() + ".new";
  try {
    write_whole(new_key, key, S_IRUSR | S_IWUSR);
    write_whole(new_certificate, certificate, S_IRUSR | S_IWUSR | S_IRGRP | S_IROTH);
    fs::rename(new_key, files.key);
    fs::rename(new_certificate, files.certificate);
  } catch (const std::exception&) {
    std::error_code ignored;
    fs::remove(new_key, ignored);
    fs::remove(new_certificate, ignored);
    throw;
  }
}

struct Authority {
  Certificate certificate;
  Key key;
};

Authority authority_in(const fs::path& folder) {
  Authority authority{certificate_in(folder / kAuthorityCertificate),
                      key_in(folder / kAuthorityKey)};
  if (::X509_check_private_key(authority.certificate.get(), authority.key.get()) != 1) {
    ::ERR_clear_error();
    throw std::runtime_error((folder / kAuthorityKey).string() + ": the key is of another " +
                             kAuthorityCertificate);
  }
  return authority;
}

// A certificate that signs for itself alone, and its key, in these files.  `alternatives`: other
// names of what it is for; empty: none.
void make_pair(const Authority& authority, const Pair& files, const std::string& name,
               const std::string& purpose, const std::string& alternatives) {
  X509* const issuer = authority.certificate.get();
  const Key key = make_key();
  const Certificate certificate = begin_certificate(key.get(), name, kServerValidity);
  X509* const raw = certificate.get();
  ::X509_set_issuer_name(raw, ::X509_get_subject_name(issuer));
  extend(raw, issuer, NID_basic_constraints, "critical,CA:FALSE");
  extend(raw, issuer, NID_key_usage, "critical,digitalSignature");
  extend(raw, issuer, NID_ext_key_usage, purpose);
  if (!alternatives.empty()) extend(raw, issuer, NID_subject_alt_name, alternatives);
  extend(raw, issuer, NID_subject_key_identifier, "hash");
  extend(raw, issuer, NID_authority_key_identifier, "keyid");
  sign(raw, authority.key.get());
  write_both(files, pem_of(key.get()), pem_of(raw));
}

// The name is that of two files, too.
void require_client_name(const std::string& name) {
  const auto is_allowed = [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '-' || c == '_' || c == '.';
  };
  const bool is_taken = name == fs::path(kAuthorityCertificate).stem().string() ||
                        name == fs::path(kServerCertificate).stem().string();
  if (!name.empty() && name.size() <= kMostCommonName && name.front() != '.' &&
      name.front() != '-' && !is_taken && std::all_of(name.begin(), name.end(), is_allowed)) {
    return;
  }
  throw std::runtime_error(
      fmt::format("'{}' is no name for a client's certificate; expected: 1 to {} letters, digits, "
                  "'-', '_' and '.', the first a letter, digit or '_'; not authority, not server",
                  name, kMostCommonName));
}

std::string common_name_of(const X509* certificate) {
  const X509_NAME* subject = ::X509_get_subject_name(certificate);
  const int at = ::X509_NAME_get_index_by_NID(subject, NID_commonName, -1);
  if (at < 0) return {};
  unsigned char* text = nullptr;
  const int size =
      ::ASN1_STRING_to_UTF8(&text, ::X509_NAME_ENTRY_get_data(::X509_NAME_get_entry(subject, at)));
  if (size < 0) return {};
  std::string name(reinterpret_cast<const char*>(text), static_cast<std::size_t>(size));
  ::OPENSSL_free(text);
  return name;
}

}  // namespace

void make_authority(const fs::path& folder, const std::string& name) {
  fs::create_directories(folder);
  for (const char* file : {kAuthorityCertificate, kAuthorityKey}) {
    if (fs::exists(folder / file)) {
      throw std::runtime_error(
          (folder / file).string() +
          " is there already: `skerry tls renew` makes another certificate by it; for another "
          "authority give another folder");
    }
  }
  const Key key = make_key();
  const Certificate certificate = begin_certificate(key.get(), name, kAuthorityValidity);
  X509* const raw = certificate.get();
  ::X509_set_issuer_name(raw, ::X509_get_subject_name(raw));
  extend(raw, raw, NID_basic_constraints, "critical,CA:TRUE,pathlen:0");
  extend(raw, raw, NID_key_usage, "critical,keyCertSign,cRLSign");
  extend(raw, raw, NID_subject_key_identifier, "hash");
  sign(raw, key.get());
  write_whole(folder / kAuthorityKey, pem_of(key.get()), S_IRUSR | S_IWUSR);
  write_whole(folder / kAuthorityCertificate, pem_of(raw), S_IRUSR | S_IWUSR | S_IRGRP | S_IROTH);
}

void make_server_certificate(const fs::path& folder, const std::vector<std::string>& names) {
  if (names.empty()) throw std::runtime_error("a server's certificate needs a name or address");
  std::string alternatives;
  for (const std::string& name : names) {
    if (!alternatives.empty()) alternatives += ',';
    alternatives += alternative_name(name);
  }
  make_pair(authority_in(folder), {folder / kServerKey, folder / kServerCertificate}, names.front(),
            "serverAuth", alternatives);
}

fs::path client_certificate_file(const fs::path& folder, const std::string& name) {
  return folder / (name + ".pem");
}

void make_client_certificate(const fs::path& folder, const std::string& name, ClientFiles files) {
  require_client_name(name);
  const Pair pair{folder / (name + ".key"), client_certificate_file(folder, name)};
  for (const fs::path& file : {pair.key, pair.certificate}) {
    if (files == ClientFiles::are_renewed || !fs::exists(file)) continue;
    throw std::runtime_error(file.string() +
                             " is there already: --renew makes another in its place; for another "
                             "client give another name");
  }
  if (files == ClientFiles::are_renewed) certificate_in(pair.certificate);  // there is one
  make_pair(authority_in(folder), pair, name, "clientAuth", {});
}

CertificateFacts facts_of_certificate(const fs::path& file) {
  const Certificate certificate = certificate_in(file);
  CertificateFacts facts;
  const Names names(static_cast<GENERAL_NAMES*>(
      ::X509_get_ext_d2i(certificate.get(), NID_subject_alt_name, nullptr, nullptr)));
  for (int i = 0; names && i < sk_GENERAL_NAME_num(names.get()); ++i) {
    const GENERAL_NAME* name = sk_GENERAL_NAME_value(names.get(), i);
    if (name->type == GEN_IPADD) facts.names.push_back(text_of(name->d.iPAddress));
    if (name->type == GEN_DNS) {
      const auto* text = reinterpret_cast<const char*>(::ASN1_STRING_get0_data(name->d.dNSName));
      facts.names.emplace_back(text,
                               static_cast<std::size_t>(::ASN1_STRING_length(name->d.dNSName)));
    }
  }
  facts.common_name = common_name_of(certificate.get());
  facts.is_for_clients = ::X509_check_purpose(certificate.get(), X509_PURPOSE_SSL_CLIENT, 0) == 1;
  std::tm end{};
  ::ASN1_TIME_to_tm(::X509_get0_notAfter(certificate.get()), &end);
  facts.until = std::chrono::sys_seconds(std::chrono::seconds(::timegm(&end)));
  facts.ends = fmt::format("{:04}-{:02}-{:02}", end.tm_year + 1900, end.tm_mon + 1, end.tm_mday);
  int days = 0, seconds = 0;
  ::ASN1_TIME_diff(&days, &seconds, nullptr, ::X509_get0_notAfter(certificate.get()));
  facts.days_left = seconds < 0 ? days - 1 : days;
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned size = 0;
  ::X509_digest(certificate.get(), ::EVP_sha256(), digest.data(), &size);
  for (unsigned i = 0; i < size; ++i) {
    facts.fingerprint += fmt::format("{}{:02X}", i == 0 ? "" : ":", digest[i]);
    facts.sha256 += fmt::format("{:02x}", digest[i]);
  }
  return facts;
}

void require_certificate(const fs::path& file) {
  const Certificate certificate = certificate_in(file);
  if (::X509_cmp_current_time(::X509_get0_notAfter(certificate.get())) < 0) {
    throw std::runtime_error(fmt::format("{}: the certificate ended on {}", file.string(),
                                         facts_of_certificate(file).ends));
  }
  if (::X509_cmp_current_time(::X509_get0_notBefore(certificate.get())) > 0) {
    throw std::runtime_error(file.string() +
                             ": the certificate does not hold yet; is this host's clock right?");
  }
}

}  // namespace skerry::server
