#include "clients/doctor/firewall.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <optional>
#include <string>

namespace skerry::client::doctor {
namespace {

constexpr char kNft[] = "/usr/sbin/nft";
constexpr std::size_t kMost = 4 << 20;  // octets of rules that are read

// Nothing if it could not say.
std::optional<std::string> ruleset() {
  if (::access(kNft, X_OK) != 0) return std::nullopt;
  std::FILE* pipe = ::popen((std::string(kNft) + " list ruleset 2>/dev/null").c_str(), "r");
  if (pipe == nullptr) return std::nullopt;
  std::string text;
  char part[4096];
  for (std::size_t n; (n = std::fread(part, 1, sizeof part, pipe)) > 0;) {
    if (text.size() < kMost) text.append(part, n);
  }
  const int status = ::pclose(pipe);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) return std::nullopt;
  return text;
}

}  // namespace

Firewall firewall_of(std::string_view rules) {
  if (rules.find_first_not_of(" \t\n") == std::string_view::npos) return Firewall::none;
  for (std::size_t at = 0; at < rules.size();) {
    const std::size_t end = std::min(rules.find('\n', at), rules.size());
    const std::string_view line = rules.substr(at, end - at);
    if (line.find("hook input") != std::string_view::npos &&
        line.find("policy drop") != std::string_view::npos) {
      return Firewall::drops;
    }
    at = end + 1;
  }
  return Firewall::open;
}

Firewall read_firewall() {
  if (const auto rules = ruleset()) return firewall_of(*rules);
  // Of iptables' older kind; the file is empty without rules, and closed to all but root.
  std::ifstream tables("/proc/net/ip_tables_names");
  std::string name;
  const bool has_tables = static_cast<bool>(std::getline(tables, name));
  const bool closed = ::access("/proc/net/ip_tables_names", F_OK) == 0 &&
                      ::access("/proc/net/ip_tables_names", R_OK) != 0;
  const bool asked_in_vain = ::access(kNft, X_OK) == 0;
  return has_tables || closed || asked_in_vain ? Firewall::unreadable : Firewall::none;
}

}  // namespace skerry::client::doctor
