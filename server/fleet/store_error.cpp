#include "server/fleet/store_error.hpp"

namespace skerry::fleet {
namespace {

int telling_rank(Trouble trouble) {
  switch (trouble) {
    case Trouble::unreachable:
      return 0;
    case Trouble::slow:
      return 1;
    case Trouble::no_majority:
      return 2;
    default:
      return 3;
  }
}

}  // namespace

std::string_view name_of(Trouble trouble) {
  switch (trouble) {
    case Trouble::unreachable:
      return "unreachable";
    case Trouble::no_majority:
      return "no majority";
    case Trouble::slow:
      return "slow";
    case Trouble::full:
      return "full";
    case Trouble::refused:
      return "refused";
    case Trouble::went_back:
      return "went back";
    case Trouble::compacted:
      return "compacted";
    case Trouble::deposed:
      return "deposed";
    case Trouble::overtaken:
      return "overtaken";
    case Trouble::id_taken:
      return "id taken";
    case Trouble::broken:
      return "broken";
  }
  return "unknown";
}

const StoreError& more_telling(const StoreError& one, const StoreError& other) {
  return telling_rank(other.trouble) > telling_rank(one.trouble) ? other : one;
}

}  // namespace skerry::fleet
