#include "sim/contact_forces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/complementarity.hpp"

namespace ghtrack {
namespace {

constexpr int kFewSweeps = 200;  // that most need, from a good guess
constexpr int kMostSweeps = 2000;
constexpr int kPatience = 100;              // sweeps in which the change must halve
constexpr double kExact = 1e-11;            // of the largest rate
constexpr int kLeapEvery = 8;               // sweeps
constexpr std::size_t kMostUnknowns = 100;  // of a leap, or of pivoting before many sweeps
constexpr std::size_t kMostPivoted = 250;   // unknowns: so many take 30 ms

/// One touch at work on its bodies.
class Row {
 public:
  Row(std::vector<Pushed>& bodies, Touch& touch)
      : touch_(touch),
        one_(bodies[static_cast<std::size_t>(touch.one)]),
        other_(touch.other >= 0 ? bodies[static_cast<std::size_t>(touch.other)] : rigid()),
        tangent_(tangent_to(touch.normal)),
        inverse_mass_(one_.inverse_mass + other_.inverse_mass),
        inverse_slip_(inverse_mass_ + one_.radius * one_.radius * one_.inverse_inertia +
                      other_.radius * other_.radius * other_.inverse_inertia) {}

  void apply(double push, double grip, double couple) {
    const Vec2 impulse = push * touch_.normal + grip * tangent_;
    one_.rate += one_.inverse_mass * impulse;
    other_.rate -= other_.inverse_mass * impulse;
    one_.spin_rate += one_.inverse_inertia * (one_.radius * grip + couple);
    other_.spin_rate += other_.inverse_inertia * other_.radius * grip;
  }

  /// What a leap solves for: forces that are at none of their bounds.
  enum class Unknown { kPush, kGrip, kCouple };

  bool is_free(Unknown unknown) const {
    if (unknown == Unknown::kPush) return touch_.holds || touch_.push > 0.0;
    if (touch_.push <= 0.0) return false;
    if (unknown == Unknown::kGrip) {
      const double most = touch_.friction * touch_.push;
      return std::abs(touch_.grip) < most && (touch_.slip == 0.0 || touch_.grip != 0.0);
    }
    const double most = touch_.rolling * one_.radius * touch_.push;
    return touch_.rolling > 0.0 && touch_.direction == 0.0 && std::abs(touch_.couple) < most;
  }

  /// More of one force; a push takes along what is at a bound that grows with it.
  void add(Unknown unknown, double amount) {
    double push = 0.0;
    double grip = 0.0;
    double couple = 0.0;
    if (unknown == Unknown::kPush) {
      push = amount;
      if (touch_.push > 0.0) {
        if (!is_free(Unknown::kGrip)) grip = amount * touch_.grip / touch_.push;
        if (!is_free(Unknown::kCouple)) couple = amount * touch_.couple / touch_.push;
      }
    } else {
      (unknown == Unknown::kGrip ? grip : couple) = amount;
    }
    added_ = {added_[0] + push, added_[1] + grip, added_[2] + couple};
    apply(push, grip, couple);
  }

  /// The part of what was added, at most all, with which no free force passes its bound.
  double possible_part() const {
    const auto [push, grip, couple] = added_;
    double part = 1.0;
    // Of force + x × more ≥ 0
    const auto limit = [&part](double force, double more) {
      if (force + more < 0.0) part = std::min(part, std::max(0.0, force) / -more);
    };
    if (!touch_.holds) limit(touch_.push, push);
    if (is_free(Unknown::kGrip)) {
      limit(touch_.friction * touch_.push - touch_.grip, touch_.friction * push - grip);
      limit(touch_.friction * touch_.push + touch_.grip, touch_.friction * push + grip);
      if (touch_.slip != 0.0) limit(std::abs(touch_.grip), touch_.grip > 0.0 ? grip : -grip);
    }
    if (is_free(Unknown::kCouple)) {
      const double arm = touch_.rolling * one_.radius;
      limit(arm * touch_.push - touch_.couple, arm * push - couple);
      limit(arm * touch_.push + touch_.couple, arm * push + couple);
    }
    return part;
  }

  /// Takes a part of what was added into the touch.
  void keep(double part) {
    touch_.push += part * added_[0];
    touch_.grip += part * added_[1];
    touch_.couple += part * added_[2];
    added_ = {0.0, 0.0, 0.0};
  }
  void forget() { added_ = {0.0, 0.0, 0.0}; }

