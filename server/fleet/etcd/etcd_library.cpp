// The library that a server loads to reach an etcd.
#include <utility>

#include "server/fleet/etcd/etcd_store.hpp"
#include "server/fleet/store_source.hpp"

namespace skerry::fleet {
namespace {

class EtcdSource final : public StoreSource {
 public:
  explicit EtcdSource(std::shared_ptr<const EtcdMembers> members) : members_(std::move(members)) {}
  std::unique_ptr<KeyStore> store() override { return std::make_unique<EtcdStore>(members_); }

 private:
  std::shared_ptr<const EtcdMembers> members_;
};

}  // namespace
}  // namespace skerry::fleet

extern "C" skerry::fleet::StoreSource* skerry_open_etcd_1(
    const skerry::fleet::StoreAddress& address) {
  using namespace skerry::fleet;
  EtcdAddress etcd{address.members, std::nullopt};
  if (!address.authority.empty())
    etcd.tls = EtcdTls{address.authority, address.certificate, address.key};
  return new EtcdSource(std::make_shared<const EtcdMembers>(etcd));
}
