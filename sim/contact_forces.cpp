#include "sim/contact_forces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ghtrack {
namespace {

constexpr int kPatience = 100;    // sweeps in which the change must halve
constexpr double kExact = 1e-11;  // of the largest rate

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
};

}  // namespace

void solve_contacts(std::vector<Pushed>& bodies, std::vector<Touch>& touches, int most_sweeps) {
  double largest = 1e-300;
  for (const Pushed& body : bodies) {
    largest = std::max({largest, body.rate.norm(), std::abs(body.spin_rate) * body.radius});
  }
  std::vector<Row> rows;
  rows.reserve(touches.size());
  for (Touch& touch : touches) {
    rows.emplace_back(bodies, touch).apply(touch.push, touch.grip, touch.couple);
  }
  // Up and down in turn: what leans on what is not known.
  double earlier = std::numeric_limits<double>::infinity();  // change, kPatience sweeps ago
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    double change = 0.0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      change = std::max(change, rows[sweep % 2 == 0 ? i : rows.size() - 1 - i].improve());
    }
    if (change <= kExact * largest) break;
    if (sweep % kPatience != kPatience - 1) continue;
    if (change > 0.5 * earlier) break;  // friction has no answer, or none that it converges to
    earlier = change;
  }
}

}  // namespace ghtrack
