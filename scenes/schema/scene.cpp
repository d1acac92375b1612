#include "scenes/schema/scene.hpp"

namespace ghtrack {

WorldScene::WorldScene() = default;
WorldScene::WorldScene(const WorldScene&) = default;
WorldScene::WorldScene(WorldScene&&) noexcept = default;
WorldScene& WorldScene::operator=(const WorldScene&) = default;
WorldScene& WorldScene::operator=(WorldScene&&) noexcept = default;
WorldScene::~WorldScene() = default;

SeriesScene::SeriesScene() = default;
SeriesScene::SeriesScene(const SeriesScene&) = default;
SeriesScene::SeriesScene(SeriesScene&&) noexcept = default;
SeriesScene& SeriesScene::operator=(const SeriesScene&) = default;
SeriesScene& SeriesScene::operator=(SeriesScene&&) noexcept = default;
SeriesScene::~SeriesScene() = default;

}  // namespace ghtrack
