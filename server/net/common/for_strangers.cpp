#include "server/net/common/for_strangers.hpp"

#include <string>

namespace skerry::server {
namespace {

constexpr const char* kProblem = "there is a problem; the server's own host is told which";

}  // namespace

void leave_out_for_strangers(wire::RecorderState& state) {
  state.clear_folder();
  if (!state.problem().empty()) state.set_problem(kProblem);
}

void leave_out_for_strangers(wire::PlaybackState& state) {
  state.clear_last_by();
  if (state.problem().find('/') != std::string::npos) state.set_problem(kProblem);
}

void leave_out_for_strangers(wire::HopStatus& hop) {
  hop.clear_upstream();
  if (!hop.problem().empty()) hop.set_problem(kProblem);
}

void leave_out_for_strangers(wire::Status& status) {
  for (wire::ClientStatus& client : *status.mutable_clients()) client.clear_peer();
  for (wire::OutputStatus& output : *status.mutable_outputs()) {
    output.clear_address();
    output.clear_interface_address();
    output.clear_last_display();
  }
  for (wire::HopStatus& hop : *status.mutable_hops()) leave_out_for_strangers(hop);
  if (status.has_recorder()) leave_out_for_strangers(*status.mutable_recorder());
  if (status.has_playback()) leave_out_for_strangers(*status.mutable_playback());
}

}  // namespace skerry::server
