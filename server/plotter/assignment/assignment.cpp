#include "server/plotter/assignment/assignment.hpp"

#include <stdexcept>

namespace skerry::server {
namespace {

// Each row also has a column of its own, in which it is alone: so there is always a whole
// assignment, of finite cost.
class Table {
 public:
  Table(std::span<const double> costs, std::size_t rows, std::size_t columns, double alone)
      : costs_(costs), rows_(rows), columns_(columns), alone_(alone) {}

  std::size_t rows() const { return rows_; }
  std::size_t columns() const { return columns_ + rows_; }
  double cost(std::size_t row, std::size_t column) const {
    if (column >= columns_) return column - columns_ == row ? alone_ : kNoPair;
    const double cost = costs_[row * columns_ + column];
    return cost <= alone_ ? cost : kNoPair;
  }

 private:
  std::span<const double> costs_;
  std::size_t rows_, columns_;
  double alone_;
};

// Dijkstra from one row over reduced costs to the nearest free column, then the pairs along the
// path change places.
class Pairing {
 public:
  explicit Pairing(const Table& table)
      : table_(table),
        row_price_(table.rows()),
        column_price_(table.columns()),
        column_of_(table.rows(), kUnpaired),
        row_of_(table.columns(), kUnpaired),
        from_(table.columns()),
        distance_(table.columns()),
        is_final_(table.columns()) {}

  void add(std::size_t first) {
    distance_.assign(table_.columns(), kNoPair);
    is_final_.assign(table_.columns(), false);
    std::size_t row = first;
    double at = 0.0;
    std::size_t end = kUnpaired;
    while (end == kUnpaired) {
      std::size_t nearest = kUnpaired;
      for (std::size_t c = 0; c < table_.columns(); ++c) {
        if (is_final_[c]) continue;
        const double way = at + table_.cost(row, c) - row_price_[row] - column_price_[c];
        if (way < distance_[c]) {
          distance_[c] = way;
          from_[c] = row;
        }
        if (nearest == kUnpaired || distance_[c] < distance_[nearest]) nearest = c;
      }
      at = distance_[nearest];
      is_final_[nearest] = true;
      if (row_of_[nearest] == kUnpaired) {
        end = nearest;
      } else {
        row = row_of_[nearest];
      }
    }
    for (std::size_t c = 0; c < table_.columns(); ++c) {
      if (!is_final_[c] || c == end) continue;
      column_price_[c] += distance_[c] - at;
      row_price_[row_of_[c]] += at - distance_[c];
    }
    row_price_[first] += at;
    for (std::size_t c = end;;) {
      const std::size_t owner = from_[c];
      row_of_[c] = owner;
      const std::size_t next = column_of_[owner];
      column_of_[owner] = c;
      if (owner == first) break;
      c = next;
    }
  }

  std::size_t column_of(std::size_t row) const { return column_of_[row]; }

 private:
  const Table& table_;
  std::vector<double> row_price_, column_price_;
  std::vector<std::size_t> column_of_, row_of_, from_;
  std::vector<double> distance_;
  std::vector<bool> is_final_;
};

}  // namespace

std::vector<std::size_t> cheapest_pairs(std::span<const double> costs, std::size_t rows,
                                        std::size_t columns, double alone) {
  if (costs.size() != rows * columns)
    throw std::invalid_argument("costs: must be rows times columns of them");
  if (!(alone >= 0.0) || alone == kNoPair)
    throw std::invalid_argument("alone: must be a number of 0 or more");
  for (const double cost : costs)
    if (!(cost >= 0.0)) throw std::invalid_argument("costs: each must be 0 or more");
  const Table table(costs, rows, columns, alone);
  Pairing pairing(table);
  for (std::size_t row = 0; row < rows; ++row) pairing.add(row);
  std::vector<std::size_t> out(rows);
  for (std::size_t row = 0; row < rows; ++row) {
    const std::size_t column = pairing.column_of(row);
    out[row] = column < columns ? column : kUnpaired;
  }
  return out;
}

}  // namespace skerry::server
