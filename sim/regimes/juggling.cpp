#include "sim/regimes/juggling.hpp"

namespace ghtrack {

JugglingPattern::JugglingPattern(const Juggling& juggling, const Vec2& from, const Vec2& gravity,
                                 double begin)
    : juggling_(juggling), from_(from), gravity_(gravity), begin_(begin) {}

double JugglingPattern::end_of(int phase) const {
  const int throws = phase / 2;
  const double thrown = begin_ + throws * (juggling_.flight + juggling_.hold);
  return is_flight(phase) ? thrown + juggling_.flight : thrown + juggling_.flight + juggling_.hold;
}

PlanarMotion JugglingPattern::throw_at(int phase) const {
  const bool back = (phase / 2) % 2 == 1;
  const Vec2& here = back ? juggling_.to : from_;
  const Vec2& there = back ? from_ : juggling_.to;
  const Vec2 way = there - here;
  const double distance = way.norm();
  const Vec2 flown = distance > 0.0 ? Vec2((1.0 + juggling_.scoop / distance) * way) : way;
  return {here, flown / juggling_.flight - 0.5 * juggling_.flight * gravity_, gravity_};
}

PlanarMotion Carry::at(double time) const {
  const double duration = end - begin;
  const double f = (time - begin) / duration;
  const double g = 1.0 - f;
  const Vec2 way = thrown.position - caught.position;
  PlanarMotion motion;
  motion.position = g * g * (1.0 + 2.0 * f) * caught.position +
                    f * f * (1.0 + 2.0 * g) * thrown.position +
                    duration * f * g * (g * caught.velocity - f * thrown.velocity);
  motion.velocity = 6.0 * f * g / duration * way + g * (1.0 - 3.0 * f) * caught.velocity +
                    f * (1.0 - 3.0 * g) * thrown.velocity;
  motion.acceleration = (6.0 * (g - f) / duration * way + (6.0 * f - 4.0) * caught.velocity +
                         (6.0 * f - 2.0) * thrown.velocity) /
                        duration;
  return motion;
}

}  // namespace ghtrack
