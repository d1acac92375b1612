#include <vector>

#include "sim/regimes/train.hpp"

namespace ghtrack {
namespace {

struct Row {
  std::string_view stock;
  int cars;
  double car_length;     // [m]
  double mass;           // [kg]
  double rotating_mass;  // factor
  double davis_a;        // [N]
  double davis_b;        // [N s/m]
  double davis_c;        // [N s²/m²]
  double max_force;      // [N]
  double max_power;      // [W]
  double adhesive_mass;  // [kg]
  double service_brake;  // [m/s²]
  double service_build_up;
  double emergency_brake;
  double emergency_build_up;
};

// Mass, rotating mass and brakes as in SUMO's MSCFModel_Rail (DLR); the Davis coefficients are
// least-squares fits to its resistance tables, exact within 0.5 kN. Freight: AAR-modified Davis
// formula, 6.5 + 320/wn + 0.046 V + 0.096 V²/(wn) N/t, for 18 four-axle cars of 80 t. Lengths,
// powers and adhesive masses are the operators' rounded figures; build-up times are typical. The
// ideal train, for exercises, does at once what its driver says and nothing holds it back.
constexpr Row kRows[] = {
    {"ICE3", 8, 25.0, 420e3, 1.04, 7396.1, 51.9, 8.697, 300e3, 8.0e6, 210e3, 0.5, 3.0, 1.0, 1.5},
    {"ICE1", 14, 25.6, 876e3, 1.10, 10679.0, 553.7, 15.34, 400e3, 9.6e6, 160e3, 0.5, 3.0, 1.0, 1.5},
    {"RB425", 4, 16.9, 138e3, 1.04, 2617.3, 79.95, 6.3329, 150e3, 2.35e6, 105e3, 0.9, 2.0, 1.2,
     1.0},
    {"RB628", 2, 23.2, 72.2e3, 1.04, 1289.0, 47.35, 5.699, 60e3, 0.485e6, 28e3, 0.7, 3.0, 1.0, 1.5},
    {"RE", 7, 26.0, 425.5e3, 1.10, 8429.0, 125.1, 13.26, 300e3, 5.6e6, 84e3, 0.6, 4.0, 0.9, 2.0},
    {"freight", 18, 16.5, 1440e3, 1.06, 15120.0, 238.464, 22.39488, 300e3, 5.6e6, 84e3, 0.3, 10.0,
     0.5, 5.0},
    {"ideal", 1, 25.0, 100e3, 1.0, 0.0, 0.0, 0.0, 10e6, 1e9, 100e6, 5.0, 0.0, 5.0, 0.0},
};

Train to_train(const Row& row) {
  Train train;
  train.stock = row.stock;
  train.cars = row.cars;
  train.car_length = row.car_length;
  train.mass = row.mass;
  train.rotating_mass = row.rotating_mass;
  train.davis_a = row.davis_a;
  train.davis_b = row.davis_b;
  train.davis_c = row.davis_c;
  if (row.davis_a == 0.0) train.curve_resistance = 0.0;
  train.max_force = row.max_force;
  train.max_power = row.max_power;
  train.adhesive_mass = row.adhesive_mass;
  train.service_brake = row.service_brake;
  train.service_brake_build_up = row.service_build_up;
  train.emergency_brake = row.emergency_brake;
  train.emergency_brake_build_up = row.emergency_build_up;
  return train;
}

}  // namespace

std::span<const Train> Train::presets() {
  static const std::vector<Train> rows = [] {
    std::vector<Train> trains;
    for (const Row& row : kRows) trains.push_back(to_train(row));
    return trains;
  }();
  return rows;
}

}  // namespace ghtrack
