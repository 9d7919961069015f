#include "server/net/common/output_registry.hpp"

#include <utility>

namespace skerry::server {

void OutputCounters::set_last_display(const std::string& address) {
  const std::lock_guard lock(mutex_);
  last_display_ = address;
}

std::string OutputCounters::last_display() const {
  const std::lock_guard lock(mutex_);
  return last_display_;
}

OutputPtr OutputRegistry::add(wire::OutputStatus what) {
  auto output = std::make_shared<OutputCounters>(std::move(what));
  const std::lock_guard lock(mutex_);
  std::erase_if(outputs_, [](const auto& known) { return known.expired(); });
  outputs_.push_back(output);
  return output;
}

void OutputRegistry::append_to(wire::Status& status) const {
  const std::lock_guard lock(mutex_);
  for (const auto& known : outputs_) {
    const OutputPtr output = known.lock();
    if (output == nullptr) continue;
    const auto read = [](const std::atomic<std::uint64_t>& counter) {
      return counter.load(std::memory_order_relaxed);
    };
    wire::OutputStatus& entry = *status.add_outputs();
    entry = output->fixed;
    entry.set_datagrams(read(output->datagrams));
    entry.set_reports(read(output->reports));
    entry.set_bytes(read(output->bytes));
    entry.set_spokes_lost(read(output->spokes_lost));
    entry.set_datagrams_unsent(read(output->datagrams_unsent));
    entry.set_commands(read(output->commands));
    entry.set_commands_refused(read(output->commands_refused));
    entry.set_commands_dropped(read(output->commands_dropped));
    entry.set_last_display(output->last_display());
  }
}

}  // namespace skerry::server
