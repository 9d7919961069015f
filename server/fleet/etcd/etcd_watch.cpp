#include "server/fleet/etcd/etcd_watch.hpp"

#include <fmt/format.h>

#include <utility>

#include "server/fleet/etcd/etcd_status.hpp"
#include "server/fleet/etcd/etcd_values.hpp"

namespace skerry::fleet {

EtcdWatch::EtcdWatch(std::shared_ptr<const EtcdMembers> members, std::size_t member,
                     const std::string& prefix, Revision from)
    : members_(std::move(members)),
      member_(member),
      stub_(etcdserverpb::Watch::NewStub(members_->channel(member))) {
  auto& create = *request_.mutable_create_request();
  create.set_key(prefix);
  create.set_range_end(end_of_prefix(prefix));
  create.set_start_revision(from);
  // A member that loses its leader ends the stream.
  context_.AddMetadata("hasleader", "true");
  stream_ = stub_->AsyncWatch(&context_, &done_, this);
}

EtcdWatch::~EtcdWatch() {
  context_.TryCancel();
  done_.Shutdown();
  void* tag = nullptr;
  bool well = false;
  while (done_.Next(&tag, &well)) {
  }
}

void EtcdWatch::go_on(bool well) {
  if (stage_ == Stage::finishing) {
    stage_ = Stage::ended;
    return;
  }
  if (!well) {
    stage_ = Stage::finishing;
    stream_->Finish(&status_, this);
    return;
  }
  if (stage_ == Stage::starting) {
    stage_ = Stage::asking;
    stream_->Write(request_, this);
    return;
  }
  has_response_ = stage_ == Stage::reading;
  stage_ = Stage::reading;
  if (!has_response_) stream_->Read(&response_, this);
}

StoreError EtcdWatch::how_it_ended() const {
  if (status_.ok())
    return {Trouble::unreachable,
            fmt::format("etcd {} has ended the watch", members_->name(member_)), false};
  StoreError error = store_error_of(status_, members_->name(member_), true);
  error.maybe_done = false;
  return error;
}

StoreResult<WatchStep> EtcdWatch::next(HostTime deadline) {
  for (;;) {
    if (stage_ == Stage::ended) return Failure{how_it_ended()};
    void* tag = nullptr;
    bool well = false;
    const auto came = done_.AsyncNext(&tag, &well, as_deadline(deadline, host_now()));
    if (came != grpc::CompletionQueue::GOT_EVENT) return WatchStep{};
    go_on(well);
    if (!has_response_) continue;
    has_response_ = false;
    auto step = take();
    if (!step) return step;
    stream_->Read(&response_, this);
    if (!step->events.empty()) return step;
  }
}

StoreResult<WatchStep> EtcdWatch::take() {
  const std::string& member = members_->name(member_);
  if (response_.compact_revision() != 0) {
    stage_ = Stage::ended;
    return Failure{StoreError{
        Trouble::compacted,
        fmt::format("etcd {} has compacted its history up to revision {}: the log is read instead, "
                    "in which all orders are",
                    member, response_.compact_revision()),
        false}};
  }
  if (response_.canceled()) {
    stage_ = Stage::ended;
    return Failure{StoreError{
        response_.cancel_reason().find("permission") != std::string::npos ? Trouble::refused
                                                                          : Trouble::no_majority,
        fmt::format("etcd {} has ended the watch: {}", member, response_.cancel_reason()), false}};
  }
  WatchStep step{header_of(response_.header()), {}};
  for (auto& event : *response_.mutable_events())
    step.events.push_back(
        {key_of(std::move(*event.mutable_kv())), event.type() == mvccpb::Event::DELETE});
  return step;
}

}  // namespace skerry::fleet
