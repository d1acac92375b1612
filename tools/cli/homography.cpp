#include "tools/cli/homography.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include "scenes/schema/diagnostic.hpp"
#include "tools/cli/usage_error.hpp"

namespace ghtrack::cli {
namespace {

std::optional<Eigen::Vector2d> parse_pair(std::string_view text) {
  Eigen::Vector2d pair;
  const char* const end = text.data() + text.size();
  const auto [comma, first] = std::from_chars(text.data(), end, pair.x());
  if (first != std::errc{} || comma == end || *comma != ',') return std::nullopt;
  const auto [rest, second] = std::from_chars(comma + 1, end, pair.y());
  const bool is_pair = second == std::errc{} && rest == end && pair.allFinite();
  return is_pair ? std::optional(pair) : std::nullopt;
}

}  // namespace

std::array<GroundPoint, 4> parse_ground_points(const std::vector<std::string>& texts) {
  std::array<GroundPoint, 4> points;
  if (texts.size() != points.size()) {
    throw UsageError(
        fmt::format("--homography needs four points, X,Y=U,V each; there are {}", texts.size()));
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::string_view text = texts[i];
    const std::size_t equals = text.find('=');
    const auto ground = parse_pair(text.substr(0, equals));
    const auto pixel =
        equals == std::string_view::npos ? std::nullopt : parse_pair(text.substr(equals + 1));
    if (!ground || !pixel) {
      throw UsageError(
          fmt::format("--homography: '{}' is not X,Y=U,V: a place and the pixel that shows it",
                      printable(text)));
    }
    points[i] = {*ground, *pixel};
  }
  return points;
}

namespace {

/// Whether three of four points, of the ground or of the picture, span no triangle.
bool has_three_on_a_line(const std::array<GroundPoint, 4>& points,
                         Eigen::Vector2d GroundPoint::*side) {
  constexpr double kFlat = 1e-9;  // of the product of two sides
  for (std::size_t left_out = 0; left_out < 4; ++left_out) {
    const Eigen::Vector2d& corner = points[(left_out + 1) % 4].*side;
    const Eigen::Vector2d a = points[(left_out + 2) % 4].*side - corner;
    const Eigen::Vector2d b = points[(left_out + 3) % 4].*side - corner;
    if (!(std::abs(a.x() * b.y() - a.y() * b.x()) > kFlat * a.norm() * b.norm())) return true;
  }
  return false;
}

}  // namespace

Eigen::Matrix3d homography(const std::array<GroundPoint, 4>& points) {
  // Eight equations u (h₃ · p) = h₁ · p, v (h₃ · p) = h₂ · p for the entries but the last, which is
  // 1; about the first point and in units of the distances, so that no entry is lost to rounding.
  const Eigen::Vector2d middle = points[0].ground;
  double unit = 0.0;
  for (const GroundPoint& point : points) unit = std::max(unit, (point.ground - middle).norm());
  if (!(unit > 0.0)) throw UsageError("--homography: the points are all the same");
  Eigen::Matrix<double, 8, 8> equations;
  Eigen::Matrix<double, 8, 1> values;
  for (int i = 0; i < 4; ++i) {
    const auto& [ground, pixel] = points[static_cast<std::size_t>(i)];
    const Eigen::Vector2d p = (ground - middle) / unit;
    equations.row(2 * i) << p.x(), p.y(), 1, 0, 0, 0, -pixel.x() * p.x(), -pixel.x() * p.y();
    equations.row(2 * i + 1) << 0, 0, 0, p.x(), p.y(), 1, -pixel.y() * p.x(), -pixel.y() * p.y();
    values.segment<2>(2 * i) = pixel;
  }
  if (has_three_on_a_line(points, &GroundPoint::ground)) {
    throw UsageError("--homography: three of the four places are on a line, which leaves it open");
  }
  if (has_three_on_a_line(points, &GroundPoint::pixel)) {
    throw UsageError("--homography: three of the four pixels are on a line, which leaves it open");
  }
  const Eigen::FullPivLU<Eigen::Matrix<double, 8, 8>> solver(equations);
  const Eigen::Matrix<double, 8, 1> h = solver.solve(values);
  Eigen::Matrix3d scaled;
  scaled << h[0], h[1], h[2], h[3], h[4], h[5], h[6], h[7], 1.0;
  Eigen::Matrix3d to_unit;
  to_unit << 1.0 / unit, 0.0, -middle.x() / unit, 0.0, 1.0 / unit, -middle.y() / unit, 0.0, 0.0,
      1.0;
  return scaled * to_unit;
}

Eigen::Vector2d projected(const Eigen::Matrix3d& homography, const Eigen::Vector2d& point) {
  const Eigen::Vector3d image = homography * point.homogeneous();
  if (!(image.z() > 0.0)) {
    constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();
    return {kNowhere, kNowhere};
  }
  return image.hnormalized();
}

}  // namespace ghtrack::cli
