#include "server/net/signalk/mdns_advertiser.hpp"

#include <avahi-client/client.h>
#include <avahi-client/publish.h>
#include <avahi-common/alternative.h>
#include <avahi-common/error.h>
#include <avahi-common/malloc.h>
#include <avahi-common/simple-watch.h>
#include <avahi-common/strlst.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <pthread.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <utility>

#include "server/net/common/asio.hpp"

namespace skerry::server {
namespace {

constexpr std::chrono::seconds kRetry{30};

// The interface that has the address; every one for 0.0.0.0 and ::.
AvahiIfIndex avahi_interface(const std::string& text) {
  error_code error;
  const auto wanted = asio::ip::make_address(text, error);
  if (error || wanted.is_unspecified()) return AVAHI_IF_UNSPEC;
  ifaddrs* all = nullptr;
  if (getifaddrs(&all) != 0) return AVAHI_IF_UNSPEC;
  AvahiIfIndex index = AVAHI_IF_UNSPEC;
  for (const ifaddrs* each = all; each != nullptr; each = each->ifa_next) {
    if (each->ifa_addr == nullptr) continue;
    asio::ip::address address;
    if (each->ifa_addr->sa_family == AF_INET) {
      const auto* v4 = reinterpret_cast<const sockaddr_in*>(each->ifa_addr);
      address = asio::ip::address_v4(ntohl(v4->sin_addr.s_addr));
    } else if (each->ifa_addr->sa_family == AF_INET6) {
      const auto* v6 = reinterpret_cast<const sockaddr_in6*>(each->ifa_addr);
      asio::ip::address_v6::bytes_type bytes;
      std::copy(std::begin(v6->sin6_addr.s6_addr), std::end(v6->sin6_addr.s6_addr), bytes.begin());
      address = asio::ip::address_v6(bytes);
    }
    if (address == wanted) index = static_cast<AvahiIfIndex>(if_nametoindex(each->ifa_name));
  }
  freeifaddrs(all);
  return index;
}

}  // namespace

// Avahi calls back within avahi_simple_poll_iterate(), so on the thread "mdns" alone.
class MdnsAdvertiser::Impl {
 public:
  Impl(std::string name, AvahiIfIndex interface, std::vector<MdnsService> services)
      : name_(std::move(name)),
        interface_(interface),
        services_(std::move(services)),
        poll_(avahi_simple_poll_new()) {
    if (poll_ == nullptr) throw std::runtime_error("mDNS: no memory for Avahi's event loop");
    thread_ = std::thread([this] {
      pthread_setname_np(pthread_self(), "mdns");
      run();
    });
  }
  ~Impl() {
    {
      const std::lock_guard lock(mutex_);
      stopping_ = true;
    }
    stop_.notify_all();
    avahi_simple_poll_wakeup(poll_);
    thread_.join();
    avahi_simple_poll_free(poll_);
  }

 private:
  bool stopping() {
    const std::lock_guard lock(mutex_);
    return stopping_;
  }

  void run() {
    while (!stopping()) {
      if (connect()) {
        while (!stopping() && !failed_ && avahi_simple_poll_iterate(poll_, -1) == 0) {
        }
        disconnect();
      }
      std::unique_lock lock(mutex_);
      stop_.wait_for(lock, kRetry, [this] { return stopping_; });
    }
  }

  bool connect() {
    failed_ = false;
    int error = 0;
    client_ = avahi_client_new(avahi_simple_poll_get(poll_), AVAHI_CLIENT_NO_FAIL, on_client, this,
                               &error);
    if (client_ != nullptr) return true;
    if (!std::exchange(said_missing_, true)) {
      spdlog::info("mDNS: not announced, Avahi cannot be asked: {}", avahi_strerror(error));
    }
    return false;
  }

  void disconnect() {
    group_ = nullptr;  // the client frees it
    if (client_ != nullptr) avahi_client_free(std::exchange(client_, nullptr));
  }

  // `client_` is not yet set when it is called from within avahi_client_new().
  static void on_client(AvahiClient* client, AvahiClientState state, void* self) {
    auto& mine = *static_cast<Impl*>(self);
    switch (state) {
      case AVAHI_CLIENT_S_RUNNING:
        return mine.publish(client);
      case AVAHI_CLIENT_S_COLLISION:
      case AVAHI_CLIENT_S_REGISTERING:
        if (mine.group_ != nullptr) avahi_entry_group_reset(mine.group_);
        return;
      case AVAHI_CLIENT_FAILURE:
        mine.failed_ = true;
        return;
      case AVAHI_CLIENT_CONNECTING:
        return;
    }
  }

  static void on_group(AvahiEntryGroup* group, AvahiEntryGroupState state, void* self) {
    auto& mine = *static_cast<Impl*>(self);
    if (state == AVAHI_ENTRY_GROUP_COLLISION) {
      mine.take_another_name();
      mine.publish(avahi_entry_group_get_client(group));
    } else if (state == AVAHI_ENTRY_GROUP_ESTABLISHED) {
      spdlog::info("mDNS: announced as '{}'", mine.name_);
    } else if (state == AVAHI_ENTRY_GROUP_FAILURE) {
      mine.failed_ = true;
    }
  }

  void take_another_name() {
    char* another = avahi_alternative_service_name(name_.c_str());
    name_ = another;
    avahi_free(another);
  }

  void publish(AvahiClient* client) {
    if (group_ == nullptr) group_ = avahi_entry_group_new(client, on_group, this);
    if (group_ == nullptr) {
      failed_ = true;
      return;
    }
    avahi_entry_group_reset(group_);
    for (const MdnsService& service : services_) {
      const int error = add(service);
      if (error == AVAHI_ERR_COLLISION) {
        take_another_name();
        return publish(client);
      }
      if (error != 0) {
        spdlog::warn("mDNS: {} is not announced: {}", service.type, avahi_strerror(error));
        return;
      }
    }
    if (avahi_entry_group_commit(group_) != 0) failed_ = true;
  }

  int add(const MdnsService& service) {
    AvahiStringList* texts = nullptr;
    for (const std::string& text : service.texts) {
      texts = avahi_string_list_add(texts, text.c_str());
    }
    const int error = avahi_entry_group_add_service_strlst(
        group_, interface_, AVAHI_PROTO_UNSPEC, AvahiPublishFlags(0), name_.c_str(),
        service.type.c_str(), nullptr, nullptr, service.port, texts);
    avahi_string_list_free(texts);
    return error;
  }

  std::string name_;
  const AvahiIfIndex interface_;
  const std::vector<MdnsService> services_;
  AvahiSimplePoll* poll_;
  AvahiClient* client_ = nullptr;
  AvahiEntryGroup* group_ = nullptr;
  bool failed_ = false;
  bool said_missing_ = false;
  std::mutex mutex_;  // of stopping_
  std::condition_variable stop_;
  bool stopping_ = false;
  std::thread thread_;
};

MdnsAdvertiser::MdnsAdvertiser(std::string name, const std::string& address,
                               std::vector<MdnsService> services)
    : impl_(
          std::make_unique<Impl>(std::move(name), avahi_interface(address), std::move(services))) {}
MdnsAdvertiser::~MdnsAdvertiser() = default;

}  // namespace skerry::server
