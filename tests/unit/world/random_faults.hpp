// Faults drawn within their ranges.
#pragma once

#include <random>

#include "protocol/wire/exercise.pb.h"
#include "protocol/wire/schema.hpp"

namespace skerry::server {

// Each number is 0, one of its bounds or between them; each switch is seldom on.
inline wire::Faults random_faults(std::mt19937_64& random) {
  const auto unit = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  wire::Faults faults;
  const google::protobuf::Reflection& reflection = *faults.GetReflection();
  for (const auto* field : wire::fields_of(*wire::Faults::descriptor())) {
    if (field->cpp_type() == google::protobuf::FieldDescriptor::CPPTYPE_BOOL) {
      reflection.SetBool(&faults, field, unit() < 0.1);
      continue;
    }
    const config::FieldRule& rule = wire::rule_of(*field);
    const double kind = unit();
    const double value = kind < 0.3   ? 0.0
                         : kind < 0.4 ? rule.min()
                         : kind < 0.5 ? rule.max()
                                      : rule.min() + unit() * (rule.max() - rule.min());
    reflection.SetDouble(&faults, field, value);
  }
  return faults;
}

}  // namespace skerry::server
