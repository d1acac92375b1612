#include "sim/random.hpp"

#include <Random123/philox.h>

#include <cmath>

#include "sim/portable_math.hpp"

namespace ghtrack {
namespace {

std::uint32_t low(std::uint64_t x) { return static_cast<std::uint32_t>(x); }
std::uint32_t high(std::uint64_t x) { return static_cast<std::uint32_t>(x >> 32); }

std::array<std::uint32_t, 4> philox(const std::array<std::uint32_t, 4>& counter,
                                    const std::array<std::uint32_t, 2>& key) {
  const r123::Philox4x32::ctr_type c{{counter[0], counter[1], counter[2], counter[3]}};
  const r123::Philox4x32::key_type k{{key[0], key[1]}};
  const r123::Philox4x32::ctr_type out = r123::Philox4x32{}(c, k);
  return {out[0], out[1], out[2], out[3]};
}

constexpr double kTwoToMinus53 = 0x1p-53;

}  // namespace

Stream::Stream(std::uint64_t seed, Purpose purpose, std::uint64_t object_key, std::uint64_t step) {
  // 224 bits name a stream, 192 fit into Philox: the seed ciphers (object, purpose), whose image
  // becomes the key and a quarter of the counter for the blocks of this step.
  const std::array<std::uint32_t, 4> name =
      philox({low(object_key), high(object_key), static_cast<std::uint32_t>(purpose), 0x67687472},
             {low(seed), high(seed)});
  key_ = {name[0], name[1]};
  counter_ = {0, low(step), high(step), name[2]};
}

std::uint64_t Stream::bits() {
  if (used_ == 2) {
    const std::array<std::uint32_t, 4> words = philox(counter_, key_);
    ++counter_[0];
    block_ = {(std::uint64_t{words[1]} << 32) | words[0],
              (std::uint64_t{words[3]} << 32) | words[2]};
    used_ = 0;
  }
  return block_[static_cast<std::size_t>(used_++)];
}

double Stream::uniform() { return static_cast<double>(bits() >> 11) * kTwoToMinus53; }

double Stream::normal() {
  if (has_spare_) {
    has_spare_ = false;
    return spare_normal_;
  }
  const double radius = std::sqrt(2.0 * exponential());
  const portable::SinCos direction = portable::sin_cos_of_turns(uniform());
  spare_normal_ = radius * direction.sin;
  has_spare_ = true;
  return radius * direction.cos;
}

double Stream::exponential() { return -portable::log(1.0 - uniform()); }

int Stream::poisson(double mean) {
  int events = 0;
  for (double time = exponential(); time < mean; time += exponential()) ++events;
  return events;
}

double Stream::student_t(double dof) {
  const double excess = portable::exp(exponential() * 2.0 / dof) - 1.0;
  const portable::SinCos direction = portable::sin_cos_of_turns(uniform());
  return std::sqrt(dof * excess) * direction.cos;
}

}  // namespace ghtrack
