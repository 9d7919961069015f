// Lines of the log as the journal wants them: with their priority, without a time of their own.
#pragma once

#include <spdlog/formatter.h>

#include <memory>
#include <string>

namespace skerry::server {

// Whether standard error goes to systemd's journal, as JOURNAL_STREAM says and the descriptor
// confirms: an inherited variable alone does not count.
bool stderr_is_journal();

// "<4>[skerryd] radar 0 stands still": sd-daemon(3)'s prefix gives the journal's field PRIORITY.
std::unique_ptr<spdlog::formatter> journal_formatter();

// The prefix of an error, which ends the program.
inline constexpr const char* kJournalError = "<3>";

}  // namespace skerry::server
