#include "server/app/fleet/fleet_store.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "server/fleet/store_source.hpp"

namespace skerry::server {
namespace {

// Beside the program, as it is built and as it is installed.
std::filesystem::path library() {
  const auto program = std::filesystem::read_symlink("/proc/self/exe");
  return program.parent_path().parent_path() / "lib" / "skerry" / fleet::kEtcdLibrary;
}

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (!in || text.empty()) {
    throw std::runtime_error(fmt::format(
        "--fleet-tls: {} cannot be read; expected a folder with ca.pem, host.pem and host.key",
        file.string()));
  }
  return text;
}

}  // namespace

std::function<std::unique_ptr<fleet::KeyStore>()> open_fleet_store(
    const std::vector<std::string>& members, const std::string& tls) {
  fleet::StoreAddress address{members, {}, {}, {}};
  if (!tls.empty()) {
    const std::filesystem::path folder(tls);
    address.authority = text_of(folder / "ca.pem");
    address.certificate = text_of(folder / "host.pem");
    address.key = text_of(folder / "host.key");
  }
  const std::filesystem::path file = library();
  void* const handle = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) {
    throw std::runtime_error(fmt::format(
        "--fleet: {} cannot be loaded ({}); server/run --fleet ... installs what it needs and "
        "builds it",
        file.string(), ::dlerror()));
  }
  const auto open = reinterpret_cast<fleet::OpenEtcd>(::dlsym(handle, fleet::kOpenEtcd));
  if (open == nullptr) {
    throw std::runtime_error(fmt::format("--fleet: {} is of another version", file.string()));
  }
  // The library stays loaded: gRPC's threads outlive any store.
  const std::shared_ptr<fleet::StoreSource> source(open(address));
  return [source] { return source->store(); };
}

}  // namespace skerry::server
