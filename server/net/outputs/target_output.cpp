#include "server/net/outputs/target_output.hpp"

#include <fmt/format.h>

#include <array>
#include <cstring>
#include <utility>
#include <vector>

#include "protocol/wire/host_and_port.hpp"

namespace skerry::server {
namespace {

// A target that was seen in every turn is in a list up to a turn and what the plotter needs later.
constexpr double kTurns = 2.0;
constexpr double kUnknownTurn_s = 6.0;  // at 10 turns a minute

// One category: a row for each of TargetCategory, in the same order.
struct CategoryRow {
  const char* name;
  unsigned most_track;
  std::vector<Bytes> (*datagrams)(const ReportedTargets& news, std::size_t most);
};
constexpr std::array<CategoryRow, 3> kCategories = {{
    {"cat048", kMostCat048Track,
     [](const ReportedTargets& news, std::size_t most) {
       return encode_cat048(cat048_reports(news), most);
     }},
    {"cat062", kMostCat062Track,
     [](const ReportedTargets& news, std::size_t most) {
       return encode_cat062(cat062_reports(news), most);
     }},
    {"cat010", kMostCat010Track,
     [](const ReportedTargets& news, std::size_t most) {
       return encode_cat010(cat010_reports(news), most);
     }},
}};

const CategoryRow& row_of(const TargetOutputConfig& config) {
  return kCategories.at(static_cast<std::size_t>(config.category));
}

}  // namespace

TargetOutput::TargetOutput(NetContext& context, const TargetOutputConfig& config)
    : context_(context),
      config_(config),
      // Readers of plots and tracks expect packets of Ethernet, on loopback as well.
      max_datagram_(config.to.max_datagram != 0 ? config.to.max_datagram : kAsterixDatagram),
      destination_(open_destination(context.io, config.to, row_of(config).name)),
      told_(row_of(config).most_track) {
  check_radar(context.host, config.to, row_of(config).name);
  wire::OutputStatus status;
  status.set_name(row_of(config).name);
  status.set_radar(config.to.radar);
  status.set_address(host_and_port(config.to.address, config.to.port));
  status.set_interface_address(config.to.interface_address);
  counters_ = context.outputs.add(std::move(status));
}

void TargetOutput::tick() {
  TargetPort* const port = context_.host.targets();
  if (port == nullptr) return;
  // Not at once where as many plotters run as may.
  if (wanted_targets_ == nullptr) wanted_targets_ = port->want(config_.to.radar, 0);
  TargetPlotsPtr plots = port->plots(config_.to.radar, 0);
  TargetListPtr list = port->targets(config_.to.radar, 0);
  ReportedTargets news;
  if (plots != nullptr && plots != plots_) news.plots = plots.get();
  std::vector<ReportedTrack> tracks;
  if (list != nullptr && list != list_) {
    news.list = list.get();
    tracks = told_.next(*list);
    news.tracks = tracks;
  }
  if (news.plots != nullptr || news.list != nullptr) send(news);
  plots_ = std::move(plots);
  list_ = std::move(list);
}

void TargetOutput::close() {
  wanted_targets_.reset();
  error_code ignored;
  destination_.socket.close(ignored);
}

void TargetOutput::send(const ReportedTargets& what) {
  ReportedTargets news = what;
  news.source = config_.source;
  const double rpm = context_.host.settings(config_.to.radar, 0).rotation_rpm();
  news.extrapolated_after_s = kTurns * (rpm > 0.0 ? 60.0 / rpm : kUnknownTurn_s);
  for (const Bytes& datagram : row_of(config_).datagrams(news, max_datagram_)) {
    const int error = send_at_once(destination_.socket, destination_.endpoint, datagram);
    if (error == 0) {
      counters_->reports.fetch_add(1, std::memory_order_relaxed);
      counters_->bytes.fetch_add(datagram.size(), std::memory_order_relaxed);
      continue;
    }
    counters_->datagrams_unsent.fetch_add(1, std::memory_order_relaxed);
    context_.errors.add(fmt::format("{} send", row_of(config_).name),
                        fmt::format("{}: {}", counters_->fixed.address(), std::strerror(error)));
  }
}

}  // namespace skerry::server
