#include "echo/propagation/path_table.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <utility>

#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/fast_math.hpp"
#include "echo/kernel/shared_tables.hpp"

namespace skerry::echo {
namespace {

#define SKERRY_INLINE inline __attribute__((always_inline))

constexpr int kMantissa = 23;
constexpr float kFirstRange = 32.0f, kFirstHeight = 0.25f, kLastHeight = 4095.0f;
constexpr float kFull = static_cast<float>(kFullDifference);
constexpr float kFloor = static_cast<float>(kNullFloor);
constexpr float kPi = std::numbers::pi_v<float>;

// Position of x between the nodes of an octave grid that begins at `first`.
struct Between {
  std::uint32_t node;
  std::int32_t rest;  // beyond the node, times share_of_rest() the share of the way to the next
};
SKERRY_INLINE Between grid_place(float x, float first, int bits_per_octave) {
  const int rest = kMantissa - bits_per_octave;
  const auto bits = std::bit_cast<std::uint32_t>(x);
  return {(bits >> rest) - (std::bit_cast<std::uint32_t>(first) >> rest),
          static_cast<std::int32_t>(bits & ((1u << rest) - 1u))};
}
float share_of_rest(int bits_per_octave) {
  return 1.0f / static_cast<float>(1 << (kMantissa - bits_per_octave));
}
float node_at(std::size_t node, float first, int bits_per_octave) {
  const int rest = kMantissa - bits_per_octave;
  const auto bits =
      (std::bit_cast<std::uint32_t>(first) >> rest) + static_cast<std::uint32_t>(node);
  return std::bit_cast<float>(bits << rest);
}

// sin(pi x), 0 <= x < 2^24.  Error: 1e-7 (and x's own last bit).
SKERRY_INLINE float sine_of_half_turns(float x) {
  const auto whole = static_cast<std::int32_t>(x + 0.5f);
  const float f = x - static_cast<float>(whole);
  const float q = f * f;
  float s = -0.00737043f;
  s = s * q + 0.08214589f;
  s = s * q - 0.59926453f;
  s = s * q + 2.55016404f;
  s = s * q - 5.16771278f;
  s = s * q + kPi;
  const float sine = f * s;
  return sine - 2.0f * static_cast<float>(whole & 1) * sine;
}

}  // namespace

struct PathTable::Place {
  const Node* corner;
  float range_share, height_share;
  float range, height;
};

// One place of the table, ready to be made into power.
struct PathTable::Ray {
  float turns;  // by which the reflected ray is longer, at least that of full clearance
  float rho;    // faded
  float loss_octaves;
  float body_ratio;

