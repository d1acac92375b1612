#pragma once

#include "tracker/boxes/box.hpp"
#include "tracker/filters/axis_covariance.hpp"

namespace ghtrack {

/// What a filter of boxes takes for granted: variances in units of the box. A length is a multiple
/// of the box's scale, the root of its area; a size is a share of width or height; time counts
/// images.
struct BoxNoise {
  double place = 0.0;       // of a seen centre, per axis
  double size = 0.0;        // of a seen width and height
  double velocity = 0.0;    // of an object seen once, per axis
  double manoeuvre = 0.0;   // of the change of the velocity in one image
  double size_drift = 0.0;  // of the change of width and height in one image
  double usual = 1.0;       // of a usual box, as a share of `place` and `size`, which have room
                            // for those of objects that are hidden in part
};

/// Where a box is, how it moves, and how well that is known: a Kalman filter whose axes share one
/// covariance, so that its gains are those of a g-h filter that widens with every miss.
struct BoxEstimate {
  BoundingBox box;
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  // [pixel per image]
  AxisCovariance<double> motion{};  // of centre and velocity on one axis [scale², per image]
  double size_variance = 0.0;       // of width and height, relative

  bool is_finite() const;
};

BoxEstimate begin_estimate(const BoxNoise& noise, const BoundingBox& seen);

/// Constant velocity and size during dt images.
/// @param spread  what the manoeuvres of dt images add, process_noise() of noise.manoeuvre
void predict(const BoxNoise& noise, const AxisCovariance<double>& spread, double dt,
             BoxEstimate& estimate);

/// A seen box beside the predicted one.
struct BoxResidual {
  Eigen::Vector2d place;  // seen − predicted centre [pixel]
  Eigen::Vector2d size;   // (seen − predicted) / predicted width and height
  double
      place_distance;  // squared, in variances: |place|² / (scale² (P + R)), 2 degrees of freedom
  double size_distance;  // the same of the sizes

  double distance() const { return place_distance + size_distance; }  // squared
};

BoxResidual residual(const BoxNoise& noise, const BoxEstimate& estimate, const BoundingBox& seen);

/// Takes a seen box in. Errors of a detector last for several images: half as much again is added
/// to their variance, so that the velocity does not follow them. @ingroup boxes
void correct(const BoxNoise& noise, const BoxResidual& residual, BoxEstimate& estimate);

}  // namespace ghtrack
