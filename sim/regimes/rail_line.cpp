#include "sim/regimes/rail_line.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "sim/plane.hpp"
#include "sim/portable_math.hpp"

namespace ghtrack {
namespace {

constexpr double kSame = 1e-5;  // lines closer than this are one [m]

}  // namespace

// That of the chord of an arc, else Gauss–Legendre with five points on parts that turn by less than
// half a radian.
Vec2 mean_direction(double heading, double curvature, double curvature_rate, double length) {
  constexpr std::array<double, 5> kNodes{-0.9061798459386640, -0.5384693101056831, 0.0,
                                         0.5384693101056831, 0.9061798459386640};
  constexpr std::array<double, 5> kWeights{0.2369268850561891, 0.4786286704993665,
                                           0.5688888888888889, 0.4786286704993665,
                                           0.2369268850561891};
  if (curvature_rate == 0.0) {
    const double half = 0.5 * curvature * length;
    const double shortening =
        std::abs(half) < 1e-4 ? 1.0 - half * half / 6.0 : portable::sin_cos(half).sin / half;
    return shortening * direction(heading + half);
  }
  const double turn =
      (std::abs(curvature) + std::abs(curvature_rate) * std::abs(length)) * std::abs(length);
  const int parts = 1 + static_cast<int>(2.0 * turn);
  Vec2 sum = Vec2::Zero();
  for (int part = 0; part < parts; ++part) {
    for (std::size_t i = 0; i < kNodes.size(); ++i) {
      const double s = length * (part + 0.5 * (1.0 + kNodes[i])) / parts;
      sum += kWeights[i] * direction(heading + s * (curvature + 0.5 * s * curvature_rate));
    }
  }
  return 0.5 * sum / parts;
}

RailLine::RailLine(const std::vector<TrackElement>& elements, const Vec2& origin, double heading) {
  pieces_.push_back({0.0, 0.0, {origin, heading, 0.0}, 0.0});
  double curvature = 0.0;
  for (const TrackElement& element : elements) {
    if (const auto* straight = std::get_if<Straight>(&element)) {
      append(straight->length, 0.0, 0.0);
      curvature = 0.0;
    }
    if (const auto* clothoid = std::get_if<Clothoid>(&element)) {
      const double end = clothoid->radius ? 1.0 / *clothoid->radius : 0.0;
      append(clothoid->length, curvature, end);
      curvature = end;
    }
    if (const auto* curve = std::get_if<Curve>(&element)) {
      const double angle = curve->angle_deg.value_or(0.0) * portable::kDegree;
      const double length = curve->length.value_or(std::abs(angle * curve->radius));
      const double end = std::copysign(1.0, angle) / curve->radius;
      if (curve->transition > 0.0) append(curve->transition, curvature, end);
      append(length, end, end);
      curvature = end;
      if (curve->transition > 0.0) {
        append(curve->transition, end, 0.0);
        curvature = 0.0;
      }
    }
  }
  append(0.0, 0.0, 0.0);  // the endless straight beyond
}

void RailLine::append(double length, double from_curvature, double to_curvature) {
  const Piece& last = pieces_.back();
  Piece piece{length_, length, along(last, last.length), 0.0};
  piece.start.curvature = from_curvature;
  if (length > 0.0) piece.curvature_rate = (to_curvature - from_curvature) / length;
  pieces_.push_back(piece);
  length_ += length;
}

TrackPoint RailLine::along(const Piece& piece, double distance) {
  const double heading = piece.start.heading;
  const double curvature = piece.start.curvature;
  const Vec2 direction = mean_direction(heading, curvature, piece.curvature_rate, distance);
  return {piece.start.position + distance * direction,
          heading + distance * (curvature + 0.5 * distance * piece.curvature_rate),
          curvature + distance * piece.curvature_rate};
}

const RailLine::Piece& RailLine::piece_at(double arc_length) const {
  // The first piece, of no length, is the straight before the beginning.
  const auto after = std::upper_bound(pieces_.begin() + 1, pieces_.end(), arc_length,
                                      [](double s, const Piece& piece) { return s < piece.begin; });
  return *(after - 1);
}

TrackPoint RailLine::at(double arc_length) const {
  const Piece& piece = piece_at(arc_length);
  return along(piece, arc_length - piece.begin);
}

double RailLine::curvature(double arc_length) const {
  const Piece& piece = piece_at(arc_length);
  return piece.start.curvature + (arc_length - piece.begin) * piece.curvature_rate;
}

std::optional<std::pair<double, double>> RailLine::bends() const {
  std::optional<std::pair<double, double>> bends;
  for (const Piece& piece : pieces_) {
    if (piece.start.curvature == 0.0 && piece.curvature_rate == 0.0) continue;
    bends = {bends ? bends->first : piece.begin, piece.begin + piece.length};
  }
  return bends;
}

std::optional<PlaceOnLine> place_on(const RailLine& line, const RailLine& other) {
  const auto bends = line.bends();
  const auto others = other.bends();
  if (bends.has_value() != others.has_value()) return std::nullopt;
  if (!bends) {
    const TrackPoint mine = line.at(0.0);
    const TrackPoint there = other.at(0.0);
    const Vec2 apart = mine.position - there.position;
    const Vec2 along = direction(there.heading);
    const Vec2 forwards = direction(mine.heading);
    if (std::abs(cross(along, apart)) > kSame) return std::nullopt;
    if (std::abs(cross(along, forwards)) > 1e-9) return std::nullopt;
    return PlaceOnLine{along.dot(apart), along.dot(forwards) > 0.0 ? 1.0 : -1.0};
  }
  const double length = bends->second - bends->first;
  if (std::abs(length - (others->second - others->first)) > kSame) return std::nullopt;
  for (const PlaceOnLine& place : {PlaceOnLine{others->first - bends->first, 1.0},
                                   PlaceOnLine{others->second + bends->first, -1.0}}) {
    // Beyond both ends, too.
    constexpr int kParts = 64;
    bool is_same = true;
    for (int i = -1; i <= kParts + 1 && is_same; ++i) {
      const double s = bends->first + length * i / kParts;
      const Vec2 apart = line.at(s).position - other.at(place.begin + place.direction * s).position;
      is_same = apart.norm() <= kSame;
    }
    if (is_same) return place;
  }
  return std::nullopt;
}

double mark_of(const RailLine& line) {
  if (const auto bends = line.bends()) {
    return (line.at(bends->first).position + line.at(bends->second).position).sum();
  }
  const TrackPoint begin = line.at(0.0);
  return std::abs(cross(direction(begin.heading), begin.position));
}

}  // namespace ghtrack
