// Whether types may be added and subtracted.
#pragma once

namespace skerry {

template <typename A, typename B>
concept Addable = requires(A a, B b) {
  a + b;
};
template <typename A, typename B>
concept Subtractable = requires(A a, B b) {
  a - b;
};

}  // namespace skerry
