// Passwords as the file of users has them: by Argon2id (RFC 9106), never the text.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace skerry::server {

// What it costs to try one password: memory and passes over it.  By default those of the OWASP
// Password Storage Cheat Sheet for Argon2id with one lane: some 20 ms of a core.
struct PasswordCost {
  unsigned memory_kib = 19'456;
  unsigned passes = 2;
};

// "$argon2id$v=19$m=19456,t=2,p=1$SALT$HASH" with 16 random bytes of salt.
// Error: std::invalid_argument as why_no_password(); std::runtime_error if the system gives no
// random numbers or no memory.
// Thread: any.
std::string hash_of_password(std::string_view password, PasswordCost cost = {});

// Whether the hash is of that password.  Takes as long for every wrong one.  False for what is no
// hash.  Thread: any.
bool is_password(const std::string& hash, std::string_view password);

// Why a text is no hash that this server would check: of another kind, or one whose check would
// take more than 256 MiB or 10 passes.
std::optional<std::string> why_no_hash(std::string_view hash);

// Why nobody may have it: 8 to 256 bytes of UTF-8 without control characters are allowed.
std::optional<std::string> why_no_password(std::string_view password);

}  // namespace skerry::server
