#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tools/record/mot_file.hpp"

namespace ghtrack {

/// How a detector of people errs. Every box has a quality, which falls with occlusion and distance
/// and wanders slowly for each person; what is below the threshold is not reported.
struct Detector {
  std::string name;
  double base;          // quality of a person in full view
  double occlusion;     // quality that full occlusion costs
  double threshold;     // of reported qualities
  double place_error;   // 1-sigma, in scales: as much of it lasts as is new in every image
  double size_error;    // 1-sigma, relative
  int false_places;     // of the background that look like people, now and then
  double clutter;       // expected false boxes elsewhere in an image
  double second_boxes;  // probability of a second box on the same person
  bool is_probability;  // whether the confidence is one, or the quality itself
  double strict;        // confidence of those who threshold
};

/// Three detectors like those of MOT17: real-valued confidences and many errors, probabilities and
/// fewer errors, probabilities and few errors.
const std::vector<Detector>& detectors();

enum class CameraMotion { kStill, kShaken, kPanning };

/// People on a street, in perspective, who hide each other.
struct StreetScene {
  int frames = 0;
  std::vector<MotRow> truth;       // by frame; everybody, hidden or not
  std::vector<MotRow> detections;  // by frame
};

StreetScene street_scene(const Detector& detector, CameraMotion camera, double frame_rate,
                         std::uint32_t seed);

}  // namespace ghtrack