  float point() const {
    const float sine = sine_of_half_turns(turns);
    const float power = (1.0f - rho) * (1.0f - rho) + 4.0f * rho * sine * sine;
    const float floored = power > kFloor ? power : kFloor;
    return floored * floored;
  }
  // Mean of point() over phases from 0 to this one's: (a - b cos x)^2.
  float mean() const {
    const float a = 1.0f + rho * rho, b = 2.0f * rho;
    const float once = sine_of_half_turns(2.0f * turns) / (2.0f * kPi * turns);
    const float twice = sine_of_half_turns(4.0f * turns) / (4.0f * kPi * turns);
    return a * a + 0.5f * b * b - 2.0f * a * b * once + 0.5f * b * b * twice;
  }
  // Mean of point() between this and a farther ray of about the same strength.
  float mean_to(const Ray& next) const {
    const float r = 0.5f * (rho + next.rho);
    const float a = 1.0f + r * r, b = 2.0f * r;
    const float across = 2.0f * kPi * (next.turns - turns);
    const float once =
        (sine_of_half_turns(2.0f * next.turns) - sine_of_half_turns(2.0f * turns)) / across;
    const float twice = (sine_of_half_turns(4.0f * next.turns) - sine_of_half_turns(4.0f * turns)) /
                        (2.0f * across);
    return a * a + 0.5f * b * b - 2.0f * a * b * once + 0.5f * b * b * twice;
  }
};

PathTable::PathTable(const PathConditions& conditions, double reach_m, PathGrid grid)
    : grid_(grid),
      row_share_(share_of_rest(grid.range_bits)),
      column_share_(share_of_rest(grid.height_bits)),
      antenna_m_(static_cast<float>(conditions.antenna_height_m)),
      turns_per_metre_(static_cast<float>(1.0 / conditions.wavelength_m)),
      gas_octaves_m_(static_cast<float>(2e-3 * conditions.gas_db_km * kOctavesPerDb)) {
  columns_ = grid_place(kLastHeight, kFirstHeight, grid.height_bits).node + 2;
  const float reach = std::max(static_cast<float>(reach_m), 2.0f * kFirstRange);
  rows_ = grid_place(reach, kFirstRange, grid.range_bits).node + 2;
  last_range_ = std::nextafter(node_at(rows_ - 1, kFirstRange, grid.range_bits), 0.0f);
  nodes_.resize(rows_ * columns_);
  lay_points(conditions);
  lay_bodies(conditions);
}

double PathTable::range_of_row(std::size_t row) const {
  return static_cast<double>(node_at(row, kFirstRange, grid_.range_bits));
}

double PathTable::height_of_column(std::size_t column) const {
  return static_cast<double>(node_at(column, kFirstHeight, grid_.height_bits));
}

PathTable::Node PathTable::node_of(const PathConditions& conditions, double range_m,
                                   double height_m) const {
  const double h1 = conditions.antenna_height_m, h2 = height_m, d = range_m;
  const PathTerms terms = path_terms(conditions, d, h2);
  const double flat =
      4.0 * h1 * h2 /
      (std::sqrt(d * d + (h1 + h2) * (h1 + h2)) + std::sqrt(d * d + (h1 - h2) * (h1 - h2)));
  return Node{static_cast<float>((1.0 - terms.difference_m / flat) * (h1 + h2)),
              static_cast<float>(terms.rho),
              static_cast<float>(2.0 * terms.loss_db * kOctavesPerDb), 1.0f};
}

void PathTable::lay_points(const PathConditions& conditions) {
  for (std::size_t row = 0; row < rows_; ++row)
    for (std::size_t column = 0; column < columns_; ++column)
      nodes_[row * columns_ + column] =
          node_of(conditions, range_of_row(row), height_of_column(column));
}

void PathTable::lay_bodies(const PathConditions& conditions) {
  for (std::size_t row = 0; row < rows_; ++row) {
    const double range = range_of_row(row);
    Node* const nodes = &nodes_[row * columns_];
    double sum = kFirstHeight * mean_below_first(conditions, range);
    for (std::size_t column = 0; column < columns_; ++column) {
      const double height = height_of_column(column);
      const Ray ray = ray_of(nodes[column], static_cast<float>(range), static_cast<float>(height));
      const float straight = ray.mean() * fast_exp2(-ray.loss_octaves);
      nodes[column][kBodyRatio] = static_cast<float>(sum / height) / std::max(straight, 1e-30f);
      if (column + 1 == columns_) break;
      const double next = height_of_column(column + 1);
      sum += (next - height) * mean_between(nodes[column], nodes[column + 1], range, height, next);
    }
  }
}

// Mean of point() from the water to the first height.
double PathTable::mean_below_first(const PathConditions& conditions, double range_m) const {
  constexpr int kSteps = 10;
  constexpr std::array<double, kSteps + 1> kShares = {0.03, 0.045, 0.065, 0.09, 0.13, 0.18,
                                                      0.25, 0.35,  0.5,   0.7,  1.0};
  double height = kShares[0] * kFirstHeight;
  Node low = node_of(conditions, range_m, height);
  const Ray ray = ray_of(low, static_cast<float>(range_m), static_cast<float>(height));
  double sum = height * static_cast<double>(ray.point() * fast_exp2(-ray.loss_octaves)) / 3.0;
  for (int i = 1; i <= kSteps; ++i) {
    const double next = kShares[static_cast<std::size_t>(i)] * kFirstHeight;
    const Node high = node_of(conditions, range_m, next);
    sum += (next - height) * mean_between(low, high, range_m, height, next);
    height = next;
    low = high;
  }
  return sum / kFirstHeight;
}

// Mean of point() between two heights whose nodes are known.
double PathTable::mean_between(const Node& low, const Node& high, double range_m, double bottom_m,
                               double top_m) const {
  constexpr int kSteps = 4;
  const auto range = static_cast<float>(range_m);
  const auto bottom = static_cast<float>(bottom_m), top = static_cast<float>(top_m);
  const auto ray = [&](float share) {
    const Node node = low + share * (high - low);
    return ray_of(node, range, bottom + share * (top - bottom));
  };
  const auto power = [](const Ray& r) { return r.point() * fast_exp2(-r.loss_octaves); };
  float sum = 0.0f;
  Ray a = ray(0.0f);
  for (int i = 0; i < kSteps; ++i) {
    const Ray b = ray(static_cast<float>(i + 1) / kSteps);
    if (b.turns - a.turns > 0.1f) {
      sum += a.mean_to(b);
    } else {
      const Ray middle = ray((static_cast<float>(i) + 0.5f) / kSteps);
      sum += (power(a) + 4.0f * power(middle) + power(b)) / 6.0f;
    }
    a = b;
  }
  return static_cast<double>(sum) / kSteps;
}

SKERRY_INLINE PathTable::Place PathTable::place_of(float range_m, float height_m) const {
  Place place;
  place.range = std::clamp(range_m, 1.0f, last_range_);
  place.height = std::clamp(height_m, kFirstHeight, kLastHeight);
  const Between row = grid_place(std::max(place.range, kFirstRange), kFirstRange, grid_.range_bits);
  const Between column = grid_place(place.height, kFirstHeight, grid_.height_bits);
  place.corner = &nodes_[row.node * columns_ + column.node];
  place.range_share = row_share_ * static_cast<float>(row.rest);
  place.height_share = column_share_ * static_cast<float>(column.rest);
  return place;
}

SKERRY_INLINE PathTable::Ray PathTable::ray_at(const Place& place) const {
  const Node& a = place.corner[0];
  const Node& b = place.corner[1];
  const Node& c = place.corner[columns_];
  const Node& d = place.corner[columns_ + 1];
  const float u = place.range_share, v = place.height_share;
  const float wd = u * v, wc = u - wd, wb = v - wd, wa = 1.0f - u - wb;
  const Node node = wa * a + wb * b + wc * c + wd * d;
  return ray_of(node, place.range, place.height);
}

SKERRY_INLINE PathTable::Ray PathTable::ray_of(const Node& node, float range_m,
                                               float height_m) const {
  const float both = antenna_m_ + height_m, lower = antenna_m_ - height_m;
  const float square = range_m * range_m;
  const float paths = std::sqrt(square + both * both) + std::sqrt(square + lower * lower);
  const float turns =
      4.0f * turns_per_metre_ * antenna_m_ * height_m * (both - node[kBulge]) / (both * paths);
  const float faded = turns * (1.0f / kFull);
  Ray ray;
  ray.turns = turns > kFull ? turns : kFull;
  ray.rho = node[kRho] * (faded < 1.0f ? faded : 1.0f);
  ray.loss_octaves = node[kLoss] > 0.0f ? node[kLoss] : 0.0f;
  ray.body_ratio = node[kBodyRatio];
  return ray;
}

float PathTable::gas(float range_m) const {
  return fast_exp2(-gas_octaves_m_ * std::clamp(range_m, 0.0f, 1e7f));
}

float PathTable::point(float range_m, float height_m) const {
  const Place place = place_of(range_m, height_m);
  const Ray ray = ray_at(place);
  return ray.point() * fast_exp2(-(ray.loss_octaves + gas_octaves_m_ * place.range));
}

float PathTable::body(float range_m, float height_m) const {
  const Place place = place_of(range_m, height_m);
  const Ray ray = ray_at(place);
  return ray.mean() * ray.body_ratio *
         fast_exp2(-(ray.loss_octaves + gas_octaves_m_ * place.range));
}

std::shared_ptr<const PathTable> path_table_for(const PathConditions& conditions, double reach_m) {
  static KeptTables<std::pair<PathConditions, double>, PathTable, 4> tables;
  return tables.get({conditions, reach_m}, [&] { return PathTable(conditions, reach_m); });
}

}  // namespace skerry::echo
