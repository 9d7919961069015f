#include "clients/doctor/host_facts.hpp"

#include <arpa/inet.h>
#include <dirent.h>
#include <fmt/format.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <fstream>
#include <map>
#include <memory>
#include <sstream>

#include "clients/doctor/firewall.hpp"

namespace skerry::client::doctor {
namespace {

constexpr std::uint32_t kAnyGroup = ipv4(236, 6, 7, 8);  // one that radars use

std::uint32_t ipv4_of(const sockaddr* address) {
  sockaddr_in in{};
  std::memcpy(&in, address, sizeof in);
  return ntohl(in.sin_addr.s_addr);
}

std::vector<InterfaceAddress> read_addresses() {
  std::vector<InterfaceAddress> out;
  ifaddrs* all = nullptr;
  if (::getifaddrs(&all) != 0) return out;
  for (const ifaddrs* one = all; one != nullptr; one = one->ifa_next) {
    if (one->ifa_addr == nullptr || one->ifa_addr->sa_family != AF_INET) continue;
    const auto has = [&](unsigned flag) { return (one->ifa_flags & flag) != 0; };
    out.push_back({one->ifa_name, ipv4_of(one->ifa_addr),
                   one->ifa_netmask == nullptr ? ~0u : ipv4_of(one->ifa_netmask), has(IFF_UP),
                   has(IFF_RUNNING), has(IFF_LOOPBACK), has(IFF_MULTICAST)});
  }
  ::freeifaddrs(all);
  return out;
}

std::optional<std::uint32_t> read_groups_leave_from() {
  const int socket = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (socket < 0) return std::nullopt;
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(9);
  to.sin_addr.s_addr = htonl(kAnyGroup);
  std::optional<std::uint32_t> source;
  sockaddr_in own{};
  socklen_t size = sizeof own;
  // Sends nothing: only the route is looked up.
  if (::connect(socket, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0 &&
      ::getsockname(socket, reinterpret_cast<sockaddr*>(&own), &size) == 0) {
    source = ntohl(own.sin_addr.s_addr);
  }
  ::close(socket);
  return source;
}

using Folder = std::unique_ptr<DIR, int (*)(DIR*)>;

std::vector<std::string> entries_of(const std::string& path) {
  std::vector<std::string> names;
  const Folder folder(::opendir(path.c_str()), &::closedir);
  while (folder != nullptr) {
    const dirent* entry = ::readdir(folder.get());
    if (entry == nullptr) break;
    if (entry->d_name[0] != '.') names.emplace_back(entry->d_name);
  }
  return names;
}

// The programs that have those sockets open, by inode; other users' are not seen.
std::map<std::string, std::string> programs_of_sockets() {
  std::map<std::string, std::string> out;
  for (const std::string& process : entries_of("/proc")) {
    if (process.find_first_not_of("0123456789") != std::string::npos) continue;
    const std::string folder = "/proc/" + process;
    std::string name;
    std::getline(std::ifstream(folder + "/comm"), name);
    for (const std::string& file : entries_of(folder + "/fd")) {
      char link[64];
      const ssize_t length = ::readlink((folder + "/fd/" + file).c_str(), link, sizeof link - 1);
      if (length <= 0) continue;
      const std::string target(link, static_cast<std::size_t>(length));
      if (target.starts_with("socket:[")) {
        out[target.substr(8, target.size() - 9)] = fmt::format("{} ({})", name, process);
      }
    }
  }
  return out;
}

// "0100007F:1CF2", the address in the host's order of octets.
std::optional<Ipv4Endpoint> proc_endpoint(const std::string& text) {
  std::uint32_t address = 0;
  std::uint16_t port = 0;
  if (text.size() != 13) return std::nullopt;
  const char* begin = text.data();
  if (std::from_chars(begin, begin + 8, address, 16).ptr != begin + 8 ||
      std::from_chars(begin + 9, begin + 13, port, 16).ptr != begin + 13) {
    return std::nullopt;
  }
  return Ipv4Endpoint{ntohl(address), port};
}

void read_listeners(const char* table, bool tcp, const std::map<std::string, std::string>& programs,
                    std::vector<Listener>& out) {
  std::ifstream in(table);
  std::string line;
  std::getline(in, line);  // the heading
  while (std::getline(in, line)) {
    std::istringstream fields(line);
    std::string number, local, remote, state, queues, timer, again, user, wait, inode;
    if (!(fields >> number >> local >> remote >> state >> queues >> timer >> again >> user >>
          wait >> inode)) {
      continue;
    }
    const auto at = proc_endpoint(local);
    if (!at || (tcp && state != "0A")) continue;  // 0A: listens
    const auto program = programs.find(inode);
    out.push_back({tcp, *at, program == programs.end() ? "" : program->second});
  }
}

std::vector<std::string> read_strict_interfaces(const std::vector<InterfaceAddress>& addresses) {
  const auto value_of = [](const std::string& interface) {
    int value = 0;
    std::ifstream("/proc/sys/net/ipv4/conf/" + interface + "/rp_filter") >> value;
    return value;
  };
  std::vector<std::string> out;
  for (const InterfaceAddress& one : addresses) {
    // The greater of both holds; 1 is strict.
    if (!one.loopback && std::max(value_of("all"), value_of(one.interface)) == 1) {
      out.push_back(one.interface);
    }
  }
  return out;
}

}  // namespace

HostFacts read_host_facts() {
  HostFacts facts;
  facts.addresses = read_addresses();
  facts.groups_leave_from = read_groups_leave_from();
  const auto programs = programs_of_sockets();
  read_listeners("/proc/net/tcp", true, programs, facts.listeners);
  read_listeners("/proc/net/udp", false, programs, facts.listeners);
  facts.strict_interfaces = read_strict_interfaces(facts.addresses);
  facts.firewall = read_firewall();
  return facts;
}

}  // namespace skerry::client::doctor
