// Models from text in tests, where text that cannot be read is a fault of the test.
#pragma once

#include <string>
#include <string_view>

#include "base/result.h"
#include "csg/read_csg.h"

namespace whittle {

/// The model of `text`; stops the program if there is an error. `name` is for messages.
inline Model model_of(std::string_view text, const std::string& name = "test.csg",
                      const ReadOptions& options = {}) {
  Result<Read> read = read_csg(text, name, options);
  if (!read) std::fprintf(stderr, "%s\n", read.error().message.c_str());
  WHITTLE_CHECK(read);
  return std::move(read->model);
}

/// The same with OpenSCAD's facets for all curves.
inline Model facetted_model_of(std::string_view text) {
  return model_of(text, "test.csg", {.curves = Curves::kFacets});
}

}  // namespace whittle
