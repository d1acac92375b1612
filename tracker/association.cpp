#include "tracker/association.hpp"

#include <algorithm>
#include <limits>
#include <tuple>

namespace ghtrack {
namespace {

constexpr double kUnreached = std::numeric_limits<double>::infinity();

/// A search among that many columns is given up: its track goes without a detection. Only crowds
/// that no sensor could resolve come near. All searches together have a budget that grows with the
/// tracks, so that the work of a scan does; once it is spent, searches are short.
constexpr std::size_t kMostSettled = 1000;
constexpr std::size_t kMostSettledBeyondBudget = 20;
constexpr std::size_t kBudget = 100'000;  // columns, and
constexpr std::size_t kBudgetOfTrack = 10;

/// State of the successive shortest path method. Column j < detections is a detection, column
/// detections + i is the private miss column of track i.
class ShortestPaths {
 public:
  ShortestPaths(const CandidateTable& table, int detections, double miss_cost)
      : table_(table),
        detections_(detections),
        miss_cost_(miss_cost),
        columns_(detections + table.rows()),
        assigned_column_(table.rows(), kMissed),
        budget_(kBudget + kBudgetOfTrack * assigned_column_.size()) {}

  std::vector<int> solve() {
    for (int track = 0; track < table_.rows(); ++track) augment(track);
    std::vector<int> result(table_.rows(), kMissed);
    for (int column = 0; column < detections_; ++column) {
      if (columns_[column].owner != kMissed) result[columns_[column].owner] = column;
    }
    return result;
  }

 private:
  struct Column {
    double price = 0.0;   // its dual variable
    int owner = kMissed;  // its track
    // During one search:
    int parent = kMissed;  // the row before it
    double distance = kUnreached;
    bool is_settled = false;  // its distance is final
  };
  struct Entry {
    double distance;
    int column;
    bool operator<(const Entry& other) const {
      return distance < other.distance || (distance == other.distance && column < other.column);
    }
    bool operator>(const Entry& other) const { return other < *this; }
  };

  /// Finds the cheapest way to give `track` a column, moving other tracks where that pays.
  void augment(int track) {
    if (take_if_free(track, favourite(track))) return;
    heap_.clear();
    reached_.clear();
    settled_.clear();
    relax_row(track, 0.0);
    int free_column = kMissed;
    double shortest = 0.0;
    const std::size_t most = budget_ > 0 ? kMostSettled : kMostSettledBeyondBudget;
    while (free_column == kMissed && settled_.size() < most) {
      std::pop_heap(heap_.begin(), heap_.end(), std::greater<>{});
      const Entry nearest = heap_.back();
      heap_.pop_back();
      Column& column = columns_[nearest.column];
      if (column.is_settled) continue;  // by a shorter way
      column.is_settled = true;
      settled_.push_back(nearest.column);
      if (column.owner == kMissed) {
        free_column = nearest.column;
        shortest = nearest.distance;
      } else {
        relax_row(column.owner, nearest.distance);
      }
    }
    budget_ -= std::min(budget_, settled_.size());
    if (free_column == kMissed) {
      take_if_free(track, detections_ + track);
    } else {
      for (const int column : settled_) {
        columns_[column].price += columns_[column].distance - shortest;
      }
    }
    for (int column = free_column; column != kMissed;) {
      const int row = columns_[column].parent;
      const int previous = row == track ? kMissed : assigned_column_[row];
      columns_[column].owner = row;
      assigned_column_[row] = column;
      column = previous;
    }
    for (const int column : reached_) {
      columns_[column].distance = kUnreached;
      columns_[column].is_settled = false;
    }
  }

  /// The column that is cheapest for a track, the first one of equals.
  int favourite(int track) const {
    Entry best{miss_cost_ - columns_[detections_ + track].price, detections_ + track};
    for (const Candidate& candidate : table_.row(track)) {
      const double cost = candidate.cost - columns_[candidate.detection].price;
      best = std::min(best, {cost, candidate.detection});
    }
    return best.column;
  }

  /// Nobody has to move for a free favourite, and no price changes: the usual case, spared a
  /// search.
  bool take_if_free(int track, int column) {
    if (columns_[column].owner != kMissed) return false;
    columns_[column].owner = track;
    assigned_column_[track] = column;
    return true;
  }

  /// Reduced costs of a row are measured from its own column, so that they are never negative.
  void relax_row(int row, double base) {
    const int own = assigned_column_[row];
    const double offset = own == kMissed ? base : base - cost_of(row, own) + columns_[own].price;
    for (const Candidate& candidate : table_.row(row)) {
      relax(row, candidate.detection,
            offset + candidate.cost - columns_[candidate.detection].price);
    }
    relax(row, detections_ + row, offset + miss_cost_ - columns_[detections_ + row].price);
  }

  void relax(int row, int number, double distance) {
    Column& column = columns_[number];
    if (column.is_settled || !(distance < column.distance)) return;
    if (column.distance == kUnreached) reached_.push_back(number);
    column.distance = distance;
    column.parent = row;
    heap_.push_back({distance, number});
    std::push_heap(heap_.begin(), heap_.end(), std::greater<>{});
  }

  double cost_of(int row, int column) const {
    if (column >= detections_) return miss_cost_;
    const auto candidates = table_.row(row);
    return std::find_if(candidates.begin(), candidates.end(),
                        [&](const Candidate& c) { return c.detection == column; })
        ->cost;
  }

  const CandidateTable& table_;
  int detections_;
  double miss_cost_;
  std::vector<Column> columns_;
  std::vector<int> assigned_column_;  // of each row
  std::size_t budget_;                // columns that searches may still settle
  std::vector<Entry> heap_;
  std::vector<int> reached_, settled_;
};

}  // namespace

std::vector<int> assign_globally(const CandidateTable& table, int detections, double miss_cost) {
  return ShortestPaths(table, detections, miss_cost).solve();
}

std::vector<int> assign_greedily(const CandidateTable& table, int detections) {
  struct Pair {
    double cost;
    int track, detection;
  };
  std::vector<Pair> pairs;
  for (int track = 0; track < table.rows(); ++track) {
    for (const Candidate& c : table.row(track)) pairs.push_back({c.cost, track, c.detection});
  }
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
    return std::tie(a.cost, a.track, a.detection) < std::tie(b.cost, b.track, b.detection);
  });
  std::vector<int> result(table.rows(), kMissed);
  std::vector<bool> taken(detections, false);
  for (const Pair& pair : pairs) {
    if (result[pair.track] != kMissed || taken[pair.detection]) continue;
    result[pair.track] = pair.detection;
    taken[pair.detection] = true;
  }
  return result;
}

}  // namespace ghtrack