  /// One force alone; with a push goes the couple that holds against turning.
  void apply_alone(Unknown unknown, double amount) {
    if (unknown == Unknown::kPush) {
      apply(amount, 0.0, -touch_.direction * most_per_push(Unknown::kCouple) * amount);
    } else if (unknown == Unknown::kGrip) {
      apply(0.0, amount, 0.0);
    } else {
      apply(0.0, 0.0, amount);
    }
  }

  /// The same into the touch alone.
  void note_alone(Unknown unknown, double amount) {
    if (unknown == Unknown::kPush) {
      touch_.push += amount;
      touch_.couple -= touch_.direction * most_per_push(Unknown::kCouple) * amount;
    } else {
      (unknown == Unknown::kGrip ? touch_.grip : touch_.couple) += amount;
    }
  }

  /// The largest grip or couple of a push of one.
  double most_per_push(Unknown unknown) const {
    return unknown == Unknown::kGrip ? touch_.friction : touch_.rolling * one_.radius;
  }

  /// What a free force holds at zero.
  double residue(Unknown unknown) const {
    if (unknown == Unknown::kPush) {
      return touch_.normal.dot(one_.rate - other_.rate) + touch_.normal_offset;
    }
    if (unknown == Unknown::kCouple) return one_.spin_rate;
    return tangent_.dot(one_.rate - other_.rate) + one_.radius * one_.spin_rate +
           other_.radius * other_.spin_rate + touch_.slip_offset;
  }

  /// @returns by how much a rate has changed
  double improve() {
    const double parting = touch_.normal.dot(one_.rate - other_.rate) + touch_.normal_offset;
    const double wanted_push = touch_.push - parting / inverse_mass_;
    const double push = touch_.holds ? wanted_push : std::max(0.0, wanted_push);
    const double pushed = push - touch_.push;
    touch_.push = push;
    apply(pushed, 0.0, 0.0);

    double turned = 0.0;
    if (touch_.rolling > 0.0) {
      const double most = touch_.rolling * one_.radius * push;
      const double wanted = touch_.direction != 0.0
                                ? -touch_.direction * most
                                : touch_.couple - one_.spin_rate / one_.inverse_inertia;
      turned = std::clamp(wanted, -most, most) - touch_.couple;
      touch_.couple += turned;
      apply(0.0, 0.0, turned);
    }
    const double slip = tangent_.dot(one_.rate - other_.rate) + one_.radius * one_.spin_rate +
                        other_.radius * other_.spin_rate + touch_.slip_offset;
    const double most = touch_.friction * push;
    const double gripped =
        dissipative(touch_.grip - slip / inverse_slip_, most, touch_.slip) - touch_.grip;
    touch_.grip += gripped;
    apply(0.0, gripped, 0.0);
    return std::max({std::abs(pushed) * inverse_mass_, std::abs(gripped) * inverse_slip_,
                     std::abs(turned) * one_.inverse_inertia * one_.radius});
  }

 private:
  /// What does not give way: nothing changes it.
  static Pushed& rigid() {
    thread_local Pushed body;
    return body;
  }

