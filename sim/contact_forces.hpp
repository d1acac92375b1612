#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/truth.hpp"

namespace ghtrack {

/// What contacts change about a body: its rates, be they accelerations or, at once, velocities.
struct Pushed {
  Vec2 rate = Vec2::Zero();
  double spin_rate = 0.0;
  double inverse_mass = 0.0;     // [1/kg]; 0: does not give way
  double inverse_inertia = 0.0;  // [1/(kg m²)]
  double radius = 0.0;           // [m]
};

/// A touch of two bodies, or of one with something that does not give way.
struct Touch {
  int one = 0;                  // index of a body
  int other = -1;               // of another one; −1: does not give way
  Vec2 normal = Vec2::UnitY();  // from the other to the one
  double friction = 0.0;
  double rolling = 0.0;        // coefficient of rolling resistance
  double direction = 0.0;      // of the one's spin: −1, +1; 0: it does not turn
  double normal_offset = 0.0;  // added to the rate at which the two part
  double slip_offset = 0.0;    // added to the rate of slip
  double slip = 0.0;           // sign of the slip that there is: grip does not drive it on
  bool holds = false;          // keeps the two from parting, too
  double push = 0.0;           // along the normal, ≥ 0 unless it holds; a first guess before
  double grip = 0.0;           // along the surface, towards tangent_to(normal)
  double couple = 0.0;         // of rolling resistance
};

/// The grip between these bounds that is nearest to a wanted one and, where there is slip, does not
/// drive it on: friction never does work.
inline double dissipative(double wanted, double most, double slip) {
  const double lowest = slip < 0.0 ? 0.0 : -most;
  const double highest = slip > 0.0 ? 0.0 : most;
  return std::clamp(wanted, lowest, highest);
}

/// The slip [m/s] as that function wants it: less than a rounding error is none.
inline double noticeable(double slip) { return std::abs(slip) > 1e-6 ? slip : 0.0; }

/// Along the surface, to the right of the normal.
inline Vec2 tangent_to(const Vec2& normal) { return {normal.y(), -normal.x()}; }

/// The least forces (or impulses) that keep all touches from closing, with Coulomb friction
/// |grip| ≤ friction × push that holds against slip, and a couple |couple| ≤ rolling × radius ×
/// push that holds against turning:
///   0 ≤ push ⟂ parting + normal_offset ≥ 0
/// by projected Gauss–Seidel iteration (Jourdan, Alart & Jean 1998), until nothing changes by more
/// than rounding, or so many sweeps were made. Sweeps alone need about n² for a column of n bodies,
/// and as many as the ratio of masses for a light body between heavy ones; so the linear equations
/// of what touches, sticks and slides are solved now and then, and sweeps tell whether that is the
/// answer (Silcowitz, Niebe & Erleben 2010). Where they do not find it, as where friction draws a
/// body into a wedge that jams (a hundred times the impulse that it takes to stop the approach then
/// stops the slip at once), or where light bodies lie among heavy ones, pivoting does; as it takes
/// the cube of the number of unknowns, more sweeps go first where there are many, and it is left
/// out where there are very many. To impulses there is always an answer; to the forces on what
/// slips there may be none, and then these are what the sweeps have come to. The bodies' rates are
/// those with these forces afterwards.
void solve_contacts(std::vector<Pushed>& bodies, std::vector<Touch>& touches);

}  // namespace ghtrack
