// StoreSource: what the library that reaches an etcd gives to a server that loads it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "server/fleet/key_store.hpp"

namespace skerry::fleet {

struct StoreAddress {
  std::vector<std::string> members;         // "host:port" each
  std::string authority, certificate, key;  // PEM; all empty: in the clear
};

class StoreSource {
 public:
  virtual ~StoreSource() = default;
  // Thread: any.
  virtual std::unique_ptr<KeyStore> store() = 0;
};

// The library, and its one function: a source of the caller's to delete.
// Error: std::invalid_argument.
inline constexpr const char* kEtcdLibrary = "fleet-etcd.so";
inline constexpr const char* kOpenEtcd = "skerry_open_etcd_1";
using OpenEtcd = StoreSource* (*)(const StoreAddress&);

}  // namespace skerry::fleet
