// The state folder: what a server keeps, in one place, of which a copy is a backup.
#pragma once

#include <string>

#include "server/app/config.pb.h"

namespace skerry::server {

// Gives what the server keeps a place in the folder `config.state()`, if there is one and
// where nothing else was said:
//   audit.jsonl, recordings/, setups/, and tokens.yaml and users.yaml if they are there.
void place_in_state_folder(app::ServerConfig& config);

// Makes the folder if it is missing, for its user and group alone; nothing for an empty name.
// Error: std::runtime_error naming it, if it cannot be made or is none.
void make_state_folder(const std::string& folder);

}  // namespace skerry::server
