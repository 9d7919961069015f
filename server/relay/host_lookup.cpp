#include "server/relay/host_lookup.hpp"

#include <pthread.h>

#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace skerry::server {
namespace {

namespace asio = boost::asio;

// Nothing: it is a name.
std::optional<HostAddresses> as_address(const std::string& name, std::uint16_t port) {
  boost::system::error_code error;
  const auto address = asio::ip::make_address(name, error);
  if (error) return std::nullopt;
  return HostAddresses{{}, {{address, port}}};
}

// On a thread of its own, for which nobody waits.
void resolve_apart(HostLookup::Resolve resolve, std::string name, std::uint16_t port,
                   HostLookup::Done done) {
  std::thread([resolve = std::move(resolve), name = std::move(name), port, done = std::move(done)] {
    pthread_setname_np(pthread_self(), "look-up");
    done(resolve(name, port));
  }).detach();
}

}  // namespace

// Between the thread of the io_context and that of the look-up.
struct HostLookup::Shared {
  std::mutex mutex;
  asio::io_context* io = nullptr;  // nullptr: it is no more
  std::vector<Done> waiting;       // of the io_context's thread
};

HostLookup::HostLookup(asio::io_context& io, std::string name, std::uint16_t port, Resolve resolve)
    : io_(io),
      name_(std::move(name)),
      port_(port),
      resolve_(std::move(resolve)),
      shared_(std::make_shared<Shared>()) {
  shared_->io = &io;
}

HostLookup::~HostLookup() {
  {
    const std::lock_guard lock(shared_->mutex);
    shared_->io = nullptr;
  }
  shared_->waiting.clear();  // what it holds is not the look-up's to end
}

void HostLookup::find(Done done) {
  shared_->waiting.push_back(std::move(done));
  if (shared_->waiting.size() > 1) return;
  const auto answer = [](const std::shared_ptr<Shared>& shared, HostAddresses found) {
    const std::lock_guard lock(shared->mutex);
    if (shared->io == nullptr) return;
    asio::post(*shared->io, [weak = std::weak_ptr(shared), found = std::move(found)] {
      const auto here = weak.lock();
      if (here == nullptr) return;
      for (const Done& each : std::exchange(here->waiting, {})) each(found);
    });
  };
  if (auto known = as_address(name_, port_)) return answer(shared_, *std::move(known));
  resolve_apart(resolve_, name_, port_,
                [shared = shared_, answer](const HostAddresses& found) { answer(shared, found); });
}

HostAddresses HostLookup::resolve_by_system(const std::string& name, std::uint16_t port) {
  asio::io_context io{1};
  asio::ip::tcp::resolver resolver(io);
  HostAddresses addresses;
  const auto found = resolver.resolve(name, std::to_string(port),
                                      asio::ip::tcp::resolver::numeric_service, addresses.error);
  for (const auto& each : found) addresses.places.push_back(each.endpoint());
  return addresses;
}

HostAddresses find_host(const std::string& name, std::uint16_t port, std::chrono::milliseconds time,
                        const std::function<bool(std::chrono::milliseconds)>& pause,
                        HostLookup::Resolve resolve) {
  if (auto known = as_address(name, port)) return *std::move(known);
  struct Answer {
    std::mutex mutex;
    std::optional<HostAddresses> found;
  };
  const auto answer = std::make_shared<Answer>();
  resolve_apart(std::move(resolve), name, port, [answer](const HostAddresses& found) {
    const std::lock_guard lock(answer->mutex);
    answer->found = found;
  });
  constexpr std::chrono::milliseconds kLook{20};
  const auto until = std::chrono::steady_clock::now() + time;
  for (;;) {
    if (const std::lock_guard lock(answer->mutex); answer->found) return *answer->found;
    if (std::chrono::steady_clock::now() >= until) return {asio::error::timed_out, {}};
    if (pause(kLook)) return {asio::error::operation_aborted, {}};
  }
}

}  // namespace skerry::server
