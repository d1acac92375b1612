#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace ghtrack {

/// The rows of a file in the order of time, those of one time in the order of the file. A file that
/// is ordered already is read as it goes, in constant memory; the rows of others, and of pipes, are
/// held in memory.
template <class Row>  // with a member `time`
class OrderedRows {
 public:
  using Read = std::function<bool(Row&)>;  // the next row of the file; false after the last
  using Rewind = std::function<void()>;    // absent for a pipe

  OrderedRows(Read read, Rewind rewind) : read_(std::move(read)), rewind_(std::move(rewind)) {}

  /// Goes through all rows in the order of the file, once, before anything else but settle().
  template <class Visit>
  void survey(Visit visit) {
    in_memory_ = !rewind_;
    Row row;
    double latest = 0.0;
    for (bool first = true; read_(row); first = false) {
      visit(row);
      ++count_;
      in_order_ = in_order_ && (first || row.time >= latest);
      latest = row.time;
      if (in_memory_) rows_.push_back(row);
    }
  }

  /// Makes the rows ready for next(). After survey().
  void settle() {
    if (!in_order_ && !in_memory_) {
      in_memory_ = true;
      rewind_();
      rows_.reserve(count_);
      for (Row row; read_(row);) rows_.push_back(row);
    }
    if (!in_order_) {
      std::stable_sort(rows_.begin(), rows_.end(),
                       [](const Row& a, const Row& b) { return a.time < b.time; });
    }
    rewind();
  }

  bool in_order() const { return in_order_; }

  /// The next row by time; false after the last.
  bool next(Row& row) {
    if (!in_memory_) return read_(row);
    if (at_ == rows_.size()) return false;
    row = rows_[at_++];
    return true;
  }

  /// Goes back to the first row.
  void rewind() {
    at_ = 0;
    if (!in_memory_) rewind_();
  }

 private:
  Read read_;
  Rewind rewind_;
  bool in_order_ = true;
  bool in_memory_ = false;
  std::size_t count_ = 0;  // of all rows
  std::vector<Row> rows_;
  std::size_t at_ = 0;
};

/// Gathers the rows of one time after the other.
template <class Row>
class Instants {
 public:
  explicit Instants(OrderedRows<Row>& rows) : rows_(&rows) {}

  /// The rows of the next time; empty after the last.
  const std::vector<Row>& next() {
    now_.clear();
    if (has_ahead_) now_.push_back(ahead_);
    has_ahead_ = false;
    while (rows_->next(ahead_)) {
      if (!now_.empty() && now_.front().time != ahead_.time) {
        has_ahead_ = true;
        break;
      }
      now_.push_back(ahead_);
    }
    return now_;
  }

  void rewind() {
    rows_->rewind();
    has_ahead_ = false;
  }

 private:
  OrderedRows<Row>* rows_;
  std::vector<Row> now_;
  Row ahead_{};
  bool has_ahead_ = false;
};

/// Counts instants, and takes the median of the times between the first hundred thousand of them.
class PeriodEstimate {
 public:
  /// @param time  of the next row [s]
  void add(double time) {
    const bool first = instants_ == 0;
    if (first || time != time_) ++instants_;
    if (!first && time > time_ && periods_.size() < kMost) periods_.push_back(time - time_);
    time_ = time;
  }

  std::int64_t instants() const { return instants_; }

  /// [s]; 0 if there are no two instants
  double median() const {
    if (periods_.empty()) return 0.0;
    std::vector<double> sorted = periods_;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    return *middle;
  }

 private:
  static constexpr std::size_t kMost = 100'000;

  std::vector<double> periods_;
  double time_ = 0.0;
  std::int64_t instants_ = 0;
};

}  // namespace ghtrack
