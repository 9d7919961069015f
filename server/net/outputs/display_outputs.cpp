#include "server/net/outputs/display_outputs.hpp"

#include <algorithm>
#include <stdexcept>

namespace skerry::server {

DisplayOutputs::DisplayOutputs(NetContext& context) : timer_(context.io) {
  std::vector<OutputClaim> claims;
  for (const DisplayOutputConfig& config : context.config.displays) {
    outputs_.push_back(std::make_unique<DisplayOutput>(context, config, outputs_.size()));
    claims.push_back(outputs_.back()->claim());
  }
  if (const auto conflict = conflict_among(claims)) throw std::runtime_error(*conflict);
  for (const auto& output : outputs_) output->open();
}

void DisplayOutputs::start() {
  if (outputs_.empty()) return;
  for (const auto& output : outputs_) output->start();
  due_ = std::chrono::steady_clock::now();
  tick();
}

void DisplayOutputs::close() {
  closed_ = true;  // a tick may be on its way already
  timer_.cancel();
  for (const auto& output : outputs_) output->close();
}

void DisplayOutputs::tick() {
  due_ = std::max(due_ + kTick, std::chrono::steady_clock::now());
  timer_.expires_at(due_);
  timer_.async_wait([this](error_code error) {
    if (error || closed_) return;
    for (const auto& output : outputs_) output->tick();
    tick();
  });
}

}  // namespace skerry::server
