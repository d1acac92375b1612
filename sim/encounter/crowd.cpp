#include "sim/encounter/crowd.hpp"

#include <algorithm>
#include <cmath>

#include "sim/plane.hpp"

namespace ghtrack::encounter {

Crowd::Crowd(const std::vector<Participant>& yielding, const std::vector<Participant>& passing,
             const Environment& environment, double from, double to)
    : yielding_(yielding), passing_(passing), environment_(environment), from_(from), to_(to) {
  for (const Participant& one : yielding) bodies_.push_back(one.mover->round());
  first_passers_ = passers_after(0.0);
  last_passers_ = to > from ? passers_after(to - from) : first_passers_;
  find_pairs();
}

Instant Crowd::start() const {
  Instant start{from_, {}, passers_at(from_)};
  for (const Participant& one : yielding_) start.round.push_back(one.state);
  return start;
}

std::vector<Passer> Crowd::passers_after(double duration) const {
  std::vector<Passer> result;
  for (const Participant& one : passing_) {
    Mover::State state = one.state;
    const double time = from_ + duration;
    if (duration > 0.0) one.mover->advance(state, environment_, from_, time, nullptr);
    const int object = one.mover->objects() > 1 ? one.part : 0;
    result.push_back({one.mover->body(state, one.part),
                      one.mover->kinematics(state, environment_, time, object).acceleration});
  }
  return result;
}

std::vector<Passer> Crowd::passers_at(double time) const {
  if (time <= from_) return first_passers_;
  if (time >= to_) return last_passers_;
  const double step = to_ - from_;
  const double f = (time - from_) / step;
  const double g = 1.0 - f;
  std::vector<Passer> result = first_passers_;
  for (std::size_t i = 0; i < result.size(); ++i) {
    const Passer& before = first_passers_[i];
    const Passer& after = last_passers_[i];
    Passer& there = result[i];
    const Vec2 way = after.body.position - before.body.position;
    there.body.position = before.body.position + f * f * (1.0 + 2.0 * g) * way +
                          step * f * g * (g * before.body.velocity - f * after.body.velocity);
    there.body.velocity = 6.0 * f * g / step * way + g * (1.0 - 3.0 * f) * before.body.velocity +
                          f * (1.0 - 3.0 * g) * after.body.velocity;
    there.body.angle = g * before.body.angle + f * after.body.angle;
    there.body.spin = g * before.body.spin + f * after.body.spin;
    there.acceleration = g * before.acceleration + f * after.acceleration;
  }
  return result;
}

Gap Crowd::gap_to_passer(const RigidBody& one, double radius, const Passer& passer,
                         const Outline& outline) const {
  const RigidBody& body = passer.body;
  const Vec2 apart = one.position - body.position;
  const Contact contact = contact_with_outline(one.position, body.position, body.angle, outline);
  const Vec2 arm = apart - contact.distance * contact.normal;
  return {contact.normal, contact.distance - radius, contact.curvature,
          body.velocity + body.spin * left_of(arm), passer.acceleration};
}

Gap Crowd::gap(const RigidBody& one, const RigidBody& other_round, const Pair& pair,
               const std::vector<Passer>& passing) const {
  const double radius = bodies_[at(pair.one)].radius;
  if (pair.kind == Partner::kRound) {
    const Contact contact =
        contact_with_disc(one.position - other_round.position, bodies_[at(pair.other)].radius);
    return {contact.normal, contact.distance - radius, contact.curvature, other_round.velocity,
            Vec2::Zero()};
  }
  if (pair.kind == Partner::kPassing) {
    return gap_to_passer(one, radius, passing[at(pair.other)],
                         passing_[at(pair.other)].mover->contact().outline);
  }
  const Contact contact = environment_.surfaces()[at(pair.other)].contact(one.position);
  return {contact.normal, contact.distance - radius, contact.curvature};
}

Gap Crowd::gap(const Instant& now, const Pair& pair) const {
  const RigidBody one = body_of(now, pair.one);
  const RigidBody other = pair.kind == Partner::kRound ? body_of(now, pair.other) : RigidBody{};
  return gap(one, other, pair, now.passing);
}

double Crowd::parting(const Instant& now, const Pair& pair, const Gap& gap) const {
  return gap.normal.dot(body_of(now, pair.one).velocity - gap.velocity);
}

double Crowd::restitution_of(const Pair& pair) const {
  const RoundBody& one = bodies_[at(pair.one)];
  if (pair.kind == Partner::kSurface) {
    return environment_.surfaces()[at(pair.other)].restitution.value_or(one.restitution);
  }
  const double other = pair.kind == Partner::kRound
                           ? bodies_[at(pair.other)].restitution
                           : passing_[at(pair.other)].mover->contact().restitution;
  return std::sqrt(one.restitution * other);
}

double Crowd::friction_of(const Pair& pair) const {
  const RoundBody& one = bodies_[at(pair.one)];
  if (pair.kind == Partner::kSurface) {
    return environment_.surfaces()[at(pair.other)].friction.value_or(one.friction);
  }
  const double other = pair.kind == Partner::kRound
                           ? bodies_[at(pair.other)].friction
                           : passing_[at(pair.other)].mover->contact().friction;
  return std::sqrt(one.friction * other);
}

double Crowd::rolling_of(const Pair& pair) const {
  if (pair.kind != Partner::kSurface) return 0.0;
  return environment_.surfaces()[at(pair.other)].rolling.value_or(bodies_[at(pair.one)].rolling);
}

void Crowd::find_pairs() {
  const double duration = to_ - from_;
  std::vector<RigidBody> round;
  double fastest = 0.0;
  for (const Participant& one : yielding_) {
    round.push_back(one.mover->body(one.state, 0));
    fastest = std::max(fastest, round.back().velocity.norm());
  }
  for (const Passer& passer : passers_at(from_)) {
    fastest = std::max(fastest, passer.body.velocity.norm());
  }
  // An impact can double a speed; the constant is for what begins at rest.
  const double reach = 4.0 * (fastest + 1.0) * duration + 0.05;
  const auto may_meet = [](const Participant& a, const Participant& b) {
    return a.owner != b.owner && a.carrier != b.owner && b.carrier != a.owner;
  };
  const int count = size();
  for (int i = 0; i < count; ++i) {
    for (int j = i + 1; j < count; ++j) {
      const Vec2 apart = round[at(j)].position - round[at(i)].position;
      const double far = bodies_[at(i)].radius + bodies_[at(j)].radius + reach;
      if (apart.squaredNorm() > far * far || !may_meet(yielding_[at(i)], yielding_[at(j)])) {
        continue;
      }
      pairs_.push_back({i, Partner::kRound, j});
    }
    for (int k = 0; k < static_cast<int>(passing_.size()); ++k) {
      if (may_meet(yielding_[at(i)], passing_[at(k)])) pairs_.push_back({i, Partner::kPassing, k});
    }
    for (int s = 0; s < static_cast<int>(environment_.surfaces().size()); ++s) {
      const Contact contact = environment_.surfaces()[at(s)].contact(round[at(i)].position);
      if (contact.distance <= bodies_[at(i)].radius + reach) {
        surface_pairs_.push_back({i, Partner::kSurface, s});
      }
    }
  }
}

}  // namespace ghtrack::encounter
