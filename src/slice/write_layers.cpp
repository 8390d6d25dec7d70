#include "slice/write_layers.h"

#include <fmt/format.h>

#include <utility>

#include "base/append_number.h"
#include "flat/write_drawing.h"

namespace whittle {

std::string write_layers(std::span<const SlicedLayer> layers, const Rect& page) {
  SvgWriter writer(page, "Layers");
  for (size_t i = 0; i < layers.size(); ++i) {
    std::string attributes = fmt::format(" id=\"layer{}\" data-z=\"", i);
    append_number(attributes, layers[i].z);
    writer.begin_group(attributes + '"');
    if (!layers[i].loops.empty()) {
      writer.add(layers[i].loops, true,
                 R"( fill="lightgray" fill-rule="evenodd" stroke="black" stroke-width="0.1")");
    }
    writer.end_group();
  }
  return std::move(writer).finish();
}

}  // namespace whittle