  Touch& touch_;
  Pushed& one_;
  Pushed& other_;
  Vec2 tangent_;
  double inverse_mass_;
  double inverse_slip_;
  std::array<double, 3> added_{};  // push, grip and couple
};

/// Solves a x = b by Gauss' elimination with the largest pivot; of what the equations leave open,
/// as where more friction holds than is needed, nothing.
/// @param a  row by row, size × size; in pieces afterwards
void eliminate(std::vector<double>& a, std::vector<double>& b) {
  const std::size_t size = b.size();
  const auto at = [&](std::size_t row, std::size_t column) -> double& {
    return a[row * size + column];
  };
  double largest = 0.0;
  for (const double entry : a) largest = std::max(largest, std::abs(entry));
  std::vector<std::size_t> pivot_of(size, size);  // of a column: the row that has it
  std::vector<bool> used(size, false);
  for (std::size_t column = 0; column < size; ++column) {
    std::size_t best = size;
    for (std::size_t row = 0; row < size; ++row) {
      if (used[row]) continue;
      if (best == size || std::abs(at(row, column)) > std::abs(at(best, column))) best = row;
    }
    if (best == size || std::abs(at(best, column)) < 1e-10 * largest) continue;
    used[best] = true;
    pivot_of[column] = best;
    for (std::size_t row = 0; row < size; ++row) {
      if (row == best || at(row, column) == 0.0) continue;
      const double factor = at(row, column) / at(best, column);
      for (std::size_t k = column; k < size; ++k) at(row, k) -= factor * at(best, k);
      b[row] -= factor * b[best];
    }
  }
  std::vector<double> x(size, 0.0);
  for (std::size_t column = 0; column < size; ++column) {
    const std::size_t row = pivot_of[column];
    if (row < size) x[column] = b[row] / at(row, column);
  }
  b = x;
}

/// Goes towards where the forces that are at no bound hold what they should, if all others stay at
/// theirs, until one of them comes to its bound. If none does and the others are right, that is the
/// answer.
void leap(std::vector<Pushed>& bodies, std::vector<Row>& rows) {
  struct Place {
    std::size_t row;
    Row::Unknown unknown;
  };
  std::vector<Place> unknowns;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (const auto unknown : {Row::Unknown::kPush, Row::Unknown::kGrip, Row::Unknown::kCouple}) {
      if (rows[i].is_free(unknown)) unknowns.push_back({i, unknown});
    }
  }
  const std::size_t size = unknowns.size();
  if (size == 0 || size > kMostUnknowns) return;
  std::vector<double> wanted(size);
  for (std::size_t i = 0; i < size; ++i) {
    wanted[i] = -rows[unknowns[i].row].residue(unknowns[i].unknown);
  }
  const std::vector<Pushed> before = bodies;
  std::vector<double> effect(size * size);
  for (std::size_t j = 0; j < size; ++j) {
    rows[unknowns[j].row].add(unknowns[j].unknown, 1.0);
    rows[unknowns[j].row].forget();
    for (std::size_t i = 0; i < size; ++i) {
      effect[i * size + j] = rows[unknowns[i].row].residue(unknowns[i].unknown) + wanted[i];
    }
    std::copy(before.begin(), before.end(), bodies.begin());
  }
  eliminate(effect, wanted);
  for (std::size_t j = 0; j < size; ++j) {
    rows[unknowns[j].row].add(unknowns[j].unknown, wanted[j]);
  }
  double part = 1.0;
  for (const Row& row : rows) part = std::min(part, row.possible_part());
  for (Row& row : rows) row.keep(part);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    bodies[i].rate = before[i].rate + part * (bodies[i].rate - before[i].rate);
    bodies[i].spin_rate = before[i].spin_rate + part * (bodies[i].spin_rate - before[i].spin_rate);
  }
}

/// One unknown of the problem of complementarity that contacts are.
struct Column {
  enum class What {
    kForce,  // a push, or a grip or couple towards one side
    kSpeed,  // at which a touch slips or turns on regardless
  };
  std::size_t touch;
  What what;
  Row::Unknown unknown;
  double sign;  // of the force
};

/// The unknowns of a touch: its push, towards either side where it holds; the grips that do not
/// drive its slip on, and its couples; and for each of these pairs what it lets through.
void append_columns(std::size_t index, const Touch& touch, std::vector<Column>& columns) {
  using enum Column::What;
  const auto append = [&](Column::What what, Row::Unknown unknown, double sign) {
    columns.push_back({index, what, unknown, sign});
  };
  append(kForce, Row::Unknown::kPush, 1.0);
  if (touch.holds) append(kForce, Row::Unknown::kPush, -1.0);
  if (touch.friction > 0.0) {
    if (touch.slip <= 0.0) append(kForce, Row::Unknown::kGrip, 1.0);
    if (touch.slip >= 0.0) append(kForce, Row::Unknown::kGrip, -1.0);
    append(kSpeed, Row::Unknown::kGrip, 0.0);
  }
  if (touch.rolling > 0.0 && touch.direction == 0.0) {
    append(kForce, Row::Unknown::kCouple, 1.0);
    append(kForce, Row::Unknown::kCouple, -1.0);
    append(kSpeed, Row::Unknown::kCouple, 0.0);
  }
}

