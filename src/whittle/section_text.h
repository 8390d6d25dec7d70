// Sections as a command line has them.
#pragma once

#include <string_view>

#include "base/result.h"
#include "model/section.h"

namespace whittle {

/// Planes of one section, at most.
inline constexpr size_t kMostSectionPlanes = 16;

/// Reads terms with commas between them: `x>1` is what is to be taken away, `x=1` is the side that
/// looks at the default camera (greater x, lesser y, greater z). In place of x, y and z there may
/// be any direction: `n=[1,1,0],d=3` is the plane where n.p = 3, with n as long as it stands there.
/// Of several terms what all of them say is taken away: `x>0,y<0` is a quarter. Anything else is a
/// kUsage error: numbers that are not finite, a direction of no length, a plane beyond
/// kFarthestSection, more than kMostSectionPlanes planes.
Result<Section> parse_section(std::string_view text);

}  // namespace whittle
