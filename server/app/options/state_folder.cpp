#include "server/app/options/state_folder.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>

namespace skerry::server {
namespace {

namespace fs = std::filesystem;

}  // namespace

void place_in_state_folder(app::ServerConfig& config) {
  if (config.state().empty()) return;
  const fs::path folder(config.state());
  const auto in_folder = [&](const char* name) { return (folder / name).string(); };
  if (!config.has_audit()) config.set_audit(in_folder("audit.jsonl"));
  if (!config.has_setups()) config.set_setups(in_folder("setups"));
  if (config.recorder().folder().empty()) {
    config.mutable_recorder()->set_folder(in_folder("recordings"));
  }
  std::error_code error;
  if (!config.has_tokens() && fs::exists(folder / "tokens.yaml", error)) {
    config.set_tokens(in_folder("tokens.yaml"));
  }
  if (!config.has_users() && fs::exists(folder / "users.yaml", error)) {
    config.set_users(in_folder("users.yaml"));
  }
}

void make_state_folder(const std::string& folder) {
  if (folder.empty()) return;
  std::error_code error;
  if (fs::create_directories(folder, error)) {
    fs::permissions(folder, fs::perms::owner_all | fs::perms::group_read | fs::perms::group_exec,
                    error);
  }
  if (error || !fs::is_directory(folder)) {
    throw std::runtime_error(fmt::format("--state: {}: is no folder and cannot be made one: {}",
                                         folder,
                                         error ? error.message() : "something else has the name"));
  }
}

}  // namespace skerry::server
