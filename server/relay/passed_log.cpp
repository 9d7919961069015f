#include "server/relay/passed_log.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <utility>
#include <vector>

#include "protocol/wire/schema.hpp"

namespace skerry::server {

std::string knob_of(const wire::Set& set) {
  std::vector<const wire::FieldDescriptor*> given;
  set.GetReflection()->ListFields(set, &given);
  std::string knob;
  for (const wire::FieldDescriptor* field : given) {
    const bool is_place = field->number() == wire::Set::kRadarFieldNumber ||
                          field->number() == wire::Set::kViewFieldNumber ||
                          field->number() == wire::Set::kTokenFieldNumber;
    if (!is_place && wire::Controls::descriptor()->FindFieldByName(field->name()) == nullptr) {
      return {};
    }
    knob += is_place ? "" : field->name() + " ";
  }
  return knob + fmt::format("of radar {} view {}", set.radar(), set.view());
}

std::string PassedLog::who_at(const std::string& origin) const {
  return audit_ == nullptr ? std::string() : audit_->who_at(origin);
}

void PassedLog::tell(const PassedUp& done, Time now) {
  const std::lock_guard lock(mutex_);
  const bool goes_on = !done.knob.empty() && done.knob == turned_.knob &&
                       done.origin == turned_.origin && done.who == turned_.who;
  if (goes_on && now - told_at_ < kEvery) {
    turned_ = done;
    ++untold_;
    return;
  }
  if (untold_ > 0) put_down(turned_, std::exchange(untold_, 0));
  put_down(done, 1);
  turned_ = done;
  told_at_ = now;
}

void PassedLog::tell_late(Time now) {
  const std::lock_guard lock(mutex_);
  if (untold_ == 0 || now - told_at_ < kEvery) return;
  put_down(turned_, std::exchange(untold_, 0));
  told_at_ = now;
}

void PassedLog::put_down(const PassedUp& done, std::uint32_t times) {
  spdlog::info("{} has done for {}: {}", upstream_, done.origin, done.what);
  if (audit_ == nullptr) return;
  audit_->add({.kind = AuditEntry::Kind::request,
               .from = done.origin,
               .who = done.who,
               .what = "passed to " + upstream_ + ": " + done.what,
               .times = times,
               .result = "ok"});
}

}  // namespace skerry::server
