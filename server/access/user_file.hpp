// UserFile: the people whom a server knows by name and password.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "server/access/rights.hpp"

namespace skerry::server {

// What the file has of a user.
struct KeptUser {
  std::string name;  // 1 to 64 bytes of printable UTF-8
  Role role = access::OBSERVER;
  std::string ship;      // empty: of all
  std::string password;  // its hash (password.hpp)
  bool operator==(const KeptUser&) const = default;
};

class UserFile {
 public:
  static constexpr std::size_t kMost = 4000;  // what a YAML text may hold (yaml_tree.hpp)

  UserFile() = default;
  // Error: ConfigError naming file, line and what is wrong: a file that cannot be read, two users
  // of one name, a hash that is none or costs too much, more than kMost.
  static UserFile read(const std::filesystem::path& file);
  // The same of a text; `file` is for errors.
  static UserFile parse(const std::string& text, const std::string& file);

  const std::vector<KeptUser>& users() const { return users_; }
  // nullptr if there is none of that name.
  const KeptUser* find(std::string_view name) const;

  // Error: std::invalid_argument if the name is taken or a value is not allowed.
  void add(KeptUser user);
  // False if there is none of that name.
  bool remove(std::string_view name);
  bool set_password(std::string_view name, std::string hash);

  // As read() reads it.
  std::string text() const;

 private:
  std::vector<KeptUser> users_;
};

// Changes the file: reads it (no file: no users), lets `change` change it, and writes it whole or
// not at all, readable by its owner alone, while no other such change runs.
// Error: as read(); std::runtime_error naming the file and the system's reason; what `change`
// throws.  Then the file is as before.
void change_users(const std::filesystem::path& file, const std::function<void(UserFile&)>& change);

}  // namespace skerry::server
