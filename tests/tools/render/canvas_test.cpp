#include "tools/render/canvas.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/core.hpp>

namespace ghtrack::render {
namespace {

constexpr Color kBlack{0, 0, 0};
constexpr Color kWhite{255, 255, 255};
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

cv::Mat blank(int width = 100, int height = 80) { return cv::Mat::zeros(height, width, CV_8UC3); }

int red(const cv::Mat& image, int x, int y) { return image.at<cv::Vec3b>(y, x)[2]; }

/// Area that was painted white [px²].
double painted_area(const cv::Mat& image) { return cv::sum(image)[0] / 255.0; }

// Derived: the area of a disc is π r².
TEST(Canvas, PaintsAsMuchOfADiscAsItsArea) {
  for (const double radius : {1.5, 4.5, 12.3, 30.0}) {
    cv::Mat image = blank();
    Canvas(image).disc({50.3, 39.8}, radius, kWhite);
    const double area = std::numbers::pi * radius * radius;
    EXPECT_NEAR(painted_area(image), area, 0.02 * area + 0.3) << "radius " << radius;
  }
}

// Derived: the area of a line with round ends is its length times its thickness and a disc.
TEST(Canvas, PaintsAsMuchOfALineAsItsAreaInAnyDirection) {
  for (const double degrees : {0.0, 17.0, 45.0, 80.0, 90.0}) {
    cv::Mat image = blank(200, 200);
    const double angle = degrees * std::numbers::pi / 180.0;
    const Pixel to{20.0 + 120.0 * std::cos(angle), 30.0 + 120.0 * std::sin(angle)};
    Canvas(image).line({20.0, 30.0}, to, kWhite, 3.0);
    const double area = 120.0 * 3.0 + std::numbers::pi * 1.5 * 1.5;
    EXPECT_NEAR(painted_area(image), area, 0.02 * area) << degrees << " degrees";
  }
}

// Derived: the shoelace formula.
TEST(Canvas, PaintsAsMuchOfAConvexPolygonAsItsAreaInBothDirections) {
  std::vector<Pixel> corners{{10.2, 10.7}, {60.4, 14.1}, {70.9, 50.3}, {22.5, 60.6}};
  double area = 0.0;
  for (std::size_t i = 0; i < 4; ++i)
    area += 0.5 * (corners[i].x * corners[(i + 1) % 4].y - corners[(i + 1) % 4].x * corners[i].y);
  cv::Mat image = blank();
  Canvas(image).polygon(corners, kWhite);
  EXPECT_NEAR(painted_area(image), area, 0.005 * area);
  std::reverse(corners.begin(), corners.end());
  cv::Mat reversed = blank();
  Canvas(reversed).polygon(corners, kWhite);
  EXPECT_NEAR(painted_area(reversed), area, 0.005 * area);
}

// Property: a line through points at any distance shows where it crosses the picture.
TEST(Canvas, ClipsLinesThatReachFarBeyondThePicture) {
  for (const double far : {1e3, 1e9, 1e300}) {
    cv::Mat image = blank();
    Canvas(image).line({-far, 40.0}, {far, 40.0}, kWhite, 3.0);
    EXPECT_EQ(red(image, 0, 40), 255) << far;
    EXPECT_EQ(red(image, 99, 40), 255) << far;
    EXPECT_EQ(red(image, 50, 60), 0) << far;
  }
}

// Property: what is not finite or out of sight leaves the picture as it was.
TEST(Canvas, DrawsNothingThatIsNotFiniteOrOutOfSight) {
  cv::Mat image = blank();
  Canvas canvas(image);
  const Font font(Font::Weight::kRegular);
  for (const double bad : {kNan, std::numeric_limits<double>::infinity(), 1e300, -1e12}) {
    canvas.line({bad, 1.0}, {bad, 2.0}, kWhite);
    canvas.polygon({{bad, 0.0}, {bad, 1.0}, {bad, 2.0}}, kWhite);
    canvas.disc({bad, bad}, 4.0, kWhite);
    canvas.ring({bad, 5.0}, 4.0, kWhite);
    canvas.cross({5.0, bad}, 4.0, kWhite);
    canvas.arrow({bad, 1.0}, {bad, 4.0}, 3.0, kWhite);
    canvas.dashed({{bad, 1.0}, {bad, 4.0}}, kWhite, 3.0, 3.0);
    canvas.text(font, U"far", 12, {bad, bad}, kWhite);
  }
  canvas.disc({50.0, 40.0}, kNan, kWhite);
  EXPECT_EQ(painted_area(image), 0.0);
}

// Property: a part of a canvas keeps the picture's coordinates and is not left.
TEST(Canvas, KeepsAPartsDrawingInsideThePart) {
  cv::Mat image = blank();
  constexpr Color kVermillion{213, 94, 0};
  Canvas part = Canvas(image).within({20.0, 10.0, 30.0, 40.0});
  part.fill(kWhite);
  part.line({0.0, 30.0}, {99.0, 30.0}, kVermillion, 3.0);
  EXPECT_EQ(painted_area(image(cv::Rect(0, 0, 20, 80))), 0.0);
  EXPECT_EQ(painted_area(image(cv::Rect(50, 0, 50, 80))), 0.0);
  EXPECT_EQ(red(image, 20, 10), 255);
  EXPECT_EQ(image.at<cv::Vec3b>(30, 35)[0], kVermillion.blue);
}

// Derived: dashes of 6 with gaps of 4 cover six tenths of a line.
TEST(Canvas, DashesCoverTheirShareOfALine) {
  cv::Mat image = blank(1000, 20);
  Canvas(image).dashed({{0.0, 10.0}, {400.0, 10.0}, {1000.0, 10.0}}, kWhite, 6.0, 4.0, 1.0);
  EXPECT_NEAR(painted_area(image), 600.0, 100.0);  // round ends add up to a pixel a dash
  EXPECT_EQ(red(image, 8, 10), 0);
  EXPECT_EQ(red(image, 3, 10), 255);
}

// Property: ink with half opacity leaves half of what is below.
TEST(Canvas, LetsTransparentInkShowWhatIsBelow) {
  cv::Mat image = blank();
  Canvas canvas(image);
  canvas.fill(kWhite);
  canvas.disc({50.0, 40.0}, 10.0, {kBlack, 0.5});
  EXPECT_NEAR(red(image, 50, 40), 127, 1);
}

// Property: a text is as wide as it says, and "…" marks where it was cut.
TEST(Font, MeasuresWhatItDrawsAndCutsWhatDoesNotFit) {
  const Font font(Font::Weight::kRegular);
  const std::u32string text = U"#12 ball 12.4 m/s";
  const int width = font.width(text, 16);
  cv::Mat image = blank(400, 60);
  Canvas(image).text(font, text, 16, {20.0, 40.0}, kWhite);
  EXPECT_GT(painted_area(image), 100.0);
  EXPECT_EQ(painted_area(image(cv::Rect(0, 0, 18, 60))), 0.0);
  EXPECT_EQ(painted_area(image(cv::Rect(22 + width, 0, 378 - width, 60))), 0.0);
  EXPECT_EQ(font.fitted(text, 16, width), text);
  const std::u32string cut = font.fitted(text, 16, width / 2);
  EXPECT_EQ(cut.back(), U'…');
  EXPECT_LE(font.width(cut, 16), width / 2);
}

}  // namespace
}  // namespace ghtrack::render
