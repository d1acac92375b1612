#pragma once

#include <cstddef>

namespace ghtrack {

/// How a target changes between the modes that filters assume: a Markov chain in continuous time,
/// from each mode to all others alike. It also says when its transitions are to be carried out.
///
/// A filter that carries them out makes one state of several. Just after a measurement that costs
/// nothing, as all modes know the place alike. Halfway to the next one nimble modes know it badly,
/// and spoil what a steady mode knows: other sensors that measure there worse, or see nothing,
/// would make the estimate worse. So transitions wait for a measurement as good as a nominal one,
/// or after which the mode that knows the position least knows it as well as when they were last
/// carried out; less well the longer that is ago, by a factor of two in three nominal intervals.
class ModeChain {
 public:
  /// @param switching  probability that the target changes its mode in one nominal interval
  /// @param interval   the nominal one [s], > 0
  /// @param sigma      1-sigma error of a nominal measurement, per axis [m]
  /// @param axes       that a position has
  /// @throws std::invalid_argument without a mode, or unless 0 ≤ switching ≤ 1/2
  ModeChain(std::size_t modes, double switching, double interval, double sigma, int axes);

  /// At first sight.
  /// @param variance  the largest that a mode takes the position to have, summed over the axes [m²]
  void start(double variance);
  void predict(double dt) { elapsed_ += dt; }
  /// A measurement has been used.
  /// @param variance  as above, after it
  /// @param error     variance of the measurement, summed over the axes [m²]; infinite where it is
  ///                  not one of the position
  void update(double variance, double error);

  /// Since the last measurement [s].
  double elapsed() const { return elapsed_; }
  bool is_due() const { return is_due_; }
  /// Probability that the target has left its mode since transitions were last carried out; 0 while
  /// they wait.
  double leaving() const;
  /// The same at the last measurement.
  double has_left() const { return has_left_; }

 private:
  double modes_;
  double switching_;
  double interval_;
  double nominal_;  // variance of a measurement, summed over the axes [m²]
  double elapsed_ = 0.0;
  double waiting_ = 0.0;  // time before that without transitions [s]
  double variance_;       // that makes them due [m²]
  double has_left_;
  bool is_due_ = true;
};

}  // namespace ghtrack
