#pragma once

#include <vector>

#include "sim/contact_forces.hpp"
#include "sim/encounter/crowd.hpp"

namespace ghtrack::encounter {

/// Bodies that are pressed together, and all that they touch.
struct Heap {
  std::vector<int> bodies;  // ascending
  std::vector<int> place;   // of each round body among these; −1: moves alone
  std::vector<Pair> pairs;
  std::vector<Touch> touches;   // of the pairs; pushes are first guesses
  std::vector<double> turning;  // signs of the bodies' spins

  bool holds(int body) const { return place[at(body)] >= 0; }
  std::size_t index(int body) const { return at(place[at(body)]); }
};

/// These pairs and their bodies.
Heap heap_of(const Crowd& crowd, const Instant& now, std::vector<Pair> pairs);

/// All that touches and moves against each other at no more than this speed [m/s]; without a limit
/// also what touches surfaces alone.
Heap touching(const Crowd& crowd, const Instant& now, double speed);

/// Marks the round bodies of a pair.
void involve(const Pair& pair, std::vector<bool>& involved);

std::vector<FlightState> states_of(const Crowd& crowd, const Instant& now, const Heap& heap);

/// A heap's bodies for solve_contacts(), without rates.
std::vector<Pushed> pushed_by(const Crowd& crowd, const Heap& heap);

/// Rates of a heap's bodies under all forces; the heap keeps the pushes as the next first guess.
std::vector<FlightRate> rates(const Crowd& crowd, const Instant& now, Heap& heap);

/// One common Runge–Kutta step, to the time of its end.
/// @returns the heap with the pushes at its end
Heap move_heap(const Crowd& crowd, const Instant& start, Instant& end, Heap heap);

/// Moves bodies that press each other back to touching, the lighter ones more: the error of the
/// step. Overlaps go before gaps.
void close_gaps(const Crowd& crowd, std::vector<FlightState>& states, const Heap& heap,
                const std::vector<Passer>& passing);

/// Contacts do no work, and friction less than none: what a step's error has added is taken back.
void keep_energy(const Crowd& crowd, const std::vector<FlightState>& before,
                 std::vector<FlightState>& after, const Heap& heap, double from, double to);

/// Keeps what the truth says of bodies that lean on others, and brings to rest what hardly moves.
void note_leaning(const Crowd& crowd, Instant& now, Heap heap);

}  // namespace ghtrack::encounter
