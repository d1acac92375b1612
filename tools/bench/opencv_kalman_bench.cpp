#include <benchmark/benchmark.h>

#include <opencv2/core.hpp>
#include <opencv2/video/tracking.hpp>
#include <vector>

#include "tools/bench/measurements.hpp"

namespace ghtrack::bench {
namespace {

/// OpenCV's filter with the matrices of constant velocity on two axes, for one object.
void opencv_kalman(benchmark::State& state) {
  cv::KalmanFilter filter(4, 2, 0, CV_64F);
  filter.transitionMatrix = (cv::Mat_<double>(4, 4) << 1, 0, kStep, 0,  //
                             0, 1, 0, kStep,                            //
                             0, 0, 1, 0,                                //
                             0, 0, 0, 1);
  filter.measurementMatrix = cv::Mat::eye(2, 4, CV_64F);
  cv::setIdentity(filter.processNoiseCov, cv::Scalar(0.01));
  cv::setIdentity(filter.measurementNoiseCov, cv::Scalar(1.0));
  cv::setIdentity(filter.errorCovPost, cv::Scalar(1.0));

  const std::vector<double> z = measurements<double>(2);
  const cv::Mat measurement = (cv::Mat_<double>(2, 1) << z[0], z[1]);
  for (auto _ : state) {
    filter.predict();
    benchmark::DoNotOptimize(filter.correct(measurement).data);
  }
  state.counters["updates/s"] =
      benchmark::Counter(1, benchmark::Counter::kIsIterationInvariantRate);
}

BENCHMARK(opencv_kalman)->Name("kalman_cv/opencv");

}  // namespace
}  // namespace ghtrack::bench
