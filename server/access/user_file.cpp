#include "server/access/user_file.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <utility>

#include "server/access/file_text.hpp"
#include "server/access/password.hpp"
#include "server/config/whole_file.hpp"
#include "server/config/yaml_message.hpp"

namespace skerry::server {

namespace fs = std::filesystem;

UserFile UserFile::read(const fs::path& file) {
  return parse(read_yaml_file(file.string()), file.string());
}

UserFile UserFile::parse(const std::string& text, const std::string& file) {
  access::UserFile message;
  YamlSource source(file);
  read_yaml(text, source, message);
  UserFile read;
  std::set<std::string_view> names;
  for (int i = 0; i < message.users_size(); ++i) {
    const access::User& user = message.users(i);
    const std::string path = fmt::format("users[{}]", i);
    read.users_.push_back({user.name(), user.role(), user.ship(), user.password()});
    if (source.is_sound(path + ".password")) {
      if (const auto why = why_no_hash(user.password())) source.refuse(path + ".password", *why);
    }
    if (source.is_sound(path + ".name") && !names.insert(user.name()).second) {
      source.refuse(path + ".name", fmt::format("'{}' is the name of an earlier user, too",
                                                printable(user.name())));
    }
  }
  if (read.users_.size() > kMost) {
    source.refuse("users", fmt::format("there are {}; allowed: {}", read.users_.size(), kMost));
  }
  source.require_sound();
  return read;
}

const KeptUser* UserFile::find(std::string_view name) const {
  const auto found = std::find_if(users_.begin(), users_.end(),
                                  [&](const KeptUser& user) { return user.name == name; });
  return found == users_.end() ? nullptr : &*found;
}

void UserFile::add(KeptUser user) {
  require_entry("user", user.name, user.ship);
  if (users_.size() >= kMost) {
    throw std::invalid_argument(fmt::format("there are {} users; no more are allowed", kMost));
  }
  if (find(user.name) != nullptr) {
    throw std::invalid_argument(
        fmt::format("there is a user '{}'; remove her, or give this one another name", user.name));
  }
  users_.push_back(std::move(user));
}

bool UserFile::remove(std::string_view name) {
  return std::erase_if(users_, [&](const KeptUser& user) { return user.name == name; }) > 0;
}

bool UserFile::set_password(std::string_view name, std::string hash) {
  const auto found = std::find_if(users_.begin(), users_.end(),
                                  [&](const KeptUser& user) { return user.name == name; });
  if (found == users_.end()) return false;
  found->password = std::move(hash);
  return true;
}

std::string UserFile::text() const {
  if (users_.empty()) return "users: []\n";
  std::string out =
      "# Users of skerryd, with Argon2id of their passwords; `skerry user` changes it.\n";
  out += "users:\n";
  for (const KeptUser& user : users_) {
    out += fmt::format("  - name: {}\n    role: {}\n", in_quotes(user.name), name_of(user.role));
    if (!user.ship.empty()) out += fmt::format("    ship: {}\n", in_quotes(user.ship));
    out += fmt::format("    password: {}\n", in_quotes(user.password));
  }
  return out;
}

void change_users(const fs::path& file, const std::function<void(UserFile&)>& change) {
  while_locked(file, [&] {
    UserFile users;
    if (fs::exists(file)) users = UserFile::read(file);
    change(users);
    write_whole(file, users.text(), S_IRUSR | S_IWUSR);
  });
}

}  // namespace skerry::server
