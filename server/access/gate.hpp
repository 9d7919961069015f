// Gate: who stands behind a connection, by where it comes from and by its token; and who has signed
// in.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "server/access/class_codes.hpp"
#include "server/access/rights.hpp"
#include "server/access/token_file.hpp"
#include "server/access/user_file.hpp"

namespace skerry::server {

// Where there is no file of tokens or users, everybody sees and the control token makes an admin.
// With one, who is not on the server's own host sees nothing without a token: of the file, or one
// that a user or a trainee was given when she signed in.  Who is on that host is an admin, unless a
// token says otherwise.  A connection's certificate that the file of tokens has stands for a token
// where none is shown.
//
// Thread: one at a time.
class Gate {
 public:
  struct Config {
    std::string control_token;     // empty: none
    std::filesystem::path tokens;  // empty: none
    std::filesystem::path users;   // empty: none
  };

  // Reads the files.  Error: ConfigError as TokenFile::read() and UserFile::read().
  explicit Gate(Config config);

  // Where somebody comes from, and what she shows.
  struct Shown {
    bool from_here = false;             // the server's own host
    std::string_view token = {};        // empty: none
    std::string_view certificate = {};  // its SHA-256, as KeptToken has it; empty: none
  };
  // Who that is.  Never throws for a token.
  Who who(const Shown& shown, UtcTime now) const;
  Who who(bool from_here, std::string_view token, UtcTime now) const {
    return who({.from_here = from_here, .token = token}, now);
  }

  // Whether the token, or without one the certificate, is a good one, wherever it comes from.
  bool knows(const Shown& shown, UtcTime now) const;
  bool knows(std::string_view token, UtcTime now) const { return knows({.token = token}, now); }

  // Reads the files anew if they are others than before; call it once a second.  What is wrong with
  // one is returned, once; then what was read before holds.
  std::optional<std::string> refresh(UtcTime now);

  // Another number after each change of who may do what: a file changed, or a token ended.
  std::uint64_t generation() const { return generation_; }

  bool has_users() const { return !users_.path.empty(); }  // a file of them
  bool is_closed() const { return has_users() || !tokens_.path.empty(); }
  bool knows_tokens() const { return is_closed() || !control_token_.empty(); }

  bool has_user(std::string_view name) const { return users_.contents.find(name) != nullptr; }
  // What a user's password is tried against (password.hpp).  Of a name that nobody has it is a hash
  // that no password is of: it takes as long, so that names cannot be found out.
  std::string hash_of(std::string_view name) const;

  // A user who has given her password holds a token from now on.  It ends after kSignedIn, when she
  // signs out, and as soon as the file has her no more or another password of hers; her role and
  // ship are always those of the file.  Of more than kMostOfUser the oldest ends.
  static constexpr std::chrono::hours kSignedIn{12};
  static constexpr std::size_t kMostOfUser = 20;
  struct SignedIn {
    std::string token;
    Who who;
    UtcTime ends;
  };
  // `hash`: what hash_of() gave when the password was tried.  Nothing if it is no more that of the
  // user.
  std::optional<SignedIn> sign_in(std::string_view name, std::string_view hash, UtcTime now);
  // The same by a class code, for a trainee.  Error: as ClassCodes::sign_in().
  std::optional<SignedIn> sign_in_class(std::string_view code, const std::string& name,
                                        UtcTime now);
  // Error: as ClassCodes::make().
  void make_class_code(const std::string& ship, std::chrono::minutes time, unsigned digits,
                       UtcTime now);
  // False if the ship has none.
  bool end_class_code(std::string_view ship);
  const ClassCodes& class_codes() const { return classes_; }

  // False if nobody is signed in with it.
  bool sign_out(std::string_view token);
  // When the token, or without one the certificate's entry, ends; nothing: it does not, or is none.
  std::optional<UtcTime> end_of(const Shown& shown, UtcTime now) const;
  std::optional<UtcTime> end_of(std::string_view token, UtcTime now) const {
    return end_of({.token = token}, now);
  }

 private:
  struct Stamp {
    std::filesystem::file_time_type time;
    std::uintmax_t size = 0;
    std::uint64_t inode = 0;
    bool operator==(const Stamp&) const = default;
  };
  // A file that is read again when it is another one.
  template <typename Contents>
  struct Watched {
    std::filesystem::path path;  // empty: none
    Contents contents;
    std::optional<Stamp> stamp;  // nothing: it is not there

    // Error: as Contents::read().
    bool read_if_new();
  };
  static std::optional<Stamp> stamp_of(const std::filesystem::path& file);

  struct Session {
    std::string user, hash;
    UtcTime began, ends;
  };
  // The user of a session, as the file has her now; nullptr if it is over.
  const KeptUser* user_of(const Session& session, UtcTime now) const;
  // Whoever signed in with the token; nothing: nobody did.
  std::optional<Who> who_signed_in(std::string_view token, UtcTime now) const;
  Who who_shows_no_token(const Shown& shown, UtcTime now) const;

  std::string control_token_;
  Watched<TokenFile> tokens_;
  Watched<UserFile> users_;
  std::map<std::string, Session, std::less<>> sessions_;  // by the digest of the token
  ClassCodes classes_;
  UtcTime looked_at_{};
  std::uint64_t generation_ = 1;
};

}  // namespace skerry::server
