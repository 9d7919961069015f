#include "server/access/rights.hpp"

#include <fmt/format.h>

#include <array>
#include <stdexcept>
#include <vector>

#include "protocol/wire/schema.hpp"

namespace skerry::server {
namespace {

constexpr std::array kRoles = {access::OBSERVER, access::TRAINEE, access::ASSESSOR,
                               access::INSTRUCTOR, access::ADMIN};
static_assert(kRoles.size() == access::Role_ARRAYSIZE);

// "instructor and admin"
std::string names_of(Roles roles) {
  std::vector<std::string> names;
  for (const Role role : kRoles) {
    if ((roles >> role) & 1U) names.push_back(name_of(role));
  }
  std::string joined;
  for (std::size_t i = 0; i < names.size(); ++i) {
    joined += i == 0 ? "" : i + 1 == names.size() ? " and " : ", ";
    joined += names[i];
  }
  return joined;
}

constexpr std::string_view in_words(Scope scope) {
  switch (scope) {
    case Scope::open:
      return "everybody";
    case Scope::any:
      return "any";
    case Scope::ship:
      return "the token's ship";
    case Scope::fleet:
      return "no ship's token";
  }
  return "";
}

// "the token bridge-1"
std::string shown_by(const Who& who) {
  return fmt::format("the {} {}", who.by_certificate ? "certificate" : "token", who.name);
}

}  // namespace

bool has(const Right& right, Role role) { return ((right.roles >> role) & 1U) != 0; }

std::string text_of(const Who& who) {
  if (!who.role) return {};
  std::string text = who.name.empty() ? name_of(*who.role) : who.name + ", " + name_of(*who.role);
  if (who.by_certificate) text = "certificate " + text;
  return who.ship.empty() ? text : text + " of " + who.ship;
}

std::string name_of(Role role) { return wire::word_of(*access::Role_descriptor(), role); }

std::vector<std::string> role_names() {
  std::vector<std::string> names;
  for (const Role role : kRoles) names.push_back(name_of(role));
  return names;
}

Role role_named(std::string_view name) {
  for (const Role role : kRoles) {
    if (name == name_of(role)) return role;
  }
  throw std::invalid_argument(fmt::format("there is no role '{}'", name));
}

std::optional<std::string> why_not(const Who& who, std::string_view name, std::string_view ship) {
  const Right* right = right_of(name);
  if (right == nullptr) return fmt::format("no rule says who may do this ({})", name);
  if (right->scope == Scope::open) return std::nullopt;
  if (!who.role) return fmt::format("to {}: {}", right->does, who.more);
  if (!has(*right, *who.role)) {
    return fmt::format(
        "to {} is for {}; {}", right->does, names_of(right->roles),
        !who.more.empty() ? who.more
                          : fmt::format("{} is of the role {}", shown_by(who), name_of(*who.role)));
  }
  if (who.ship.empty()) return std::nullopt;
  if (right->scope == Scope::ship && ship != who.ship) {
    return fmt::format("to {}: {} is of the ship {} alone, and this radar is on {}", right->does,
                       shown_by(who), who.ship, ship.empty() ? "no ship" : ship);
  }
  if (right->scope == Scope::fleet) {
    return fmt::format("to {} is of all ships, and {} is of the ship {} alone", right->does,
                       shown_by(who), who.ship);
  }
  return std::nullopt;
}

std::string rights_page() {
  std::string page =
      "# Who may do what\n\n"
      "`skerry token rights` prints this page out of the table that the server decides by,\n"
      "[rights_table.cpp](rights_table.cpp); a test compares. What has no row is refused to "
      "everybody.\n\n"
      "A right of \"the token's ship\" ends at other ships' radars, if the token names a ship; one "
      "of\n\"no ship's token\" is for tokens that name none. A client's certificate that has an "
      "entry\n"
      "among the tokens is as a token on a connection that comes with it.\n\n"
      "| right | to | of |";
  std::string rule = "|---|---|---|";
  for (const Role role : kRoles) {
    page += fmt::format(" {} |", name_of(role));
    rule += "---|";
  }
  page += "\n" + rule + "\n";
  for (const Right& right : rights()) {
    page += fmt::format("| `{}` | {} | {} |", right.name, right.does, in_words(right.scope));
    for (const Role role : kRoles) {
      page += right.scope == Scope::open || has(right, role) ? " yes |" : " |";
    }
    page += "\n";
  }
  return page;
}

}  // namespace skerry::server
