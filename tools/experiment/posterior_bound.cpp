#include "tools/experiment/posterior_bound.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <tuple>
#include <utility>

#include "tools/metrics/expected_measurement.hpp"
#include "tools/run/truth_source.hpp"

namespace ghtrack {
namespace {

using Matrix = MotionLaw::Matrix;
using Information = Eigen::Matrix4d;  // of position and velocity

/// How much the errors of a sensor tell of what they are added to, beside normal ones of its
/// covariance: a pair of Student's t (ν + 2) / (ν + 4) (Lange, Little & Taylor 1989), an outlier
/// that says that it is one 1 / scale².
double sharpness(const SensorConfig& sensor) {
  const double p = sensor.outlier_probability;
  const double dof = sensor.student_dof.value_or(0.0);
  const double of_pair = sensor.student_dof ? (dof + 2.0) / (dof + 4.0) : 1.0;
  return of_pair * (1.0 - p + p / (sensor.outlier_scale * sensor.outlier_scale));
}

/// Hᵀ R⁻¹ H of a detection of something at this place.
std::optional<Information> information_of(const SensorConfig& sensor, const TruthState& truth) {
  const std::optional<Detection> detection = noiseless_detection(sensor, truth.position);
  if (!detection) return std::nullopt;
  Information sum = Information::Zero();
  if (detection->measured) {
    const auto h = predicted(detection->measured->model, truth.position, truth.velocity).jacobian;
    const Eigen::MatrixXd sharp = detection->measured->r.inverse();
    sum = h.transpose() * sharp * h;
  } else {
    sum.topLeftCorner<2, 2>() = detection->covariance.inverse();
  }
  return sharpness(sensor) * sum;
}

/// What detections of an object in a scan tell on average over the runs.
class AverageInformation {
 public:
  AverageInformation(const std::vector<const LabelledObject*>& objects,
                     std::span<const SensorConfig> sensors) {
    for (const LabelledObject* object : objects) {
      for (const ObjectScan& scan : object->scans) {
        if (!scan.detection) continue;
        const auto told =
            information_of(sensors[static_cast<std::size_t>(scan.sensor)], scan.truth);
        if (!told) continue;
        auto& [sum, count] = of_scans_[key(*object, scan)];
        sum = count == 0 ? *told : Information(sum + *told);
        ++count;
      }
    }
  }

  Information of(const LabelledObject& object, const ObjectScan& scan) const {
    const auto found = of_scans_.find(key(object, scan));
    if (found == of_scans_.end()) return Information::Zero();
    return found->second.first / found->second.second;
  }

 private:
  using Key = std::tuple<ObjectId, double, int>;
  static Key key(const LabelledObject& object, const ObjectScan& scan) {
    return {object.id, scan.time, scan.sensor};
  }

  std::map<Key, std::pair<Information, int>> of_scans_;
};

/// Goes with a law from scan to scan: times between them that differ by rounding are one.
class Steps {
 public:
  explicit Steps(const MotionLaw& law) : law_(law) {}

  void predict(Matrix& p, double dt) {
    if (!(dt > 0.0)) return;
    if (!(std::abs(dt - dt_) < 1e-9 * dt)) {
      dt_ = dt;
      transition_ = law_.transition(dt);
      noise_ = law_.noise(dt);
    }
    p = (transition_ * p * transition_.transpose() + noise_).eval();
  }

 private:
  const MotionLaw& law_;
  double dt_ = 0.0;
  Matrix transition_, noise_;
};

/// (P⁻¹ + I)⁻¹ = P (1 + I P)⁻¹, for singular P, too.
void correct(Matrix& p, const Information& told) {
  Matrix sum = Matrix::Identity(p.rows(), p.cols());
  sum.topRows<4>() += told * p.topRows<4>();
  p = p * Eigen::PartialPivLU<Matrix>(sum).inverse();
  p = (0.5 * (p + p.transpose())).eval();
}

}  // namespace

std::vector<std::optional<RandomMotion>> random_motions(const WorldScene& scene, Runs runs) {
  const std::vector<Target> targets = spell_out(scene.targets);
  std::map<std::string, const Target*> by_name;
  for (const Target& target : targets) by_name[target.name] = &target;
  const std::vector<ObjectInfo> objects = make_world(scene).objects();
  std::vector<std::optional<RandomMotion>> motions(objects.size());
  for (const ObjectInfo& object : objects) {
    const auto found = by_name.find(object.name);
    if (found == by_name.end() || found->second->released_by) continue;
    std::optional<MotionLaw> law = law_of(found->second->motion, scene.environment);
    if (!law || (law->holds_alone && objects.size() > 1)) continue;
    const bool is_noisy = law->noise(1.0).cwiseAbs().maxCoeff() > 0.0;
    if (is_noisy && runs == Runs::kMany && !scene.compare.fresh_wind) continue;
    if (runs == Runs::kMany && scene.compare.launch) {
      const LaunchScatter& scatter = *scene.compare.launch;
      if (scatter.velocity > 0.0 && !law->takes_any_start) continue;
      for (int axis = 0; axis < 2; ++axis) {
        law->start(axis, axis) += scatter.position * scatter.position;
        law->start(2 + axis, 2 + axis) += scatter.velocity * scatter.velocity;
      }
    }
    if (!is_noisy && law->start.trace() == 0.0) continue;
    motions[static_cast<std::size_t>(object.id)] = {std::move(*law), found->second->appears};
  }
  return motions;
}

std::optional<double> posterior_bound(const std::vector<const LabelledObject*>& objects,
                                      std::span<const SensorConfig> sensors,
                                      std::span<const std::optional<RandomMotion>> motions) {
  const bool all_are_known =
      std::all_of(objects.begin(), objects.end(), [&](const LabelledObject* object) {
        const auto id = static_cast<std::size_t>(object->id);
        return id < motions.size() && motions[id].has_value();
      });
  if (objects.empty() || !all_are_known) return std::nullopt;
  const AverageInformation told(objects, sensors);
  Mean squares;
  for (const LabelledObject* object : objects) {
    const RandomMotion& motion = *motions[static_cast<std::size_t>(object->id)];
    Steps steps(motion.law);
    Matrix p = motion.law.start;
    double before = motion.appears;
    visit_judged(
        *object,
        [&](const ObjectScan& scan, double) {
          steps.predict(p, scan.time - before);
          before = scan.time;
          if (scan.detection) correct(p, told.of(*object, scan));
        },
        [&](const ObjectScan&) { squares.add(p.topLeftCorner<2, 2>().trace()); });
  }
  return squares.root();
}

}  // namespace ghtrack
