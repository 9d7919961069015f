// Who may do what: one table of rights, and the decision by it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "server/access/access.pb.h"

namespace skerry::server {

using access::Role;

// Who stands behind a connection or a request.
struct Who {
  std::optional<Role> role;     // none: nobody that the server knows
  std::string ship;             // the own ship that all she does is of; empty: of any
  std::string name;             // for logs
  std::string more;             // how she may do more than her role says; ends a refusal
  bool by_certificate = false;  // she is known by the connection's certificate, not by a token
};

// What a right is about.
enum class Scope : std::uint8_t {
  open,   // for everybody, known or not
  any,    // of no ship in particular, and nothing changes
  ship,   // of the own ship that the message's radar is on
  fleet,  // of all ships: not for those who are bound to one
};

// A set of roles: bit n is role n's.
using Roles = std::uint8_t;
template <typename... Each>
constexpr Roles roles_of(Each... each) {
  return static_cast<Roles>(((1U << each) | ... | 0U));
}

// A row: what may be done, in the words of the protocol, and by which roles.
struct Right {
  std::string_view name;  // "set.course_deg", "GET /status", "signalk.change"
  Scope scope = Scope::any;
  Roles roles = 0;        // of Scope::open: none
  std::string_view does;  // "order own ship's course"
};

// All rows.  A row "record.*" holds for every field of the message `record`.
std::span<const Right> rights();

// The row of a name: its own, or "record.*" for "record.name".  nullptr if there is none.
const Right* right_of(std::string_view name);

bool has(const Right& right, Role role);

// Why `who` may not, if so: "no rule" of a name without a row.  `ship` is the own ship that it is
// about, looked at where the scope is Scope::ship.
std::optional<std::string> why_not(const Who& who, std::string_view right,
                                   std::string_view ship = {});

// "Anna, trainee of Frida" or "certificate relay, observer", for logs; empty: nobody that the
// server knows.
std::string text_of(const Who& who);

// "observer", as files and command lines have it.
std::string name_of(Role role);
std::vector<std::string> role_names();
// Error: std::invalid_argument if there is none of that name.
Role role_named(std::string_view name);

// The table as the page RIGHTS.md has it.
std::string rights_page();

}  // namespace skerry::server
