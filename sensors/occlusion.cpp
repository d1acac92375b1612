#include "sensors/occlusion.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "sim/plane.hpp"

namespace ghtrack {
namespace {

constexpr int kPoints = 500;

// Multiples of the inverse of the plastic number, the real root of x³ = x + 1, and of its square
// spread more evenly over a square than a grid does for slanted edges (Roberts 2018, sequence R2).
constexpr double kPlastic = 0.7548776662466927;

double fraction(double x) { return x - std::floor(x); }

/// The outline of a rigid part where it is now.
class Shape {
 public:
  Shape(const BodyPose& body, const Outline& outline)
      : centre_(body.position),
        is_box_(outline.shape == Outline::Shape::kBox),
        half_(0.5 * Vec2(outline.length, is_box_ ? outline.width : outline.length)) {
    if (!is_box_) return;
    along_ = direction(body.angle);
  }

  double reach() const { return is_box_ ? half_.norm() : half_.x(); }
  const Vec2& centre() const { return centre_; }

  bool covers(const Vec2& point) const {
    const Vec2 local = to_local(point - centre_);
    return is_box_ ? (local.cwiseAbs().array() <= half_.array()).all()
                   : local.squaredNorm() <= half_.x() * half_.x();
  }

  /// Points spread evenly over the shape.
  std::vector<Vec2> points() const {
    std::vector<Vec2> points;
    const Vec2 across = left_of(along_);
    for (int i = 1; i <= kPoints; ++i) {
      const double x = half_.x() * (2.0 * fraction(i * kPlastic) - 1.0);
      const double y = half_.y() * (2.0 * fraction(i * kPlastic * kPlastic) - 1.0);
      const Vec2 point = centre_ + x * along_ + y * across;
      if (covers(point)) points.push_back(point);
    }
    return points;
  }

 private:
  Vec2 to_local(const Vec2& offset) const { return {offset.dot(along_), cross(along_, offset)}; }

  Vec2 centre_;
  bool is_box_;
  Vec2 half_;  // half its length and width
  Vec2 along_ = Vec2::UnitX();
};

bool is_part_of(const std::string& object, const std::string& target) {
  return object == target || object.rfind(target + " car ", 0) == 0;
}

/// By object id: 0 is nearest.
std::vector<std::size_t> depths(const std::vector<ObjectInfo>& objects,
                                const std::vector<std::string>& nearest_first) {
  std::vector<std::size_t> depths(objects.size());
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const auto named =
        std::find_if(nearest_first.begin(), nearest_first.end(),
                     [&](const std::string& name) { return is_part_of(objects[i].name, name); });
    depths[i] = static_cast<std::size_t>(named - nearest_first.begin());
    if (named == nearest_first.end()) depths[i] += objects.size() - i;
  }
  return depths;
}

double covered_fraction(const Shape& shape, const std::vector<const Shape*>& nearer) {
  const std::vector<Vec2> points = shape.points();
  const auto covered = std::count_if(points.begin(), points.end(), [&](const Vec2& point) {
    return std::any_of(nearer.begin(), nearer.end(),
                       [&](const Shape* other) { return other->covers(point); });
  });
  return static_cast<double>(covered) / static_cast<double>(points.size());
}

}  // namespace

std::vector<double> covered_fractions(const TruthSnapshot& truth,
                                      const std::vector<ObjectInfo>& objects,
                                      const std::vector<std::string>& nearest_first) {
  const std::vector<std::size_t> depth = depths(objects, nearest_first);
  std::vector<Shape> shapes;
  for (const BodyPose& body : truth.bodies) {
    shapes.emplace_back(body, objects[static_cast<std::size_t>(body.id)].outline);
  }
  std::vector<double> fractions(objects.size(), 0.0);
  std::vector<int> parts(objects.size(), 0);
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const auto object = static_cast<std::size_t>(truth.bodies[i].id);
    std::vector<const Shape*> nearer;
    for (std::size_t j = 0; j < shapes.size(); ++j) {
      const double reach = shapes[i].reach() + shapes[j].reach();
      if (depth[static_cast<std::size_t>(truth.bodies[j].id)] < depth[object] &&
          (shapes[i].centre() - shapes[j].centre()).squaredNorm() < reach * reach) {
        nearer.push_back(&shapes[j]);
      }
    }
    ++parts[object];
    if (!nearer.empty()) fractions[object] += covered_fraction(shapes[i], nearer);
  }
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (parts[i] > 1) fractions[i] /= parts[i];  // they have the same outline
  }
  return fractions;
}

}  // namespace ghtrack