/// Coulomb's law as a problem of complementarity (Stewart & Trinkle 1996), which pivoting solves
/// where sweeps do not: where friction draws a body into a wedge that jams, and in heaps where much
/// is on the verge of slipping.
/// @returns false, with touches as they were, if that ends on a ray
bool guess_by_pivoting(const std::vector<Pushed>& bodies, const std::vector<Column>& columns,
                       std::vector<Touch>& touches) {
  const std::size_t size = columns.size();
  std::vector<Pushed> pushed = bodies;
  std::vector<Touch> guess = touches;
  std::vector<Row> rows;
  rows.reserve(guess.size());
  for (Touch& touch : guess) {
    touch.push = touch.grip = touch.couple = 0.0;
    rows.emplace_back(pushed, touch);
  }
  const auto residues = [&] {
    std::vector<double> result;
    for (const Column& column : columns) {
      const bool is_force = column.what == Column::What::kForce;
      result.push_back(is_force ? column.sign * rows[column.touch].residue(column.unknown) : 0.0);
    }
    return result;
  };
  const std::vector<double> q = residues();
  std::vector<double> m(size * size, 0.0);
  for (std::size_t j = 0; j < size; ++j) {
    const Column& cause = columns[j];
    const bool is_force = cause.what == Column::What::kForce;
    if (is_force) {
      std::copy(bodies.begin(), bodies.end(), pushed.begin());
      rows[cause.touch].apply_alone(cause.unknown, cause.sign);
      const std::vector<double> then = residues();
      for (std::size_t i = 0; i < size; ++i) m[i * size + j] = then[i] - q[i];
    }
    for (std::size_t i = 0; i < size; ++i) {
      const Column& effect = columns[i];
      if (effect.touch != cause.touch || effect.what == cause.what) continue;
      const bool same = effect.unknown == cause.unknown;
      if (!is_force && same) m[i * size + j] = 1.0;
      if (is_force && same) m[i * size + j] = -1.0;
      if (is_force && cause.unknown == Row::Unknown::kPush) {
        m[i * size + j] = cause.sign * rows[cause.touch].most_per_push(effect.unknown);
      }
    }
  }
  const auto z = solve_complementarity(m, q);
  if (!z) return false;
  for (std::size_t i = 0; i < size; ++i) {
    const Column& column = columns[i];
    if (column.what != Column::What::kForce) continue;
    rows[column.touch].note_alone(column.unknown, column.sign * (*z)[i]);
  }
  touches = std::move(guess);
  return true;
}

/// Projected Gauss–Seidel iteration from the touches' first guesses, with leaps.
/// @returns whether nothing changes any more
bool sweep_contacts(std::vector<Pushed>& bodies, std::vector<Touch>& touches, int most_sweeps) {
  double largest = 1e-300;
  for (const Pushed& body : bodies) {
    largest = std::max({largest, body.rate.norm(), std::abs(body.spin_rate) * body.radius});
  }
  std::vector<Row> rows;
  rows.reserve(touches.size());
  for (Touch& touch : touches) {
    largest = std::max(largest, std::abs(touch.normal_offset));
    rows.emplace_back(bodies, touch).apply(touch.push, touch.grip, touch.couple);
  }
  // Up and down in turn: what leans on what is not known.
  double earlier = std::numeric_limits<double>::infinity();  // change, kPatience sweeps ago
  // Sweeps find out soon which forces are at their bounds, and the others late: these are leapt to,
  // and the leap is taken back if the next sweep finds more to change than the one before.
  std::vector<Pushed> bodies_before;
  std::vector<Touch> touches_before;
  double change_before = 0.0;
  double change = 0.0;
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    const bool leaps = sweep % kLeapEvery == 0 && sweep > 0;
    if (leaps) {
      bodies_before = bodies;
      touches_before = touches;
      change_before = change;
      leap(bodies, rows);
    }
    change = 0.0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      change = std::max(change, rows[sweep % 2 == 0 ? i : rows.size() - 1 - i].improve());
    }
    if (change <= kExact * largest) return true;
    if (leaps && !(change < change_before)) {
      std::copy(bodies_before.begin(), bodies_before.end(), bodies.begin());
      std::copy(touches_before.begin(), touches_before.end(), touches.begin());
      change = change_before;
    }
    if (sweep % kPatience != kPatience - 1) continue;
    if (change > 0.5 * earlier) break;  // friction has no answer, or none that it converges to
    earlier = change;
  }
  return false;
}

}  // namespace

void solve_contacts(std::vector<Pushed>& bodies, std::vector<Touch>& touches) {
  const std::vector<Pushed> before = bodies;
  const std::vector<Touch> first_guess = touches;
  const auto begin_again = [&] {
    bodies = before;
    touches = first_guess;
  };
  if (sweep_contacts(bodies, touches, kFewSweeps)) return;
  std::vector<Column> columns;
  for (std::size_t i = 0; i < touches.size(); ++i) append_columns(i, touches[i], columns);
  begin_again();
  if (columns.size() > kMostUnknowns) {
    if (sweep_contacts(bodies, touches, kMostSweeps) || columns.size() > kMostPivoted) return;
    begin_again();
  }
  const bool has_guess = guess_by_pivoting(bodies, columns, touches);
  sweep_contacts(bodies, touches, has_guess ? kFewSweeps : kMostSweeps);
}

}  // namespace ghtrack
