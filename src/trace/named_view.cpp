#include "trace/named_view.h"

#include "base/result.h"

namespace whittle {
namespace {

/// The angle between a cube's space diagonal and its edges: acos(1 / sqrt(3)).
constexpr double kIsometricTilt = 54.735610317245346;

}  // namespace

Vec3 rotation_of(NamedView view) {
  switch (view) {
    case NamedView::kFront:
      return {90, 0, 0};
    case NamedView::kBack:
      return {90, 0, 180};
    case NamedView::kLeft:
      return {90, 0, 270};
    case NamedView::kRight:
      return {90, 0, 90};
    case NamedView::kTop:
      return {0, 0, 0};
    case NamedView::kBottom:
      return {180, 0, 0};
    case NamedView::kIso:
      return {kIsometricTilt, 0, 45};
  }
  WHITTLE_CHECK(false);
  return {};
}

}  // namespace whittle
