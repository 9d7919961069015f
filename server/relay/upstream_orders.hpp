// UpstreamOrders: what is to be asked of the server that is relayed, from any thread to the one
// that talks with it.
#pragma once

#include <cstdint>
#include <functional>
#include <mutex>
#include <utility>
#include <variant>
#include <vector>

#include "server/core/radar_host.hpp"
#include "server/relay/upstream_line.hpp"

namespace skerry::server {

// A request as it is sent.
struct AskUp {
  wire::ClientMessage message;
  std::chrono::seconds patience{5};
  AnsweredUp answered;
  // As UpstreamLine::ask() has it.
  AnsweredUp late = {};
};
// A view of its own for a console.
struct OpenUp {
  std::uint32_t radar = 0, like = 0;
  std::uint32_t like_there = 0;  // the same by its number there
  std::function<void(VideoChannel&)> prepare;
  RadarHost::ViewOpened later;
};
// And its end; `view` by its number here.
struct CloseUp {
  std::uint32_t radar = 0, view = 0;
};
using UpstreamOrder = std::variant<AskUp, OpenUp, CloseUp>;

// Thread: any.
class UpstreamOrders {
 public:
  static constexpr std::size_t kMost = 1024;  // that wait

  // False: too many wait already, or nobody takes any more.  The end of a view is never refused.
  bool add(UpstreamOrder order);
  std::vector<UpstreamOrder> take();
  // Nothing is added from now on.
  void close();

  // `wake` is called after each that was added.  Before any is.
  void on_order(std::function<void()> wake) { wake_ = std::move(wake); }

 private:
  std::function<void()> wake_;
  std::mutex mutex_;
  std::vector<UpstreamOrder> orders_;
  bool closed_ = false;
};

}  // namespace skerry::server
