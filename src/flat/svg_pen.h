// Draws what SVG describes as corners: OpenSCAD's steps along curves, OpenSCAD's strokes.
#pragma once

#include <string_view>
#include <vector>

#include "flat/polygons.h"

namespace whittle {

enum class SvgCap { kButt, kRound, kSquare };

struct SvgStroke {
  double width = 1;
  SvgCap cap = SvgCap::kSquare;
};

/// Contours of one shape. What is closed, or ends within 0.1 of where it began, is an area; what is
/// open is the area of its stroke.
class SvgPen {
 public:
  /// It stops drawing, and is full, beyond `most_corners`.
  SvgPen(SvgStroke stroke, size_t most_corners) : stroke_(stroke), left_(most_corners) {}

  Vec2 at() const { return at_; }

  void move_to(Vec2 to);
  void line_to(Vec2 to);
  void quadratic_to(Vec2 control, Vec2 to);
  void cubic_to(Vec2 first, Vec2 second, Vec2 to);
  struct Arc {
    Vec2 radii;
    double turn_degrees = 0;
    bool is_large = false, is_positive = false;
  };
  /// SVG 1.1, appendix F.6: radii that are too short grow.
  void arc_to(const Arc& arc, Vec2 to);
  void close();
  /// The end of a path. After a close the last contour is an area even if it is open.
  void end_path();
  /// The end of a line that is never an area.
  void end_line();
  void ellipse(Vec2 center, Vec2 radii);

  const std::vector<Contour>& contours() const { return contours_; }
  std::vector<Contour> take() { return std::move(contours_); }
  bool is_full() const { return is_full_; }

 private:
  void add(Vec2 p);
  void keep(Contour contour);
  void keep_stroke();
  void keep_stroke_if_open();

  SvgStroke stroke_;
  size_t left_;
  bool is_full_ = false, was_closed_ = false;
  Vec2 at_;
  Contour contour_;
  std::vector<Contour> contours_;
};

/// Draws the `d` of a path, as far as it is understood.
void draw_svg_path(std::string_view data, SvgPen& pen);

}  // namespace whittle
