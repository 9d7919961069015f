#include "server/access_tool/user_command.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

#include "echo/tool_console/console.hpp"
#include "server/access/password.hpp"
#include "server/access/user_file.hpp"
#include "server/access_tool/password_entry.hpp"

namespace skerry::server {
namespace {

// Options of a command, kept as long as the command.
struct UserGiven {
  std::string file = "users.yaml";
  std::string name;
  std::string role = "observer";
  std::string ship;
};

std::shared_ptr<UserGiven> user_given_to(CLI::App& command) {
  auto given = std::make_shared<UserGiven>();
  command.add_option("--users", given->file, "the file that skerryd --users reads")
      ->type_name("FILE")
      ->capture_default_str();
  return given;
}

void add_name(CLI::App& command, UserGiven& given) {
  command.add_option("NAME", given.name, "by which she signs in")->required();
}

int no_user(const UserGiven& given) {
  return echo::report(fmt::format("{} has no user '{}'", given.file, given.name),
                      "`skerry user list` has their names.");
}

echo::Command make_user_add_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("add", "Adds a user and asks for her password");
  const auto given = user_given_to(*command);
  add_name(*command, *given);
  command->add_option("--role", given->role, "what she may do; `skerry token rights` has the table")
      ->check(CLI::IsMember(role_names()))
      ->capture_default_str();
  command->add_option("--ship", given->ship, "the own ship that she is of (all)");
  return {command, [given] {
            KeptUser user{given->name, role_named(given->role), given->ship, {}};
            // What is wrong with the name is told before a password is asked for.
            UserFile before;
            if (std::filesystem::exists(given->file)) before = UserFile::read(given->file);
            before.add(user);
            user.password = hash_of_password(enter_password(given->name));
            change_users(given->file, [&](UserFile& file) { file.add(user); });
            fmt::print(stderr, "Kept in {} as {}, {}{}.\n", given->file, given->name, given->role,
                       given->ship.empty() ? "" : " of the ship " + given->ship);
            return echo::kExitOk;
          }};
}

echo::Command make_user_list_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("list", "Lists the users of the file");
  const auto given = user_given_to(*command);
  return {command, [given] {
            const UserFile file = UserFile::read(given->file);
            std::string out = fmt::format("{:<24} {:<11} {}\n", "name", "role", "ship");
            for (const KeptUser& user : file.users()) {
              out += fmt::format("{:<24} {:<11} {}\n", user.name, name_of(user.role),
                                 user.ship.empty() ? "all" : user.ship);
            }
            echo::write_out(out);
            return echo::kExitOk;
          }};
}

echo::Command make_user_passwd_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("passwd", "Gives a user another password");
  const auto given = user_given_to(*command);
  add_name(*command, *given);
  return {command, [given] {
            if (UserFile::read(given->file).find(given->name) == nullptr) return no_user(*given);
            const std::string hash = hash_of_password(enter_password(given->name));
            bool was_there = false;
            change_users(given->file,
                         [&](UserFile& file) { was_there = file.set_password(given->name, hash); });
            return was_there ? echo::kExitOk : no_user(*given);
          }};
}

echo::Command make_user_remove_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("remove", "Takes a user out of the file; she is signed out in a second");
  const auto given = user_given_to(*command);
  add_name(*command, *given);
  return {command, [given] {
            UserFile::read(given->file);  // there is one
            bool was_there = false;
            change_users(given->file,
                         [&](UserFile& file) { was_there = file.remove(given->name); });
            return was_there ? echo::kExitOk : no_user(*given);
          }};
}

}  // namespace

std::vector<echo::Command> make_user_commands(CLI::App& app) {
  return {make_user_add_command(app), make_user_list_command(app), make_user_passwd_command(app),
          make_user_remove_command(app)};
}

}  // namespace skerry::server
