// `$vpt`, `$vpr`, `$vpd` and `$vpf` as a program sets them: a .csg that openscad writes has none of
// them, so openscad is asked to say them while it evaluates the program.
#pragma once

#include <string>
#include <string_view>

#include "model/model.h"

namespace whittle {

/// What openscad is given by -D to make it say all four.
std::string view_question();

/// Which of the four a text assigns where they count: outside of braces, parentheses, comments and
/// strings.
struct AssignedViews {
  bool target = false, rotation = false, distance = false, fov = false;
  bool any() const { return target || rotation || distance || fov; }
};
/// Adds what `text` assigns. Linear in the text.
void find_assigned_views(std::string_view text, AssignedViews& assigned);

/// The answer among what openscad said, of those that are assigned; it goes from the messages. What
/// has not the kind that it must have is not set, as in OpenSCAD. Openscad prints six digits.
FileView take_view(std::string& messages, const AssignedViews& assigned);

}  // namespace whittle
