// The text of scenarios/bergen.yaml, built into the program.
#pragma once

namespace skerry::server {

extern const char* const kDefaultScenarioText;

}  // namespace skerry::server
