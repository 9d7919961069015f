// The table of rights.  A message, route or command without a row is refused to everybody.
#include <algorithm>
#include <array>
#include <string>

#include "server/access/rights.hpp"

namespace skerry::server {
namespace {

using access::ADMIN, access::ASSESSOR, access::INSTRUCTOR, access::OBSERVER, access::TRAINEE;

// Who sees; who has a console; who reads a board; who knows the truth; who leads the exercise.
constexpr Roles kAll = roles_of(OBSERVER, TRAINEE, ASSESSOR, INSTRUCTOR, ADMIN);
constexpr Roles kConsole = roles_of(TRAINEE, INSTRUCTOR, ADMIN);
constexpr Roles kBoard = roles_of(TRAINEE, ASSESSOR, INSTRUCTOR, ADMIN);
constexpr Roles kTruth = roles_of(ASSESSOR, INSTRUCTOR, ADMIN);
constexpr Roles kExercise = roles_of(INSTRUCTOR, ADMIN);

constexpr auto kRights = std::to_array<Right>({
    // The native protocol: messages, and fields of those whose fields differ.
    {"sign_in.*", Scope::open, 0, "say who one is, by a token, a password or a class code"},
    {"subscribe.*", Scope::ship, kAll, "see a radar's video, settings and own ship"},
    {"subscribe.new_view", Scope::ship, kConsole, "have a view of her own"},
    {"subscribe.exercise_hz", Scope::fleet, kTruth, "see all ships as they really are"},
    {"set.course_deg", Scope::ship, kConsole, "order own ship's course"},
    {"set.speed_kn", Scope::ship, kConsole, "order own ship's speed"},
    {"set.con", Scope::ship, kConsole, "con own ship"},
    {"set.controls", Scope::ship, kConsole, "set the controls of a view and of a radar"},
    {"set.world", Scope::fleet, kExercise, "change sea, air, rain, targets and artefacts"},
    {"set.exercise", Scope::fleet, kExercise, "lead the exercise: ships, faults, clock, events"},
    {"set.lock", Scope::fleet, kExercise, "lock controls"},
    {"set.unlock", Scope::fleet, kExercise, "unlock controls"},
    {"set.instructor", Scope::fleet, kExercise, "change what is locked"},
    {"target_order.*", Scope::ship, kConsole, "acquire, cancel and rule a view's targets"},
    {"get_status.*", Scope::any, kAll, "read the server's status"},
    {"get_hops.*", Scope::any, kAll, "see how a relay is connected"},
    {"get_coastline.*", Scope::any, kAll, "have the coast about a place"},
    {"get_chart_objects.*", Scope::any, kAll, "have the chart's objects about a place"},
    {"record.*", Scope::fleet, kExercise, "start, mark and stop recordings"},
    {"playback.*", Scope::fleet, kExercise, "pause, move and pace a playback"},
    {"class_order.*", Scope::fleet, kExercise, "make, see and end class codes"},
    {"board_access.*", Scope::ship, kAll, "read an interface board's registers"},
    {"board_access.write", Scope::ship, kExercise, "write an interface board's registers"},
    {"board_stream.*", Scope::ship, kBoard, "have the records or signals of a board"},
    {"board_fifo.*", Scope::ship, kExercise, "take sweeps out of a board's FIFO"},
    {"board_ring.*", Scope::ship, kExercise, "open a board's ring in shared memory"},
    // HTTP.
    {"GET /", Scope::open, 0, "load the pages of console, con and instructor"},
    {"GET /controls.json", Scope::open, 0, "read what controls there are"},
    {"GET /ws", Scope::open, 0, "begin the native protocol; each message has its own right"},
    {"GET /login", Scope::open, 0, "learn who one is"},
    {"POST /login", Scope::open, 0, "sign in by password or class code"},
    {"DELETE /login", Scope::open, 0, "sign out"},
    {"GET /status", Scope::any, kAll, "read the server's status"},
    {"GET /metrics", Scope::any, kAll, "read the metrics"},
    {"GET /audit", Scope::fleet, kExercise, "see who did what"},
    {"GET /setups", Scope::any, kAll, "see and use the set-ups that consoles have kept"},
    {"PUT /setups", Scope::any, kConsole, "keep a console's set-up"},
    {"DELETE /setups", Scope::any, kConsole, "delete a set-up that is kept"},
    // Signal K, on the same port.
    {"signalk.discover", Scope::open, 0, "learn that a Signal K server is here, and log in"},
    {"signalk.read", Scope::ship, kAll, "read radars, controls, targets and ships"},
    {"signalk.stream", Scope::ship, kAll, "have deltas and spokes"},
    {"signalk.change", Scope::ship, kConsole, "change controls; acquire and cancel targets"},
});

}  // namespace

std::span<const Right> rights() { return kRights; }

const Right* right_of(std::string_view name) {
  const auto row_named = [](std::string_view wanted) -> const Right* {
    const auto found = std::find_if(kRights.begin(), kRights.end(),
                                    [&](const Right& right) { return right.name == wanted; });
    return found == kRights.end() ? nullptr : &*found;
  };
  if (const Right* own = row_named(name)) return own;
  return row_named(std::string(name.substr(0, name.find('.'))) + ".*");
}

}  // namespace skerry::server
