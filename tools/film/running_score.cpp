#include "tools/film/running_score.hpp"

#include <algorithm>

namespace ghtrack::film {
namespace {

/// Points with the ids of what is there.
struct Places {
  std::vector<int> ids;
  std::vector<Vec2> positions;

  void add(int id, const Vec2& position) {
    ids.push_back(id);
    positions.push_back(position);
  }
  std::optional<Vec2> find(int id) const {
    const auto found = std::find(ids.begin(), ids.end(), id);
    if (found == ids.end()) return std::nullopt;
    return positions[static_cast<std::size_t>(found - ids.begin())];
  }
};

/// Everyone but those for whom `is_taken(id)`.
template <class IsTaken>
Places without(const Places& places, IsTaken is_taken) {
  Places rest;
  for (std::size_t i = 0; i < places.ids.size(); ++i)
    if (!is_taken(places.ids[i])) rest.add(places.ids[i], places.positions[i]);
  return rest;
}

void append(const Places& objects, const Places& tracks, const GospaResult& result,
            std::vector<render::Pairing>& pairings) {
  for (const PointMatch& match : result.matches)
    pairings.push_back({objects.ids[static_cast<std::size_t>(match.truth)],
                        tracks.ids[static_cast<std::size_t>(match.track)], match.distance});
}

}  // namespace

RunningScore::RunningScore(const GospaOptions& options, const std::vector<ObjectInfo>& objects)
    : options_(options) {
  for (const ObjectInfo& object : objects) {
    const auto known = std::find(regimes_.begin(), regimes_.end(), object.regime);
    regime_of_.push_back(static_cast<std::size_t>(known - regimes_.begin()));
    if (known == regimes_.end()) regimes_.push_back(object.regime);
  }
  squared_errors_by_regime_.resize(regimes_.size());
}

std::vector<render::RegimeScore> RunningScore::by_regime() const {
  std::vector<render::RegimeScore> scores;
  if (regimes_.size() < 2) return scores;
  for (std::size_t i = 0; i < regimes_.size(); ++i) {
    scores.push_back({regimes_[i], squared_errors_by_regime_[i].root()});
  }
  return scores;
}

void RunningScore::add(const TruthSnapshot& truth, const TrackSnapshot& snapshot) {
  Places objects;
  for (const TruthState& object : truth.objects) objects.add(object.id, object.position);
  Places tracks;
  for (const TrackEstimate& track : snapshot.tracks)
    if (track.status != TrackStatus::kTentative) tracks.add(track.id, track.position);

  std::vector<render::Pairing> kept;
  for (render::Pairing pairing : pairings_) {
    const auto object = objects.find(pairing.object);
    const auto track = tracks.find(pairing.track);
    if (!object || !track) continue;
    pairing.distance = (*object - *track).norm();
    if (pairing.distance < options_.cutoff) kept.push_back(pairing);
  }
  pairings_ = std::move(kept);
  if (objects.ids.empty() && tracks.ids.empty()) return;

  const GospaResult all = ghtrack::gospa(objects.positions, tracks.positions, options_);
  gospa_.add(all.gospa);
  for (std::size_t i = 0; i < objects.ids.size(); ++i) {
    missed_.add(i < all.matches.size() ? 0.0 : 1.0);
  }
  for (const PointMatch& match : all.matches) {
    const double squared = match.distance * match.distance;
    const auto object =
        static_cast<std::size_t>(objects.ids[static_cast<std::size_t>(match.truth)]);
    squared_errors_.add(squared);
    squared_errors_by_regime_.at(regime_of_.at(object)).add(squared);
  }

  if (pairings_.empty()) return append(objects, tracks, all, pairings_);
  const auto is_paired = [&](int render::Pairing::*member) {
    return [this, member](int id) {
      return std::any_of(pairings_.begin(), pairings_.end(),
                         [&](const render::Pairing& pairing) { return pairing.*member == id; });
    };
  };
  const Places free_objects = without(objects, is_paired(&render::Pairing::object));
  const Places free_tracks = without(tracks, is_paired(&render::Pairing::track));
  append(free_objects, free_tracks,
         ghtrack::gospa(free_objects.positions, free_tracks.positions, options_), pairings_);
}

}  // namespace ghtrack::film
